// Films: what somebody sees who walks a route, or a flight through the scene's cameras, frame by
// frame, from the flux of one run, or of one for each state of a scene that changes in time. A
// frame is the filtered picture of a camera, with that camera's own exposure. One call at a time
// per run.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "actors/results/pictures/pictures.hpp"

namespace luxodus {

namespace limits {
/// An hour and more at 12 frames a second.
inline constexpr int max_film_frames = 50'000;
}  // namespace limits

struct FilmedWalk {
  double speed_m_s = 1;
  double frames_per_s = 12;
  double eye_height_m = 1.6;  // above the route's centre line
};

/// A camera for each frame, from the start of a route to its end, `speed_m_s` / `frames_per_s`
/// apart along its centre line. Who walks looks where he is going to be in 1.5 m, so that he turns
/// before a corner. `lens`: whose size and angle of view they have.
/// Errors: more than limits::max_film_frames; they name the route.
Result<std::vector<Camera>> cameras_of(const EscapeRoute& route, const FilmedWalk& walk,
                                       const Camera& lens);

/// Where a film is at a time: eye, gaze, up and angle of view of a camera.
struct Keyframe {
  double time_s = 0;
  Camera camera;
};

/// A camera for each frame, from the first key to the last. Eyes and gazes go through the keys on a
/// cubic spline, without a corner; angles of view go straight. `lens`: whose size they have.
/// Errors: fewer than two keys, times that do not ascend, a gaze that turns around between two
/// keys, more than limits::max_film_frames.
Result<std::vector<Camera>> cameras_through(const std::vector<Keyframe>& keys, double frames_per_s,
                                            const Camera& lens);

/// File names of the films of all routes of a scene, in their order, and of one more film where
/// `more` names it. No two are the same.
std::vector<std::string> film_names(const SceneDescription& scene, const std::string& more = "");

struct Film {
  std::vector<Camera> cameras;
  bool human = false;  // as an adapted eye sees it, instead of one exposure
};

/// The states that a film goes through, each of as many of its frames one after another.
struct FilmedStates {
  size_t frames = 0;  // of a state, at least 1
  /// The run of a state, traced; null where it was interrupted. The one before is not used any
  /// more.
  std::function<Result<std::shared_ptr<const LocalRun>>(size_t state)> run;
};

/// How many frames have one state, if the scene's clock goes `seconds_per_frame` on from one frame
/// to the next and states are `step_s` apart: at least one.
size_t frames_of_state(double step_s, double seconds_per_frame);

/// A frame's file within its folder: "000041.png".
std::string name_of_frame(size_t frame);

/// Renders the frames into `folder` (made if missing); frames of an earlier film there are removed
/// first. Returns how many are there: fewer than cameras where it was interrupted. All frames have
/// the random numbers of the scene's first camera: one that stands where that does is its picture,
/// bit for bit. `progress`: frames that are done, the one under way by its share.
/// Errors: as write_png; a folder that cannot be made; of `states`.
Result<size_t> render_film(const std::filesystem::path& folder, const LocalRun& run,
                           const Film& film, const PictureOptions& options,
                           const std::function<void(double frames)>& progress);
/// The same of states. Requires: `options` name no executor.
Result<size_t> render_film(const std::filesystem::path& folder, const FilmedStates& states,
                           const Film& film, const PictureOptions& options,
                           const std::function<void(double frames)>& progress);

/// Has ffmpeg make a film (H.264, MP4) of the first `frames` of a folder. False where there is no
/// ffmpeg on the path. Errors: it fails, with its last words; the file cannot be put into its
/// place.
Result<bool> write_video(const std::filesystem::path& file, const std::filesystem::path& folder,
                         size_t frames, double frames_per_s);

}  // namespace luxodus
