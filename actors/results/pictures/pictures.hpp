// Pictures of a run's cameras: luminance data (OpenEXR, cd/m2) and pixels (PNG). Paths are traced
// from the eye; a path ends in the run's flux at the first event after a diffuse one, on a surface
// or in smoke (final gather), so a picture takes seconds once the flux exists. Traced data are
// neither clamped nor blurred; PNG files show filtered data (regression_filter.hpp). The standard
// error of a pixel includes that of its paths and that of the flux, which many paths share. The
// last quarter of the paths is allocated to pixels where the filter would leave most error
// (path_allocation.hpp). Pixels depend on the scene, the flux, the seed and the paths per pixel,
// never on the number of threads or of passes. One call at a time per run.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "actors/results/pictures/flux_radiance.hpp"
#include "actors/results/pictures/path_allocation.hpp"
#include "actors/results/pictures/pixel_tracer.hpp"
#include "actors/results/run/local_run.hpp"
#include "runtime/core/atomic_file.hpp"
#include "scenes/light/vision/picture.hpp"
#include "scenes/light/vision/regression_filter.hpp"
#include "scenes/light/vision/tone.hpp"

namespace luxodus {

class Executor;
class SharedExposure;

namespace limits {
/// Memory of the sums of one picture [bytes], of 36 megapixels; and of those that are traced
/// together.
inline constexpr uint64_t max_view_bytes = uint64_t{20} << 30;
inline constexpr uint64_t max_growing_bytes = uint64_t{1} << 30;
}  // namespace limits

/// What PNG files show as white. Luminances stay.
enum class PictureWhite : uint8_t {
  lamps,    // the light of all sources together, if it looks white
  adapted,  // what an eye adapts to: the light on the surfaces in view, as far as it adapts
  d65       // D65: colours as they are
};

struct PictureOptions {
  /// On average; a maximum if one of the two limits below ends a picture earlier.
  int paths_per_pixel = 28;
  /// Limit for all pictures of a call, including filtering and writing [s]; 0: none.
  double max_seconds = 0;
  /// Stop once the worst picture's error (ViewError) is this low; 0: never.
  double target_error = 0;
  /// Write intermediate pictures, the first after one path for each pixel.
  bool progressive = false;
  /// End paths in the run's flux. Without it they are traced to their end: slower and noisier, but
  /// independent of the size of patches. A run that has traced nothing has no flux to end in.
  bool gather = true;
  /// PNG files show traced instead of filtered light. All pixels then have the same number of
  /// paths; otherwise some are allocated where the filter leaves most error (even_paths).
  bool raw = false;
  std::optional<Exposure> exposure;  // of plain pictures; nothing: each has its own, or
  bool share_exposure = false;       // all of a call of render_views have one
  /// Shares it with the pictures of other calls, and is written by the caller; null: it is not.
  SharedExposure* exposed_with = nullptr;
  PictureWhite white = PictureWhite::lamps;
  ToneStyle tone = ToneStyle::neutral;  // of plain pictures
  /// Moment of steady flames, which then are turbulent (flame_shape.hpp); nothing: their mean. Of a
  /// film, that of its first frame.
  std::optional<double> flames_at_s;
  HumanTone human;  // monitor and limits of sight of human views; angles are those of each camera
  /// When set, the current work ends within a pixel, and incomplete pictures are not written. Null:
  /// no interruption.
  const std::atomic<bool>* interrupt = nullptr;
  /// Whether the current work shall end for another reason; empty: none.
  std::function<bool()> gives_up = {};
  /// Traces the pictures, tile by tile; null: the threads of the run.
  Executor* executor = nullptr;

  bool may_end_early() const { return interrupt != nullptr || gives_up; }
  bool interrupted() const {
    return (interrupt != nullptr && interrupt->load()) || (gives_up && gives_up());
  }
};

/// A camera's picture, the standard error of its luminance, and the input of a filter.
struct TracedPicture {
  XyzPicture light;                     // with scotopic luminance from the bands
  std::vector<float> standard_error_y;  // [cd/m2]; NaN with one path per pixel
  std::vector<float> flux_error_y;      // the part of it that the run's flux causes
  /// X, Y, Z, scotopic of light straight from emitters to the eye, deterministic except for the
  /// position in the pixel [cd/m2]; the halves of `noisy` exclude it.
  std::vector<float> emitted;
  NoisyPicture noisy;
};

struct FilteredView {
  XyzPicture light;
  std::vector<float> standard_error_y;  // [cd/m2] from the difference of two halves
};

/// Paths that a filter needs of a pixel: two for each half, to estimate its error.
inline constexpr int min_filtered_paths = 4;

/// Requires: at least min_filtered_paths per pixel; threads >= 1. The result is the same for any
/// number of threads.
FilteredView filter_traced(const TracedPicture& traced, int threads,
                           const RegressionFilter& filter = {});

/// Visible error of a picture: the root mean square over pixels of the relative standard error of
/// luminance. A pixel darker than a hundredth of the mean counts as that bright. The worst
/// hundredth of the pixels is left out: beside lamps a filtered error is that of brighter
/// neighbours. NaN if errors are not known.
double relative_error(const XyzPicture& light, const std::vector<float>& standard_error_y);

/// Whether a pixel belongs to the first picture, of half the size: one of four does.
constexpr bool comes_first(int column, int row) {
  return column % 2 == 0 && row % 2 == 0;
}

/// Least number of paths that a pass adds, and that a first picture has in one pixel of four.
inline constexpr int min_pass = 4;
static_assert(min_pass >= min_filtered_paths);
/// How many of the average paths are the same for all pixels.
int even_paths(const PictureOptions& options);
/// Number of paths of a pixel after the next pass: 4, 8, 16, 32, 48, 64, 96 and so on.
int next_pass(int paths);

/// A camera's picture that grows path by path. Its bits do not depend on how paths were added. One
/// thread at a time.
class ViewPasses {
 public:
  /// `number`: seeds the random numbers, one per camera; below 2^16. `flux`: the light that paths
  /// end in, or null. `sight`: from make_emitter_sight, shared by all pictures of the run; pixels
  /// do not depend on its cache. Both may be null if only the results of others are taken.
  /// `flames_at_s`: the moment of steady flames; nothing: their mean.
  /// Requires: run and flux outlive this.
  ViewPasses(const LocalRun& run, const Camera& camera, uint64_t number, const RadianceCache* flux,
             std::shared_ptr<const EmitterSight> sight,
             std::optional<double> flames_at_s = std::nullopt);
  ViewPasses(const ViewPasses&) = delete;
  ViewPasses& operator=(const ViewPasses&) = delete;

  /// Memory that the sums of a picture take [bytes].
  static uint64_t bytes_of(const Camera& camera);

  /// Adds the first paths of one pixel of four, those of even columns and rows. False if it was
  /// interrupted. Requires: paths() == 0, and add() then adds at least as many.
  bool add_first(int paths, const PictureOptions& options, const ShareDone& progress = {});
  /// These pixels as a picture of half the size. Requires: add_first() was the last call.
  TracedPicture first_picture() const;
  /// Adds this many paths to each pixel. False if it was interrupted: then none was added.
  /// Requires: paths() + `paths` <= limits::max_paths_per_pixel.
  bool add(int paths, const PictureOptions& options, const ShareDone& progress = {});
  /// The ends of each pixel's paths if `more` per pixel on average are added (path_allocation.hpp).
  /// Requires: paths() is a multiple of four and the same for all pixels.
  std::vector<HalfEnds> allocate(int more) const;
  /// Adds paths up to these ends, which come from allocate(more); no others may follow. False if it
  /// was interrupted: then none was added.
  bool add_allocated(const std::vector<HalfEnds>& ends, int more, const PictureOptions& options,
                     const ShareDone& progress = {});
  /// Takes paths that others have traced from the present state: sums of pixels as bins of a group
  /// of totals, which are removed from the totals (PixelSums::bin).
  void take_first(Totals& totals, int group, int paths);
  void take(Totals& totals, int group, int paths);
  void take_allocated(Totals& totals, int group, int more);
  /// Paths of each pixel; including allocated ones, on average.
  int paths() const { return paths_ + allocated_; }
  /// The picture so far. Requires: paths() > 0.
  TracedPicture picture() const;

 private:
  size_t pixels() const;
  void take_sums(Totals& totals, int group);
  template <class PathsOf>
  bool trace(const PictureOptions& options, const ShareDone& progress, const PathsOf& paths_of);
  TracedPicture picture_of(const std::vector<const PixelSums*>& sums, int width, int height,
                           int paths_of_all) const;

  const LocalRun& run_;
  const Camera camera_;
  const uint64_t number_;
  const RadianceCache* flux_;
  std::shared_ptr<const EmitterSight> sight_;  // shared by all pictures and threads
  const std::optional<double> flames_at_s_;
  std::vector<PixelSums> sums_;
  int paths_ = 0;        // of each pixel
  int allocated_ = 0;    // in addition, on average
  int first_paths_ = 0;  // of pixels of even columns and rows, while others have none
};

/// Traces one camera's picture; an empty one if it was interrupted. `flux`: the light that paths
/// end in, or null. Requires: camera is one of the scene's; 1 <= paths_per_pixel <=
/// limits::max_paths_per_pixel.
TracedPicture trace_picture(const LocalRun& run, size_t camera, const PictureOptions& options,
                            const RadianceCache* flux, const ShareDone& progress = {});

/// Progress of the pictures of a call.
struct PictureProgress {
  double share = 0;           // of the work, as estimated so far
  int paths = 0;              // of every pixel
  double relative_error = 0;  // of the worst picture that was shown; NaN: not known yet
};

struct RenderedViews {
  bool interrupted = false;   // ended before all requested paths
  int paths = 0;              // per pixel, of the picture with the fewest
  double relative_error = 0;  // of the worst picture as PNG files show it; NaN: not known
  /// Names of the cameras whose pictures were written, and the exposures of these.
  std::vector<std::pair<std::string, Exposure>> exposures;
};

/// Traces every camera, or the one named `only_view`, and writes into folder/views (made if
/// missing): NAME.exr (traced and filtered light, errors, features), NAME.png (one exposure),
/// NAME_human.png (the view of an adapted eye), NAME_luminance.png (false colours with a scale; up
/// to 8192 pixels an edge); NAME is that of result_names(). A scene without cameras has no
/// pictures, which is no error. An interrupted call leaves pictures of the paths that all pixels
/// have. `after_first` is called once, as soon as first pictures exist or none will, and its time
/// does not count against theirs; not after an earlier failure. Only views that are traced together
/// with the first one (within max_growing_bytes) exist by then.
/// Errors: as check_views; a file that cannot be written; those of `after_first`.
Result<RenderedViews> render_views(const std::filesystem::path& folder, const LocalRun& run,
                                   const std::string& only_view, const PictureOptions& options,
                                   const std::function<void(const PictureProgress&)>& progress,
                                   const std::function<Result<void>()>& after_first = {});

/// Errors: no camera of that name, paths per pixel out of range, a picture that takes more memory
/// than limits::max_view_bytes.
Result<void> check_views(const SceneDescription& scene, const std::string& only_view,
                         const PictureOptions& options);

}  // namespace luxodus
