#include "actors/judge/assess/state_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "actors/judge/texts/remark_json.hpp"
#include "scenes/emergency/legibility.hpp"

namespace luxodus {

namespace {

/// Names that a row lists; further ones are counted.
constexpr size_t names_listed = 12;

double number_at(const Json& object, const char* key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_number() ? at->get<double>() : 0;
}

/// The list at a key; empty if there is none.
const Json& list_at(const Json& object, const char* key) {
  static const Json none = Json::array();
  const auto at = object.find(key);
  return at != object.end() && at->is_array() ? *at : none;
}

Json rules_json(const AssessedState& state) {
  Json out = Json::array();
  for (const CodeChoice& codes : state.codes) {
    const NamedRules& set = named(codes.set);
    out.push_back({{"id", set.id},
                   {"edition", set.edition},
                   {"what", remark_json(remark(set.asks))},
                   {"source", set.source},
                   {"status", set.status ? remark_json(remark(*set.status)) : Json()}});
  }
  return out;
}

Json deviations_json(const AssessedState& state) {
  Json out = Json::array();
  for (const CodeChoice& codes : state.codes)
    for (const Deviation deviation : codes.deviations) {
      const NamedRules& one = named(deviation);
      out.push_back({{"id", one.id},
                     {"from", named(codes.set).id},
                     {"edition", one.edition},
                     {"what", remark_json(remark(one.asks))},
                     {"source", one.source},
                     {"status", one.status ? remark_json(remark(*one.status)) : Json()}});
    }
  return out;
}

/// Range over all media except flames; null without smoke. Extinctions add where media overlap.
Json smoke_json(const AssessedState& state) {
  if (!state.smoke) return Json();
  double low = 0, high = 0;
  bool first = true;
  Json media = Json::array();
  for (const StatedMedium& m : state.media) {
    media.push_back({{"name", m.name},
                     {"kind", m.kind},
                     {"place", m.place},
                     {"notes", remarks_json(m.notes)},
                     {"extinction_min", m.extinction_min},
                     {"extinction_max", m.extinction_max}});
    if (m.kind == "flame") continue;
    low = first ? m.extinction_min : std::min(low, m.extinction_min);
    high = std::max(high, m.extinction_max);
    first = false;
  }
  return {
      {"extinction", {{"min", low}, {"max", high}, {"unit", "1/m"}, {"wavelength_nm", stated_nm}}},
      {"media", media}};
}

std::string operation_row(const Json& state) {
  std::string out = text_in(state, "operation");
  if (out == "mains") return "MAINS: not an emergency";
  if (out == "dark") out += ": neither mains nor emergency luminaires";
  const auto seconds = state.find("seconds_after_failure");
  return out +
         (seconds != state.end() && seconds->is_object()
              ? fmt::format(", {:g} s after the failure of the mains", number_at(*seconds, "value"))
              : ", time after the failure of the mains not stated");
}

std::string luminaire_row(const Json& state) {
  const auto at = state.find("luminaires");
  if (at == state.end() || !at->is_object()) return "";
  std::string out =
      fmt::format("{:.0f} of {:.0f} lit", number_at(*at, "lit"), number_at(*at, "of"));
  const Json& names = list_at(*at, "lit_names");
  for (size_t i = 0; i < std::min(names.size(), names_listed); ++i)
    if (names[i].is_string()) out += (i == 0 ? ": " : ", ") + names[i].get<std::string>();
  if (names.size() > names_listed) out += fmt::format(" and {} more", names.size() - names_listed);
  return out;
}

std::string range_words(double low, double high) {
  return low == high ? fmt::format("{:.3g}/m", low)
                     : fmt::format("{:.3g}/m to {:.3g}/m", low, high);
}

std::string smoke_row(const Json& state) {
  const auto at = state.find("smoke");
  if (at == state.end() || !at->is_object()) return "none";
  std::string out;
  if (const auto all = at->find("extinction"); all != at->end() && all->is_object())
    out = fmt::format("extinction {} at {:g} nm (optical density {})",
                      range_words(number_at(*all, "min"), number_at(*all, "max")),
                      number_at(*all, "wavelength_nm"),
                      range_words(number_at(*all, "min") / std::numbers::ln10,
                                  number_at(*all, "max") / std::numbers::ln10));
  else
    out = "none";
  for (const Json& medium : list_at(*at, "media")) {
    out += fmt::format(
        "; {} \"{}\" {}", text_in(medium, "kind"), text_in(medium, "name"),
        range_words(number_at(medium, "extinction_min"), number_at(medium, "extinction_max")));
    std::string source = text_in(medium, "place");
    for (const Json& note : list_at(medium, "notes")) source += ", " + text_in(note, "text");
    if (!source.empty()) out += " (" + source + ")";
  }
  return out;
}

std::string named_row(const Json& rows) {
  std::string out;
  for (const Json& row : rows) {
    out += (out.empty() ? "" : "; ") + text_in(row, "edition") + " (" + text_in(row, "id") + ")";
    for (const char* key : {"what", "status"})
      if (const std::string text = english_in(row, key); !text.empty()) out += ", " + text;
  }
  return out.empty() ? "none" : out;
}

/// A row for each reason; only the first has a name.
void add_unassessed(const Json& assessment, std::vector<StateRow>& rows) {
  const char* what = "not assessed";
  for (const Json& group : list_at(assessment, "not_assessed")) {
    const double count = number_at(group, "count");
    std::string why = english_in(group, "why");
    if (group.value("undecided", false)) why = english().say("views.undecided", why);
    rows.emplace_back(what, fmt::format("{}: {}{}", text_in(group, "what"), why,
                                        count > 1 ? fmt::format(" ({:.0f} times)", count) : ""));
    what = "";
  }
  if (*what != '\0') rows.emplace_back(what, "nothing");
}

/// "\"fire\", emergency operation, 60 s after the failure, in smoke of 0.2/m to 0.8/m".
std::string judged_words(const AssessedState& state) {
  std::string out = fmt::format("\"{}\", {} operation", state.scenario, name_of(state.operation));
  if (state.seconds_after_failure)
    out += fmt::format(", {:g} s after the failure", *state.seconds_after_failure);
  const Json smoke = smoke_json(state);
  if (!smoke.is_object()) return out + ", in clear air";
  const Json& extinction = smoke["extinction"];
  return out + ", in smoke of " +
         range_words(number_at(extinction, "min"), number_at(extinction, "max"));
}

std::string first_sentence(const AssessedState& state, const CheckCounts& counts,
                           const std::map<std::string, size_t>& sights) {
  std::string rules;
  for (const CodeChoice& codes : state.codes)
    rules += (rules.empty() ? "" : " and ") + std::string(named(codes.set).edition);
  std::string out = fmt::format("{}, by {}: {}", judged_words(state), rules, words_of(counts));
  size_t all = 0;
  for (const auto& [verdict, count] : sights) all += count;
  if (all == 0) return out + "; no view of a sign was judged";
  const auto legible = sights.find(name_of(SightVerdict::legible));
  return out + fmt::format("; {} of {} views of signs are legible",
                           legible == sights.end() ? 0 : legible->second, all);
}

}  // namespace

Json state_json(const AssessedState& state) {
  return {{"scenario", state.scenario},
          {"operation", name_of(state.operation)},
          {"seconds_after_failure",
           state.seconds_after_failure ? exact_json(*state.seconds_after_failure, "s") : Json()},
          {"luminaires",
           {{"lit", state.lit.size()}, {"of", state.luminaires}, {"lit_names", state.lit}}},
          {"smoke", smoke_json(state)},
          {"rules", rules_json(state)},
          {"deviations", deviations_json(state)},
          {"light", remark_json(state.light)},
          {"remarks", remarks_json(state.remarks)}};
}

Json verdict_json(const AssessedState& state, const CheckCounts& counts,
                  const std::map<std::string, size_t>& sights) {
  return {{"first", first_sentence(state, counts, sights)},
          {"words", words_of(counts)},
          {"fail", count_of(counts, CheckVerdict::fail)},
          {"not_assessed", count_of(counts, CheckVerdict::not_assessed)},
          {"not_verified", count_of(counts, CheckVerdict::not_verified)},
          {"pass", count_of(counts, CheckVerdict::pass)}};
}

std::vector<StateRow> state_rows(const Json& assessment) {
  const auto at = assessment.find("state");
  if (at == assessment.end() || !at->is_object())
    return {{"judged state", "not recorded: this assessment is of an older version; make it anew"}};
  const Json& state = *at;
  std::vector<StateRow> rows{
      {"scenario", text_in(state, "scenario")}, {"operation", operation_row(state)},
      {"luminaires", luminaire_row(state)},     {"smoke", smoke_row(state)},
      {"light", english_in(state, "light")},    {"rules", named_row(list_at(state, "rules"))}};
  if (!list_at(state, "deviations").empty())
    rows.emplace_back("deviations", named_row(list_at(state, "deviations")));
  add_unassessed(assessment, rows);
  return rows;
}

std::string state_text(const Json& assessment) {
  std::string out = "judged state\n";
  for (const auto& [what, words] : state_rows(assessment))
    out += fmt::format("  {:<13} {}\n", what, words);
  const auto state = assessment.find("state");
  if (state == assessment.end()) return out;
  for (const Json& remark : list_at(*state, "remarks"))
    out += fmt::format("  note: {}\n", text_in(remark, "text"));
  return out;
}

std::string verdict_words(const Json& assessment) {
  const auto verdict = assessment.find("verdict");
  if (verdict != assessment.end() && verdict->is_object())
    if (const std::string words = text_in(*verdict, "words"); !words.empty()) return words;
  CheckCounts counts{};
  for (const Json& check : list_at(assessment, "checks"))
    for (size_t i = 0; i < counts.size(); ++i)
      if (text_in(check, "verdict") == name_of(static_cast<CheckVerdict>(i))) ++counts[i];
  return words_of(counts);
}

std::string first_words(const Json& assessment) {
  const auto verdict = assessment.find("verdict");
  if (verdict != assessment.end() && verdict->is_object())
    if (const std::string words = text_in(*verdict, "first"); !words.empty()) return words;
  return verdict_words(assessment);
}

bool anything_open(const Json& assessment) {
  const Json& counts = assessment.at("counts");
  for (const char* verdict : {"fail", "not_assessed", "not_verified"})
    if (number_at(counts, verdict) > 0) return true;
  const Json& views = assessment.at("sight_counts");
  return number_at(views, name_of(SightVerdict::undecided)) > 0 ||
         number_at(views, name_of(SightVerdict::not_assessed)) > 0;
}

}  // namespace luxodus
