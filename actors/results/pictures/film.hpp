// Films: the view of a person who walks a route, or a camera move through the scene's cameras,
// frame by frame, from the flux of one run, or of one run per state of a scene that changes in
// time. A frame is the filtered picture of a camera, with that camera's own exposure, with one that
// all frames share, or with the one of the options. One call at a time per run.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "actors/results/pictures/pictures.hpp"

namespace luxodus {

namespace limits {
/// More than an hour at 12 frames a second.
inline constexpr int max_film_frames = 50'000;
}  // namespace limits

struct FilmedWalk {
  double speed_m_s = 1;
  double frames_per_s = 12;
  double eye_height_m = 1.6;  // above the route's centre line
};

/// A camera for each frame, from the start of a route to its end, `speed_m_s` / `frames_per_s`
/// apart along its centre line. The camera looks at the point 1.5 m ahead on the route, so that it
/// turns before a corner. `lens` gives size and angle of view.
/// Errors: more than limits::max_film_frames; the message names the route.
Result<std::vector<Camera>> cameras_of(const EscapeRoute& route, const FilmedWalk& walk,
                                       const Camera& lens);

/// Camera position at a time of a film: eye, gaze, up and angle of view.
struct Keyframe {
  double time_s = 0;
  Camera camera;
};

/// A camera for each frame, from the first key to the last. Eyes and gazes follow a cubic spline
/// through the keys, without a corner; angles of view are linear. `lens` gives the size.
/// Errors: fewer than two keys, times that do not ascend, a gaze that reverses between two keys,
/// more than limits::max_film_frames.
Result<std::vector<Camera>> cameras_through(const std::vector<Keyframe>& keys, double frames_per_s,
                                            const Camera& lens);

/// File names of the films of all routes of a scene, in their order, and of one more film if `more`
/// names it. All are different.
std::vector<std::string> film_names(const SceneDescription& scene, const std::string& more = "");

struct Film {
  std::vector<Camera> cameras;
  bool human = false;        // as an adapted eye sees it, instead of one exposure
  double frames_per_s = 12;  // how fast steady flames move
};

/// The states that a film goes through, each with the same number of consecutive frames.
struct FilmedStates {
  size_t frames = 0;  // of each state, at least 1
  /// Returns the traced run of a state; null if it was interrupted. The previous run is no longer
  /// used then.
  std::function<Result<std::shared_ptr<const LocalRun>>(size_t state)> run;
};

/// How many frames share a state if the scene's clock advances by `seconds_per_frame` per frame and
/// states are `step_s` apart: at least one.
size_t frames_of_state(double step_s, double seconds_per_frame);

/// Name of a frame's file within its folder: "000041.png".
std::string name_of_frame(size_t frame);

/// Renders the frames into `folder` (made if missing), after removing frames of an earlier film.
/// Returns how many are there: fewer than cameras if it was interrupted. All frames use the random
/// numbers of the scene's first camera, so that a frame from that camera is its picture, bit for
/// bit. `progress`: frames done, including the share of the current one. Frames that
/// `options.exposed_with` keeps are files only when the caller writes it.
/// Errors: as write_png; a folder that cannot be made; those of `states`.
Result<size_t> render_film(const std::filesystem::path& folder, const LocalRun& run,
                           const Film& film, const PictureOptions& options,
                           const std::function<void(double frames)>& progress);
/// Renders frames of several states. Requires: `options` name no executor.
Result<size_t> render_film(const std::filesystem::path& folder, const FilmedStates& states,
                           const Film& film, const PictureOptions& options,
                           const std::function<void(double frames)>& progress);

/// Makes a film (H.264, MP4) of the first `frames` of a folder with ffmpeg. False if ffmpeg is not
/// on the path. Errors: ffmpeg fails, with its last words; the file cannot be moved into place.
Result<bool> write_video(const std::filesystem::path& file, const std::filesystem::path& folder,
                         size_t frames, double frames_per_s);

}  // namespace luxodus
