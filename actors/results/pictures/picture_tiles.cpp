// A batch is 32 x 8 pixels with four paths each, or with their allocated paths: some ten
// milliseconds. So little is lost with a node, and a lease, its flush and their replies are short
// in comparison.
#include "actors/results/pictures/picture_tiles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "actors/results/formats/json_out.hpp"
#include "actors/results/run/flux_store.hpp"
#include "runtime/core/check.hpp"

namespace luxodus {

namespace {

constexpr int tile_width = 32, tile_height = 8;
/// Paths of a pixel traced without a pause: some milliseconds in thick smoke.
constexpr int paths_of_portion = 32;

/// A step is a stream of BatchRange: 0 is the first picture, 1 the allocated paths, then four paths
/// each.
constexpr int first_picture_step = 0, allocated_step = 1;
constexpr int step_of(int path) {
  return 2 + path / PictureExecutor::paths_of_tile;
}

struct PixelRange {
  int first_column, end_column, first_row, end_row;
};

int tiles_across(const Camera& camera) {
  return (camera.width + tile_width - 1) / tile_width;
}
int64_t tiles_of(const Camera& camera) {
  return int64_t{tiles_across(camera)} * ((camera.height + tile_height - 1) / tile_height);
}
PixelRange pixels_of(const Camera& camera, int64_t tile) {
  const int column = static_cast<int>(tile % tiles_across(camera)) * tile_width;
  const int row = static_cast<int>(tile / tiles_across(camera)) * tile_height;
  return {column, std::min(column + tile_width, camera.width), row,
          std::min(row + tile_height, camera.height)};
}

/// Traces tiles of a state, one at a time.
class TileWorker final : public BatchWorker {
 public:
  explicit TileWorker(const PictureState& state)
      : state_(state), tracers_(state.pictures().views.size()) {}

  void begin(const BatchRange& batch) override {
    if (static_cast<size_t>(batch.group) >= tracers_.size() ||
        batch.first >= tiles_of(view_of(batch).camera) ||
        batch.stream > step_of(state_.pictures().paths_per_pixel - 1) ||
        (batch.stream == allocated_step && view_of(batch).ends.empty()))
      throw std::runtime_error("a tile was lent of a picture that has none such");
    batch_ = batch;
    area_ = pixels_of(view_of(batch).camera, batch.first);
    done_ = 0;
    sums_.assign(
        static_cast<size_t>(columns()) * static_cast<size_t>(area_.end_row - area_.first_row), {});
  }

  bool go_on() override {
    for (int paths = 0; done_ < sums_.size() && paths < paths_of_portion; ++done_) {
      trace_pixel(done_);
      paths += sums_[done_].paths();
    }
    return done_ < sums_.size();
  }

  /// A tile is a few pixels: merging needs no pauses.
  void merge_into(Totals& totals, const std::function<void()>&) override {
    std::vector<Total> bins;
    for (int row = area_.first_row; row < area_.end_row; ++row) {
      bins.clear();
      for (int column = area_.first_column; column < area_.end_column; ++column)
        for (size_t k = 0; k < PixelSums::bins; ++k) bins.push_back(sums_[at(column, row)].bin(k));
      const int64_t pixel = int64_t{row} * view_of(batch_).camera.width + area_.first_column;
      totals.add_bins(batch_.group, pixel * static_cast<int64_t>(PixelSums::bins), bins);
    }
    totals.count_batch(batch_.group);
  }

 private:
  const TiledView& view_of(const BatchRange& batch) const {
    return state_.pictures().views[static_cast<size_t>(batch.group)];
  }
  int columns() const { return area_.end_column - area_.first_column; }
  size_t at(int column, int row) const {
    return static_cast<size_t>((row - area_.first_row) * columns() + column - area_.first_column);
  }

  void trace_pixel(size_t i) {
    const int column = area_.first_column + static_cast<int>(i) % columns();
    const int row = area_.first_row + static_cast<int>(i) / columns();
    const size_t pixel =
        static_cast<size_t>(row) * static_cast<size_t>(view_of(batch_).camera.width) +
        static_cast<size_t>(column);
    tracer().trace(column, row, pixel, paths_of(column, row, pixel), sums_[i]);
    counters_.paths += static_cast<uint64_t>(sums_[i].paths());
  }

  PathRange paths_of(int column, int row, size_t pixel) const {
    const bool first = view_of(batch_).first && comes_first(column, row);
    if (batch_.stream == allocated_step)
      return {state_.pictures().paths_per_pixel, view_of(batch_).ends[pixel]};
    if (batch_.stream == first_picture_step)
      return all_paths(0, first ? PictureExecutor::paths_of_tile : 0);
    const int from = (batch_.stream - step_of(0)) * PictureExecutor::paths_of_tile;
    if (from == 0 && first) return {};
    return all_paths(
        from, std::min(from + PictureExecutor::paths_of_tile, state_.pictures().paths_per_pixel));
  }

  PixelTracer& tracer() {
    std::optional<PixelTracer>& tracer = tracers_[static_cast<size_t>(batch_.group)];
    if (!tracer) {
      const LocalRun& run = state_.run();
      const TiledView& view = view_of(batch_);
      tracer.emplace(run.scene(), GeometryAccess::resident(run.index()), run.seed(), view.camera,
                     view.number, state_.flux(), state_.sight(), view.flames_at_s);
    }
    return *tracer;
  }

  const PictureState& state_;
  std::vector<std::optional<PixelTracer>> tracers_;  // by view
  BatchRange batch_;
  PixelRange area_{};
  size_t done_ = 0;  // pixels of it
  std::vector<PixelSums> sums_;
};

/// Steps of one picture, tile after tile.
class TilePass final : public Work {
 public:
  TilePass(const PictureState& state, const PictureOptions& options, Totals& totals, size_t view,
           int first_step, int end_step, const ShareDone& progress)
      : state_(state),
        options_(options),
        totals_(totals),
        view_(static_cast<int>(view)),
        tiles_(tiles_of(state.pictures().views[view].camera)),
        step_(first_step),
        end_step_(end_step),
        all_(tiles_ * (end_step - first_step)),
        progress_(progress) {}

  std::unique_ptr<BatchWorker> worker() const override {
    return state_.worker(state_.run().seed(), 1, {});
  }
  std::optional<BatchRange> next(int64_t most) override {
    if (options_.interrupted()) return std::nullopt;
    const std::lock_guard lock(mutex_);
    if (!again_.empty()) return take_again(most);
    if (step_ == end_step_) return std::nullopt;
    const BatchRange out{view_, step_, tile_, std::min(most, tiles_ - tile_)};
    tile_ += out.count;
    if (tile_ == tiles_) {
      tile_ = 0;
      ++step_;
    }
    return out;
  }
  void give_back(const BatchRange& batches) override {
    const std::lock_guard lock(mutex_);
    again_.push_back(batches);
  }
  bool stopped() const override { return options_.interrupted(); }
  Totals& totals() override { return totals_; }
  void merged(int64_t batches) override {
    const std::lock_guard lock(mutex_);
    merged_ += batches;
    if (progress_) progress_(static_cast<double>(merged_) / static_cast<double>(all_));
  }
  bool is_whole() const { return merged_ == all_; }

 private:
  BatchRange take_again(int64_t most) {
    BatchRange& left = again_.back();
    const BatchRange out{left.group, left.stream, left.first, std::min(left.count, most)};
    left.first += out.count;
    left.count -= out.count;
    if (left.count == 0) again_.pop_back();
    return out;
  }

  const PictureState& state_;
  const PictureOptions& options_;
  Totals& totals_;
  const int view_;
  const int64_t tiles_;
  std::mutex mutex_;  // guards all members below
  int step_;
  const int end_step_;
  int64_t tile_ = 0;
  std::vector<BatchRange> again_;
  const int64_t all_;
  int64_t merged_ = 0;
  const ShareDone& progress_;
};

// ---- as text ------------------------------------------------------------------------------------

Json three(const glm::dvec3& v) {
  return Json::array({v.x, v.y, v.z});
}
glm::dvec3 vector_of(const Json& three) {
  return {three.at(0).get<double>(), three.at(1).get<double>(), three.at(2).get<double>()};
}

Json json_of(const TiledView& view) {
  const Camera& camera = view.camera;
  return {{"eye", three(camera.eye)},
          {"target", three(camera.target)},
          {"up", three(camera.up)},
          {"vertical_fov_deg", camera.vertical_fov_deg},
          {"width", camera.width},
          {"height", camera.height},
          {"cut_m", camera.cut_m ? Json(*camera.cut_m) : Json()},
          {"number", view.number},
          {"first", view.first},
          {"ends", !view.ends.empty()},
          {"flames_at_s", view.flames_at_s ? Json(*view.flames_at_s) : Json()}};
}

TiledView view_of(const Json& object) {
  TiledView view;
  view.camera.eye = vector_of(object.at("eye"));
  view.camera.target = vector_of(object.at("target"));
  view.camera.up = vector_of(object.at("up"));
  view.camera.vertical_fov_deg = object.at("vertical_fov_deg").get<double>();
  view.camera.width = object.at("width").get<int>();
  view.camera.height = object.at("height").get<int>();
  if (const Json& cut = object.at("cut_m"); !cut.is_null()) view.camera.cut_m = cut.get<double>();
  view.number = object.at("number").get<uint64_t>();
  view.first = object.at("first").get<bool>();
  if (const Json& moment = object.at("flames_at_s"); !moment.is_null())
    view.flames_at_s = moment.get<double>();
  return view;
}

/// Checks a view from another process.
bool is_picture(const TiledView& view) {
  const Camera& camera = view.camera;
  return camera.width > 0 && camera.height > 0 && camera.width <= limits::max_picture_edge &&
         camera.height <= limits::max_picture_edge &&
         ViewPasses::bytes_of(camera) <= limits::max_view_bytes && camera.vertical_fov_deg > 0 &&
         camera.vertical_fov_deg < 180 && camera.eye != camera.target &&
         camera.up != glm::dvec3(0) &&
         (!camera.cut_m || (std::isfinite(*camera.cut_m) && *camera.cut_m < camera.eye.z)) &&
         view.number >> 16 == 0 && std::isfinite(view.flames_at_s.value_or(0));
}

/// Ends are multiples of four, up to 2^16: two bytes each, the lower one first.
void add_ends(const std::vector<HalfEnds>& ends, std::string& text) {
  for (const HalfEnds& of_pixel : ends)
    for (const int end : of_pixel) {
      const int tiles = end / PictureExecutor::paths_of_tile;
      text += static_cast<char>(tiles & 0xff);
      text += static_cast<char>(tiles >> 8);
    }
}

/// Takes the ends of a view off the front of `bytes`. False if there are too few, or one is out of
/// range.
bool take_ends(std::string_view& bytes, int paths_per_pixel, TiledView& view) {
  const size_t pixels =
      static_cast<size_t>(view.camera.width) * static_cast<size_t>(view.camera.height);
  const size_t size = 2 * sizeof(uint16_t) * pixels;
  if (bytes.size() < size) return false;
  view.ends.resize(pixels);
  for (size_t i = 0; i < 2 * pixels; ++i) {
    const auto byte = [&](size_t k) {
      return static_cast<int>(static_cast<uint8_t>(bytes[2 * i + k]));
    };
    const int end = (byte(0) | byte(1) << 8) * PictureExecutor::paths_of_tile;
    if (end < paths_per_pixel || end > limits::max_paths_per_pixel) return false;
    view.ends[i / 2][i % 2] = end;
  }
  bytes.remove_prefix(size);
  return true;
}

}  // namespace

std::string tiles_text(const TiledPictures& pictures) {
  Json header{{"paths_per_pixel", pictures.paths_per_pixel}, {"views", Json::array()}};
  for (const TiledView& view : pictures.views) header["views"].push_back(json_of(view));
  std::string text = header.dump() + "\n";
  for (const TiledView& view : pictures.views) add_ends(view.ends, text);
  return text + pictures.flux;
}

Result<TiledPictures> parse_tiles(const std::string& text) try {
  const size_t end = text.find('\n');
  if (end == std::string::npos) return problem("these are no pictures: a line is missing");
  const Json header = Json::parse(text.substr(0, end));
  TiledPictures out;
  out.paths_per_pixel = header.at("paths_per_pixel").get<int>();
  if (out.paths_per_pixel < 1 || out.paths_per_pixel > limits::max_paths_per_pixel)
    return problem("these are no pictures: of so many paths a pixel there are none");
  if (header.at("views").empty() || header.at("views").size() > limits::max_tiled_views)
    return problem("these are no pictures, or more than can be traced at once");
  std::string_view rest(text);
  rest.remove_prefix(end + 1);
  for (const Json& one : header.at("views")) {
    out.views.push_back(view_of(one));
    TiledView& view = out.views.back();
    if (!is_picture(view)) return problem("a camera is none, or too large");
    if (one.at("ends").get<bool>() && !take_ends(rest, out.paths_per_pixel, view))
      return problem("these are no pictures: paths end nowhere, or where they cannot");
  }
  out.flux = rest;
  return out;
} catch (const Json::exception& e) {
  return problem(std::string("these are no pictures: ") + e.what());
}

// ---- states -------------------------------------------------------------------------------------

PictureState::PictureState(const LocalRun& run, TiledPictures pictures,
                           std::shared_ptr<const RadianceCache> flux,
                           std::shared_ptr<const EmitterSight> sight)
    : run_(run), pictures_(std::move(pictures)), flux_(std::move(flux)), sight_(std::move(sight)) {
  int64_t pixels = 1;
  for (const TiledView& view : pictures_.views)
    pixels = std::max(pixels, int64_t{view.camera.width} * view.camera.height);
  layout_.add_block({.name = "pixels",
                     .bins = static_cast<uint32_t>(pixels),
                     .quantities = static_cast<uint32_t>(PixelSums::bins),
                     .unit = ScoreUnit::value,
                     .banded = false});
}

std::unique_ptr<Totals> PictureState::totals() const {
  const size_t views = pictures_.views.size();
  return std::make_unique<Totals>(layout_, static_cast<int>(views),
                                  std::vector<std::vector<int64_t>>(views), Cleared::given_back);
}

std::unique_ptr<BatchWorker> PictureState::worker(uint64_t seed, int64_t,
                                                  const TracerMaker&) const {
  if (seed != run_.seed()) throw std::runtime_error("pictures are of the seed of their run");
  return std::make_unique<TileWorker>(*this);
}

PictureStates::PictureStates(const LocalRun& run)
    : run_(run), sight_(make_emitter_sight(run.scene())) {}

Result<std::shared_ptr<const TracedState>> PictureStates::make(const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (state_ && text == text_) return state_;
  auto pictures = parse_tiles(text);
  if (!pictures) return pictures.problem();
  auto radiance = radiance_of(pictures->flux);
  if (!radiance) return radiance.problem();
  pictures->flux.clear();  // it is kept as radiance
  state_ = std::make_shared<PictureState>(run_, std::move(pictures).value(),
                                          std::move(radiance).value(), sight_);
  text_ = text;
  return state_;
}

namespace {

/// A run's totals, and what refers to them.
struct KnownFlux {
  std::unique_ptr<LocalRun> run;
  std::unique_ptr<RadianceCache> radiance;
};

}  // namespace

/// Consecutive pictures usually end in the same flux.
Result<std::shared_ptr<const RadianceCache>> PictureStates::radiance_of(const std::string& flux) {
  if (flux.empty()) return std::shared_ptr<const RadianceCache>();
  if (flux == flux_) return radiance_;
  const SourcePlace place{run_.scene().description->file, 0};
  const auto file = decode_flux_file(std::as_bytes(std::span(flux)), place);
  if (!file) return file.problem();
  const auto known = std::make_shared<KnownFlux>();
  known->run = run_.empty_copy();
  if (auto ok = take_flux(file.value(), place, *known->run); !ok) return ok.problem();
  known->radiance = flux_radiance(*known->run);
  flux_ = flux;
  radiance_ = {known, known->radiance.get()};
  return radiance_;
}

// ---- pictures by an executor --------------------------------------------------------------------

PictureFlux picture_flux(const LocalRun& run, const PictureOptions& options) {
  PictureFlux flux;
  flux.sight = make_emitter_sight(run.scene());
  if (!options.gather || run.batches() == 0) return flux;
  flux.radiance = flux_radiance(run);
  if (options.executor == nullptr) return flux;
  const SourcePlace place{run.scene().description->file, 0};
  const auto bytes = encode_flux_file(flux_of(run), place);
  if (!bytes) throw std::runtime_error(bytes.problem().text());
  flux.bytes.assign(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  return flux;
}

PictureExecutor::PictureExecutor(const LocalRun& run, std::vector<TiledView> views, int paths,
                                 const PictureOptions& options, const PictureFlux& flux)
    : options_(options),
      state_(run, {std::move(views), paths, {}}, flux.radiance, flux.sight),
      totals_(state_.totals()) {
  TiledPictures told = state_.pictures();
  told.flux = flux.bytes;
  options.executor->enter({run.seed(), tiles_text(told)});
}

bool PictureExecutor::trace(size_t view, int first_step, int end_step, const ShareDone& progress) {
  TilePass pass(state_, options_, *totals_, view, first_step, end_step, progress);
  options_.executor->trace(pass);
  if (pass.is_whole()) return true;
  totals_ = state_.totals();
  return false;
}

bool PictureExecutor::add_first(size_t view, ViewPasses& passes, const ShareDone& progress) {
  if (!trace(view, first_picture_step, first_picture_step + 1, progress)) return false;
  passes.take_first(*totals_, static_cast<int>(view), paths_of_tile);
  return true;
}

bool PictureExecutor::add(size_t view, ViewPasses& passes, int paths, const ShareDone& progress) {
  const int end = passes.paths() + paths;
  LUX_CHECK(passes.paths() % paths_of_tile == 0 &&
                (end % paths_of_tile == 0 || end == state_.pictures().paths_per_pixel),
            "tiles have whole steps of paths");
  if (!trace(view, step_of(passes.paths()), step_of(end - 1) + 1, progress)) return false;
  passes.take(*totals_, static_cast<int>(view), paths);
  return true;
}

bool PictureExecutor::add_allocated(size_t view, ViewPasses& passes, int more,
                                    const ShareDone& progress) {
  if (!trace(view, allocated_step, allocated_step + 1, progress)) return false;
  passes.take_allocated(*totals_, static_cast<int>(view), more);
  return true;
}

}  // namespace luxodus
