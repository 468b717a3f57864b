#include "actors/judge/design/smoke_race.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "actors/judge/design/smoke_differences.hpp"
#include "scenes/light/transport/compile.hpp"

namespace luxodus {

namespace {

/// Only layouts with equal signs are compared.
bool like_signs(const JudgedLayout& a, const JudgedLayout& b) {
  return a.sign_factor == b.sign_factor && a.low_signs.size() == b.low_signs.size();
}

SmokeVerdict verdict_of(const std::string& scenario, const SeenPlaces& places,
                        const std::vector<double>& heights_m) {
  SmokeVerdict out{scenario, {}, share_of(places, [](const RoutePlace&) { return true; })};
  for (const double height : heights_m)
    out.by_height.push_back(
        share_of(places, [&](const RoutePlace& place) { return std::get<2>(place) == height; }));
  return out;
}

}  // namespace

bool beats(const JudgedLayout& a, const JudgedLayout& b) {
  const bool costs_no_more = a.objective <= b.objective * (1 + 1e-9);
  const ShareDifference beyond = difference_of(b, a);
  if (!costs_no_more || !beyond.surely_no_less()) return false;
  return a.objective < b.objective * (1 - 1e-9) || beyond.surely_more();
}

/// Whether more paths could change the rank of a layout.
bool SmokeRace::is_open(const JudgedLayout& one) const {
  if (one.rounds == 0) return true;
  const LegibleShare share = one.worst();
  return share.least < share.most &&
         std::none_of(stage_.layouts.begin(), stage_.layouts.end(), [&](const auto& other) {
           return other.rounds > 0 && like_signs(other, one) && beats(other, one);
         });
}

/// Whether a layout is certainly ranked against all others that are still open.
bool SmokeRace::is_told_apart(const JudgedLayout& one) const {
  return std::all_of(stage_.layouts.begin(), stage_.layouts.end(), [&](const auto& other) {
    if (&other == &one || !like_signs(other, one) || !is_open(other)) return true;
    const ShareDifference beyond = difference_of(one, other);
    return beyond.surely_no_less() || beyond.surely_no_more();
  });
}

Result<bool> SmokeRace::run() {
  stage_.end = RaceEnd::rounds;
  bool finished = true;
  for (int round = 0; round < options_.rounds && finished && any_open(); ++round)
    for (size_t h = 0; h < groups_.size() && finished; ++h) {
      const auto raced = race(h, round);
      if (!raced && !stopped_) return raced.problem();
      finished = raced && raced.value();
    }
  if (!any_open()) {
    stage_.end = RaceEnd::decided;
    finished = true;
  }
  for (JudgedLayout& one : stage_.layouts) one.is_open = is_open(one) && !is_told_apart(one);
  for (const States& states : states_)
    for (const auto& state : states) stage_.paths += state->sights().paths();
  for (size_t i = 0; i < stage_.layouts.size(); ++i) count_places(i);
  return finished;
}

bool SmokeRace::any_open() const {
  return std::any_of(stage_.layouts.begin(), stage_.layouts.end(),
                     [&](const JudgedLayout& one) { return is_open(one); });
}

/// One round of a group; false if it was stopped before.
Result<bool> SmokeRace::race(size_t group, int round) {
  if (stopped_) return false;
  if (round == 0)
    if (auto ok = open_group(groups_[group]); !ok) return ok.problem();
  std::vector<bool> asked;
  for (const size_t i : groups_[group].members) asked.push_back(is_open(stage_.layouts[i]));
  if (std::find(asked.begin(), asked.end(), true) == asked.end()) return true;
  if (auto ok = trace(group, round, asked); !ok) return ok.problem();
  judge(group, round + 1);
  return true;
}

AssessProgress SmokeRace::tell(const LayoutGroup& group, size_t scenario, int round) const {
  const std::string who = group.members.size() == 1
                              ? "layout " + stage_.layouts[group.members.front()].name
                              : fmt::format("{} layouts together", group.members.size());
  return [this, said = fmt::format("judging {} of {} in \"{}\", round {} of paths", who,
                                   stage_.layouts.size(), stage_.scenarios[scenario], round + 1)](
             const std::string&, double share) {
    progress_(fmt::format("{}, {:.0f} %", said, 100 * share));
  };
}

Result<void> SmokeRace::open_group(const LayoutGroup& group) {
  States& states = states_.emplace_back();
  AssessOptions asked;
  asked.seed = options_.seed;
  asked.threads = options_.threads;
  asked.wanted = is_ahead;
  asked.sure_errors = sure_errors_of_races;
  for (size_t s = 0; s < stage_.scenarios.size(); ++s) {
    const auto scenario = find_scenario(*group.base, stage_.scenarios[s]);
    if (!scenario) return scenario.problem();
    auto state = LayoutGroupState::make(*group.lights, *group.base, scenario.value(), asked,
                                        tell(group, s, 0));
    if (!state) return state.problem();
    states.push_back(std::move(state).value());
  }
  return {};
}

Result<void> SmokeRace::trace(size_t group, int round, const std::vector<bool>& asked) {
  for (size_t s = 0; s < stage_.scenarios.size(); ++s) {
    SightsInLights& sights = states_[group][s]->sights();
    bool any = false;
    for (size_t i = 0; i < asked.size(); ++i) any |= asked[i] && sights.is_open(i);
    if (!any) continue;
    if (auto ok = sights.trace(round, asked, stopped_, tell(groups_[group], s, round)); !ok)
      return ok.problem();
  }
  return {};
}

/// Sets the verdicts of all layouts of a group, also of those that were decided before.
void SmokeRace::judge(size_t group, int rounds) {
  for (size_t i = 0; i < groups_[group].members.size(); ++i) {
    const size_t layout = groups_[group].members[i];
    JudgedLayout& one = stage_.layouts[layout];
    one.smoke.clear();
    places_[layout].clear();
    for (size_t s = 0; s < stage_.scenarios.size(); ++s) {
      LayoutGroupState& state = *states_[group][s];
      places_[layout].push_back(places_of(state.scene(), state.sights().rows(i)));
      one.smoke.push_back(
          verdict_of(stage_.scenarios[s], places_[layout].back(), stage_.heights_m));
    }
    one.rounds = rounds;
  }
  for (size_t h = 0; h < states_.size(); ++h) compare_with_first(h);
}

/// Compares all layouts of a group with the first layout; views are paired if both share paths.
void SmokeRace::compare_with_first(size_t group) {
  const std::vector<size_t>& members = groups_[group].members;
  for (size_t i = 0; i < members.size(); ++i) {
    if (stage_.layouts[members[i]].rounds == 0) continue;
    for (size_t s = 0; s < stage_.scenarios.size(); ++s) {
      const LayoutViews first{places_[0][s], states_[0][s]->sights().rows(0)};
      const SightsInLights& sights = states_[group][s]->sights();
      ShareDifference& beyond = stage_.layouts[members[i]].smoke[s].beyond_first;
      if (members[i] == 0)
        beyond = {0, 0};
      else if (group == 0)
        beyond = difference_of(first, {places_[members[i]][s], sights.rows(i)},
                               [&](size_t row) { return sights.error_beyond_first(i, row); });
      else
        beyond = difference_of(first, {places_[members[i]][s], sights.rows(i)}, {});
    }
  }
}

/// Counts places that are read with the first layout only, and with this one only.
void SmokeRace::count_places(size_t layout) {
  JudgedLayout& one = stage_.layouts[layout];
  one.lost = one.won = 0;
  for (size_t s = 0; s < places_[layout].size(); ++s)
    for (const auto& [place, seen] : places_[layout][s]) {
      const auto first = places_[0][s].find(place);
      if (first == places_[0][s].end()) continue;
      one.lost += first->second.read == Read::a_sign && seen.read == Read::nothing;
      one.won += first->second.read == Read::nothing && seen.read == Read::a_sign;
    }
}

}  // namespace luxodus
