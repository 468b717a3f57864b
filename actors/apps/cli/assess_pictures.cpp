#include "actors/apps/cli/assess_pictures.hpp"

#include <algorithm>
#include <cmath>

#include "actors/apps/cli/progress_line.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/judge/assess/judged_state.hpp"
#include "actors/results/pictures/pictures.hpp"
#include "actors/results/run/local_run.hpp"
#include "scenes/light/transport/compile.hpp"

namespace luxodus::cli {

namespace {

/// Pictures of a report, their size [pixels], and what they are traced with: some seconds on two
/// cores for a furnished floor in smoke. Whoever needs better ones traces them with `luxodus run`.
constexpr size_t max_pictures = 4;
constexpr int picture_width = 320;
constexpr int64_t particles = 250'000;
constexpr int paths_per_pixel = 8;
/// Eyes of a walker, and how far before him he looks [m].
constexpr double eye_height_m = 1.65, look_ahead_m = 8;

Camera smaller(Camera camera) {
  const double share = std::min(1.0, static_cast<double>(picture_width) / camera.width);
  camera.height = std::max(1, static_cast<int>(std::lround(camera.height * share)));
  camera.width = std::max(1, static_cast<int>(std::lround(camera.width * share)));
  return camera;
}

/// What a person sees who sets out on a route.
Camera camera_on(const EscapeRoute& route) {
  const glm::dvec3 from = route.path[0], to = route.path[1];
  const glm::dvec3 eyes(0, 0, eye_height_m);
  Camera out;
  out.name = route.name;
  out.place = route.place;
  out.eye = from + eyes;
  out.target = from + glm::normalize(to - from) * look_ahead_m + eyes;
  return out;
}

std::vector<Camera> cameras_of(const SceneDescription& scene) {
  std::vector<Camera> out;
  for (const Camera& camera : scene.cameras) out.push_back(smaller(camera));
  if (out.empty())
    for (const EscapeRoute& route : scene.routes) out.push_back(smaller(camera_on(route)));
  if (out.size() > max_pictures) out.resize(max_pictures);
  return out;
}

}  // namespace

Result<void> picture_state(const AssessmentJob& job, const std::filesystem::path& folder) {
  const auto scenario = judged_scenario(*job.scene, job.options.scenario);
  if (!scenario) return scenario.problem();
  auto scene = std::make_shared<SceneDescription>(*job.scene);
  scene->cameras = cameras_of(*job.scene);
  if (scene->cameras.empty()) return {};
  const auto compiled = compile_scene(scene, scenario.value(), {});
  if (!compiled) return compiled.problem();
  const ProgressLine line("pictures");
  LocalRun run(compiled.value(), job.options.seed, job.options.threads);
  StopRule stop;
  stop.particles = particles;
  run.run(stop, interrupt_flag(), [](const Progress&) {});
  PictureOptions picture;
  picture.paths_per_pixel = paths_per_pixel;
  picture.interrupt = &interrupt_flag();
  const auto done = render_views(folder, run, "", picture, [](const PictureProgress&) {});
  if (!done) return done.problem();
  return {};
}

}  // namespace luxodus::cli
