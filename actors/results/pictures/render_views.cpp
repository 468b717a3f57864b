// Pictures of all cameras, refined together. All of them get a few paths, then all a few more, so
// that each exists early; the last paths are allocated. Steps follow from the number of paths
// alone, and a time or error limit ends a picture between steps: the result is that of the same
// number of paths at once. Files are replaced atomically. The cost of writing limits how often it
// is done.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <limits>
#include <mutex>
#include <utility>

#include "actors/results/files/result_files.hpp"
#include "actors/results/pictures/picture_tiles.hpp"
#include "actors/results/pictures/shared_exposure.hpp"
#include "actors/results/pictures/view_files.hpp"

namespace luxodus {

namespace {

static_assert(min_pass == PictureExecutor::paths_of_tile);
/// Smaller pictures take no time.
constexpr int64_t min_first_pixels = 10'000;
/// Before the cost of writing is known, none is due earlier than this [s].
constexpr double unknown_writing_s = 5;
/// Between two writings, this many times the cost of one is spent on paths.
constexpr double paths_per_writing = 10;
/// Estimates the first cost of writing, in units of that of the first pictures: these have one
/// pixel of four, and one file of four.
constexpr double whole_by_first = 4;
/// The last writing gets this many times the time of the one before: later pictures compress no
/// better.
constexpr double writing_slack = 1.2;

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }
  /// Seconds of other work, which do not count.
  template <class Work>
  auto left_out(const Work& work) {
    const auto before = Clock::now();
    auto outcome = work();
    began_ += Clock::now() - before;
    return outcome;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point began_ = Clock::now();
};

/// The cameras to render, by number.
Result<std::vector<size_t>> chosen_views(const SceneDescription& scene, const std::string& only) {
  std::vector<size_t> out;
  std::string known;
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    if (only.empty() || scene.cameras[i].name == only) out.push_back(i);
    known += (known.empty() ? "\"" : ", \"") + scene.cameras[i].name + "\"";
  }
  if (!only.empty() && out.empty()) {
    return problem_in(scene.file,
                      "there is no camera \"" + only + "\"; there " +
                          (known.empty() ? "are none: add a [[camera]]" : "are: " + known));
  }
  return out;
}

struct GrowingView {
  GrowingView(const LocalRun& run, size_t of, const PictureFlux& flux,
              std::optional<double> flames_at_s)
      : camera(run.scene().description->cameras[of]),
        number(of),
        passes(run, camera, of, flux.radiance.get(), flux.sight, flames_at_s) {}

  double pixels() const { return static_cast<double>(camera.width) * camera.height; }

  /// Small pictures take no time, and need no first one.
  bool shows_first(const PictureOptions& options) const {
    return options.progressive && options.paths_per_pixel > min_pass &&
           int64_t{camera.width} * camera.height >= min_first_pixels;
  }

  const Camera& camera;
  size_t number;
  ViewPasses passes;
  std::filesystem::path stem;
  std::optional<ShownView> shown;  // kept until it is written
  int shown_paths = 0, written_paths = 0;
  std::optional<Exposure> exposure;                         // of the last written picture
  double error = std::numeric_limits<double>::quiet_NaN();  // of the last shown picture
};

/// Views that are refined together.
class GrowingViews {
 public:
  using Progress = std::function<void(const PictureProgress&)>;

  /// `seconds`: limit for all of them; 0: none.
  GrowingViews(const LocalRun& run, const PictureOptions& options, const PictureFlux& flux,
               double seconds, Progress progress)
      : run_(run),
        options_(options),
        flux_(flux),
        seconds_(seconds),
        progress_(std::move(progress)) {}

  void add(size_t camera, const std::filesystem::path& stem) {
    views_.emplace_back(run_, camera, flux_, options_.flames_at_s).stem = stem;
    pixels_ += views_.back().pixels();
  }

  /// Refines until all requested paths are done, or it is interrupted; then writes everything.
  /// `after_first`: called when first pictures exist.
  Result<void> grow(const std::function<Result<void>()>& after_first) {
    if (options_.executor != nullptr)
      elsewhere_.emplace(run_, tiled_views(), options_.paths_per_pixel, options_, flux_);
    if (auto ok = show_first(); !ok) return ok;
    if (auto ok = watch_.left_out(after_first); !ok) return ok;
    for (int target = next_target(); target > 0 && !interrupted_; target = next_target()) {
      const double before_s = watch_.seconds();
      const int added = target - paths_;
      add_paths(added);
      if (interrupted_) break;
      seconds_per_path_ = (watch_.seconds() - before_s) / added;
      // The filter estimates the error, which needs no files.
      if (options_.target_error > 0) look();
      if (!should_write()) continue;
      if (auto ok = write(); !ok) return ok;
    }
    if (const int more = next_allocation(); more > 0) add_allocated(more);
    return write();
  }

  bool interrupted() const { return interrupted_; }
  int paths() const {
    int fewest = std::numeric_limits<int>::max();
    for (const GrowingView& view : views_) fewest = std::min(fewest, view.passes.paths());
    return fewest;
  }
  /// Error of the worst view; NaN if one is not known.
  double error() const {
    double worst = 0;
    for (const GrowingView& view : views_)
      if (!std::isnan(worst) && !(view.error <= worst)) worst = view.error;
    return worst;
  }
  double seconds() const { return watch_.seconds(); }
  /// Of the pictures that were written.
  void add_exposures(std::vector<std::pair<std::string, Exposure>>& out) const {
    for (const GrowingView& view : views_)
      if (view.exposure) out.emplace_back(view.camera.name, *view.exposure);
  }

 private:
  Result<void> show_first() {
    const double before_s = watch_.seconds();
    bool any = false;
    for (size_t i = 0; i < views_.size(); ++i) {
      GrowingView& view = views_[i];
      if (!view.shows_first(options_)) continue;
      any = true;
      interrupted_ |= elsewhere_ ? !elsewhere_->add_first(i, view.passes)
                                 : !view.passes.add_first(min_pass, options_);
      if (interrupted_) return {};
      const ShownView half(view.passes.first_picture(), min_pass, options_, run_.threads(),
                           first_filter);
      if (auto ok = write_first_view(view.stem, run_, view.camera, half); !ok) return ok;
    }
    if (!any) return {};
    written_s_ = watch_.seconds();
    writing_s_ = whole_by_first * (written_s_ - before_s);
    return {};
  }

  bool is_good_enough() const {
    return options_.target_error > 0 && error() <= options_.target_error;
  }

  /// Paths for each pixel that fit into the time.
  int fitting() const {
    const double left_s = seconds_ - watch_.seconds() - writing_slack * writing_s_;
    return static_cast<int>(
        std::clamp(left_s / seconds_per_path_, 0.0, double{limits::max_paths_per_pixel}));
  }

  /// Number of paths of all pixels after the next step; 0: no step follows.
  int next_target() const {
    const int target = std::min(even_paths(options_), next_pass(paths_));
    if (target <= paths_ || is_good_enough()) return 0;
    if (!(seconds_ > 0) || paths_ == 0) return target;
    const int in_time = paths_ + fitting();
    const int even = options_.raw ? in_time : even_paths(in_time);
    const int steps = (even - paths_) / min_pass;
    return steps <= 0 ? 0 : std::min(target, paths_ + steps * min_pass);
  }

  /// Number of paths to allocate, per pixel on average; 0: none.
  int next_allocation() const {
    if (options_.raw || interrupted_ || is_good_enough()) return 0;
    const int even = even_paths(options_);
    const int more = options_.paths_per_pixel - even;
    if (paths_ == even && !(seconds_ > 0)) return more;
    // As many as if the paths that fit into the time had been requested.
    const int fit = std::min({options_.paths_per_pixel - paths_, (paths_ + 2) / 3, fitting()});
    return even_paths(paths_ + fit) == paths_ ? fit : 0;
  }

  /// Calls add(number, view, tell) for each view, which adds `count` paths per pixel, until one
  /// returns false, because it was interrupted and has changed nothing.
  template <class Add>
  void add_to_views(int count, const Add& add) {
    double before = 0;
    for (size_t i = 0; i < views_.size(); ++i) {
      GrowingView& view = views_[i];
      const auto tell = [&](double share) {
        show_progress(paths_ + count * (before + share * view.pixels()) / pixels_);
      };
      interrupted_ |= !add(i, view, tell);
      if (interrupted_) return;
      before += view.pixels();
    }
    paths_ += count;
  }

  void add_paths(int count) {
    add_to_views(count, [&](size_t i, GrowingView& view, const ShareDone& tell) {
      return elsewhere_ ? elsewhere_->add(i, view.passes, count, tell)
                        : view.passes.add(count, options_, tell);
    });
  }

  void add_allocated(int more) {
    std::vector<TiledView> tiled = tiled_views();
    for (size_t i = 0; i < views_.size(); ++i) tiled[i].ends = views_[i].passes.allocate(more);
    if (elsewhere_) elsewhere_.emplace(run_, tiled, paths_, options_, flux_);
    add_to_views(more, [&](size_t i, GrowingView& view, const ShareDone& tell) {
      return elsewhere_ ? elsewhere_->add_allocated(i, view.passes, more, tell)
                        : view.passes.add_allocated(tiled[i].ends, more, options_, tell);
    });
  }

  void show_progress(double paths) const {
    if (!progress_) return;
    double share = paths / options_.paths_per_pixel;
    if (seconds_ > 0) share = std::max(share, watch_.seconds() / seconds_);
    // The error falls with the root of the paths.
    if (options_.target_error > 0 && error() > options_.target_error)
      share = std::max(share, paths / looked_ * std::pow(options_.target_error / error(), 2));
    progress_({std::min(share, 1.0), paths_, error()});
  }

  bool should_write() const {
    if (!options_.progressive) return false;
    // One writing measures its cost, which a time limit needs.
    if (written_ == 0 && (seconds_ > 0 || !(writing_s_ > 0)))
      return seconds_ > 0 || watch_.seconds() > unknown_writing_s;
    return watch_.seconds() - written_s_ > paths_per_writing * writing_s_;
  }

  /// Filters views with new paths since they were filtered, or interrupted.
  void look() {
    const double before_s = watch_.seconds();
    bool any = false;
    for (GrowingView& view : views_) {
      const int paths = view.passes.paths();
      if (paths == 0 || paths == view.shown_paths) continue;
      any = true;
      view.shown.emplace(view.passes.picture(), paths, options_, run_.threads());
      view.shown_paths = paths;
      view.error = view.shown->error();
    }
    if (!any) return;
    looked_ = paths_;
    looking_s_ = watch_.seconds() - before_s;
    if (progress_) show_progress(paths_);
  }

  /// Writes views with new paths since they were written.
  Result<void> write() {
    look();
    const double before_s = watch_.seconds();
    if (auto ok = write_files(); !ok) return ok;
    written_ = paths_;
    written_s_ = watch_.seconds();
    writing_s_ = looking_s_ + written_s_ - before_s;
    return {};
  }

  /// On all threads: each file is compressed by one.
  Result<void> write_files() {
    std::vector<GrowingView*> shown;
    for (GrowingView& view : views_)
      if (view.shown && view.shown_paths != view.written_paths) shown.push_back(&view);
    // Metered once for the file and for the console.
    for (GrowingView* const view : shown)
      view->exposure = view->shown->exposure = shown_exposure(run_, view->camera, *view->shown);
    if (options_.exposed_with != nullptr)
      for (const GrowingView* const view : shown)
        if (auto ok = options_.exposed_with->keep(std::filesystem::path(view->stem) += ".png", run_,
                                                  view->camera, *view->shown);
            !ok)
          return ok;
    std::mutex mutex;
    Result<void> outcome;
    const auto write_one = [&](int64_t unit) {
      const GrowingView& view = *shown[static_cast<size_t>(unit) / view_file_count];
      const auto file = static_cast<ViewFile>(static_cast<size_t>(unit) % view_file_count);
      auto written = write_view_file(view.stem, file, run_, view.camera, *view.shown);
      const std::lock_guard lock(mutex);
      if (!written && outcome) outcome = written.problem();
    };
    parallel_for(static_cast<int64_t>(shown.size() * view_file_count), run_.threads(),
                 [&] { return write_one; });
    for (GrowingView* const view : shown) {
      view->written_paths = view->shown_paths;
      view->shown.reset();
    }
    return outcome;
  }

  std::vector<TiledView> tiled_views() const {
    std::vector<TiledView> views;
    for (const GrowingView& view : views_)
      views.push_back(
          {view.camera, view.number, view.shows_first(options_), {}, options_.flames_at_s});
    return views;
  }

  const LocalRun& run_;
  const PictureOptions& options_;
  const PictureFlux& flux_;
  const double seconds_;
  const Progress progress_;
  std::deque<GrowingView> views_;
  std::optional<PictureExecutor> elsewhere_;  // traces on other nodes
  double pixels_ = 0;
  int paths_ = 0;  // of all views
  bool interrupted_ = false;
  Stopwatch watch_;
  double seconds_per_path_ = 0;
  int looked_ = 0;        // paths of the last filtered pictures
  double looking_s_ = 0;  // time for filtering
  int written_ = 0;       // paths of the last written pictures
  double written_s_ = 0;  // when
  double writing_s_ = 0;  // time for writing, with filtering
};

/// Views that fit into memory together, one group after another.
std::vector<std::vector<size_t>> in_groups(const SceneDescription& scene,
                                           const std::vector<size_t>& views) {
  std::vector<std::vector<size_t>> groups;
  uint64_t bytes = 0;
  for (const size_t view : views) {
    const uint64_t more = ViewPasses::bytes_of(scene.cameras[view]);
    if (groups.empty() || bytes + more > limits::max_growing_bytes) {
      groups.emplace_back();
      bytes = 0;
    }
    groups.back().push_back(view);
    bytes += more;
  }
  return groups;
}

double pixels_of(const SceneDescription& scene, const std::vector<size_t>& views) {
  double pixels = 0;
  for (const size_t view : views)
    pixels += static_cast<double>(scene.cameras[view].width) * scene.cameras[view].height;
  return pixels;
}

}  // namespace

Result<void> check_views(const SceneDescription& scene, const std::string& only_view,
                         const PictureOptions& options) {
  if (options.paths_per_pixel < 1 || options.paths_per_pixel > limits::max_paths_per_pixel) {
    return problem_in(scene.file, "paths per pixel must be 1 to " +
                                      std::to_string(limits::max_paths_per_pixel) + ", not " +
                                      std::to_string(options.paths_per_pixel));
  }
  const auto views = chosen_views(scene, only_view);
  if (!views) return views.problem();
  for (const size_t view : views.value()) {
    const Camera& camera = scene.cameras[view];
    if (ViewPasses::bytes_of(camera) <= limits::max_view_bytes) continue;
    const uint64_t gib = ViewPasses::bytes_of(camera) >> 30;
    return problem_in(camera.place, "camera \"" + camera.name + "\": a picture of " +
                                        std::to_string(camera.width) + " x " +
                                        std::to_string(camera.height) + " pixels takes " +
                                        std::to_string(gib) + " GiB of memory, and " +
                                        std::to_string(limits::max_view_bytes >> 30) +
                                        " GiB is the most: give it fewer pixels");
  }
  return {};
}

namespace {

Result<RenderedViews> render_all(const std::filesystem::path& folder, const LocalRun& run,
                                 const std::vector<size_t>& views, const PictureOptions& options,
                                 const std::function<void(const PictureProgress&)>& progress,
                                 const std::function<Result<void>()>& after_first) {
  const SceneDescription& scene = *run.scene().description;
  RenderedViews rendered;
  const PictureFlux flux = picture_flux(run, options);
  const std::vector<std::string> names = result_names(scene).views;
  double seconds = options.max_seconds, done = 0;
  double left = pixels_of(scene, views);
  const double all = left;
  rendered.paths = std::numeric_limits<int>::max();
  for (const std::vector<size_t>& group : in_groups(scene, views)) {
    const double pixels = pixels_of(scene, group);
    const auto tell = [&](PictureProgress of_group) {
      of_group.share = (done + of_group.share * pixels) / all;
      if (progress) progress(of_group);
    };
    GrowingViews growing(run, options, flux, seconds * pixels / left, tell);
    for (const size_t view : group) growing.add(view, folder / "views" / names[view]);
    if (auto ok = growing.grow(after_first); !ok) return ok.problem();
    growing.add_exposures(rendered.exposures);
    rendered.paths = std::min(rendered.paths, growing.paths());
    if (!(growing.error() <= rendered.relative_error)) rendered.relative_error = growing.error();
    rendered.interrupted = growing.interrupted();
    if (rendered.interrupted) return rendered;
    seconds = std::max(seconds - growing.seconds(), seconds > 0 ? 1e-3 : 0);
    left -= pixels;
    done += pixels;
  }
  return rendered;
}

}  // namespace

Result<RenderedViews> render_views(const std::filesystem::path& folder, const LocalRun& run,
                                   const std::string& only_view, const PictureOptions& options,
                                   const std::function<void(const PictureProgress&)>& progress,
                                   const std::function<Result<void>()>& after_first) {
  const SceneDescription& scene = *run.scene().description;
  if (auto ok = check_views(scene, only_view, options); !ok) return ok.problem();
  const auto views = chosen_views(scene, only_view);
  std::function<Result<void>()> once = after_first;
  const auto once_after_first = [&once]() -> Result<void> {
    const auto work = std::exchange(once, nullptr);
    return work ? work() : Result<void>();
  };
  if (views->empty()) {
    if (auto ok = once_after_first(); !ok) return ok.problem();
    return RenderedViews();
  }
  std::error_code error;
  std::filesystem::create_directories(folder / "views", error);
  if (error) return system_problem(folder / "views", "cannot make this folder", error.value());
  PictureOptions of_call = options;
  std::optional<SharedExposure> shared;
  if (options.share_exposure && options.exposed_with == nullptr)
    of_call.exposed_with = &shared.emplace(folder / "views");
  auto rendered = render_all(folder, run, views.value(), of_call, progress, once_after_first);
  if (!rendered) return rendered;
  if (options.exposed_with != nullptr) rendered->exposures.clear();
  if (!shared || shared->pictures() == 0) return rendered;
  const auto exposure = shared->write(run.threads());
  if (!exposure) return exposure.problem();
  for (auto& [name, of_picture] : rendered->exposures) of_picture = exposure.value();
  return rendered;
}

}  // namespace luxodus
