// The JSON of a glTF becomes the plain lists of GltfFile (glTF 2.0 specification, chapter 5).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>

#include "runtime/core/printable.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/light/geometry/gltf_file.hpp"
#include "scenes/light/geometry/import.hpp"

namespace luxodus {

namespace {

using nlohmann::json;

/// Largest distance between two elements of a buffer view [bytes] (glTF 2.0, 5.11.4).
constexpr uint64_t max_stride = 252;

/// Whether brackets outside strings nest deeper than the limit.
bool nests_too_deep(std::string_view text) {
  int depth = 0;
  bool in_string = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > limits::gltf_nesting) return true;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return false;
}

/// Whether a file that requires this extension is read rightly without more, because it concerns
/// what is read, or what is told, or only pictures and gloss.
bool is_read(const std::string& extension) {
  static const std::set<std::string> known = {
      "KHR_mesh_quantization", "KHR_node_visibility", "EXT_mesh_gpu_instancing",
      "KHR_lights_punctual",   "KHR_texture_basisu",  "KHR_texture_transform",
      "EXT_texture_webp",      "EXT_texture_avif",    "MSFT_texture_dds"};
  return known.contains(extension) || extension.starts_with("KHR_materials_");
}

const json& empty_object() {
  static const json empty = json::object();
  return empty;
}

const json& empty_list() {
  static const json empty = json::array();
  return empty;
}

}  // namespace

/// Reads the JSON of one file. The first mistake is kept; what follows it is without meaning.
class GltfJson {
 public:
  GltfJson(GltfFile& file, const json& top) : file_(file), top_(top) {}

  Result<void> read() {
    read_extensions();
    if (!fault_) read_buffers();
    if (!fault_) read_accessors();
    if (!fault_) read_materials();
    if (!fault_) read_meshes();
    if (!fault_) read_lamps();
    if (!fault_) read_nodes();
    if (!fault_) check_trees();
    if (!fault_) read_scene();
    if (fault_) return *fault_;
    return {};
  }

 private:
  // ---- values --------------------------------------------------------------------------------

  void fail(std::string what) {
    if (!fault_) fault_ = file_.problem(std::move(what));
  }
  void wrong(const char* key, const char* wanted) {
    fail(fmt::format("{}: \"{}\" has to be {}", at_, key, wanted));
  }
  static const json* find(const json& from, const char* key) {
    const auto it = from.is_object() ? from.find(key) : from.end();
    return it == from.end() ? nullptr : &*it;
  }
  const json& object(const json& from, const char* key) {
    const json* value = find(from, key);
    if (value == nullptr) return empty_object();
    if (!value->is_object()) wrong(key, "an object");
    return value->is_object() ? *value : empty_object();
  }
  const json& list(const json& from, const char* key) {
    const json* value = find(from, key);
    if (value == nullptr) return empty_list();
    if (!value->is_array()) wrong(key, "a list");
    return value->is_array() ? *value : empty_list();
  }
  double number(const json& from, const char* key, double otherwise) {
    const json* value = find(from, key);
    if (value == nullptr) return otherwise;
    if (!value->is_number()) wrong(key, "a number");
    return value->is_number() ? value->get<double>() : otherwise;
  }
  uint64_t count(const json& from, const char* key, uint64_t otherwise) {
    const json* value = find(from, key);
    if (value == nullptr) return otherwise;
    if (value->is_number_unsigned()) return value->get<uint64_t>();
    wrong(key, "a whole number");
    return otherwise;
  }
  bool flag(const json& from, const char* key, bool otherwise) {
    const json* value = find(from, key);
    if (value == nullptr) return otherwise;
    if (!value->is_boolean()) wrong(key, "true or false");
    return value->is_boolean() ? value->get<bool>() : otherwise;
  }
  std::string text(const json& from, const char* key) {
    const json* value = find(from, key);
    if (value == nullptr) return "";
    if (!value->is_string()) wrong(key, "a text");
    return value->is_string() ? value->get<std::string>() : "";
  }
  std::vector<double> numbers(const json& from, const char* key) {
    std::vector<double> out;
    for (const json& one : list(from, key)) {
      if (!one.is_number()) wrong(key, "a list of numbers");
      out.push_back(one.is_number() ? one.get<double>() : 0);
    }
    return out;
  }
  /// As many numbers as `otherwise` has.
  template <size_t n>
  std::array<double, n> numbers(const json& from, const char* key,
                                std::array<double, n> otherwise) {
    if (find(from, key) == nullptr) return otherwise;
    const std::vector<double> values = numbers(from, key);
    if (values.size() != n) {
      wrong(key, fmt::format("{} numbers", n).c_str());
      return otherwise;
    }
    std::copy(values.begin(), values.end(), otherwise.begin());
    return otherwise;
  }
  glm::dvec3 colour(const json& from, const char* key, std::array<double, 3> otherwise) {
    const auto c = numbers(from, key, otherwise);
    return {c[0], c[1], c[2]};
  }
  /// A reference to one of `size` things.
  GltfIndex index(const json& from, const char* key, size_t size) {
    const json* value = find(from, key);
    if (value == nullptr) return std::nullopt;
    if (!value->is_number_unsigned() || value->get<uint64_t>() >= size) {
      fail(fmt::format("{}: \"{}\" names what there is not", at_, key));
      return std::nullopt;
    }
    return value->get<size_t>();
  }
  size_t needed_index(const json& from, const char* key, size_t size) {
    const GltfIndex found = index(from, key, size);
    if (!found) fail(fmt::format("{}: \"{}\" is missing", at_, key));
    return found.value_or(0);
  }
  const json& extension(const json& from, const char* name) {
    return object(object(from, "extensions"), name);
  }
  static bool extended(const json& from, const char* name) {
    const json* all = find(from, "extensions");
    return all != nullptr && find(*all, name) != nullptr;
  }
  /// Calls `take` for each object of a list of the file.
  template <class Take>
  void each(const char* key, const Take& take) {
    at_ = "the file";
    const json& all = list(top_, key);
    for (size_t i = 0; i < all.size() && !fault_; ++i) {
      at_ = fmt::format("{}[{}]", key, i);
      if (!all[i].is_object()) return fail(at_ + " has to be an object");
      take(all[i], i);
    }
  }

  // ---- lists of the file ---------------------------------------------------------------------

  void read_extensions() {
    at_ = "the file";
    const std::string version = text(object(top_, "asset"), "version");
    if (!version.starts_with("2.")) fail("it is no glTF 2.0: \"asset\" does not say version 2");
    for (const json& one : list(top_, "extensionsRequired")) {
      const std::string name = one.is_string() ? one.get<std::string>() : "?";
      if (is_read(name)) continue;
      const bool packs = name == "KHR_draco_mesh_compression" || name.starts_with("EXT_meshopt") ||
                         name.starts_with("KHR_meshopt");
      fail(fmt::format("it requires the extension \"{}\", which is not read: export it {}",
                       excerpt(name), packs ? "without compression" : "without"));
    }
    file_.animations = list(top_, "animations").size();
  }

  void read_buffers() {
    each("buffers", [&](const json& from, size_t) {
      GltfBuffer buffer;
      buffer.bytes = count(from, "byteLength", 0);
      if (find(from, "uri") != nullptr) buffer.uri = text(from, "uri");
      file_.buffers_.push_back(std::move(buffer));
    });
    file_.read_.resize(file_.buffers_.size());
    each("bufferViews", [&](const json& from, size_t) {
      GltfView view;
      view.buffer = needed_index(from, "buffer", file_.buffers_.size());
      view.offset = count(from, "byteOffset", 0);
      view.bytes = count(from, "byteLength", 0);
      view.stride = count(from, "byteStride", 0);
      if (view.stride > max_stride) wrong("byteStride", "4 to 252");
      view.compressed =
          extended(from, "EXT_meshopt_compression") || extended(from, "KHR_meshopt_compression");
      file_.views_.push_back(view);
    });
  }

  int component_type(const json& from) {
    const auto type = static_cast<int>(std::min<uint64_t>(count(from, "componentType", 0), 9999));
    if (type < 5120 || type > 5126 || type == 5124) fail(at_ + ": its component type is unknown");
    return type;
  }

  void read_accessors() {
    each("accessors", [&](const json& from, size_t) {
      GltfAccessor a;
      a.view = index(from, "bufferView", file_.views_.size());
      a.offset = count(from, "byteOffset", 0);
      a.count = count(from, "count", 0);
      a.type = component_type(from);
      const std::string shape = text(from, "type");
      a.numbers = shape == "SCALAR"                               ? 1
                  : shape.starts_with("VEC") && shape.size() == 4 ? shape[3] - '0'
                                                                  : 16;
      a.normalized = flag(from, "normalized", false);
      if (find(from, "sparse") != nullptr) {
        const json& sparse = object(from, "sparse");
        const json &indices = object(sparse, "indices"), &values = object(sparse, "values");
        a.sparse = GltfSparse{count(sparse, "count", 0),
                              needed_index(indices, "bufferView", file_.views_.size()),
                              needed_index(values, "bufferView", file_.views_.size()),
                              count(indices, "byteOffset", 0),
                              count(values, "byteOffset", 0),
                              component_type(indices)};
      }
      if (a.count > limits::mesh_vertices)
        fail(fmt::format("{}: it has {} elements, the most are {}: simplify or split the file", at_,
                         a.count, limits::mesh_vertices));
      file_.accessors.push_back(std::move(a));
    });
  }

  void read_materials() {
    each("materials", [&](const json& from, size_t) {
      GltfMaterial m;
      m.name = text(from, "name");
      const json& plain = object(from, "pbrMetallicRoughness");
      const auto base = numbers<4>(plain, "baseColorFactor", {1, 1, 1, 1});
      m.colour = {base[0], base[1], base[2]};
      m.colour_in_picture = find(plain, "baseColorTexture") != nullptr;
      double alpha = base[3];
      if (const char* old = "KHR_materials_pbrSpecularGlossiness"; extended(from, old)) {
        const auto diffuse = numbers<4>(extension(from, old), "diffuseFactor", {1, 1, 1, 1});
        m.colour = {diffuse[0], diffuse[1], diffuse[2]};
        m.colour_in_picture = find(extension(from, old), "diffuseTexture") != nullptr;
        alpha = diffuse[3];
      }
      const glm::dvec3 glow = colour(from, "emissiveFactor", {0, 0, 0});
      m.emits = std::max({glow.x, glow.y, glow.z}) > 0;
      const std::string mode = text(from, "alphaMode");
      m.lets_pass =
          (mode == "BLEND" && (alpha < 1 || m.colour_in_picture)) || mode == "MASK" ||
          number(extension(from, "KHR_materials_transmission"), "transmissionFactor", 0) > 0 ||
          number(extension(from, "KHR_materials_diffuse_transmission"), "diffuseTransmissionFactor",
                 0) > 0;
      file_.materials.push_back(std::move(m));
    });
  }

  GltfPrimitive primitive(const json& from) {
    GltfPrimitive p;
    const size_t accessors = file_.accessors.size();
    const json& attributes = object(from, "attributes");
    p.mode = static_cast<int>(std::min<uint64_t>(count(from, "mode", 4), 99));
    if (p.mode > 6) wrong("mode", "0 to 6");
    p.positions = index(attributes, "POSITION", accessors);
    p.texture_uv = index(attributes, "TEXCOORD_0", accessors);
    p.coloured = find(attributes, "COLOR_0") != nullptr;
    p.indices = index(from, "indices", accessors);
    p.material = index(from, "material", file_.materials.size());
    p.compressed = extended(from, "KHR_draco_mesh_compression");
    for (const json& target : list(from, "targets"))
      p.morphs.push_back(index(target, "POSITION", accessors));
    return p;
  }

  void read_meshes() {
    each("meshes", [&](const json& from, size_t) {
      GltfMesh mesh;
      mesh.name = text(from, "name");
      mesh.weights = numbers(from, "weights");
      for (const json& one : list(from, "primitives")) mesh.primitives.push_back(primitive(one));
      file_.meshes.push_back(std::move(mesh));
    });
  }

  void read_lamps() {
    at_ = "KHR_lights_punctual";
    const json& all = list(extension(top_, "KHR_lights_punctual"), "lights");
    for (size_t i = 0; i < all.size(); ++i) {
      at_ = fmt::format("KHR_lights_punctual, lights[{}]", i);
      GltfLamp lamp;
      lamp.name = text(all[i], "name");
      lamp.type = text(all[i], "type");
      if (lamp.type != "point" && lamp.type != "spot" && lamp.type != "directional")
        wrong("type", "point, spot or directional");
      lamp.intensity = number(all[i], "intensity", 1);
      lamp.colour = colour(all[i], "color", {1, 1, 1});
      lamp.inner_rad = number(object(all[i], "spot"), "innerConeAngle", lamp.inner_rad);
      lamp.outer_rad = number(object(all[i], "spot"), "outerConeAngle", lamp.outer_rad);
      constexpr double widest_rad = 1.5707963267948968;
      const bool sound = lamp.intensity >= 0 && lamp.intensity < 1e12 && lamp.inner_rad >= 0 &&
                         lamp.inner_rad < lamp.outer_rad && lamp.outer_rad <= widest_rad &&
                         std::min({lamp.colour.x, lamp.colour.y, lamp.colour.z}) >= 0 &&
                         std::max({lamp.colour.x, lamp.colour.y, lamp.colour.z}) <= 1;
      if (!sound) fail(at_ + ": its intensity, colour or cone is out of range");
      file_.lamps.push_back(std::move(lamp));
    }
  }

  Transform place_of(const json& from) {
    if (find(from, "matrix") != nullptr) {
      const auto m = numbers<16>(from, "matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
      return {glm::dmat3(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]),
              {m[12], m[13], m[14]}};
    }
    const auto t = numbers<3>(from, "translation", {0, 0, 0});
    const auto r = numbers<4>(from, "rotation", {0, 0, 0, 1});
    const auto s = numbers<3>(from, "scale", {1, 1, 1});
    return gltf_placement({t[0], t[1], t[2]}, {r[0], r[1], r[2], r[3]}, {s[0], s[1], s[2]});
  }

  void read_nodes() {
    at_ = "the file";
    if (const size_t all = list(top_, "nodes").size(); all > limits::mesh_parts)
      return fail(fmt::format("it has {} nodes, the most are {}: simplify or split it", all,
                              limits::mesh_parts));
    const size_t total = list(top_, "nodes").size();
    each("nodes", [&](const json& from, size_t) {
      GltfNode node;
      node.name = text(from, "name");
      node.mesh = index(from, "mesh", file_.meshes.size());
      node.skinned = find(from, "skin") != nullptr;
      node.weights = numbers(from, "weights");
      node.place = place_of(from);
      node.hidden = !flag(extension(from, "KHR_node_visibility"), "visible", true);
      node.lamp = index(extension(from, "KHR_lights_punctual"), "light", file_.lamps.size());
      node.instanced = extended(from, "EXT_mesh_gpu_instancing");
      const json& of_instances = object(extension(from, "EXT_mesh_gpu_instancing"), "attributes");
      const size_t accessors = file_.accessors.size();
      node.instance_translations = index(of_instances, "TRANSLATION", accessors);
      node.instance_rotations = index(of_instances, "ROTATION", accessors);
      node.instance_scales = index(of_instances, "SCALE", accessors);
      for (const json& child : list(from, "children")) {
        if (!child.is_number_unsigned() || child.get<uint64_t>() >= total)
          return fail(at_ + " has a child that there is not");
        node.children.push_back(child.get<size_t>());
      }
      file_.nodes.push_back(std::move(node));
    });
  }

  // ---- trees ---------------------------------------------------------------------------------

  /// Walks down from the roots, so that no node is met twice or beyond the limit of depth.
  void check_trees() {
    const auto& nodes = file_.nodes;
    std::vector<GltfIndex> parents(nodes.size());
    for (size_t i = 0; i < nodes.size(); ++i) {
      for (const size_t child : nodes[i].children) {
        if (parents[child])
          return fail(
              fmt::format("node {} is a child of node {} and again of node {}: the nodes "
                          "of a glTF form trees; export it anew",
                          child, *parents[child], i));
        parents[child] = i;
      }
    }
    std::vector<size_t> level;
    for (size_t i = 0; i < nodes.size(); ++i)
      if (!parents[i]) level.push_back(i);
    parentless_ = level;
    size_t met = level.size();
    for (int depth = 1; !level.empty(); ++depth) {
      if (depth > limits::gltf_node_depth)
        return fail(
            fmt::format("its nodes are more than {} deep: flatten the tree of objects "
                        "before exporting",
                        limits::gltf_node_depth));
      std::vector<size_t> below;
      for (const size_t node : level)
        below.insert(below.end(), nodes[node].children.begin(), nodes[node].children.end());
      met += below.size();
      level = std::move(below);
    }
    if (met < nodes.size()) fail("a node is its own ancestor: export it anew");
  }

  void read_scene() {
    at_ = "the file";
    const json& scenes = list(top_, "scenes");
    file_.scenes = scenes.size();
    if (scenes.empty()) {
      file_.roots = parentless_;
      return;
    }
    const size_t shown = index(top_, "scene", scenes.size()).value_or(0);
    at_ = fmt::format("scenes[{}]", shown);
    std::set<size_t> roots;
    for (const json& one : list(scenes[shown], "nodes")) {
      if (!one.is_number_unsigned() || one.get<uint64_t>() >= file_.nodes.size())
        return fail(at_ + " has a node that there is not");
      if (!std::binary_search(parentless_.begin(), parentless_.end(), one.get<size_t>()))
        return fail(at_ + " names a node that is a child of another");
      if (roots.insert(one.get<size_t>()).second) file_.roots.push_back(one.get<size_t>());
    }
  }

  GltfFile& file_;
  const json& top_;
  std::string at_ = "the file";  // the thing that is read
  std::optional<Problem> fault_;
  std::vector<size_t> parentless_;  // ascending
};

Result<GltfFile> GltfFile::read(const std::string& path) {
  GltfFile out;
  out.path_ = path;
  out.files.push_back(path);
  auto bytes = read_regular_file(path, limits::mesh_file_bytes);
  if (!bytes) return bytes.problem();
  out.text_ = std::move(bytes).value();
  const auto found = out.find_json();
  if (!found) return found.problem();
  const std::string_view text = found.value();
  if (nests_too_deep(text))
    return out.problem(
        fmt::format("its JSON is nested deeper than {}: export it anew, without "
                    "extras",
                    limits::gltf_nesting));
  const json top = json::parse(text.begin(), text.end(), nullptr, false);
  if (!top.is_object()) return out.problem("it is no glTF: its JSON is damaged");
  if (auto ok = GltfJson(out, top).read(); !ok) return ok.problem();
  return out;
}

}  // namespace luxodus
