#include "actors/display/film.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>

#include "actors/display/picture_tiles.hpp"
#include "actors/display/view_files.hpp"
#include "scenes/emergency/way.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

/// How far ahead somebody looks who walks [m].
constexpr double look_ahead_m = 1.5;
/// What is so near is the same place, as in a hairpin bend [m].
constexpr double same_place_m = 1e-3;

Camera camera_at(const EscapeRoute& route, double along_m, const FilmedWalk& walk,
                 const Camera& lens) {
  Camera camera = lens;
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
  if (error) return problem_in(folder, "cannot make this folder: " + error.message());
  std::vector<fs::path> old;
  for (auto at = fs::directory_iterator(folder, error); !error && at != fs::directory_iterator();
       at.increment(error))
    if (is_frame(at->path())) old.push_back(at->path());
  if (error) return problem_in(folder, "cannot list this folder: " + error.message());
  for (const fs::path& file : old)
    if (!fs::remove(file, error) || error)
      return problem_in(file, "cannot remove this frame of an earlier film: " + error.message());
  return {};
}

/// Runs a program found on the path, with nothing to read and nowhere to write. Its exit code; -1
/// where it is not there. Errors: it cannot be begun, or ends by a signal.
Result<int> run_quietly(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  for (const int out : {STDOUT_FILENO, STDERR_FILENO})
    ::posix_spawn_file_actions_addopen(&actions, out, "/dev/null", O_WRONLY, 0);
  pid_t pid = 0;
  const int failed =
      ::posix_spawnp(&pid, arguments[0], &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failed == ENOENT) return -1;
  if (failed != 0) return system_problem({}, "cannot begin " + words[0], failed);
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0)
    if (errno != EINTR) return system_problem({}, "cannot wait for " + words[0], errno);
  if (!WIFEXITED(status)) return problem(words[0] + " was ended by a signal");
  return WEXITSTATUS(status);
}

}  // namespace

Result<std::vector<Camera>> cameras_of(const EscapeRoute& route, const FilmedWalk& walk,
                                       const Camera& lens) {
  const double step_m = walk.speed_m_s / walk.frames_per_s;
  // A step that ends at the end but for rounding is one.
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

std::string name_of_frame(size_t frame) {
  return fmt::format("{:06}.png", frame);
}

Result<size_t> render_film(const fs::path& folder, const LocalRun& run, const Film& film,
                           const PictureOptions& options,
                           const std::function<void(double frames)>& progress) {
  if (auto ok = make_frame_folder(folder); !ok) return ok.problem();
  const PictureFlux flux = picture_flux(run, options);
  for (size_t k = 0; k < film.cameras.size(); ++k) {
    const Camera& camera = film.cameras[k];
    ViewPasses view(run, camera, 0, flux.radiance.get());
    const auto tell = [&](double share) {
      if (progress) progress(static_cast<double>(k) + share);
    };
    const bool whole = options.executor == nullptr
                           ? view.add(options.paths_per_pixel, options, tell)
                           : PictureExecutor(run, {{camera}}, options, flux)
                                 .add(0, view, options.paths_per_pixel, tell);
    if (!whole) return k;
    const ShownView shown(view.picture(), view.paths(), options, run.threads());
    auto written = write_shown_png(folder / name_of_frame(k), film.human, run, camera, shown);
    if (!written) return written.problem();
  }
  return film.cameras.size();
}

Result<bool> write_video(const fs::path& file, const fs::path& folder, size_t frames,
                         double frames_per_s) {
  // Under another name until it is whole.
  fs::path unfinished = file.parent_path() / (".unfinished-" + file.filename().string());
  const auto code =
      run_quietly({"ffmpeg", "-nostdin", "-y", "-framerate", fmt::format("{:g}", frames_per_s),
                   "-i", (folder / "%06d.png").string(), "-frames:v", std::to_string(frames), "-vf",
                   // H.264 takes even edges.
                   "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-movflags",
                   "+faststart", unfinished.string()});
  std::error_code error;
  if (!code || code.value() != 0) {
    fs::remove(unfinished, error);
    if (!code) return code.problem();
    if (code.value() == -1) return false;
    return problem_in(file, fmt::format("ffmpeg failed with code {}", code.value()));
  }
  fs::rename(unfinished, file, error);
  if (error) return problem_in(file, "cannot be put into its place: " + error.message());
  return true;
}

}  // namespace luxodus
