// Pictures as work for an executor: a state of the scene whose batches are tiles of pictures.
// Whoever traces them elsewhere knows the scene; cameras and the flux that paths end in come with
// the state. Sums are whole numbers, so pixels are the same bits as those of threads
// (ViewPasses::add), whoever traces which tile.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "actors/results/pictures/pictures.hpp"
#include "actors/results/run/executor.hpp"

namespace luxodus {

namespace limits {
/// Views of one state: bits of a source group's number (BatchRange).
inline constexpr size_t max_tiled_views = 4096;
}  // namespace limits

/// A picture that is made of tiles.
struct TiledView {
  Camera camera;
  uint64_t number = 0;  // of the random numbers; see ViewPasses
  bool first = false;   // whether its first picture is traced before it (ViewPasses::add_first)
  /// Of all pixels, where paths end that are allocated (ViewPasses::allocate); none: there are
  /// none.
  std::vector<HalfEnds> ends = {};
};

/// What the tiles of a state are of.
struct TiledPictures {
  std::vector<TiledView> views;
  int paths_per_pixel = 0;  // at most; what is allocated follows
  std::string flux;         // the bytes of a flux file, in which paths end; none: they do not
};

/// JSON, whose numbers read back to the same bits; behind it ends of paths, and the flux.
std::string tiles_text(const TiledPictures& pictures);
/// Errors: a text that is none; views that are no pictures, or take more memory than
/// limits::max_view_bytes; too many of them.
Result<TiledPictures> parse_tiles(const std::string& text);

/// A state whose batches are tiles: of view `group`, where `stream` says which paths of each pixel.
class PictureState final : public TracedState {
 public:
  /// `flux`: of `pictures`, or null. `sight`: of make_emitter_sight.
  /// Requires: the run is resident, and outlives this.
  PictureState(const LocalRun& run, TiledPictures pictures,
               std::shared_ptr<const KnownRadiance> flux,
               std::shared_ptr<const EmitterSight> sight);

  std::unique_ptr<Totals> totals() const override;
  /// Throws std::runtime_error: `seed` is not the run's.
  std::unique_ptr<BatchWorker> worker(uint64_t seed, int64_t portion,
                                      const TracerMaker& make_tracer) const override;

  const LocalRun& run() const { return run_; }
  const TiledPictures& pictures() const { return pictures_; }
  const KnownRadiance* flux() const { return flux_.get(); }
  const std::shared_ptr<const EmitterSight>& sight() const { return sight_; }

 private:
  const LocalRun& run_;
  const TiledPictures pictures_;
  const std::shared_ptr<const KnownRadiance> flux_;
  const std::shared_ptr<const EmitterSight> sight_;  // of all workers
  TallyLayout layout_;
};

/// Pictures of one run's scene, as nodes make them. The nodes of a process share the last that any
/// of them was asked for. Any thread.
class PictureStates final : public StateMaker {
 public:
  /// Whatever the run has traced does not count. Requires: it is resident, and outlives this and
  /// all states.
  explicit PictureStates(const LocalRun& run);
  /// Errors: as parse_tiles; a flux of another scene, scenario or seed than the run's.
  Result<std::shared_ptr<const TracedState>> make(const std::string& text) override;

 private:
  Result<std::shared_ptr<const KnownRadiance>> radiance_of(const std::string& flux);

  const LocalRun& run_;
  const std::shared_ptr<const EmitterSight> sight_;  // of all states: cameras do not matter to it
  std::mutex mutex_;                                 // guards all below
  std::string text_, flux_;
  std::shared_ptr<const KnownRadiance> radiance_;  // of the flux
  std::shared_ptr<const TracedState> state_;
};

/// Light that the paths of pictures end in, for those who trace here and elsewhere; and what they
/// choose emitters by. For all pictures of a run.
struct PictureFlux {
  std::shared_ptr<const KnownRadiance> radiance;  // null: they are traced to their end
  std::string bytes;                              // of a flux file; none where nobody asks for them
  std::shared_ptr<const EmitterSight> sight;      // of make_emitter_sight
};

/// That of a run, as `options` ask for it. Requires: the run outlives it.
/// Throws std::runtime_error: as flux_radiance; more than a flux file can hold.
PictureFlux picture_flux(const LocalRun& run, const PictureOptions& options);

/// Has pictures traced by an executor.
class PictureExecutor {
 public:
  /// Enters their state. `paths`: of all pixels, at most. Requires: the run is resident;
  /// options.executor is there; all that is referred to outlives this.
  PictureExecutor(const LocalRun& run, std::vector<TiledView> views, int paths,
                  const PictureOptions& options, const PictureFlux& flux);

  /// As ViewPasses::add_first and ViewPasses::add, of the picture of `view`.
  /// Requires: `passes` are of that picture and have only been added to here; of add(): that they
  /// have a number of paths that is a multiple of `paths_of_tile`, as has the sum, or the most.
  bool add_first(size_t view, ViewPasses& passes, const ShareDone& progress = {});
  bool add(size_t view, ViewPasses& passes, int paths, const ShareDone& progress = {});
  /// As ViewPasses::add_allocated, of the ends that the view has. Requires: `passes` have the paths
  /// per pixel that the state says.
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
