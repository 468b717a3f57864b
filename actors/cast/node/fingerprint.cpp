#include "actors/cast/node/fingerprint.hpp"

#include <stdexcept>

#include "runtime/core/hash.hpp"
#include "scenes/light/geometry/primitives.hpp"
#include "scenes/light/transport/compile.hpp"
#include "scenes/light/transport/trace.hpp"

namespace luxodus {

namespace {

constexpr int64_t particles = 4096;

/// A grey room with a lamp in forward-scattering smoke: surfaces, layers, phases, splits.
std::shared_ptr<const CompiledScene> tiny_room() {
  auto scene = std::make_shared<SceneDescription>();
  scene->name = "fingerprint";
  scene->materials.emplace_back().name = "grey";
  const auto room = shapes::room({4, 3, 2.5});
  int number = 0;
  for (const Mesh* wall :
       {&room->floor, &room->ceiling, &room->x0, &room->x1, &room->y0, &room->y1}) {
    Object object;
    object.name = "wall " + std::to_string(number++);
    object.mesh = *wall;
    object.patch_edge_m = 1;
    scene->objects.push_back(std::move(object));
  }
  Emitter lamp;
  lamp.name = "lamp";
  lamp.shape = EmitterShape::rectangle;
  lamp.frame.origin = {2, 1.5, 2.49};
  lamp.size = {0.6, 0.6, 0};
  lamp.mains_flux = 1000;
  scene->emitters.push_back(lamp);
  Medium smoke;
  smoke.name = "smoke";
  smoke.kind = MediumKind::layered;
  smoke.optics.albedo = Spectrum::constant(0.8);
  for (int i = 0; i < 2; ++i) {
    SmokeOptics optics = smoke.optics;
    optics.extinction.sigma_t = 0.3 + i;
    smoke.layers.push_back({1.25 * i, 1.25 * (i + 1), optics});
  }
  scene->media.push_back(smoke);
  scene->run.max_bands = 1;
  auto compiled = compile_scene(scene, find_scenario(*scene, "").value(), {});
  if (!compiled) throw std::logic_error("fingerprint: " + compiled.problem().text());
  return compiled.value();
}

uint64_t trace_fingerprint() {
  const auto scene = tiny_room();
  const EmbreeDevice device;
  const SceneIndex index(device, *scene);
  const auto tracer = make_batch_tracer(*scene, GeometryAccess::resident(index), 1);
  BatchScores scores;
  scores.reset(scene->layout);
  tracer->trace(0, 0, particles, scores);
  Hasher hash;
  hash.add(scores.scores.data(), scores.scores.size() * sizeof(int64_t));
  return hash.value();
}

}  // namespace

std::string isa_in_use() {
  return std::string(LUX_BUILT_FOR) + ", Embree " + EmbreeDevice::instruction_sets();
}

uint64_t numeric_fingerprint() {
  static const uint64_t value = trace_fingerprint();
  return value;
}

}  // namespace luxodus
