// Compiles media: checks each medium, turns each homogeneous part of it into a component with
// extinction and albedo by band, and adds the component to the stack, a prism, a body or a grid.
#include "scenes/light/optics/media_set.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace luxodus {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Heights beyond this are "no limit" (medium.hpp writes 1e30).
constexpr double unlimited_m = 1e29;
/// Tolerance for the rounding of band averages at 0 and 1.
constexpr double rounding = 1e-9;

bool same(const Phase& a, const Phase& b) {
  if (a.kind != b.kind) return false;
  if (a.kind == PhaseKind::henyey_greenstein) return a.g == b.g;
  if (a.kind == PhaseKind::tabulated) {
    return a.table_cos == b.table_cos && a.table_value == b.table_value;
  }
  return true;
}

double value_at(const Spectrum& s, double wavelength_nm) {
  const double x = std::clamp((wavelength_nm - spectrum_first_nm) / spectrum_step_nm, 0.0,
                              static_cast<double>(spectrum_samples - 1));
  const auto i = static_cast<size_t>(x);
  const size_t next = std::min(i + 1, static_cast<size_t>(spectrum_samples - 1));
  const double share = x - static_cast<double>(i);
  return (1 - share) * s.value[i] + share * s.value[next];
}

glm::dvec3 rounded_down(const glm::dvec3& low, const glm::dvec3& high) {
  glm::dvec3 out = low;
  for (int k = 0; k < 3; ++k) {
    if (std::isfinite(low[k])) out[k] -= rounding * std::max(std::abs(low[k]), std::abs(high[k]));
    if (std::isnan(out[k])) out[k] = -infinity;
  }
  return out;
}

}  // namespace

class MediaCompiler {
 public:
  MediaCompiler(int bands, const BandAverage& average, const glm::dvec3& local_origin)
      : bands_(bands), average_(average), origin_(local_origin) {}

  Result<MediaSet> compile(std::span<const MediumInput> media) {
    for (size_t i = 0; i < media.size(); ++i) {
      medium_ = media[i].medium;
      index_ = static_cast<int>(i);
      factor_ = media[i].factor;
      table_ = media[i].table;
      fault_.clear();
      bricks_.emplace_back();
      add_medium();
      if (!fault_.empty()) {
        return problem_in(medium_->place, "medium \"" + medium_->name + "\" " + fault_);
      }
    }
    if (auto ok = lay_out(); !ok) return ok.problem();
    MediaSet out;
    out.count_ = static_cast<int>(media.size());
    out.bands_ = bands_;
    out.need_ = need();
    out.tables_ = std::make_shared<const MediaTables>(std::move(tables_));
    out.bricks_ = std::make_shared<const MediaBricks>(std::move(bricks_));
    return out;
  }

 private:
  struct Heights {
    double low;
    double high;
  };

  void fail(std::string what) {
    if (fault_.empty()) fault_ = std::move(what);
  }
  bool failed() const { return !fault_.empty(); }

  void add_medium() {
    if (!(factor_ >= 0) || !std::isfinite(factor_)) {
      return fail("has a factor that is negative or not finite");
    }
    const bool placed =
        medium_->kind == MediumKind::bounded || medium_->kind == MediumKind::data_set;
    if (medium_->emission && !placed) {
      return fail("glows but has no end; only bounded media and data sets can emit");
    }
    switch (medium_->kind) {
      case MediumKind::homogeneous:
        return add_slabs({{-infinity, infinity, medium_->optics}});
      case MediumKind::layered:
        return add_slabs(medium_->layers);
      case MediumKind::bounded:
        return add_body();
      case MediumKind::data_set:
        return add_grid();
    }
  }

  // ---- components ----------------------------------------------------------------------------

  int phase_index(const Phase& phase) {
    for (size_t i = 0; i < tables_.phases.size(); ++i) {
      if (same(tables_.phases[i], phase)) return static_cast<int>(i);
    }
    tables_.phases.push_back(phase);
    return static_cast<int>(tables_.phases.size()) - 1;
  }

  /// Extinction times the scenario's factor; if `relative`, the wavelength law alone, 1 at its
  /// reference wavelength.
  std::vector<double> extinction_by_band(const Extinction& e, bool relative) {
    std::vector<double> out;
    if (!(e.wavelength_nm > 0) || !std::isfinite(e.wavelength_nm) || !std::isfinite(e.angstrom)) {
      fail("has an extinction whose wavelength or Angstrom exponent is not valid");
      return std::vector<double>(static_cast<size_t>(bands_), 0.0);
    }
    Extinction law = e;
    double scale = factor_;
    if (relative) {
      law.sigma_t = 1;
      if (law.table) scale /= value_at(*law.table, law.wavelength_nm);
    }
    const Spectrum spectrum = law.spectrum();
    for (int b = 0; b < bands_; ++b) {
      const double sigma = scale * average_(spectrum, b);
      if (!(sigma >= 0) || !std::isfinite(sigma)) {
        fail("has an extinction that is negative or not finite");
      }
      out.push_back(sigma);
    }
    return out;
  }

  std::vector<double> albedo_by_band(const Spectrum& albedo) {
    std::vector<double> out;
    for (int b = 0; b < bands_; ++b) {
      const double value = average_(albedo, b);
      if (!(value >= -rounding && value <= 1 + rounding)) {
        fail("has an albedo of " + std::to_string(value) + "; it must lie in [0, 1]");
      }
      out.push_back(std::clamp(value, 0.0, 1.0));
    }
    return out;
  }

  /// The index of a new component, or -1 if it has no extinction in any band and `keep` is false.
  int add_component(const SmokeOptics& optics, bool relative, bool keep) {
    std::vector<double> sigma = extinction_by_band(optics.extinction, relative);
    std::vector<double> albedo = albedo_by_band(optics.albedo);
    if (failed()) return -1;
    const bool any = std::any_of(sigma.begin(), sigma.end(), [](double s) { return s > 0; });
    if (!any && !keep) return -1;
    tables_.components.push_back({index_, phase_index(optics.phase), -1});
    sigma_.push_back(std::move(sigma));
    albedo_.push_back(std::move(albedo));
    return static_cast<int>(tables_.components.size()) - 1;
  }

  bool has_extinction(int component) const {
    const std::vector<double>& sigma = sigma_[static_cast<size_t>(component)];
    return std::any_of(sigma.begin(), sigma.end(), [](double s) { return s > 0; });
  }

  void add_emitter(int component, VolumeEmitter emitter) {
    if (tables_.emitters.size() == static_cast<size_t>(limits::max_volume_emitters)) {
      return fail("is one glowing medium too many; at most " +
                  std::to_string(limits::max_volume_emitters) + " are allowed");
    }
    if (!emitter.glows()) return fail("glows, but its emission is 0 in every cell");
    tables_.components[static_cast<size_t>(component)].emitter =
        static_cast<int>(tables_.emitters.size());
    tables_.emitters.push_back(std::move(emitter));
  }

  // ---- shapes --------------------------------------------------------------------------------

  Heights local_heights(double low, double high) const {
    return {low <= -unlimited_m ? -infinity : low - origin_.z,
            high >= unlimited_m ? infinity : high - origin_.z};
  }

  void add_slabs(const std::vector<Layer>& layers) {
    const Footprint& f = medium_->footprint;
    if (!(f.z_low < f.z_high))
      return fail("has a footprint whose z range is empty or not a number");
    const Heights cut = local_heights(f.z_low, f.z_high);
    std::vector<LayerStack::Part> parts;
    double top = -infinity;
    for (size_t i = 0; i < layers.size(); ++i) {
      const Layer& layer = layers[i];
      if (!(layer.z_low < layer.z_high)) {
        return fail("has layer " + std::to_string(i + 1) + " with no thickness");
      }
      if (layer.z_low < top) {
        return fail("has layer " + std::to_string(i + 1) +
                    " that begins below the end of the one before");
      }
      top = layer.z_high;
      const int component = add_component(layer.optics, false, false);
      if (failed()) return;
      if (component < 0) continue;
      const Heights z = local_heights(layer.z_low, layer.z_high);
      const LayerStack::Part part{std::max(z.low, cut.low), std::min(z.high, cut.high), component};
      if (part.z_low < part.z_high) parts.push_back(part);
    }
    if (f.polygon.empty()) {
      stack_.insert(stack_.end(), parts.begin(), parts.end());
      return;
    }
    if (auto ok = check_polygon(f.polygon); !ok) {
      return fail("has a footprint that " + ok.problem().what);
    }
    if (parts.empty()) return;
    std::vector<glm::dvec2> polygon;
    for (const glm::dvec2& p : f.polygon) polygon.push_back(p - glm::dvec2(origin_));
    tables_.prisms.emplace_back(std::move(polygon), std::move(parts));
    const FootprintPrism& prism = tables_.prisms.back();
    segments_ += prism.max_segments();
    place({prism.low(), prism.high(), static_cast<int>(tables_.prisms.size()) - 1, -1, -1});
    general_ = true;
  }

  void add_body() {
    auto body = QuadricBody::make(*medium_, origin_);
    if (!body) {
      body_problem(body.problem());
      return;
    }
    const int component = add_component(medium_->optics, false, medium_->emission.has_value());
    if (failed() || component < 0) return;
    if (medium_->emission) add_emitter(component, VolumeEmitter(index_, body.value()));
    if (has_extinction(component)) general_ = true;
    const Bounds box = body->bounds();
    tables_.quadrics.push_back(std::move(body).value());
    segments_ += 2;
    place({box.low, box.high, -1, static_cast<int>(tables_.quadrics.size()) - 1, component});
  }

  void add_grid() {
    auto grid = SmokeGrid::make(*medium_, index_, origin_);
    if (!grid) {
      body_problem(grid.problem());
      return;
    }
    const bool emits = medium_->emission.has_value();
    const bool relative =
        table_ != nullptr ? table_->has_extinction : !medium_->data.extinction.empty();
    const int component = add_component(medium_->optics, relative, emits);
    if (failed() || component < 0) return;
    if (tables_.grids.size() == static_cast<size_t>(limits::max_grids)) {
      return fail("is one data set too many; at most " + std::to_string(limits::max_grids) +
                  " are allowed");
    }
    const BrickTable table = table_ != nullptr ? *table_ : cut_bricks();
    grid->settle(table, emits);
    if (emits) add_emitter(component, VolumeEmitter(grid.value(), table));
    if (has_extinction(component)) general_ = true;
    tables_.grids.push_back({std::move(grid).value(), component});
  }

  BrickTable cut_bricks() {
    const DataSet& data = medium_->data;
    BrickTable table{!data.extinction.empty(), !data.albedo.empty(), !data.emission.empty(), {}};
    for (size_t i = 0; i < brick_count(data); ++i) {
      bricks_.back().push_back(cut_brick(data, i));
      table.bricks.push_back(summary_of(bricks_.back().back()));
    }
    return table;
  }

  /// Adds the place only: problems of bodies and grids already name the medium.
  void body_problem(const Problem& problem) {
    const std::string prefix = "medium \"" + medium_->name + "\" ";
    fail(problem.what.rfind(prefix, 0) == 0 ? problem.what.substr(prefix.size()) : problem.what);
  }

  void place(PlacedBody body) {
    const glm::dvec3 low = body.low;
    body.low = rounded_down(low, body.high);
    body.high = -rounded_down(-body.high, -low);
    tables_.bodies.push_back(body);
  }

  // ---- result --------------------------------------------------------------------------------

  Result<void> lay_out() {
    if (segments_ > limits::max_ray_segments) {
      return problem(
          "the media have together " + std::to_string(segments_) +
          " stretches that one ray may cross (footprint corners / 2 + layers, 2 for a body); at "
          "most " +
          std::to_string(limits::max_ray_segments) + " are allowed: simplify footprints");
    }
    if (stack_.size() > static_cast<size_t>(limits::max_layers)) {
      return problem("the layered media have together " + std::to_string(stack_.size()) +
                     " layers; at most " + std::to_string(limits::max_layers) + " are allowed");
    }
    const size_t n = tables_.components.size();
    for (size_t b = 0; b < static_cast<size_t>(bands_); ++b) {
      for (size_t c = 0; c < n; ++c) {
        tables_.sigma_t.push_back(sigma_[c][b]);
        tables_.albedo.push_back(albedo_[c][b]);
      }
    }
    tables_.stack.build(stack_, tables_.sigma_t, static_cast<int>(n), bands_);
    return {};
  }

  MediaNeed need() const {
    if (general_) return MediaNeed::general;
    if (tables_.stack.empty()) return MediaNeed::none;
    return tables_.stack.slabs() == 1 ? MediaNeed::homogeneous : MediaNeed::layered;
  }

  int bands_;
  const BandAverage& average_;
  glm::dvec3 origin_;

  const Medium* medium_ = nullptr;
  int index_ = 0;
  double factor_ = 1;
  const BrickTable* table_ = nullptr;
  std::string fault_;

  MediaTables tables_;
  MediaBricks bricks_;
  std::vector<std::vector<double>> sigma_;   // [component][band]
  std::vector<std::vector<double>> albedo_;  // [component][band]
  std::vector<LayerStack::Part> stack_;
  int segments_ = 0;
  bool general_ = false;
};

MediaSet::MediaSet()
    : tables_(std::make_shared<const MediaTables>()),
      bricks_(std::make_shared<const MediaBricks>()) {}

Result<MediaSet> MediaSet::compile(std::span<const MediumInput> media, int bands,
                                   const BandAverage& average, const glm::dvec3& local_origin) {
  if (bands < 1 || bands > limits::max_media_bands) {
    return problem("a scene has 1 to " + std::to_string(limits::max_media_bands) + " bands, not " +
                   std::to_string(bands));
  }
  return MediaCompiler(bands, average, local_origin).compile(media);
}

const VolumeEmitter* MediaSet::emitter(int medium) const {
  for (const VolumeEmitter& e : tables_->emitters) {
    if (e.medium() == medium) return &e;
  }
  return nullptr;
}

}  // namespace luxodus
