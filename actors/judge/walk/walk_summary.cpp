#include "actors/judge/walk/walk_summary.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "actors/judge/assess/plan_cut.hpp"

namespace luxodus {

namespace {

bool is_undecided(const WalkStep& step) {
  return !step.reads() && step.count(SignAnswer::undecided) > 0;
}

}  // namespace

PersonSummary summary_of(const WalkedPerson& walked, double step_s) {
  PersonSummary out;
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

std::vector<SignSummary> sign_summaries(size_t signs, const std::vector<WalkedPerson>& walks,
                                        double step_s) {
  std::vector<SignSummary> out(signs);
  for (const WalkedPerson& walked : walks) {
    std::set<uint32_t> read;
    for (const WalkStep& step : walked.steps)
      for (const SignOnWay& one : step.signs) {
        SignSummary& sign = out[one.sign];
        sign.in_view_s += step_s;
        sign.by_answer_s[static_cast<size_t>(one.answer)] += step_s;
        if (one.hidden_by_people) sign.hidden_by_people_s += step_s;
        if (one.answer == SignAnswer::read) read.insert(one.sign);
      }
    for (const uint32_t sign : read) ++out[sign].readers;
  }
  return out;
}

std::optional<double> CurvePoint::reading_share() const {
  if (present == 0) return std::nullopt;
  return static_cast<double>(reading) / static_cast<double>(present);
}

std::vector<CurvePoint> curve_of(const std::vector<WalkedPerson>& walks, double step_s) {
  std::map<int64_t, CurvePoint> points;
  for (const WalkedPerson& walked : walks)
    for (const WalkStep& step : walked.steps) {
      CurvePoint& point = points[std::llround(step.time_s / step_s)];
      ++point.present;
      point.reading += step.reads() ? 1 : 0;
      point.undecided += is_undecided(step) ? 1 : 0;
    }
  std::vector<CurvePoint> out;
  if (points.empty()) return out;
  for (int64_t k = points.begin()->first; k <= points.rbegin()->first; ++k) {
    out.push_back(points[k]);
    out.back().time_s = static_cast<double>(k) * step_s;
  }
  return out;
}

WalkSummaries summaries_of(size_t signs, const std::vector<WalkedPerson>& walks, double step_s) {
  WalkSummaries out{{}, sign_summaries(signs, walks, step_s), curve_of(walks, step_s)};
  for (const WalkedPerson& walked : walks) out.people.push_back(summary_of(walked, step_s));
  return out;
}

std::vector<FloorCount> floor_counts(const std::vector<PlanLevel>& levels,
                                     const std::vector<PlacedPerson>& people,
                                     const std::vector<WalkedPerson>& walks, double step_s) {
  std::vector<FloorCount> out(levels.size());
  for (const WalkedPerson& walked : walks)
    for (const WalkStep& step : walked.steps) {
      const double foot_m = step.eye.z - people[walked.person].eye_height_m;
      double& unread_s = out[level_of(levels, foot_m)]
                            [{static_cast<int>(std::floor(step.eye.x / counted_cell_m)),
                              static_cast<int>(std::floor(step.eye.y / counted_cell_m))}];
      if (!step.reads()) unread_s += step_s;
    }
  return out;
}

}  // namespace luxodus
