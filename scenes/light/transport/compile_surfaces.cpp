#include "scenes/light/transport/compile_surfaces.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/light/geometry/partition.hpp"
#include "scenes/light/geometry/patches.hpp"
#include "scenes/light/geometry/primitives.hpp"
#include "scenes/light/geometry/transform.hpp"
#include "scenes/light/optics/offset_ray.hpp"
#include "scenes/light/tally/fixed_point.hpp"
#include "scenes/light/transport/packed_scene.hpp"

namespace luxodus {

namespace limits {
/// 16 GB of totals; ten times as many exceed 32-bit indices.
inline constexpr uint64_t patches = 200'000'000;
}  // namespace limits

namespace {

SurfaceKind surface_kind(MaterialKind kind) {
  switch (kind) {
    case MaterialKind::lambertian:
      return SurfaceKind::lambertian;
    case MaterialKind::glossy:
      return SurfaceKind::glossy;
    case MaterialKind::mirror:
      return SurfaceKind::mirror;
    case MaterialKind::glass_pane:
      return SurfaceKind::glass_pane;
    case MaterialKind::dielectric:
      return SurfaceKind::dielectric;
    case MaterialKind::open:
      return SurfaceKind::open;
  }
  return SurfaceKind::lambertian;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool door_is_open(const Object& object, const Scenario& scenario) {
  if (contains(scenario.doors_open, object.name)) return true;
  if (contains(scenario.doors_closed, object.name)) return false;
  return object.door->open;
}

/// The object's mesh with its door turned as the scenario says.
Mesh mesh_in(const Object& object, const Scenario& scenario) {
  Mesh mesh = object.mesh;
  if (object.door && door_is_open(object, scenario)) {
    const auto turn = rotation(object.door->axis, object.door->open_angle_deg);
    if (turn) {
      apply(translation(-object.door->hinge), mesh);
      apply(turn.value(), mesh);
      apply(translation(object.door->hinge), mesh);
    }
  }
  return mesh;
}

/// A flat face in the local xy plane of a frame, front to +z, with texture coordinates.
Mesh face_mesh(const Frame& frame, double width, double height) {
  const glm::dvec3 x = frame.axes[0] * (width / 2);
  const glm::dvec3 y = frame.axes[1] * (height / 2);
  const glm::dvec3 o = frame.origin;
  return {{o - x - y, o + x - y, o + x + y, o - x + y},
          {{0, 1, 2}, {0, 2, 3}},
          {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
}

/// The solid surface of an emitter that has a body; its front is where light leaves.
Mesh body_mesh(const Emitter& e) {
  const double bound = 0.002;  // [m] chords of round bodies stay this close
  Mesh mesh;
  switch (e.shape) {
    case EmitterShape::point:
      return mesh;
    case EmitterShape::rectangle: {
      Frame down = e.frame;
      down.axes[1] = -down.axes[1];
      down.axes[2] = -down.axes[2];
      return face_mesh(down, e.size.x, e.size.y);
    }
    case EmitterShape::disc: {
      const auto n = shapes::segments_within(e.size.x / 2, bound);
      if (auto shape = shapes::disc(e.size.x / 2, n ? n.value() : 32); shape) mesh = shape->mesh;
      apply(rotation({1, 0, 0}, 180).value(), mesh);
      break;
    }
    case EmitterShape::sphere:
      if (auto shape = shapes::sphere(e.size.x / 2, bound); shape) mesh = shape->mesh;
      break;
    case EmitterShape::tube: {
      const auto n = shapes::segments_within(e.size.y / 2, bound);
      auto shape = shapes::cylinder(e.size.y / 2, e.size.x, n ? n.value() : 32, shapes::Caps::none);
      if (shape) mesh = shape->mesh;
      apply(translation({0, 0, -e.size.x / 2}), mesh);
      apply(rotation({0, 1, 0}, 90).value(), mesh);
      break;
    }
    case EmitterShape::mesh:
      return e.mesh;
  }
  apply(as_transform(e.frame), mesh);
  return mesh;
}

Frame back_frame(const Sign& sign) {
  Frame back = sign.frame;
  back.origin -= sign.frame.axes[2] * sign.thickness_m;
  back.axes[0] = -back.axes[0];
  back.axes[2] = -back.axes[2];
  return back;
}

/// Distance of hit points from the edges of a triangle, in ray offsets: in a corner of two walls,
/// no ray starts beyond the other wall down to an angle of 1 / 16, 3.6 degrees.
constexpr double offsets_to_edge = 16;
/// Limit of that distance along slivers, as a multiple: a triangle has one margin for all its
/// edges.
constexpr double along_slivers = 16;
/// In 2^-16 of the triangle's heights; never 0, since an edge belongs to two triangles.
uint16_t edge_margin(const TriangleRecord& t, double twice_area_m2, double longest_m,
                     double min_offset_m) {
  float farthest = 0;
  for (const glm::vec3& corner : t.corner) {
    for (int axis = 0; axis < 3; ++axis) farthest = std::max(farthest, std::fabs(corner[axis]));
  }
  const double off = offsets_to_edge * largest_offset(double{farthest}, min_offset_m);
  const double share =
      off * std::min(longest_m / twice_area_m2, along_slivers / longest_m) * 0x1p16;
  return static_cast<uint16_t>(std::clamp(share, 1.0, double{TriangleRecord::max_edge_margin}));
}

/// Longer than any building: then the unit is probably millimetres [m].
constexpr double max_length_m = 1000;

double length_of(const Mesh& mesh) {
  Bounds box;
  for (const glm::dvec3& p : mesh.positions) box.extend(p);
  const glm::dvec3 size = box.high - box.low;
  return std::max({size.x, size.y, size.z});
}

/// Collects the triangles of one surface after another.
class TriangleBuilder {
 public:
  explicit TriangleBuilder(CompiledScene& scene) : scene_(scene) {}

  /// Errors: this surface makes the scene exceed limits::patches; `place` is its description.
  Result<void> add(CompiledSurface surface, const SourcePlace& place, const Mesh& mesh,
                   double patch_edge_m) {
    surface.first_patch = patches();
    if (surface.one_patch && !mesh.triangles.empty()) patches_ += 2;
    const auto index = static_cast<uint32_t>(scene_.surfaces.size());
    for (const glm::uvec3& t : mesh.triangles) {
      add_triangle(surface, index, mesh, t, patch_edge_m);
      if (patches_ > limits::patches) {
        return problem_in(place, "with \"" + surface.name + "\" the scene has more than " +
                                     std::to_string(limits::patches) + " flux patches: " +
                                     (length_of(mesh) > max_length_m
                                          ? "it is longer than a kilometre: is it in another unit "
                                            "than metres? Else make patch_edge_m larger"
                                          : "make patch_edge_m larger"));
      }
    }
    surface.patches = patches() - surface.first_patch;
    scene_.total_area_m2 += surface.area_m2;
    scene_.surfaces.push_back(std::move(surface));
    return {};
  }

  int64_t degenerate() const { return degenerate_; }
  uint32_t patches() const { return static_cast<uint32_t>(patches_); }
  std::vector<TriangleRecord>& records() { return records_; }
  std::vector<GeometryCell::TriangleUv>& uv() { return uv_; }

 private:
  void add_triangle(CompiledSurface& surface, uint32_t index, const Mesh& mesh, const glm::uvec3& t,
                    double patch_edge_m) {
    TriangleRecord r{};
    double longest = 0;
    for (int k = 0; k < 3; ++k) {
      r.corner[k] = glm::vec3(mesh.positions[t[k]] - scene_.local_origin);
      longest =
          std::max(longest, glm::distance(mesh.positions[t[k]], mesh.positions[t[(k + 1) % 3]]));
    }
    const glm::dvec3 cross = glm::cross(glm::dvec3(r.corner[1]) - glm::dvec3(r.corner[0]),
                                        glm::dvec3(r.corner[2]) - glm::dvec3(r.corner[0]));
    const double twice_area = glm::length(cross);
    if (!(twice_area > 0)) {
      ++degenerate_;
      return;
    }
    r.normal = glm::vec3(cross / twice_area);
    const bool cut = patch_edge_m > 0 && !surface.one_patch;
    r.subdivision = static_cast<uint16_t>(cut ? subdivision_for(longest, patch_edge_m) : 1);
    r.edge_margin = edge_margin(r, twice_area, longest, scene_.min_offset_m);
    r.first_patch = surface.one_patch ? surface.first_patch : patches();
    r.surface = index;
    r.global_triangle = static_cast<uint32_t>(records_.size());
    if (!surface.one_patch) patches_ += 2 * uint64_t{r.subdivision} * r.subdivision;
    surface.area_m2 += twice_area / 2;
    if (!mesh.texture_uv.empty()) {
      uv_.push_back({r.global_triangle,
                     {mesh.texture_uv[t[0]], mesh.texture_uv[t[1]], mesh.texture_uv[t[2]]}});
    }
    records_.push_back(r);
  }

  CompiledScene& scene_;
  std::vector<TriangleRecord> records_;
  std::vector<GeometryCell::TriangleUv> uv_;
  // 64 bits: one triangle has up to 2^31 patches, so the sum can exceed 32 bits before it is
  // refused.
  uint64_t patches_ = 0;
  int64_t degenerate_ = 0;
};

GeometryCell make_cell(const std::vector<TriangleRecord>& records,
                       const std::vector<GeometryCell::TriangleUv>& uv,
                       const std::vector<uint32_t>& members) {
  GeometryCell cell;
  cell.low = glm::vec3(std::numeric_limits<float>::infinity());
  cell.high = -cell.low;
  for (const uint32_t global : members) {
    const auto at = std::lower_bound(uv.begin(), uv.end(), global,
                                     [](const auto& t, uint32_t g) { return t.triangle < g; });
    if (at != uv.end() && at->triangle == global) {
      cell.texture_uv.push_back(*at);
      cell.texture_uv.back().triangle = static_cast<uint32_t>(cell.triangles.size());
    }
    cell.triangles.push_back(records[global]);
    for (const glm::vec3& c : records[global].corner) {
      cell.low = glm::min(cell.low, c);
      cell.high = glm::max(cell.high, c);
    }
  }
  return cell;
}

/// Numbers of the triangles, those longer than a cell's side in a separate list. If the two
/// triangles of a floor share a cell with a chair, the cell's box spans the floor, and every ray
/// above it has to enter it. One list if there is only one kind.
std::vector<std::vector<uint32_t>> split_by_size(const CompiledScene& scene,
                                                 const std::vector<TriangleRecord>& records,
                                                 int cells) {
  const glm::dvec3 size = glm::max(scene.bounds.high - scene.bounds.low, glm::dvec3(1e-3));
  const double side = std::cbrt(size.x * size.y * size.z / cells);
  std::vector<std::vector<uint32_t>> out(2);
  for (uint32_t i = 0; i < records.size(); ++i) {
    const auto& c = records[i].corner;
    const float longest =
        std::max({glm::distance(c[0], c[1]), glm::distance(c[1], c[2]), glm::distance(c[2], c[0])});
    out[static_cast<double>(longest) > side ? 0 : 1].push_back(i);
  }
  std::erase_if(out, [](const auto& list) { return list.empty(); });
  return out;
}

/// Partitions these triangles into compact cells.
void add_cells(CompiledScene& scene, TriangleBuilder& builder,
               const std::vector<uint32_t>& triangles, int cells) {
  std::vector<glm::dvec3> centroids;
  for (const uint32_t t : triangles) {
    const auto& c = builder.records()[t].corner;
    centroids.push_back((glm::dvec3(c[0]) + glm::dvec3(c[1]) + glm::dvec3(c[2])) / 3.0);
  }
  for (std::vector<uint32_t>& members : partition_triangles(centroids, cells)) {
    for (uint32_t& member : members) member = triangles[member];
    scene.cells.push_back(make_cell(builder.records(), builder.uv(), members));
    scene.cell_boxes.push_back({scene.cells.back().low, scene.cells.back().high});
  }
}

void cut_into_cells(CompiledScene& scene, TriangleBuilder& builder, int cells) {
  // Without triangles there is nothing to partition, but resolvers expect a cell.
  if (cells <= 1 || builder.records().empty()) {
    GeometryCell cell;
    cell.triangles = std::move(builder.records());
    cell.texture_uv = std::move(builder.uv());
    cell.low = scene.local_low;
    cell.high = scene.local_high;
    scene.cell_boxes.push_back({cell.low, cell.high});
    scene.cells.push_back(std::move(cell));
    return;
  }
  const auto sizes = split_by_size(scene, builder.records(), cells);
  const auto all = static_cast<double>(builder.records().size());
  int left = cells;
  for (size_t i = 0; i < sizes.size(); ++i) {
    const auto share = static_cast<double>(sizes[i].size()) / all;
    const bool last = i + 1 == sizes.size();
    const int own =
        last ? left : std::clamp(static_cast<int>(std::lround(cells * share)), 1, left - 1);
    left -= own;
    add_cells(scene, builder, sizes[i], own);
  }
}

/// Adds the scenario's surfaces: objects, then signs, then emitter bodies.
Result<void> add_surfaces(CompiledScene& scene, TriangleBuilder& builder) {
  const auto dark = static_cast<uint32_t>(scene.materials.size() - 1);
  for (const Object& object : scene.description->objects) {
    CompiledSurface s;
    s.name = object.name;
    s.material[0] = static_cast<uint32_t>(object.material);
    s.material[1] = static_cast<uint32_t>(object.back_material);
    s.one_patch = object.one_patch;
    s.body = object.body;
    const Mesh mesh = mesh_in(object, scene.scenario);
    if (auto ok = builder.add(std::move(s), object.place, mesh, object.patch_edge_m); !ok)
      return ok.problem();
  }
  for (uint32_t i = 0; i < scene.signs.size(); ++i) {
    const Sign& sign = scene.description->signs[scene.signs[i].sign];
    CompiledSurface s;
    s.name = sign.name + (scene.signs[i].back ? " back" : "");
    s.material[0] = s.material[1] = dark;
    s.sign = i;
    scene.signs[i].surface = static_cast<uint32_t>(scene.surfaces.size());
    const Mesh face = face_mesh(scene.signs[i].frame, sign.width_m, sign.height_m);
    if (auto ok = builder.add(std::move(s), sign.place, face, 0); !ok) return ok.problem();
  }
  for (uint32_t i = 0; i < scene.description->emitters.size(); ++i) {
    const Emitter& e = scene.description->emitters[i];
    if (e.body_material.empty()) continue;
    CompiledSurface s;
    s.name = e.name + " body";
    s.body_emitter = i;
    s.material[0] = s.material[1] = dark;
    for (uint32_t m = 0; m < scene.materials.size(); ++m) {
      if (scene.materials[m].name == e.body_material) s.material[0] = s.material[1] = m;
    }
    if (auto ok = builder.add(std::move(s), e.place, body_mesh(e), 0); !ok) return ok.problem();
  }
  return {};
}

/// Back sides of signs and of emitter bodies: matt, dark.
constexpr double sign_back_reflectance = 0.3;

}  // namespace

void compile_materials(CompiledScene& scene) {
  scene.images = distinct_images(*scene.description);
  const auto add = [&](const Material& m) {
    CompiledMaterial out;
    out.name = m.name;
    out.kind = m.kind;
    for (int b = 0; b < scene.bands.count(); ++b) {
      out.by_band.push_back(make_surface(surface_kind(m.kind),
                                         scene.bands.average(m.reflectance, b),
                                         scene.bands.average(m.specular, b), m.roughness, m.ior,
                                         scene.bands.average(m.internal_transmittance, b)));
    }
    if (m.reflectance_image) {
      const auto at = std::find(scene.images.begin(), scene.images.end(), m.reflectance_image);
      out.image = static_cast<uint32_t>(at - scene.images.begin());
    }
    scene.materials.push_back(std::move(out));
  };
  for (const Material& m : scene.description->materials) add(m);
  Material back;
  back.name = "sign back";
  back.reflectance = Spectrum::constant(sign_back_reflectance);
  add(back);
  // Texels are linear RGB: the contribution of each channel to a white texel's reflectance in a
  // band.
  const Spectrum r = reflectance_from_linear_srgb(1, 0, 0);
  const Spectrum g = reflectance_from_linear_srgb(0, 1, 0);
  const Spectrum b = reflectance_from_linear_srgb(0, 0, 1);
  for (int i = 0; i < scene.bands.count(); ++i) {
    const double share[3] = {scene.bands.average(r, i), scene.bands.average(g, i),
                             scene.bands.average(b, i)};
    const double sum = std::max(share[0] + share[1] + share[2], 1e-9);
    scene.image_basis.push_back({static_cast<Real>(share[0] / sum),
                                 static_cast<Real>(share[1] / sum),
                                 static_cast<Real>(share[2] / sum)});
  }
}

void compile_sign_faces(CompiledScene& scene) {
  for (uint32_t i = 0; i < scene.description->signs.size(); ++i) {
    const Sign& sign = scene.description->signs[i];
    for (int side = 0; side < (sign.double_sided ? 2 : 1); ++side) {
      CompiledSign out;
      out.sign = i;
      out.back = side == 1;
      out.frame = side == 0 ? sign.frame : back_frame(sign);
      out.origin = Vec3(out.frame.origin - scene.local_origin);
      out.axes = Mat3(out.frame.axes);
      out.parts = sign.face.parts();
      for (size_t c = 0; c < sign.colours.size(); ++c) {
        CompiledFaceColour& colour = out.colours.emplace_back();
        colour.luminance_cd_m2 =
            scenario_luminance(sign, static_cast<ColourIndex>(c), scene.scenario);
        for (int b = 0; b < scene.bands.count(); ++b)
          colour.reflectance.push_back(
              static_cast<Real>(scene.bands.average(sign.colours[c].reflectance, b)));
      }
      scene.signs.push_back(std::move(out));
    }
  }
}

Result<void> compile_triangles(CompiledScene& scene, int cells) {
  TriangleBuilder builder(scene);
  if (auto ok = add_surfaces(scene, builder); !ok) return ok.problem();
  if (builder.degenerate() > 0) {
    scene.warnings.push_back({{scene.description->file, 0},
                              std::to_string(builder.degenerate()) +
                                  " triangles have no area in single precision and were dropped"});
  }
  scene.triangles = builder.records().size();
  scene.patch_count = builder.patches();
  cut_into_cells(scene, builder, cells);
  return {};
}

std::vector<std::string> open_doors(const SceneDescription& description, const Scenario& scenario) {
  std::vector<std::string> open;
  for (const Object& object : description.objects) {
    if (object.door && door_is_open(object, scenario)) open.push_back(object.name);
  }
  return open;
}

Result<void> adopt_packed_geometry(CompiledScene& scene) {
  const PackedScene& packed = *scene.description->packed;
  if (open_doors(*scene.description, scene.scenario) != packed.open_doors) {
    return problem_in(packed.file->name(),
                      "in scenario \"" + scene.scenario.name +
                          "\" other doors are open than in the one that was packed: pack that one");
  }
  scene.surfaces = packed.surfaces;
  scene.triangles = packed.triangles;
  scene.patch_count = packed.patch_count;
  scene.total_area_m2 = packed.total_area_m2;
  for (uint32_t i = 0; i < scene.surfaces.size(); ++i) {
    const uint32_t sign = scene.surfaces[i].sign;
    if (sign != none_index) scene.signs[sign].surface = i;
  }
  for (const PackedScene::Cell& cell : packed.cells)
    scene.cell_boxes.push_back({cell.low, cell.high});
  for (const std::string& warning : packed.warnings)
    scene.warnings.push_back({{packed.file->name(), 0}, warning});
  return {};
}

void compile_lambert_fractions(CompiledScene& scene) {
  const auto bands = static_cast<size_t>(scene.bands.count());
  scene.lambert_fraction.resize(scene.surfaces.size() * 2 * bands);
  for (size_t i = 0; i < scene.surfaces.size(); ++i) {
    for (size_t side = 0; side < 2; ++side) {
      const CompiledMaterial& m = scene.materials[scene.surfaces[i].material[side]];
      for (size_t b = 0; b < bands; ++b) {
        scene.lambert_fraction[(i * 2 + side) * bands + b] =
            to_fraction(static_cast<double>(m.by_band[b].reflectance));
      }
    }
  }
}

Bounds solid_bounds(const SceneDescription& description, const Scenario& scenario) {
  if (description.packed != nullptr) return description.packed->bounds;
  Bounds bounds;
  const auto extend = [&](const Mesh& mesh) {
    for (const glm::dvec3& p : mesh.positions) bounds.extend(p);
  };
  for (const Object& object : description.objects) extend(mesh_in(object, scenario));
  for (const Sign& sign : description.signs) {
    extend(face_mesh(sign.frame, sign.width_m, sign.height_m));
    if (sign.double_sided) extend(face_mesh(back_frame(sign), sign.width_m, sign.height_m));
  }
  for (const Emitter& e : description.emitters) {
    if (!e.body_material.empty()) extend(body_mesh(e));
    bounds.extend(e.frame.origin);
  }
  for (const PlaneMeasure& p : description.planes) {
    bounds.extend(p.corner);
    bounds.extend(p.corner + p.edge_u + p.edge_v);
  }
  for (const Observer& o : description.observers) bounds.extend(o.eye);
  return bounds;
}

}  // namespace luxodus
