#include "tests/validate/flawed_eyes.hpp"

#include <cmath>

#include "runtime/core/check.hpp"
#include "scenes/light/transport/direct.hpp"
#include "scenes/light/transport/eye_paths.hpp"

namespace luxodus::light {

namespace {

// ---- altered scenes ---------------------------------------------------------------------------

void turn_webs(CompiledScene& scene) {
  for (CompiledEmitter& e : scene.emitters) {
    if (e.distribution != Distribution::web) continue;
    const Vec3 x = e.axes[0];
    e.axes[0] = e.axes[1];
    e.axes[1] = -x;
  }
}

void brighten_webs(CompiledScene& scene) {
  for (CompiledEmitter& e : scene.emitters) {
    if (e.distribution != Distribution::web) continue;
    for (double& p : e.power_w) p *= 1.03;
  }
}

/// Compiled anew, so that media and probes are those of the changed description.
std::shared_ptr<const CompiledScene> changed(const CompiledScene& scene,
                                             const std::function<void(SceneDescription&)>& change) {
  SceneDescription description = *scene.description;
  change(description);
  return compile(std::move(description));
}

std::shared_ptr<const CompiledScene> spoiled(const CompiledScene& scene, EyeFlaw flaw) {
  if (flaw == EyeFlaw::thin_smoke)
    return changed(scene, [](SceneDescription& d) {
      for (Medium& m : d.media) m.optics.extinction.sigma_t *= 0.97;
    });
  if (flaw == EyeFlaw::tilted_probe)
    return changed(scene, [](SceneDescription& d) {
      for (ProbeMeasure& p : d.probes)
        p.normal = glm::normalize(p.normal + 0.176 * glm::dvec3(p.normal.z, 0, -p.normal.x));
    });
  const auto out = std::make_shared<CompiledScene>(scene);
  if (flaw == EyeFlaw::even_phase) {
    for (PhaseFunction& p : out->phases) p = PhaseFunction();
  }
  if (flaw == EyeFlaw::bright_sign) {
    for (CompiledSign& s : out->signs) {
      for (double& r : s.colours[0].radiance) r *= 1.03;
    }
  }
  if (flaw == EyeFlaw::bright_flames) {
    for (CompiledEmitter& e : out->emitters) {
      if (e.kind != EmitterKind::volume) continue;
      for (double& p : e.power_w) p *= 1.03;
    }
  }
  if (flaw == EyeFlaw::wrong_lobe) {
    for (CompiledMaterial& m : out->materials) {
      for (SurfaceModel& s : m.by_band) s.alpha *= s.alpha;
    }
  }
  if (flaw == EyeFlaw::turned_web) turn_webs(*out);
  if (flaw == EyeFlaw::bright_web) brighten_webs(*out);
  return out;
}

/// Hits nothing if it is blind.
class MaybeBlind : public MergedResolver {
 public:
  MaybeBlind(const CompiledScene& scene, const SceneIndex& index, bool blind)
      : MergedResolver(scene, index), blind_(blind) {}
  Hit nearest(const Ray& ray) const { return blind_ ? Hit{} : MergedResolver::nearest(ray); }
  bool occluded(const Ray& ray) const { return !blind_ && MergedResolver::occluded(ray); }

 private:
  bool blind_;
};

// ---- eyes --------------------------------------------------------------------------------------

class FlawedEyes final : public BatchTracer {
 public:
  FlawedEyes(const CompiledScene& scene, const GeometryAccess& access, uint64_t seed, EyeFlaw flaw)
      : scene_(scene),
        particles_(make_batch_tracer(scene, access, seed)),
        flaw_(flaw),
        spoiled_(spoiled(scene, flaw)),
        resolver_(*spoiled_, *access.index, flaw == EyeFlaw::through_sheets),
        eyes_(*spoiled_, resolver_, seed) {
    LUX_CHECK(access.index->cells() == 1, "one cell");
  }

  void trace(int group, uint64_t first, int64_t count, BatchScores& scores) override {
    particles_->trace(group, first, count, scores);
  }
  uint32_t look_units() const override { return eyes_.units(); }
  void look(int64_t batch, uint32_t unit, BatchScores& scores) override {
    eyes_.score(batch, unit, scores);
    if (flaw_ != EyeFlaw::missed_veil || unit >= 3 * scene_.eye_targets.size()) return;
    const uint32_t bin = scene_.eye_targets[unit / 3].first_bin + unit % 3;
    const auto score = [&](EyeQuantity q) -> int64_t& {
      return scores.scores
          .data()[scene_.layout.score_index(scene_.blocks.views, bin, 0, static_cast<uint32_t>(q))];
    };
    score(EyeQuantity::at_eye) -= score(EyeQuantity::path);
    score(EyeQuantity::path) = 0;
  }

 private:
  const CompiledScene& scene_;
  std::unique_ptr<BatchTracer> particles_;
  EyeFlaw flaw_;
  std::shared_ptr<const CompiledScene> spoiled_;
  MaybeBlind resolver_;
  EyeScores<MaybeBlind> eyes_;
};

class RepeatedBatches final : public BatchTracer {
 public:
  RepeatedBatches(std::unique_ptr<BatchTracer> tracer, int64_t batch_particles)
      : tracer_(std::move(tracer)), batch_particles_(static_cast<uint64_t>(batch_particles)) {}

  void trace(int group, uint64_t first, int64_t count, BatchScores& scores) override {
    // The first batch of every four: numbers within a group begin at a power of two.
    const uint64_t batches_on = first / batch_particles_ % 4;
    tracer_->trace(group, first - batches_on * batch_particles_, count, scores);
  }
  uint32_t look_units() const override { return tracer_->look_units(); }
  void look(int64_t batch, uint32_t unit, BatchScores& scores) override {
    tracer_->look(batch - batch % 4, unit, scores);
  }

 private:
  std::unique_ptr<BatchTracer> tracer_;
  uint64_t batch_particles_;
};

}  // namespace

const char* name_of(EyeFlaw flaw) {
  constexpr const char* names[] = {
      "none",       "even phase function",     "missed veil",   "bright sign",
      "thin smoke", "eyes see through sheets", "bright flames", "turned web",
      "bright web", "wrong glossy lobe",       "tilted probe"};
  static_assert(std::size(names) == static_cast<size_t>(eye_flaws));
  return names[static_cast<size_t>(flaw)];
}

LocalRun::MakeTracer eyes_with(EyeFlaw flaw) {
  return [flaw](const CompiledScene& scene, const GeometryAccess& access, uint64_t seed) {
    return std::make_unique<FlawedEyes>(scene, access, seed, flaw);
  };
}

LocalRun::MakeTracer repeated_batches() {
  return [](const CompiledScene& scene, const GeometryAccess& access, uint64_t seed) {
    return std::make_unique<RepeatedBatches>(make_batch_tracer(scene, access, seed),
                                             scene.batch_particles);
  };
}

// ---- direct light ------------------------------------------------------------------------------

const char* name_of(DirectFlaw flaw) {
  constexpr const char* names[] = {"none",
                                   "direct light without cosine",
                                   "direct light without smoke",
                                   "direct light through sheets",
                                   "coarse lamps",
                                   "turned web",
                                   "bright web"};
  static_assert(std::size(names) == static_cast<size_t>(direct_flaws));
  return names[static_cast<size_t>(flaw)];
}

DirectLightAt direct_light_with(DirectFlaw flaw) {
  return [flaw](const CompiledScene& scene, const GeometryAccess& access, const Vec3& point,
                const Vec3& normal, DirectOptions options) {
    CompiledScene other = scene;
    if (flaw == DirectFlaw::no_smoke) options.media = false;
    if (flaw == DirectFlaw::coarse_lamps) options.part_share = 4;
    if (flaw == DirectFlaw::turned_web) turn_webs(other);
    if (flaw == DirectFlaw::bright_web) brighten_webs(other);
    MaybeBlind resolver(other, *access.index, flaw == DirectFlaw::through_sheets);
    DirectLight light = direct_light(other, point, normal, options, resolver);
    if (flaw == DirectFlaw::no_cosine) light.illuminance_lx = light.fluence_lm_m2;
    return light;
  };
}

}  // namespace luxodus::light
