// Walks the nodes of the scene that a glTF shows, and copies what they place. All arithmetic is in
// double precision; the file's own numbers are floats or integers.
#include "scenes/light/geometry/gltf_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "runtime/core/isolated_job.hpp"
#include "runtime/core/printable.hpp"
#include "scenes/light/geometry/gltf_file.hpp"
#include "scenes/light/geometry/mesh_parts.hpp"

namespace luxodus {
namespace {

/// Step between neighbouring floats at a coordinate.
double float_step(double coordinate) {
  const auto magnitude = static_cast<float>(std::abs(coordinate));
  return static_cast<double>(std::nextafter(magnitude, INFINITY)) - static_cast<double>(magnitude);
}

std::string of_those(size_t count, const char* one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

class GltfWalk {
 public:
  GltfWalk(GltfFile& file, const std::string& path, double metres_per_unit, UpAxis up,
           MeshExtras& extras)
      : file_(file),
        path_(path),
        metres_per_unit_(metres_per_unit),
        parts_(path, metres_per_unit, up),
        extras_(extras) {}

  Result<std::vector<ImportedPart>> walk() {
    struct Open {
      size_t node;
      Transform above;
      bool hidden;
    };
    std::vector<Open> open;
    for (auto root = file_.roots.rbegin(); root != file_.roots.rend(); ++root)
      open.push_back({*root, parts_.to_scene(), false});
    for (size_t done = 0; !open.empty(); ++done) {
      const Open here = open.back();
      open.pop_back();
      const GltfNode& node = file_.nodes[here.node];
      const Transform place = here.above * node.place;
      const bool hidden = here.hidden || node.hidden;
      if (hidden)
        hidden_ += node.mesh || node.lamp ? 1 : 0;
      else if (auto ok = take_node(here.node, place); !ok)
        return ok.problem();
      // Reversed, so that the stack gives children in the file's order.
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        open.push_back({*child, place, hidden});
      tell_share(static_cast<double>(done) / static_cast<double>(file_.nodes.size()));
    }
    tell_notes();
    auto parts = parts_.take();
    if (!parts && triangles_ == 0 && !extras_.lamps.empty()) return std::vector<ImportedPart>();
    return parts;
  }

 private:
  Problem problem(std::string what) const { return problem_in(path_, std::move(what)); }

  Result<void> take_node(size_t index, const Transform& place) {
    const GltfNode& node = file_.nodes[index];
    if (node.lamp) take_lamp(node, file_.lamps[*node.lamp], place);
    if (!node.mesh) return {};
    skinned_ += node.skinned ? 1 : 0;
    if (!node.instanced) return take_mesh(index, place);
    const auto places = instances_of(node);
    if (!places) return places.problem();
    for (const Transform& one : places.value())
      if (auto ok = take_mesh(index, place * one); !ok) return ok.problem();
    return {};
  }

  /// EXT_mesh_gpu_instancing: a translation, rotation and scale for each instance.
  Result<std::vector<Transform>> instances_of(const GltfNode& node) {
    std::vector<double> values[3];
    const std::pair<GltfIndex, int> lists[] = {
        {node.instance_translations, 3}, {node.instance_rotations, 4}, {node.instance_scales, 3}};
    uint64_t count = 0;
    for (const auto& [list, numbers] : lists)
      if (list) count = std::max(count, file_.accessors[*list].count);
    for (size_t i = 0; i < 3; ++i) {
      if (!lists[i].first) continue;
      auto read = file_.values(*lists[i].first, lists[i].second);
      if (!read) return read.problem();
      if (read->size() != count * static_cast<size_t>(lists[i].second))
        return problem("the lists of a node's instances have different lengths");
      values[i] = std::move(read).value();
    }
    if (count > limits::mesh_parts)
      return problem(fmt::format("more than {} instances: simplify the file", limits::mesh_parts));
    std::vector<Transform> out;
    for (size_t i = 0; i < count; ++i) {
      glm::dvec3 t(0), s(1);
      glm::dvec4 r(0, 0, 0, 1);
      for (int k = 0; k < 3; ++k) {
        if (!values[0].empty()) t[k] = values[0][3 * i + static_cast<size_t>(k)];
        if (!values[2].empty()) s[k] = values[2][3 * i + static_cast<size_t>(k)];
      }
      for (int k = 0; k < 4 && !values[1].empty(); ++k)
        r[k] = values[1][4 * i + static_cast<size_t>(k)];
      out.push_back(gltf_placement(t, r, s));
    }
    return out;
  }

  Result<void> take_mesh(size_t index, const Transform& place) {
    const GltfNode& node = file_.nodes[index];
    const GltfMesh& mesh = file_.meshes[*node.mesh];
    const auto& weights = node.weights.empty() ? mesh.weights : node.weights;
    for (size_t i = 0; i < mesh.primitives.size(); ++i) {
      ImportedPart part;
      // Names as scenes know them from earlier releases.
      const std::string mesh_name =
          mesh.name.empty() ? fmt::format("meshes[{}]", *node.mesh) : mesh.name;
      part.name = node.name.empty() ? fmt::format("nodes[{}]", index) : node.name;
      if (mesh.primitives.size() > 1) part.name += fmt::format("/{}-{}", mesh_name, i);
      if (auto ok = copy_triangles(mesh.primitives[i], weights, part); !ok) return ok.problem();
      if (part.mesh.triangles.empty()) continue;
      copy_material(mesh.primitives[i], part);
      if (auto ok = parts_.add(std::move(part), place); !ok) return ok.problem();
    }
    return {};
  }

  Result<void> copy_triangles(const GltfPrimitive& from, const std::vector<double>& weights,
                              ImportedPart& part) {
    constexpr int triangle_list = 4;
    if (from.mode < triangle_list || !from.positions) return {};
    if (from.compressed && !file_.accessors[*from.positions].view)
      return problem(
          fmt::format("part \"{}\" is compressed by Draco, which is not read: export it "
                      "without compression",
                      excerpt(part.name)));
    auto positions = file_.values(*from.positions, 3);
    if (!positions) return positions.problem();
    if (auto ok = check_precision(*from.positions, positions.value(), part.name); !ok)
      return ok.problem();
    if (auto ok = morph(from, weights, positions.value()); !ok) return ok.problem();
    Mesh& mesh = part.mesh;
    const std::vector<double>& p = positions.value();
    for (size_t i = 0; i + 2 < p.size(); i += 3)
      mesh.positions.emplace_back(p[i], p[i + 1], p[i + 2]);
    if (from.texture_uv) {
      const auto uv = file_.values(*from.texture_uv, 2);
      if (!uv) return uv.problem();
      if (uv->size() != 2 * mesh.positions.size())
        return problem(
            fmt::format("part \"{}\": positions and texture coordinates differ in their "
                        "number",
                        excerpt(part.name)));
      // A picture of glTF begins with its top row.
      for (size_t i = 0; i + 1 < uv->size(); i += 2)
        mesh.texture_uv.emplace_back(uv.value()[i], 1 - uv.value()[i + 1]);
    }
    return index_triangles(from, part);
  }

  Result<void> index_triangles(const GltfPrimitive& from, ImportedPart& part) {
    constexpr int strip = 5, fan = 6;
    const size_t vertices = part.mesh.positions.size();
    std::vector<uint32_t> corners;
    if (from.indices) {
      const auto indices = file_.values(*from.indices, 1);
      if (!indices) return indices.problem();
      for (const double index : indices.value()) {
        if (!(index >= 0 && index < static_cast<double>(vertices)))
          return problem(fmt::format("part \"{}\": triangle {} names a vertex that does not exist",
                                     excerpt(part.name), corners.size() / 3 + 1));
        corners.push_back(static_cast<uint32_t>(index));
      }
    } else {
      for (uint32_t i = 0; i < vertices; ++i) corners.push_back(i);
    }
    auto& triangles = part.mesh.triangles;
    const size_t step = from.mode == strip || from.mode == fan ? 1 : 3;
    for (size_t i = 0; i + 2 < corners.size(); i += step) {
      if (from.mode == fan)
        triangles.push_back({corners[0], corners[i + 1], corners[i + 2]});
      else if (from.mode == strip && i % 2 == 1)
        triangles.push_back({corners[i + 1], corners[i], corners[i + 2]});
      else
        triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    }
    triangles_ += triangles.size();
    return {};
  }

  /// Adds the displacements of morph targets (glTF 2.0, 3.7.2.2).
  Result<void> morph(const GltfPrimitive& from, const std::vector<double>& weights,
                     std::vector<double>& positions) {
    for (size_t k = 0; k < std::min(weights.size(), from.morphs.size()); ++k) {
      if (weights[k] == 0 || !from.morphs[k]) continue;
      const auto moved = file_.values(*from.morphs[k], 3);
      if (!moved) return moved.problem();
      if (moved->size() != positions.size())
        return problem("a morph target and its mesh differ in the number of their vertices");
      for (size_t i = 0; i < positions.size(); ++i) positions[i] += weights[k] * moved.value()[i];
      ++morphs_;
    }
    return {};
  }

  Result<void> check_precision(size_t accessor, const std::vector<double>& positions,
                               const std::string& part) const {
    constexpr int floats = 5126;
    if (file_.accessors[accessor].type != floats) return {};
    double farthest = 0;
    for (const double x : positions)
      if (std::isfinite(x)) farthest = std::max(farthest, std::abs(x));
    const double step_m = float_step(farthest) * metres_per_unit_;
    if (step_m <= limits::mesh_coordinate_step_m) return {};
    return problem(
        fmt::format("part \"{}\": a coordinate of {:g} is known to {:.3g} m only; export the model "
                    "about an origin of its own and move it in the scene",
                    excerpt(part), farthest, step_m));
  }

  void copy_material(const GltfPrimitive& from, ImportedPart& part) {
    coloured_ += from.coloured ? 1 : 0;
    if (!from.material) return;
    const GltfMaterial& material = file_.materials[*from.material];
    part.material_name = material.name;
    const std::string told = "\"" + excerpt(material.name) + "\"";
    if (material.emits) emitting_.insert(told);
    if (material.lets_pass) passing_.insert(told);
    if (!material.colour_in_picture) {
      part.base_colour = material.colour;
      return;
    }
    part.no_colour = problem("the colour of the material '" + excerpt(material.name) +
                             "' is in a picture (\"baseColorTexture\" or \"diffuseTexture\"), and "
                             "pictures are not read");
  }

  void take_lamp(const GltfNode& node, const GltfLamp& lamp, const Transform& place) {
    if (lamp.type == "directional") {
      ++suns_;
      return;
    }
    // KHR_lights_punctual: lamps shine along their own -z, and are not scaled.
    ImportedLamp out;
    out.name = !node.name.empty() ? node.name : lamp.name.empty() ? "lamp" : lamp.name;
    out.at = place.offset;
    out.direction = place.vector({0, 0, -1});
    out.is_spot = lamp.type == "spot";
    out.candela = lamp.intensity;
    out.colour = lamp.colour;
    constexpr double degree = 3.141592653589793 / 180;
    out.inner_deg = lamp.inner_rad / degree;
    out.outer_deg = lamp.outer_rad / degree;
    extras_.lamps.push_back(std::move(out));
  }

  void tell_notes() {
    std::vector<std::string>& notes = extras_.notes;
    const auto names = [](const std::set<std::string>& all) {
      constexpr size_t most = 5;
      std::string out;
      size_t told = 0;
      for (const std::string& name : all) {
        if (told == most) return out + fmt::format(" and {} more", all.size() - most);
        out += (told++ == 0 ? "" : ", ") + name;
      }
      return out;
    };
    if (hidden_ > 0)
      notes.push_back("left out, because the file hides them: " + of_those(hidden_, "node"));
    if (!emitting_.empty())
      notes.push_back("the light of materials that emit is not read: " + names(emitting_) +
                      "; state emitters in the scene");
    if (!passing_.empty())
      notes.push_back("materials that let light pass are read as opaque: " + names(passing_) +
                      "; map them to a material of the scene");
    if (suns_ > 0)
      notes.push_back(of_those(suns_, "directional lamp") +
                      " not read: a scene has no lamps at infinity");
    if (skinned_ > 0)
      notes.push_back(of_those(skinned_, "node") +
                      " with a skin: shown at rest, without the pose of its bones");
    if (morphs_ > 0)
      notes.push_back(of_those(morphs_, "morph target") + " applied by their default weights");
    if (coloured_ > 0)
      notes.push_back("colours of vertices are not read: " + of_those(coloured_, "part"));
    if (file_.animations > 0)
      notes.push_back(of_those(file_.animations, "animation") + " not played");
    if (file_.scenes > 1)
      notes.push_back(
          fmt::format("the file has {} scenes: only the one that it shows is read", file_.scenes));
  }

  GltfFile& file_;
  const std::string& path_;
  double metres_per_unit_;
  MeshParts parts_;
  MeshExtras& extras_;
  size_t hidden_ = 0, skinned_ = 0, morphs_ = 0, coloured_ = 0, suns_ = 0;
  uint64_t triangles_ = 0;
  std::set<std::string> emitting_, passing_;
};

}  // namespace

Result<std::vector<ImportedPart>> import_gltf(const std::string& path, double metres_per_unit,
                                              UpAxis up, MeshExtras& extras) {
  auto file = GltfFile::read(path);
  if (!file) {
    extras.files = {path};
    return file.problem();
  }
  auto parts = GltfWalk(file.value(), path, metres_per_unit, up, extras).walk();
  extras.files = file->files;
  return parts;
}

}  // namespace luxodus
