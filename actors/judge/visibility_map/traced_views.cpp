#include "actors/judge/visibility_map/traced_views.hpp"

#include <fmt/format.h>

#include <cmath>

#include "actors/judge/assess/traced_round.hpp"

namespace luxodus {

namespace {

/// False: a batch found more light than a tally counts.
bool is_counted(const PartLight& part) {
  bool all = true;
  PartLight::each([&](const Uncertain& one) { all = all && std::isfinite(one.value); }, part);
  return all;
}

}  // namespace

size_t TracedViews::add(const glm::dvec3& eye, uint32_t sign, bool back) {
  views_.push_back({eye, sign, back});
  return views_.size() - 1;
}

/// Each view has an observer of its own.
RoundState TracedViews::state_of(const std::vector<size_t>& views, int64_t paths) const {
  RoundState out{judged_.scenario.name, judged_.scene.at_s, {}, judged_.signs_apart, 0, {}};
  for (const size_t view : views) {
    Observer& observer = out.observers.emplace_back();
    observer.name = fmt::format("view {}", view);
    observer.eye = views_[view].eye;
    observer.gaze = judged_.scene.signs[views_[view].sign].frame.origin - observer.eye;
    observer.signs = {views_[view].sign};
  }
  out.eye_path_factor = eye_path_factor(paths, views.size());
  return out;
}

void TracedViews::pool(const CompiledScene& scene, const Totals& totals, double paths,
                       const std::vector<size_t>& views) {
  const Readout readout(scene, totals);
  const size_t mixtures = judged_.mixtures().size();
  for (const EyeTarget& target : scene.eye_targets) {
    View& view = views_[views[target.observer]];
    if (scene.signs[target.sign].back != view.back) continue;
    view.light.resize(mixtures);
    for (size_t mixture = 0; mixture < mixtures; ++mixture) {
      ViewLight light = read_view(readout, scene, target, mixture);
      for (size_t part = 0; part < light.size(); ++part) {
        if (is_counted(light[part])) continue;
        (part + 1 < light.size() ? view.face_lost : view.beyond_lost) = true;
        light[part] = {};
      }
      view.light[mixture].add(light, paths);
    }
    view.paths += paths;
  }
}

Result<void> TracedViews::trace(const std::vector<size_t>& views, int64_t paths,
                                const std::atomic<bool>& interrupt,
                                const AssessProgress& progress) {
  if (views.empty()) return {};
  const std::string what = fmt::format("{} views", views.size());
  const RoundRequest request{state_of(views, paths),
                             options_.seed + static_cast<uint64_t>(passes_++), view_batches};
  const auto run = trace_round(judged_, request, options_, interrupt,
                               [&](double share) { progress(what, share); });
  if (!run) return run.problem();
  all_paths_ += eye_paths_of(*run.value());
  pool(run.value()->scene(), run.value()->totals(), static_cast<double>(paths * view_batches),
       views);
  return {};
}

}  // namespace luxodus
