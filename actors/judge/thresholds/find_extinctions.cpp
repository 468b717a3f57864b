// Factors on the smoke of a scene at which signs are just read and just seen.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "actors/judge/assess/reality_mode.hpp"
#include "actors/judge/thresholds/factor_search.hpp"
#include "actors/judge/thresholds/thresholds.hpp"

namespace luxodus {

namespace {

/// A view and the searches for all its eyes, for reading and for seeing.
struct SearchedView {
  const SightRow* row = nullptr;
  std::vector<FactorSearch> reading, seeing;  // by eyes

  /// Adds what a tracing has given. A view that is gone there has nothing to read.
  void add(int step, const std::vector<Sight>& sights) {
    for (size_t e = 0; e < reading.size(); ++e) {
      const double factor = factor_of_step(step);
      const bool there = e < sights.size();
      reading[e].add(step, there ? point_of(factor, sights[e], true) : impossible_point(factor));
      seeing[e].add(step, there ? point_of(factor, sights[e], false) : impossible_point(factor));
    }
  }
  /// The steps that any of the searches asks for.
  std::set<int> wanted() const {
    std::set<int> out;
    for (const auto* searches : {&reading, &seeing})
      for (const FactorSearch& search : *searches)
        if (const auto step = search.next()) out.insert(*step);
    return out;
  }
};

/// Searches of all views that light decides, with the light of the assessment.
std::map<ViewKey, SearchedView> begun(const ThresholdSearch& search) {
  std::map<ViewKey, SearchedView> out;
  for (const SightRow& row : search.assessed.sights) {
    const auto sights = sights_of(row);
    if (sights.empty()) continue;
    SearchedView view{&row, std::vector<FactorSearch>(sights.size()),
                      std::vector<FactorSearch>(sights.size())};
    view.add(0, sights);
    out.emplace(key_of(row), std::move(view));
  }
  return out;
}

/// Traces some views in denser or thinner smoke. Errors: as assess_sights.
Result<void> trace_at(const ThresholdSearch& search, int step, const std::set<ViewKey>& asked,
                      std::map<ViewKey, SearchedView>& views) {
  Assessment found;
  const AssessProgress told = [&](const std::string& what, double share) {
    search.progress(fmt::format("smoke times {:.3g}, {}", factor_of_step(step), what), share);
  };
  if (auto ok = assess_sights(search.scene, search.scenario, {factor_of_step(step), {}, false},
                              looking_at(asked, search.options), search.interrupt, told, found);
      !ok)
    return ok;
  for (const ViewKey& key : asked) views.at(key).add(step, {});
  for (const SightRow& row : found.sights) views.at(key_of(row)).add(step, sights_of(row));
  return {};
}

/// The factor at which a view is no longer read, where irritant smoke comes first.
void end_where_it_stings(const ThresholdSearch& search, const SightRow& row,
                         ThresholdRecord& record) {
  SightRules rules;
  rules.irritant_smoke = search.scene.assessment.irritant_smoke.value_or(false);
  const double stings = stinging_extinction(sign_of(search.scene, row), row.view, rules);
  if (!record.read || !(row.sight.extinction > 0) || std::isinf(stings)) return;
  const double factor = stings / row.sight.extinction;
  const bool later = record.end == ThresholdEnd::found && record.at.value < factor;
  if (later || record.end == ThresholdEnd::nowhere) return;
  record.end = ThresholdEnd::found;
  record.at = {factor, 0};
  record.above = false;
}

ThresholdRecord record_of_search(const ThresholdSearch& search, const SearchedView& view,
                                 const std::string& eyes, const FactorSearch& factors, bool read) {
  ThresholdRecord record = record_for(Sought::extinction, *view.row, eyes, read);
  const auto crossing = factors.found();
  record.end = crossing                     ? ThresholdEnd::found
               : factors.holds_everywhere() ? ThresholdEnd::everywhere
                                            : ThresholdEnd::nowhere;
  if (crossing) record.at = value_of(*crossing);
  if (crossing) record.above = crossing->above;
  end_where_it_stings(search, *view.row, record);
  if (record.end == ThresholdEnd::found)
    record.amounts_to = {record.at.value * view.row->sight.extinction, "1/m"};
  return record;
}

}  // namespace

Result<ThresholdRows> find_extinctions(const ThresholdSearch& search) {
  if (!has_smoke(search.scene, search.scenario))
    return problem_in(search.scene.file, "scenario \"" + search.scenario.name +
                                             "\" has no smoke whose extinction could be varied: "
                                             "choose a scenario with smoke by --scenario");
  auto views = begun(search);
  for (;;) {
    std::map<int, std::set<ViewKey>> asked;
    for (const auto& [key, view] : views)
      for (const int step : view.wanted()) asked[step].insert(key);
    if (asked.empty()) break;
    for (const auto& [step, keys] : asked)
      if (auto ok = trace_at(search, step, keys, views); !ok) return ok.problem();
  }
  ThresholdRows out;
  const auto eyes = eyes_of(search.scene);
  for (const SightRow& row : search.assessed.sights) {
    const auto view = views.find(key_of(row));
    for (size_t e = 0; e < eyes.size(); ++e)
      for (const bool read : {true, false})
        out.push_back(view == views.end()
                          ? record_for(Sought::extinction, row, eyes[e], read)
                          : record_of_search(search, view->second, eyes[e],
                                             (read ? view->second.reading : view->second.seeing)[e],
                                             read));
  }
  return out;
}

}  // namespace luxodus
