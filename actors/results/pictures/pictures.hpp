// Pictures of a run's cameras: luminance data first (OpenEXR, cd/m2), pixels second. Paths are
// traced from the eye; a path ends in the run's flux at the first event after something diffuse, on
// a surface or in smoke (final gather), so a picture takes seconds once the flux is there. What is
// traced is neither clamped nor blurred; what PNG files show is filtered (regression_filter.hpp).
// The standard error of a pixel is that of its paths and of the flux that they end in, which is
// common to many of them. The last quarter of the paths goes where the filter would leave most
// error (path_allocation.hpp). Pixels depend on the scene, the flux, the seed and the paths per
// pixel, never on the number of threads, nor on whether their paths were traced at once or in
// passes. One call at a time per run.
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

namespace limits {
/// Memory of the sums of one picture [bytes], of 36 megapixels; and of those that grow together.
inline constexpr uint64_t max_view_bytes = uint64_t{20} << 30;
inline constexpr uint64_t max_growing_bytes = uint64_t{1} << 30;
}  // namespace limits

struct PictureOptions {
  /// On average; at most, where one of the two below may end a picture before.
  int paths_per_pixel = 28;
  /// Of all pictures of a call, with what filters and writes them [s]; 0: as long as it takes.
  double max_seconds = 0;
  /// Of the worst picture (ViewError): it may end where it is no more; 0: never.
  double target_error = 0;
  /// Writes what there is as it grows, the first after one path for each pixel.
  bool progressive = false;
  /// End paths in the run's flux. Without it they are traced to their end: slower and noisier, free
  /// of the patches' size. A run that has traced nothing has no flux to end in.
  bool gather = true;
  /// PNG files show light as traced, instead of filtered. All pixels have as many paths then;
  /// without it some go where the filter leaves most error (even_paths).
  bool raw = false;
  HumanTone human;  // monitor and limits of sight of human views; angles are those of each camera
  /// When it is set, what is under way ends within a pixel, and pictures that are not whole are not
  /// written. Null: nobody interrupts.
  const std::atomic<bool>* interrupt = nullptr;
  /// Whether what is under way shall end for another reason, likewise; none: there is none.
  std::function<bool()> gives_up = {};
  /// Who traces the pictures, tile by tile; null: the threads of the run.
  Executor* executor = nullptr;

  bool may_end_early() const { return interrupt != nullptr || gives_up; }
  bool interrupted() const {
    return (interrupt != nullptr && interrupt->load()) || (gives_up && gives_up());
  }
};

/// A camera's picture, the standard error of its luminance, and what a filter needs of it.
struct TracedPicture {
  XyzPicture light;                     // with scotopic luminance from the bands
  std::vector<float> standard_error_y;  // [cd/m2]; NaN with one path per pixel
  std::vector<float> flux_error_y;      // of it, what the run's flux errs by
  /// X, Y, Z, scotopic of what emitters send straight to the eye, without chance but for where in
  /// the pixel [cd/m2]; the halves of `noisy` are without it.
  std::vector<float> emitted;
  NoisyPicture noisy;
};

struct FilteredView {
  XyzPicture light;
  std::vector<float> standard_error_y;  // [cd/m2] by the difference of two halves
};

/// Paths that a filter needs of a pixel: each half two, to know its error.
inline constexpr int min_filtered_paths = 4;

/// Requires: min_filtered_paths per pixel at least; threads >= 1. The same for any threads.
FilteredView filter_traced(const TracedPicture& traced, int threads,
                           const RegressionFilter& filter = {});

/// Error of a picture as people see it: the root of the mean over pixels of the relative standard
/// error of luminance, squared. A pixel darker than a hundredth of the mean counts as that bright.
/// The worst hundredth of the pixels is left out: beside lamps a filtered error is that of its
/// brighter neighbours. NaN where errors are not known.
double relative_error(const XyzPicture& light, const std::vector<float>& standard_error_y);

/// Pixels of the first picture, of half the size: one of four.
constexpr bool comes_first(int column, int row) {
  return column % 2 == 0 && row % 2 == 0;
}

/// Paths that a pass adds at least, and that a first picture has in one pixel of four.
inline constexpr int min_pass = 4;
static_assert(min_pass >= min_filtered_paths);
/// How many paths all pixels have, of those that there are on average.
int even_paths(const PictureOptions& options);
/// How many paths a pixel has after the next pass: 4, 8, 16, 32, 48, 64, 96 and so on.
int next_pass(int paths);

/// A camera's picture as it grows, path by path. Pixels are the same bits however paths were added.
class ViewPasses {
 public:
  /// `number`: of the random numbers, a camera's own; below 2^16. `flux`: where paths end, or null.
  /// `sight`: of make_emitter_sight, for all pictures of the run; pixels do not depend on what it
  /// has learned before. Whoever only takes what others have traced needs neither.
  /// Requires: run and flux outlive this.
  ViewPasses(const LocalRun& run, const Camera& camera, uint64_t number, const KnownRadiance* flux,
             std::shared_ptr<const EmitterSight> sight);
  ViewPasses(const ViewPasses&) = delete;
  ViewPasses& operator=(const ViewPasses&) = delete;

  /// Memory that the sums of a picture take [bytes].
  static uint64_t bytes_of(const Camera& camera);

  /// Adds the first paths of one pixel of four, those of even columns and rows. False where it was
  /// interrupted. Requires: paths() == 0, and add() adds as many at least.
  bool add_first(int paths, const PictureOptions& options, const ShareDone& progress = {});
  /// These pixels as a picture of half the size. Requires: add_first() was the last call.
  TracedPicture first_picture() const;
  /// Adds so many paths to each pixel. False where it was interrupted: then none was added.
  /// Requires: paths() + `paths` <= limits::max_paths_per_pixel.
  bool add(int paths, const PictureOptions& options, const ShareDone& progress = {});
  /// Where `more` paths for each pixel on average are to end (path_allocation.hpp).
  /// Requires: paths() is a multiple of four and the same for all pixels.
  std::vector<HalfEnds> allocate(int more) const;
  /// Adds paths up to these ends, which are of allocate(more): the last that are added. False where
  /// it was interrupted: then none was added.
  bool add_allocated(const std::vector<HalfEnds>& ends, int more, const PictureOptions& options,
                     const ShareDone& progress = {});
  /// The same of what others have traced, who begin where this stands: sums of pixels as bins of a
  /// group of totals, which are taken out of them (PixelSums::bin).
  void take_first(Totals& totals, int group, int paths);
  void take(Totals& totals, int group, int paths);
  void take_allocated(Totals& totals, int group, int more);
  /// Of each pixel; with allocated ones, on average.
  int paths() const { return paths_ + allocated_; }
  /// What there is of it. Requires: paths() > 0.
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
  const KnownRadiance* flux_;
  std::shared_ptr<const EmitterSight> sight_;  // of all pictures and threads
  std::vector<PixelSums> sums_;
  int paths_ = 0;        // of each pixel
  int allocated_ = 0;    // beside them, on average
  int first_paths_ = 0;  // that pixels of even columns and rows have when others have none
};

/// One camera's picture; an empty one where it was interrupted. `flux`: where paths end, or
/// null. Requires: camera is one of the scene's; 1 <= paths_per_pixel <=
/// limits::max_paths_per_pixel.
TracedPicture trace_picture(const LocalRun& run, size_t camera, const PictureOptions& options,
                            const KnownRadiance* flux, const ShareDone& progress = {});

/// How far the pictures of a call are.
struct PictureProgress {
  double share = 0;           // of the work, as far as anybody knows
  int paths = 0;              // that every pixel has
  double relative_error = 0;  // of the worst picture that was shown; NaN: not known yet
};

struct RenderedViews {
  bool interrupted = false;   // before all was done that was asked for
  int paths = 0;              // per pixel, of the picture with the fewest
  double relative_error = 0;  // of the worst picture as PNG files show it; NaN: not known
};

/// Traces every camera, or the one named `only_view`, and writes into folder/views (made if
/// missing): NAME.exr (light as traced and filtered, errors, features), NAME.png (one exposure),
/// NAME_human.png (what an adapted eye tells apart), NAME_luminance.png (false colours with a
/// scale; up to 8192 pixels an edge); NAME is that of result_names(). A scene without cameras has
/// no pictures, which is no error. Where it is interrupted, pictures of the paths that all of their
/// pixels have are there. `after_first` is called once, as soon as there are first pictures or none
/// are to be awaited, and takes none of their time; not where this fails before. Only views that
/// grow together with the first one (within max_growing_bytes) have theirs by then.
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
