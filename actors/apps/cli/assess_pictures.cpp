#include "actors/apps/cli/assess_pictures.hpp"

#include <algorithm>
#include <cmath>

#include "actors/apps/cli/progress_line.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/judge/assess/judged_state.hpp"
#include "actors/judge/report/eye_pictures.hpp"
#include "actors/results/pictures/pictures.hpp"
#include "actors/results/run/local_run.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/compile_surfaces.hpp"

namespace luxodus::cli {

namespace {

/// Pictures of a report, their size [pixels], and what they are traced with: some seconds on two
/// cores for a furnished floor in smoke. Whoever needs better ones traces them with `luxodus run`.
constexpr size_t max_pictures = 4;
constexpr int picture_width = 320;
constexpr int64_t particles = 250'000;
constexpr int paths_per_pixel = 4;
/// Eyes of a walker, and how far before him he looks [m].
constexpr double eye_height_m = 1.65, look_ahead_m = 8;

Camera smaller(Camera camera) {
  const double share = std::min(1.0, static_cast<double>(picture_width) / camera.width);
  camera.height = std::max(1, static_cast<int>(std::lround(camera.height * share)));
  camera.width = std::max(1, static_cast<int>(std::lround(camera.width * share)));
  return camera;
}

/// The cover of a report: the storey of the first route or area, seen from above without what lies
/// above the cut. Its size [pixels], the angle that it sees, from where, and how high above the
/// floor it is cut: above doors, below ceilings.
constexpr int cover_width = 600, cover_height = 240;
constexpr double cover_fov_deg = 25;
const glm::dvec3 from_south = glm::normalize(glm::dvec3(0.12, 1, -1.7)),
                 from_west = glm::normalize(glm::dvec3(1, -0.12, -1.7));
constexpr double cut_above_floor_m = 2.1;

std::optional<double> floor_of(const SceneDescription& scene) {
  if (!scene.routes.empty()) return scene.routes.front().path.front().z;
  if (!scene.open_areas.empty()) return scene.open_areas.front().z_m;
  return std::nullopt;
}

/// A camera that has a box just in its picture, with the longer side across.
Camera before_box(const Bounds& box) {
  const glm::dvec3 size = box.high - box.low;
  const glm::dvec3& gaze = size.x >= size.y ? from_south : from_west;
  Camera out;
  out.width = cover_width;
  out.height = cover_height;
  out.vertical_fov_deg = cover_fov_deg;
  const glm::dvec3 right = glm::normalize(glm::cross(gaze, out.up)), up = glm::cross(right, gaze),
                   middle = (box.low + box.high) / 2.0;
  const double high = std::tan(glm::radians(cover_fov_deg) / 2),
               wide = high * cover_width / cover_height;
  double away_m = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 at =
        glm::mix(box.low, box.high, glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2)) - middle;
    away_m = std::max({away_m, std::abs(glm::dot(at, right)) / wide - glm::dot(at, gaze),
                       std::abs(glm::dot(at, up)) / high - glm::dot(at, gaze)});
  }
  constexpr double margin = 1.03;
  out.target = middle;
  out.eye = middle - gaze * (away_m * margin);
  return out;
}

/// Nothing where the scene says neither a route nor an area.
std::optional<Camera> cover_of(const SceneDescription& scene, const Bounds& building) {
  const auto floor_m = floor_of(scene);
  if (!floor_m) return std::nullopt;
  const double cut_m = *floor_m + cut_above_floor_m;
  Camera out = before_box(
      {{building.low.x, building.low.y, *floor_m}, {building.high.x, building.high.y, cut_m}});
  out.name = cover_camera;
  out.cut_m = cut_m;
  return out;
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

std::vector<Camera> cameras_of(const SceneDescription& scene, const Bounds& building) {
  std::vector<Camera> out;
  std::optional<Camera> cover;
  for (const Camera& camera : scene.cameras)
    (camera.name == cover_camera ? cover.emplace() : out.emplace_back()) = smaller(camera);
  if (out.empty())
    for (const EscapeRoute& route : scene.routes) out.push_back(smaller(camera_on(route)));
  if (out.size() > max_pictures) out.resize(max_pictures);
  if (!cover) cover = cover_of(scene, building);
  if (cover) out.push_back(*cover);
  return out;
}

}  // namespace

Result<void> picture_state(const AssessmentJob& job, const std::filesystem::path& folder) {
  const auto scenario = judged_scenario(*job.scene, job.options.scenario);
  if (!scenario) return scenario.problem();
  auto scene = std::make_shared<SceneDescription>(*job.scene);
  scene->cameras = cameras_of(*job.scene, solid_bounds(*job.scene, scenario.value()));
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
