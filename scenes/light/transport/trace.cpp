#include "scenes/light/transport/trace.hpp"

#include "scenes/light/transport/direct.hpp"
#include "scenes/light/transport/eye_paths.hpp"
#include "scenes/light/transport/flame_moment.hpp"
#include "scenes/light/transport/particle_batches.hpp"

namespace luxodus {

namespace {

std::unique_ptr<ParticleBatches> make_particle_batches(const CompiledScene& scene,
                                                       const GeometryAccess& access,
                                                       uint64_t seed) {
  switch (scene.features.media) {
    case MediaNeed::none:
      return choose_kernel<MediaNeed::none>(scene, access, seed);
    case MediaNeed::homogeneous:
      return choose_kernel<MediaNeed::homogeneous>(scene, access, seed);
    case MediaNeed::layered:
      return choose_kernel<MediaNeed::layered>(scene, access, seed);
    case MediaNeed::general:
      break;
  }
  return choose_kernel<MediaNeed::general>(scene, access, seed);
}

template <class Resolver>
class ResolverBatchTracer final : public BatchTracer {
 public:
  ResolverBatchTracer(const CompiledScene& scene, const GeometryAccess& access, Resolver resolver,
                      uint64_t seed)
      : particles_(make_particle_batches(scene, access, seed)),
        resolver_(std::move(resolver)),
        eyes_(scene, resolver_, seed) {}

  void trace(int group, uint64_t first, int64_t count, BatchScores& scores) override {
    particles_->trace(group, first, count, scores);
  }
  uint32_t look_units() const override { return eyes_.units(); }
  void look(int64_t batch, uint32_t unit, BatchScores& scores) override {
    eyes_.score(batch, unit, scores);
  }
  void rest_between_paths(std::function<void()> rest) override {
    eyes_.rest_between_paths(std::move(rest));
  }

 private:
  std::unique_ptr<ParticleBatches> particles_;
  Resolver resolver_;
  EyeScores<Resolver> eyes_;
};

}  // namespace

std::unique_ptr<BatchTracer> make_batch_tracer(const CompiledScene& scene,
                                               const GeometryAccess& access, uint64_t seed) {
  return with_resolver(scene, access, [&](auto resolver) -> std::unique_ptr<BatchTracer> {
    return std::make_unique<ResolverBatchTracer<decltype(resolver)>>(scene, access,
                                                                     std::move(resolver), seed);
  });
}

DirectLight direct_light_at(const CompiledScene& scene, const GeometryAccess& access,
                            const Vec3& point, const Vec3& normal, const DirectOptions& options) {
  return with_resolver(scene, access, [&](auto resolver) {
    return direct_light(scene, point, normal, options, resolver);
  });
}

namespace {

template <class Resolver>
class ResolverPictureTracer final : public PictureTracer {
 public:
  ResolverPictureTracer(const CompiledScene& scene, Resolver resolver, uint64_t seed,
                        std::shared_ptr<const EmitterSight> sight)
      : resolver_(std::move(resolver)),
        sight_(std::move(sight)),
        eye_(scene, resolver_, seed, RandomStream::picture, sight_.get()),
        set_(seed, RandomStream::picture),
        stratified_(scene.description->run.stratified),
        light_(scene.groups.size(), static_cast<size_t>(scene.bands.count())),
        scene_(scene) {}

  void show_flames_at(double time_s) override {
    if (steady_flames(scene_).empty()) return;
    eye_.emitters().show(&moment_.emplace(scene_, time_s));
  }

  void start(uint64_t set, uint32_t count, uint32_t path) override {
    if (!stratified_) return eye_.random().start(set + path);
    set_.choose(set, count);
    eye_.random().start(set + path, set_, path);
  }
  Real uniform() override { return eye_.random().uniform(); }
  int choose_band(double u) const override { return eye_.choose_band(u); }
  std::span<const double> radiance(const Ray& ray, int hero, const RadianceCache* gather,
                                   FirstHit* first) override {
    light_.clear();
    eye_.radiance_of_all(ray, hero, EmitterHits::none, light_, gather, first);
    return light_.by_band();
  }
  std::span<const CachedEnd> ends() const override { return eye_.ends(); }
  double radiance_in_band(const Ray& ray, int band, const RadianceCache* gather) override {
    light_.clear();
    eye_.radiance(ray, band, EmitterHits::none, 1, light_, gather);
    return light_.total();
  }

 private:
  Resolver resolver_;
  std::shared_ptr<const EmitterSight> sight_;
  PathTracer<Resolver> eye_;
  SobolSet set_;
  bool stratified_;
  GroupLight light_;
  const CompiledScene& scene_;
  std::optional<FlameMoment> moment_;
};

bool has_choice(const CompiledScene& scene) {
  return scene.emitters.size() > 1;
}

}  // namespace

std::shared_ptr<const EmitterSight> make_emitter_sight(const CompiledScene& scene) {
  if (!has_choice(scene)) return nullptr;
  return std::make_shared<const EmitterSight>(scene);
}

uint64_t emitter_sight_bytes(const CompiledScene& scene) {
  return has_choice(scene) ? EmitterSight::max_bytes(scene) : 0;
}

std::unique_ptr<PictureTracer> make_picture_tracer(const CompiledScene& scene,
                                                   const GeometryAccess& access, uint64_t seed,
                                                   std::shared_ptr<const EmitterSight> sight) {
  return with_resolver(scene, access, [&](auto resolver) -> std::unique_ptr<PictureTracer> {
    return std::make_unique<ResolverPictureTracer<decltype(resolver)>>(scene, std::move(resolver),
                                                                       seed, sight);
  });
}

std::string describe_kernel(const CompiledScene& scene) {
  const Features& f = scene.features;
  std::string text;
  switch (f.media) {
    case MediaNeed::none:
      text = "no medium";
      break;
    case MediaNeed::homogeneous:
      text = "one homogeneous medium";
      break;
    case MediaNeed::layered:
      text = "layered media";
      break;
    case MediaNeed::general:
      text = "bounded media (footprints, quadrics or data sets)";
      break;
  }
  text += f.bands ? ", " + std::to_string(scene.bands.count()) + " bands" : ", one band";
  text += f.surfaces || f.bodies ? ", all surface models" : ", Lambertian surfaces only";
  text += f.detectors ? ", scores along flights" : ", no scores along flights";
  return text;
}

}  // namespace luxodus
