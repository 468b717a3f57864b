#include "scenes/light/transport/birth_order.hpp"

#include <algorithm>
#include <numeric>

#include "scenes/light/transport/history.hpp"

namespace luxodus {

namespace {

/// Searches a cumulative table exactly as ParticleTracer does.
size_t find(const std::vector<uint64_t>& cdf, uint64_t r) {
  const auto it = std::upper_bound(cdf.begin(), cdf.end(), r);
  return std::min(static_cast<size_t>(it - cdf.begin()), cdf.size() - 1);
}

/// Interleaves 20 bits of each coordinate.
uint64_t morton(const Vec3& p, const CompiledScene& scene) {
  const Vec3 size = glm::max(scene.local_high - scene.local_low, Vec3(1e-6_r));
  const Vec3 share = glm::clamp((p - scene.local_low) / size, 0.0_r, 0.999999_r);
  uint64_t code = 0;
  for (int bit = 19; bit >= 0; --bit) {
    for (int k = 0; k < 3; ++k) {
      const auto cell = static_cast<uint32_t>(share[k] * 0x1p20_r);
      code = code << 1 | (cell >> bit & 1);
    }
  }
  return code;
}

/// The emitter of a particle. `random` may be shared by many particles: those of one batch share a
/// set.
uint32_t emitter_of(const CompiledScene& scene, int group, uint64_t particle,
                    HistoryRandom& random) {
  const Group& g = scene.groups[static_cast<size_t>(group)];
  random.start(particle);
  const size_t band = scene.features.bands ? find(g.band_cdf, random.bits64()) : 0;
  const std::vector<uint32_t>& choices = g.emitters[band];
  return choices.size() == 1 ? choices[0] : choices[find(g.emitter_cdf[band], random.bits64())];
}

/// (Place, number) packed into one integer for sorting; both have 32 bits.
constexpr uint64_t packed(uint32_t place, uint32_t number) {
  return uint64_t{place} << 32 | number;
}

}  // namespace

uint32_t emitter_of_particle(const CompiledScene& scene, uint64_t seed, int group,
                             uint64_t particle) {
  HistoryRandom random(scene, seed);
  return emitter_of(scene, group, particle, random);
}

std::vector<uint32_t> places_of_emitters(const CompiledScene& scene) {
  std::vector<uint64_t> codes;
  for (const CompiledEmitter& e : scene.emitters) codes.push_back(morton(e.origin, scene));
  std::vector<uint32_t> order(codes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return codes[a] < codes[b]; });
  std::vector<uint32_t> places(codes.size());
  for (uint32_t i = 0; i < order.size(); ++i) places[order[i]] = i;
  return places;
}

void order_by_emitter(const CompiledScene& scene, const std::vector<uint32_t>& places,
                      uint64_t seed, int group, uint64_t first, uint32_t count,
                      std::vector<uint32_t>& order) {
  HistoryRandom random(scene, seed);
  std::vector<uint64_t> keys(count);
  for (uint32_t i = 0; i < count; ++i)
    keys[i] = packed(places[emitter_of(scene, group, first + i, random)], i);
  std::sort(keys.begin(), keys.end());
  order.resize(count);
  for (uint32_t i = 0; i < count; ++i) order[i] = static_cast<uint32_t>(keys[i]);
}

}  // namespace luxodus
