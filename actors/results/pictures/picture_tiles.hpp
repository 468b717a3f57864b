// Pictures as work for an executor: a state of the scene whose batches are tiles of pictures.
// Tracers elsewhere know the scene; the state carries cameras and the flux that paths end in. Sums
// are integers, so pixels are bit for bit those of threads (ViewPasses::add), whoever traces a
// tile. PictureStates: any thread; all others: one thread at a time.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "actors/results/pictures/pictures.hpp"
#include "actors/results/run/executor.hpp"

namespace luxodus {

namespace limits {
/// Views of one state: bits of a source group's number (BatchRange).
inline constexpr size_t max_tiled_views = 4096;
}  // namespace limits

/// A picture made of tiles.
struct TiledView {
  Camera camera;
  uint64_t number = 0;  // seed part of its random numbers; see ViewPasses
  bool first = false;   // whether a first picture is traced before it (ViewPasses::add_first)
  /// Ends of the allocated paths of all pixels (ViewPasses::allocate); empty without allocation.
  std::vector<HalfEnds> ends = {};
  std::optional<double> flames_at_s = {};  // moment of steady flames; nothing: their mean
};

/// The pictures of a state.
struct TiledPictures {
  std::vector<TiledView> views;
  int paths_per_pixel = 0;  // at most; allocated paths follow
  std::string flux;         // the bytes of the flux file that paths end in; "" if they do not
};

/// JSON, whose numbers read back to the same bits, followed by ends of paths and the flux.
std::string tiles_text(const TiledPictures& pictures);
/// Errors: malformed text; views that are not pictures, or take more memory than
/// limits::max_view_bytes; too many of them.
Result<TiledPictures> parse_tiles(const std::string& text);

/// A state whose batches are tiles: `group` is the view, `stream` selects the paths of each pixel.
class PictureState final : public TracedState {
 public:
  /// `flux`: that of `pictures`, or null. `sight`: from make_emitter_sight.
  /// Requires: the run is resident, and outlives this.
  PictureState(const LocalRun& run, TiledPictures pictures,
               std::shared_ptr<const RadianceCache> flux,
               std::shared_ptr<const EmitterSight> sight);

  std::unique_ptr<Totals> totals() const override;
  /// Throws std::runtime_error: `seed` is not the run's.
  std::unique_ptr<BatchWorker> worker(uint64_t seed, int64_t portion,
                                      const TracerMaker& make_tracer) const override;

  const LocalRun& run() const { return run_; }
  const TiledPictures& pictures() const { return pictures_; }
  const RadianceCache* flux() const { return flux_.get(); }
  const std::shared_ptr<const EmitterSight>& sight() const { return sight_; }

 private:
  const LocalRun& run_;
  const TiledPictures pictures_;
  const std::shared_ptr<const RadianceCache> flux_;
  const std::shared_ptr<const EmitterSight> sight_;  // shared by all workers
  TallyLayout layout_;
};

/// Makes states of pictures of one run's scene, on nodes. The nodes of a process share the last one
/// made. Any thread.
class PictureStates final : public StateMaker {
 public:
  /// The run's own totals are not used. Requires: it is resident, and outlives this and all states.
  explicit PictureStates(const LocalRun& run);
  /// Errors: as parse_tiles; a flux of another scene, scenario or seed than the run's.
  Result<std::shared_ptr<const TracedState>> make(const std::string& text) override;

 private:
  Result<std::shared_ptr<const RadianceCache>> radiance_of(const std::string& flux);

  const LocalRun& run_;
  const std::shared_ptr<const EmitterSight> sight_;  // shared by all states: it does not depend on
                                                     // cameras
  std::mutex mutex_;                                 // guards all members below
  std::string text_, flux_;
  std::shared_ptr<const RadianceCache> radiance_;  // radiance of the flux
  std::shared_ptr<const TracedState> state_;
};

/// Light that the paths of pictures end in, for tracers here and elsewhere, and the data for
/// choosing emitters. Shared by all pictures of a run.
struct PictureFlux {
  std::shared_ptr<const RadianceCache> radiance;  // null: paths are traced to their end
  std::string bytes;                              // bytes of a flux file; empty if nobody needs
                                                  // them
  std::shared_ptr<const EmitterSight> sight;      // from make_emitter_sight
};

/// The flux of a run, as `options` ask for it. Requires: the run outlives it.
/// Throws std::runtime_error: as flux_radiance; more than a flux file can hold.
PictureFlux picture_flux(const LocalRun& run, const PictureOptions& options);

/// Traces pictures by an executor.
class PictureExecutor {
 public:
  /// Enters their state. `paths`: of each pixel, at most. Requires: the run is resident;
  /// options.executor is set; all that is referred to outlives this.
  PictureExecutor(const LocalRun& run, std::vector<TiledView> views, int paths,
                  const PictureOptions& options, const PictureFlux& flux);

  /// Like ViewPasses::add_first and ViewPasses::add, for the picture of `view`.
  /// Requires: `passes` belong to that picture and have only been extended here; for add(): they
  /// have a number of paths that is a multiple of `paths_of_tile`, as has the sum, or the maximum.
  bool add_first(size_t view, ViewPasses& passes, const ShareDone& progress = {});
  bool add(size_t view, ViewPasses& passes, int paths, const ShareDone& progress = {});
  /// Like ViewPasses::add_allocated, with the ends of the view. Requires: `passes` have the number
  /// of paths per pixel that the state says.
  bool add_allocated(size_t view, ViewPasses& passes, int more, const ShareDone& progress = {});

  /// Paths of each pixel of a tile.
  static constexpr int paths_of_tile = 4;

 private:
  bool trace(size_t view, int first_step, int end_step, const ShareDone& progress);

  const PictureOptions& options_;
  const PictureState state_;
  std::unique_ptr<Totals> totals_;
};

}  // namespace luxodus
