#include "tests/bench/bench_scenes.hpp"

#include <cmath>
#include <stdexcept>

#include "runtime/core/random.hpp"
#include "scenes/light/geometry/primitives.hpp"
#include "scenes/light/transport/compile.hpp"

namespace luxodus::bench {

namespace {

constexpr glm::dvec3 room_size{20, 15, 3};
constexpr int boxes = 131;  // of five quads: 655, and six walls
constexpr double patch_edge_m = 1.5;
constexpr double albedo = 0.8;
constexpr glm::dvec3 pictured_size{10, 8, 3};
constexpr double pictured_albedo = 0.6;
constexpr double layer_sigma_t[6] = {0.05, 0.1, 0.25, 0.5, 1, 2};  // [1/m], upwards

std::shared_ptr<const CompiledScene> compiled(SceneDescription description) {
  const Scenario scenario = find_scenario(description, "").value();
  auto scene =
      compile_scene(std::make_shared<const SceneDescription>(std::move(description)), scenario, {});
  if (!scene.ok()) throw std::logic_error(scene.problem().text());
  return std::move(scene).value();
}

void add_object(SceneDescription& d, const std::string& name, Mesh mesh, double patch_edge) {
  Object object;
  object.name = name;
  object.mesh = std::move(mesh);
  object.patch_edge_m = patch_edge;
  d.objects.push_back(std::move(object));
}

/// A box on the floor, without its invisible bottom.
Mesh furniture(const glm::dvec3& low, const glm::dvec3& size) {
  Mesh mesh;
  const glm::dvec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
  const auto face = [&](const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
    const auto first = static_cast<unsigned>(mesh.positions.size());
    for (const glm::dvec3& p : {corner, corner + u, corner + u + v, corner + v})
      mesh.positions.push_back(p);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  };
  face(low, x, z);
  face(low + y, z, x);
  face(low, z, y);
  face(low + x, y, z);
  face(low + z, x, y);
  return mesh;
}

/// Walls and boxes; the boxes shrink with the floor.
void furnish(SceneDescription& d, const glm::dvec3& size) {
  const auto room = shapes::room(size).value();
  const Mesh* walls[] = {&room.floor, &room.ceiling, &room.x0, &room.x1, &room.y0, &room.y1};
  const char* names[] = {"floor", "ceiling", "x0", "x1", "y0", "y1"};
  for (int i = 0; i < 6; ++i) add_object(d, names[i], *walls[i], patch_edge_m);
  // On a grid of 14 x 10 places, each box with its own size and shift, without overlap.
  Random random(1, RandomStream::test);
  random.start(0);
  const double place_x = size.x / 14, place_y = size.y / 10;
  const double x = size.x / room_size.x, y = size.y / room_size.y;
  for (int i = 0; i < boxes; ++i) {
    const double sx = x * (0.3 + 0.5 * random.uniform_double());
    const double sy = y * (0.3 + 0.5 * random.uniform_double());
    const double sz = 0.4 + 1.6 * random.uniform_double() * random.uniform_double();
    const double dx = x * 0.1 + (place_x - sx - x * 0.2) * random.uniform_double();
    const double dy = y * 0.1 + (place_y - sy - y * 0.2) * random.uniform_double();
    add_object(d, "box " + std::to_string(i),
               furniture({place_x * (i % 14) + dx, place_y * (i / 14) + dy, 0}, {sx, sy, sz}),
               patch_edge_m);
  }
}

Emitter lamp(const glm::dvec3& at, const glm::dvec3& size) {
  Emitter e;
  e.name = "lamp";
  e.shape = EmitterShape::rectangle;
  e.frame.origin = at;
  e.size = size;
  e.mains_flux = 10'000;
  return e;
}

Medium smoke(Air air, double scattered) {
  Medium m;
  m.name = "smoke";
  m.optics.albedo = Spectrum::constant(scattered);
  m.optics.extinction.sigma_t = 0.1;
  if (air != Air::layered) return m;
  m.kind = MediumKind::layered;
  for (int i = 0; i < 6; ++i) {
    SmokeOptics optics = m.optics;
    optics.extinction.sigma_t = layer_sigma_t[i];
    m.layers.push_back({0.5 * i, 0.5 * (i + 1), optics});
  }
  return m;
}

}  // namespace

SceneDescription furnished(Air air, const FurnishedTallies& tallies) {
  SceneDescription d;
  d.name = "furnished room";
  d.materials.emplace_back().name = "grey";
  furnish(d, room_size);
  d.emitters.push_back(lamp({10, 7.5, 2.99}, {2, 1, 0}));
  if (air != Air::clear) d.media.push_back(smoke(air, albedo));
  d.run.max_bands = 1;
  d.run.voxels = tallies.voxels;
  if (tallies.detectors) {
    PlaneMeasure plane;
    plane.name = "working plane";
    plane.corner = {0, 0, 0.85};
    plane.edge_u = {20, 0, 0};
    plane.edge_v = {0, 15, 0};
    plane.cells_u = 20;
    plane.cells_v = 15;
    d.planes.push_back(plane);
    CountingPlaneMeasure gate;
    gate.name = "gate";
    gate.corner = {10, 0, 0};
    gate.edge_u = {0, 15, 0};
    gate.edge_v = {0, 0, 3};
    d.counting_planes.push_back(gate);
    VolumeGroupMeasure volume;
    volume.name = "heads";
    volume.shape = VolumeGroupMeasure::Shape::layer;
    volume.low = {0, 0, 1.5};
    volume.high = {0, 0, 2};
    d.volume_groups.push_back(volume);
  }
  return d;
}

std::shared_ptr<const CompiledScene> furnished_room(Air air, const FurnishedTallies& tallies) {
  return compiled(furnished(air, tallies));
}

std::shared_ptr<const CompiledScene> pictured_room(Air air, int width, int height) {
  SceneDescription d;
  d.name = "pictured room";
  d.materials.emplace_back().name = "grey";
  furnish(d, pictured_size);
  for (const double x : {0.25, 0.75}) {
    for (const double y : {0.25, 0.75})
      d.emitters.push_back(
          lamp({x * pictured_size.x, y * pictured_size.y, pictured_size.z - 0.01}, {0.6, 0.3, 0}));
  }
  if (air != Air::clear) d.media.push_back(smoke(air, pictured_albedo));
  d.run.max_bands = 1;
  d.run.eye_path_factor = 0;  // pictures trace their own paths
  Camera camera;
  camera.name = "corner";
  camera.eye = {0.2, 0.2, 1.6};
  camera.target = {pictured_size.x / 2, pictured_size.y / 2, 1.2};
  camera.width = width;
  camera.height = height;
  d.cameras.push_back(camera);
  return compiled(std::move(d));
}

std::shared_ptr<const CompiledScene> landscape(int n) {
  SceneDescription d;
  d.name = "landscape";
  d.materials.emplace_back().name = "grey";
  Mesh mesh;
  const double step = 100.0 / n;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      mesh.positions.push_back(
          {i * step, j * step, std::sin(0.5 * i * step) * std::cos(0.3 * j * step)});
    }
  }
  const auto at = [&](int i, int j) { return static_cast<unsigned>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  add_object(d, "hills", std::move(mesh), 0);
  d.emitters.push_back(lamp({50, 50, 10}, {5, 5, 0}));
  d.run.max_bands = 1;
  return compiled(std::move(d));
}

}  // namespace luxodus::bench
