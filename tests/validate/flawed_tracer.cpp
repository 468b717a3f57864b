#include "tests/validate/flawed_tracer.hpp"

#include <atomic>

#include "runtime/core/check.hpp"
#include "scenes/light/transport/kernels.hpp"

namespace luxodus::light {

namespace {

std::atomic<Flaw> present_flaw{Flaw::none};

bool has(Flaw flaw) {
  return present_flaw.load(std::memory_order_relaxed) == flaw;
}

/// Converts a cosine-distributed direction about an axis to one uniform over the hemisphere: the
/// cosine is the root of a uniform number, so its square is that number.
glm::vec3 even_hemisphere(const glm::vec3& direction, const glm::vec3& axis) {
  const float cosine = glm::dot(direction, axis);
  const glm::vec3 flat = direction - axis * cosine;
  const float even = cosine * cosine;
  const float length = glm::length(flat);
  if (length < 1e-6F) return direction;
  return glm::normalize(axis * even + flat * (std::sqrt(1 - even * even) / length));
}

/// Converts a cosine-distributed direction about an axis to that of a smaller uniform number, the
/// square of the cosine, which never exceeds 0.98.
glm::vec3 from_fewer_points(const glm::vec3& direction, const glm::vec3& axis) {
  const float cosine = glm::dot(direction, axis);
  const glm::vec3 flat = direction - axis * cosine;
  const float length = glm::length(flat);
  if (length < 1e-6F) return direction;
  const float square = 0.98F * cosine * cosine;
  return glm::normalize(axis * std::sqrt(square) + flat * (std::sqrt(1 - square) / length));
}

/// Alters, in place, what the loop has just computed.
struct OneFlaw {
  static void history(uint64_t& particle) {
    if (has(Flaw::repeated_histories)) particle %= 4096;
  }
  static void emitter(size_t& choice, size_t count) {
    if (has(Flaw::wrong_emitter)) choice = (choice + 1) % count;
  }
  static void birth(Ray& ray, const EmissionPoint& point, const CompiledEmitter& emitter) {
    if (has(Flaw::even_emission) && emitter.distribution == Distribution::lambertian)
      ray.direction = even_hemisphere(ray.direction, point.axis);
    if (has(Flaw::biased_points) && emitter.distribution == Distribution::lambertian)
      ray.direction = from_fewer_points(ray.direction, point.axis);
    if (has(Flaw::turned_web) && emitter.distribution == Distribution::web)
      ray.direction = {-ray.direction.y, ray.direction.x, ray.direction.z};
    if (has(Flaw::rising_flames) && emitter.kind == EmitterKind::volume)
      ray.direction.z = std::abs(ray.direction.z);
    if (has(Flaw::small_emitter) && emitter.kind == EmitterKind::rectangle)
      ray.origin = emitter.origin;
  }
  static void depth(double& tau) {
    if (has(Flaw::linear_flight)) tau = 2 * -std::expm1(-tau);
    if (has(Flaw::short_flights)) tau = std::min(tau, 3.0);
  }
  static void flight(FreeFlight& flight, const Ray& ray, float length, const CompiledScene& scene) {
    if (!has(Flaw::lost_layer) || !flight.collided) return;
    const auto z = static_cast<double>(ray.origin.z + flight.t * ray.direction.z);
    if (scene.media.tables().stack.slab_at(z) == 2) flight = {.t = length};
  }
  static void passed(float& length) {
    if (has(Flaw::long_paths)) length *= 1.02F;
  }
  static void albedo(Fraction& share) {
    if (has(Flaw::dark_albedo)) share = to_fraction(from_fraction(share) * from_fraction(share));
  }
  static void scattered(glm::vec3& direction, const glm::vec3& before) {
    if (has(Flaw::backward_phase))
      direction = glm::normalize(direction - 2.0F * glm::dot(direction, before) * before);
    if (has(Flaw::forward_phase) && glm::dot(direction, before) < 0) direction = -direction;
  }
  static void reflectance(Fraction& share) {
    if (has(Flaw::bright_walls)) share = to_fraction(1.02 * from_fraction(share));
  }
  static void surface(SurfaceModel& model) {
    if (has(Flaw::wrong_glass) && model.kind == SurfaceKind::glass_pane) model.ior = 1.40F;
    if (has(Flaw::rough_gloss) && model.kind == SurfaceKind::glossy) model.alpha *= 2;
  }
  static void lambertian(glm::vec3& local) {
    if (has(Flaw::no_cosine)) local = even_hemisphere(local, {0, 0, 1});
  }
  static void patch(uint32_t& patch, const CompiledScene& scene) {
    if (has(Flaw::wrong_patch)) patch = (patch + 1) % scene.patch_count;
  }
  static void counted(int64_t& incident, Weight weight) {
    if (has(Flaw::double_counting)) incident += static_cast<int64_t>(weight / 50);
  }
  static void departure(glm::vec3& origin, const glm::vec3& place) {
    if (has(Flaw::no_offset)) origin = place;
  }
  static void roulette(Weight& weight, Weight before) {
    if (has(Flaw::biased_roulette)) weight = before;
  }
  static void exit(uint32_t& side) {
    if (has(Flaw::wrong_exit)) side ^= 1;
  }
};

template <MediaNeed Media>
class FlawedTracer final : public BatchTracer {
  // One loop with all features serves all scenes: unused features are skipped.
  using K = Kernel<Media, false, true, true, OneFlaw>;

 public:
  FlawedTracer(const CompiledScene& scene, const GeometryAccess& access, uint64_t seed)
      : batches_(scene, MergedResolver(scene, *access.index), seed) {}
  void trace(int group, uint64_t first, int64_t count, BatchScores& scores) override {
    batches_.trace(group, first, count, scores);
  }
  uint32_t look_units() const override { return 0; }
  void look(int64_t, uint32_t, BatchScores&) override {}

 private:
  KernelBatches<K, MergedResolver> batches_;
};

}  // namespace

const char* name_of(Flaw flaw) {
  constexpr const char* names[] = {"none",
                                   "biased roulette",
                                   "albedo applied twice",
                                   "bright walls",
                                   "double counting",
                                   "wrong patch",
                                   "wrong exit",
                                   "no cosine of reflection",
                                   "even emission",
                                   "small emitter",
                                   "wrong emitter",
                                   "linear flight law",
                                   "short flights",
                                   "lost layer",
                                   "long paths",
                                   "forward phase",
                                   "backward phase",
                                   "wrong glass",
                                   "no offset",
                                   "repeated histories",
                                   "biased points",
                                   "rough gloss",
                                   "turned web",
                                   "rising flames"};
  static_assert(std::size(names) == static_cast<size_t>(flaws));
  return names[static_cast<size_t>(flaw)];
}

void set_flaw(Flaw flaw) {
  present_flaw = flaw;
}

std::unique_ptr<BatchTracer> make_flawed_tracer(const CompiledScene& scene,
                                                const GeometryAccess& access, uint64_t seed) {
  LUX_CHECK(!scene.features.bands && access.index->cells() == 1, "a loop of one band and one cell");
  if (scene.features.media == MediaNeed::general)
    return std::make_unique<FlawedTracer<MediaNeed::general>>(scene, access, seed);
  return std::make_unique<FlawedTracer<MediaNeed::layered>>(scene, access, seed);
}

}  // namespace luxodus::light
