#include "actors/judge/walk/walk_summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "actors/judge/assess/plan_cut.hpp"

namespace luxodus {

namespace {

bool is_undecided(const WalkStep& step) {
  return !step.reads() && step.count(SignAnswer::undecided) > 0;
}

double& seconds_of(PassedSign& sign, SignAnswer answer) {
  switch (answer) {
    case SignAnswer::read:
      return sign.read_s;
    case SignAnswer::seen:
      return sign.seen_s;
    case SignAnswer::invisible:
      return sign.invisible_s;
    case SignAnswer::hidden:
      return sign.hidden_s;
    case SignAnswer::undecided:
      break;
  }
  return sign.undecided_s;
}

}  // namespace

FollowedPerson summary_of(const PlacedPerson& person, const WalkedPerson& walked, double step_s) {
  FollowedPerson out;
  out.group = person.group;
  out.id = person.id;
  out.from_s = walked.steps.front().time_s;
  out.to_s = walked.steps.back().time_s;
  std::set<uint32_t> read;
  for (const WalkStep& step : walked.steps) {
    if (step.reads()) {
      out.read_s += step_s;
      if (!out.first_read_s) out.first_read_s = step.time_s;
      out.last_read_s = step.time_s;
    } else {
      (is_undecided(step) ? out.undecided_s : out.unread_s) += step_s;
    }
    for (const SignOnWay& one : step.signs)
      if (one.answer == SignAnswer::read) read.insert(one.sign);
    out.longest_unread_s = std::max(out.longest_unread_s, step.unread_s);
    out.mean_extinction += step.extinction_per_m / static_cast<double>(walked.steps.size());
    out.max_extinction = std::max(out.max_extinction, step.extinction_per_m);
    out.max_bleached_cd_m2 = std::max(out.max_bleached_cd_m2, step.bleached_cd_m2);
  }
  out.signs_read = read.size();
  return out;
}

std::vector<PassedSign> sign_summaries(const std::vector<Sign>& signs,
                                       const std::vector<WalkedPerson>& walks, double step_s) {
  std::vector<PassedSign> out(signs.size());
  for (size_t i = 0; i < signs.size(); ++i) out[i].name = signs[i].name;
  for (const WalkedPerson& walked : walks) {
    std::set<uint32_t> read;
    for (const WalkStep& step : walked.steps)
      for (const SignOnWay& one : step.signs) {
        PassedSign& sign = out[one.sign];
        sign.in_view_s += step_s;
        seconds_of(sign, one.answer) += step_s;
        if (one.hidden_by_people) sign.hidden_by_people_s += step_s;
        if (one.answer == SignAnswer::read) read.insert(one.sign);
      }
    for (const uint32_t sign : read) ++out[sign].readers;
  }
  return out;
}

std::vector<PeopleAtTime> curve_of(const std::vector<WalkedPerson>& walks, double step_s) {
  std::map<int64_t, PeopleAtTime> points;
  for (const WalkedPerson& walked : walks)
    for (const WalkStep& step : walked.steps) {
      PeopleAtTime& point = points[std::llround(step.time_s / step_s)];
      ++point.present;
      point.reading += step.reads() ? 1 : 0;
      point.undecided += is_undecided(step) ? 1 : 0;
    }
  std::vector<PeopleAtTime> out;
  if (points.empty()) return out;
  for (int64_t k = points.begin()->first; k <= points.rbegin()->first; ++k) {
    out.push_back(points[k]);
    out.back().time_s = static_cast<double>(k) * step_s;
  }
  return out;
}

std::vector<WalkedFloor> walked_floors(const std::vector<PlanLevel>& levels,
                                       const std::vector<PlacedPerson>& people,
                                       const std::vector<WalkedPerson>& walks, double step_s) {
  // By column and row of the cell.
  std::vector<std::map<std::pair<int, int>, double>> unread_s(levels.size());
  for (const WalkedPerson& walked : walks)
    for (const WalkStep& step : walked.steps) {
      const double foot_m = step.eye.z - people[walked.person].eye_height_m;
      double& cell = unread_s[level_of(levels, foot_m)]
                             [{static_cast<int>(std::floor(step.eye.x / counted_cell_m)),
                               static_cast<int>(std::floor(step.eye.y / counted_cell_m))}];
      if (!step.reads()) cell += step_s;
    }
  std::vector<WalkedFloor> out;
  for (size_t i = 0; i < levels.size(); ++i) {
    WalkedFloor floor{levels[i].floor_m, {}};
    for (const auto& [at, seconds] : unread_s[i])
      floor.cells.push_back({counted_cell_m * glm::dvec2(at.first, at.second), seconds});
    out.push_back(std::move(floor));
  }
  return out;
}

}  // namespace luxodus
