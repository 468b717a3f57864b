#include "actors/results/pictures/film.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "actors/results/formats/file_names.hpp"
#include "actors/results/formats/run_program.hpp"
#include "actors/results/pictures/picture_tiles.hpp"
#include "actors/results/pictures/shared_exposure.hpp"
#include "actors/results/pictures/view_files.hpp"
#include "scenes/emergency/way.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

/// How far ahead a walking person looks [m].
constexpr double look_ahead_m = 1.5;
/// Points closer than this are the same place, as in a hairpin bend [m].
constexpr double same_place_m = 1e-3;
/// A mean of two gazes shorter than this has no direction.
constexpr double min_gaze = 1e-3;

Camera camera_at(const EscapeRoute& route, double along_m, const FilmedWalk& walk,
                 const Camera& lens) {
  Camera camera = lens;
  camera.cut_m.reset();
  camera.up = {0, 0, 1};
  const glm::dvec3 foot = place_along(route, along_m);
  glm::dvec3 ahead = place_along(route, along_m + look_ahead_m) - foot;
  for (double less_m = look_ahead_m; glm::length(ahead) < same_place_m; less_m /= 2)
    ahead = place_along(route, along_m + less_m / 2) - foot;
  camera.eye = foot + glm::dvec3(0, 0, walk.eye_height_m);
  camera.target = camera.eye + ahead;
  return camera;
}

bool is_frame(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.size() == 10 && name.ends_with(".png") &&
         std::all_of(name.begin(), name.begin() + 6, [](char c) { return c >= '0' && c <= '9'; });
}

Result<void> make_frame_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return system_problem(folder, "cannot make this folder", error.value());
  std::vector<fs::path> old;
  for (auto at = fs::directory_iterator(folder, error); !error && at != fs::directory_iterator();
       at.increment(error))
    if (is_frame(at->path())) old.push_back(at->path());
  if (error) return system_problem(folder, "cannot list this folder", error.value());
  for (const fs::path& file : old)
    if (!fs::remove(file, error) || error)
      return system_problem(file, "cannot remove this frame of an earlier film", error.value());
  return {};
}

/// Interpolates between two keys: a cubic Hermite spline whose tangents are those of the parabola
/// through three keys, and at the ends those of the straight line. `at`: position from key `i` to
/// the next, 0 to 1.
glm::dvec3 between(const std::vector<double>& times, const std::vector<glm::dvec3>& values,
                   size_t i, double at) {
  const auto slope = [&](size_t k) {
    return (values[k + 1] - values[k]) / (times[k + 1] - times[k]);
  };
  const auto tangent = [&](size_t k) {
    if (k == 0) return slope(0);
    if (k + 1 == values.size()) return slope(k - 1);
    const double before = times[k] - times[k - 1], after = times[k + 1] - times[k];
    return (slope(k - 1) * after + slope(k) * before) / (before + after);
  };
  const double step = times[i + 1] - times[i];
  const double t = at, t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * values[i] + (t3 - 2 * t2 + t) * step * tangent(i) +
         (3 * t2 - 2 * t3) * values[i + 1] + (t3 - t2) * step * tangent(i + 1);
}

Problem too_many_frames(const SourcePlace& place, const std::string& of, double seconds,
                        double frames_per_s) {
  return problem_in(place, fmt::format("{}: {:g} s at {:g} frames a second are more than {} "
                                       "frames: go faster, or take fewer a second",
                                       of, seconds, frames_per_s, limits::max_film_frames));
}

}  // namespace

Result<std::vector<Camera>> cameras_of(const EscapeRoute& route, const FilmedWalk& walk,
                                       const Camera& lens) {
  const double step_m = walk.speed_m_s / walk.frames_per_s;
  // A step that ends at the end but for rounding counts.
  const double steps = std::floor(length_of(route) / step_m * (1 + 1e-12));
  if (!(steps < limits::max_film_frames))
    return problem_in(route.place,
                      fmt::format("route \"{}\": {:g} m at {:g} m/s and {:g} frames a second are "
                                  "more than {} frames: walk faster, or take fewer a second",
                                  route.name, length_of(route), walk.speed_m_s, walk.frames_per_s,
                                  limits::max_film_frames));
  std::vector<Camera> cameras;
  for (int k = 0; k <= static_cast<int>(steps); ++k)
    cameras.push_back(camera_at(route, k * step_m, walk, lens));
  return cameras;
}

Result<std::vector<Camera>> cameras_through(const std::vector<Keyframe>& keys, double frames_per_s,
                                            const Camera& lens) {
  std::vector<double> times;
  std::vector<glm::dvec3> eyes, gazes, ups;
  for (const Keyframe& key : keys) {
    if (!times.empty() && !(key.time_s > times.back()))
      return problem_in(key.camera.place,
                        fmt::format("the camera \"{}\" comes at {:g} s, not after the one before "
                                    "it at {:g} s: say keyframes in the order of their times",
                                    key.camera.name, key.time_s, times.back()));
    if (key.camera.cut_m)
      return problem_in(key.camera.place, "the camera \"" + key.camera.name +
                                              "\" cuts the building: films show it whole");
    times.push_back(key.time_s);
    eyes.push_back(key.camera.eye);
    gazes.push_back(glm::normalize(key.camera.target - key.camera.eye));
    ups.push_back(glm::normalize(key.camera.up));
  }
  if (keys.size() < 2) return problem("a film goes through two cameras at least");
  const double seconds = times.back() - times.front();
  // A frame at the end but for rounding counts.
  const double frames = std::floor(seconds * frames_per_s * (1 + 1e-12));
  if (!(frames < limits::max_film_frames))
    return too_many_frames(keys[0].camera.place, "film from camera \"" + keys[0].camera.name + "\"",
                           seconds, frames_per_s);
  std::vector<Camera> cameras;
  size_t i = 0;
  for (int k = 0; k <= static_cast<int>(frames); ++k) {
    const double time = std::min(times.front() + k / frames_per_s, times.back());
    while (i + 2 < times.size() && time >= times[i + 1]) ++i;
    const double at = (time - times[i]) / (times[i + 1] - times[i]);
    Camera camera = lens;
    camera.cut_m.reset();
    camera.eye = between(times, eyes, i, at);
    const glm::dvec3 gaze = between(times, gazes, i, at);
    if (glm::length(gaze) < min_gaze)
      return problem_in(keys[i + 1].camera.place,
                        fmt::format("between the cameras \"{}\" and \"{}\" the gaze turns around: "
                                    "put one between them that says which way",
                                    keys[i].camera.name, keys[i + 1].camera.name));
    camera.target = camera.eye + glm::normalize(gaze);
    const glm::dvec3 up = between(times, ups, i, at);
    if (glm::length(up) < min_gaze)
      return problem_in(keys[i + 1].camera.place,
                        fmt::format("between the cameras \"{}\" and \"{}\" up turns around: put "
                                    "one between them that says which way",
                                    keys[i].camera.name, keys[i + 1].camera.name));
    camera.up = glm::normalize(up);
    camera.vertical_fov_deg =
        keys[i].camera.vertical_fov_deg * (1 - at) + keys[i + 1].camera.vertical_fov_deg * at;
    cameras.push_back(camera);
  }
  return cameras;
}

std::vector<std::string> film_names(const SceneDescription& scene, const std::string& more) {
  constexpr std::array<const char*, 2> endings{"", ".mp4"};
  std::vector<std::string> names;
  for (const EscapeRoute& route : scene.routes) names.push_back(route.name);
  if (!more.empty()) names.push_back(more);
  return file_names_of(names, endings);
}

std::string name_of_frame(size_t frame) {
  return fmt::format("{:06}.png", frame);
}

namespace {

/// Frames that share a state, and with it one transfer of the flux.
constexpr size_t frames_of_a_state = 16;

/// The moment of steady flames in a frame: they move in the time of the film.
std::optional<double> flames_at(const Film& film, size_t frame, const PictureOptions& options) {
  if (!options.flames_at_s) return std::nullopt;
  return *options.flames_at_s + static_cast<double>(frame) / film.frames_per_s;
}

std::vector<TiledView> frames_from(const Film& film, size_t first, const PictureOptions& options) {
  std::vector<TiledView> views;
  for (size_t k = first; k < std::min(first + frames_of_a_state, film.cameras.size()); ++k)
    views.push_back({film.cameras[k], 0, false, {}, flames_at(film, k, options)});
  return views;
}

}  // namespace

namespace {

/// Renders frames one after another, from the flux of a run.
class FramesOfRun {
 public:
  FramesOfRun(const fs::path& folder, const LocalRun& run, const Film& film,
              const PictureOptions& options)
      : folder_(folder),
        run_(run),
        film_(film),
        options_(options),
        flux_(picture_flux(run, options)) {}

  /// False if it was interrupted. Errors: as write_shown_png.
  Result<bool> render(size_t k, const std::function<void(double frames)>& progress) {
    const Camera& camera = film_.cameras[k];
    PictureOptions options = options_;
    options.flames_at_s = flames_at(film_, k, options_);
    ViewPasses view(run_, camera, 0, flux_.radiance.get(), flux_.sight, options.flames_at_s);
    const auto tell = [&](double share) {
      if (progress) progress(static_cast<double>(k) + share);
    };
    if (options_.executor != nullptr && k % frames_of_a_state == 0)
      elsewhere_.emplace(run_, frames_from(film_, k, options_), options_.paths_per_pixel, options_,
                         flux_);
    const bool whole =
        elsewhere_ ? elsewhere_->add(k % frames_of_a_state, view, options_.paths_per_pixel, tell)
                   : view.add(options_.paths_per_pixel, options_, tell);
    if (!whole) return false;
    const ShownView shown(view.picture(), view.paths(), options, run_.threads());
    const fs::path file = folder_ / name_of_frame(k);
    auto written = options_.exposed_with != nullptr && !film_.human
                       ? options_.exposed_with->keep(file, run_, camera, shown)
                       : write_shown_png(file, film_.human, run_, camera, shown);
    if (!written) return written.problem();
    return true;
  }

 private:
  const fs::path& folder_;
  const LocalRun& run_;
  const Film& film_;
  const PictureOptions& options_;
  const PictureFlux flux_;
  std::optional<PictureExecutor> elsewhere_;  // traces on other nodes
};

}  // namespace

size_t frames_of_state(double step_s, double seconds_per_frame) {
  const double frames = std::floor(step_s / seconds_per_frame * (1 + 1e-12));
  return static_cast<size_t>(std::clamp(frames, 1.0, double{limits::max_film_frames}));
}

Result<size_t> render_film(const fs::path& folder, const FilmedStates& states, const Film& film,
                           const PictureOptions& options,
                           const std::function<void(double frames)>& progress) {
  if (auto ok = make_frame_folder(folder); !ok) return ok.problem();
  for (size_t first = 0; first < film.cameras.size(); first += states.frames) {
    const auto run = states.run(first / states.frames);
    if (!run) return run.problem();
    if (!run.value()) return first;
    FramesOfRun frames(folder, *run.value(), film, options);
    for (size_t k = first; k < std::min(first + states.frames, film.cameras.size()); ++k) {
      const auto whole = frames.render(k, progress);
      if (!whole) return whole.problem();
      if (!whole.value()) return k;
    }
  }
  return film.cameras.size();
}

Result<size_t> render_film(const fs::path& folder, const LocalRun& run, const Film& film,
                           const PictureOptions& options,
                           const std::function<void(double frames)>& progress) {
  using Run = std::shared_ptr<const LocalRun>;
  const Run not_owned(Run(), &run);
  return render_film(
      folder,
      {std::max<size_t>(1, film.cameras.size()), [&](size_t) -> Result<Run> { return not_owned; }},
      film, options, progress);
}

Result<bool> write_video(const fs::path& file, const fs::path& folder, size_t frames,
                         double frames_per_s) {
  // Written under another name until complete. ffmpeg runs in the folder of the frames, because a %
  // in a folder's name would stand for a number.
  const fs::path unfinished =
      fs::absolute(file.parent_path()) / (".unfinished-" + file.filename().string());
  const fs::path said = file.parent_path() / (".said-" + file.filename().string() + ".txt");
  const auto code = run_program({"ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error", "-y",
                                 "-framerate", fmt::format("{:g}", frames_per_s), "-i", "%06d.png",
                                 "-frames:v", std::to_string(frames), "-vf",
                                 // H.264 requires even edges.
                                 "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p",
                                 "-movflags", "+faststart", unfinished.string()},
                                said, folder);
  std::error_code error;
  const std::string words = code && code.value() > 0 ? last_words(said) : "";
  fs::remove(said, error);
  if (!code || code.value() != 0) {
    fs::remove(unfinished, error);
    if (!code) return code.problem();
    if (code.value() == -1) return false;
    return problem_in(file, fmt::format("ffmpeg failed with code {}{}", code.value(), words),
                      ProblemKind::system);
  }
  fs::rename(unfinished, file, error);
  if (error) return system_problem(file, "cannot be put into its place", error.value());
  return true;
}

}  // namespace luxodus
