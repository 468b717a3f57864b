#include "actors/results/formats/write_glb.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <map>

#include "runtime/core/atomic_file.hpp"

namespace luxodus {

namespace {

static_assert(std::endian::native == std::endian::little, "GLB files are little-endian");

// Constants of glTF 2.0.
constexpr int component_float = 5126, component_uint = 5125;
constexpr int target_vertices = 34962, target_indices = 34963;
constexpr uint32_t glb_magic = 0x46546C67, glb_version = 2;
constexpr uint32_t chunk_json = 0x4E4F534A, chunk_binary = 0x004E4942;

Result<void> check_mesh(const GlbMesh& mesh) {
  const auto finite = [](const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  if (!mesh.colours.empty() && mesh.points.size() != mesh.colours.size())
    return problem("points and colours differ in number", ProblemKind::bug);
  if (mesh.triangles.empty() || mesh.triangles.size() % 3 != 0)
    return problem("it has no whole triangles", ProblemKind::bug);
  for (const uint32_t index : mesh.triangles)
    if (index >= mesh.points.size())
      return problem("a triangle has a corner that there is not", ProblemKind::bug);
  for (size_t i = 0; i < mesh.points.size(); ++i)
    if (!finite(mesh.points[i]) || (!mesh.colours.empty() && !finite(mesh.colours[i])))
      return problem("a number is not finite", ProblemKind::bug);
  return {};
}

Json numbers(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

/// From z up to y up, exactly.
template <class Vector>
Vector y_up(const Vector& v) {
  return {v.x, v.z, -v.y};
}

/// Rotates local -Z to `direction`, and local +Y as close to `up` as possible.
Json rotation_to(const glm::dvec3& direction, glm::dvec3 up) {
  const glm::dvec3 z = -glm::normalize(direction);
  if (std::abs(glm::dot(z, glm::normalize(up))) > 0.999) up = glm::dvec3(0, 1, 0);
  if (std::abs(glm::dot(z, glm::normalize(up))) > 0.999) up = glm::dvec3(1, 0, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(up, z));
  const glm::dquat q = glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z));
  return {q.x, q.y, q.z, q.w};
}

/// Collects the parts of the file.
class GlbWriter {
 public:
  Result<std::string> write(const GlbScene& scene) {
    for (const GlbMesh& mesh : scene.meshes) {
      if (auto ok = check_mesh(mesh); !ok)
        return problem("mesh \"" + mesh.name + "\": " + ok.problem().what, ok.problem().kind);
      add(mesh);
    }
    if (scene.meshes.empty()) return problem("there is nothing to write: no triangles");
    for (const GlbLight& light : scene.lights) add(light);
    for (const GlbCamera& camera : scene.cameras) add(camera);
    const std::string head = json_of(scene).dump();
    return file_of(head);
  }

 private:
  int view_of(const void* data, size_t bytes, int target) {
    views_.push_back({{"buffer", 0},
                      {"byteOffset", static_cast<int64_t>(binary_.size())},
                      {"byteLength", static_cast<int64_t>(bytes)},
                      {"target", target}});
    binary_.append(static_cast<const char*>(data), bytes);  // all values are of four bytes
    return static_cast<int>(views_.size()) - 1;
  }

  int accessor(int view, int component, size_t count, const char* type) {
    accessors_.push_back({{"bufferView", view},
                          {"componentType", component},
                          {"count", static_cast<int64_t>(count)},
                          {"type", type}});
    return static_cast<int>(accessors_.size()) - 1;
  }

  void add(const GlbMesh& mesh) {
    const auto vertices = [&](const std::vector<glm::vec3>& values) {
      const int view = view_of(values.data(), values.size() * sizeof(glm::vec3), target_vertices);
      return accessor(view, component_float, values.size(), "VEC3");
    };
    std::vector<glm::vec3> turned;
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (const glm::vec3& p : mesh.points) {
      turned.push_back(y_up(p));
      low = glm::min(low, turned.back());
      high = glm::max(high, turned.back());
    }
    const int points = vertices(turned);
    accessors_[static_cast<size_t>(points)]["min"] = numbers(low);
    accessors_[static_cast<size_t>(points)]["max"] = numbers(high);
    Json attributes = {{"POSITION", points}};
    if (!mesh.colours.empty()) attributes["COLOR_0"] = vertices(mesh.colours);
    const int view =
        view_of(mesh.triangles.data(), mesh.triangles.size() * sizeof(uint32_t), target_indices);
    const int triangles = accessor(view, component_uint, mesh.triangles.size(), "SCALAR");
    Json primitives = Json::array();
    primitives.push_back({{"attributes", std::move(attributes)},
                          {"indices", triangles},
                          {"material", material_of(mesh)}});
    add_node({{"name", mesh.name}, {"mesh", static_cast<int64_t>(meshes_.size())}});
    meshes_.push_back({{"name", mesh.name}, {"primitives", std::move(primitives)}});
  }

  int64_t material_of(const GlbMesh& mesh) {
    const auto [at, is_new] =
        material_numbers_.try_emplace(mesh.material, static_cast<int64_t>(materials_.size()));
    if (!is_new) return at->second;
    Json one = {{"name", mesh.material}};
    if (!mesh.colours.empty()) {
      one["pbrMetallicRoughness"] = {{"metallicFactor", 0.0}, {"roughnessFactor", 1.0}};
      one["extensions"] = {{"KHR_materials_unlit", Json::object()}};
      unlit_ = true;
    }
    materials_.push_back(std::move(one));
    return at->second;
  }

  void add(const GlbLight& light) {
    Json one = {{"name", light.name},
                {"type", light.outer_rad > 0 ? "spot" : "point"},
                {"color", {light.colour[0], light.colour[1], light.colour[2]}},
                {"intensity", light.intensity_cd}};
    if (light.outer_rad > 0)
      one["spot"] = {{"innerConeAngle", light.inner_rad}, {"outerConeAngle", light.outer_rad}};
    if (!light.extras.is_null()) one["extras"] = light.extras;
    Json node = {{"name", light.name}, {"translation", numbers(y_up(light.position))}};
    if (light.outer_rad > 0) node["rotation"] = rotation_to(y_up(light.direction), {0, 0, -1});
    node["extensions"] = {
        {"KHR_lights_punctual", {{"light", static_cast<int64_t>(lights_.size())}}}};
    add_node(std::move(node));
    lights_.push_back(std::move(one));
  }

  void add(const GlbCamera& camera) {
    constexpr double nearest_m = 0.05;
    add_node({{"name", camera.name},
              {"translation", numbers(y_up(camera.eye))},
              {"rotation", rotation_to(y_up(camera.target - camera.eye), y_up(camera.up))},
              {"camera", static_cast<int64_t>(cameras_.size())}});
    cameras_.push_back({{"name", camera.name},
                        {"type", "perspective"},
                        {"perspective",
                         {{"yfov", camera.vertical_fov_rad},
                          {"aspectRatio", camera.aspect},
                          {"znear", nearest_m}}}});
  }

  void add_node(Json node) {
    children_.push_back(static_cast<int64_t>(nodes_.size()) + 1);  // children follow the root
    nodes_.push_back(std::move(node));
  }

  Json json_of(const GlbScene& scene) {
    Json nodes = Json::array();
    nodes.push_back({{"name", scene.title},
                     {"translation", numbers(y_up(scene.origin))},
                     {"children", std::move(children_)}});
    for (Json& node : nodes_) nodes.push_back(std::move(node));
    Json roots = Json::array();
    roots.push_back(0);
    Json scenes = Json::array();
    scenes.push_back({{"name", scene.title}, {"nodes", std::move(roots)}});
    Json buffers = Json::array();
    buffers.push_back({{"byteLength", static_cast<int64_t>(binary_.size())}});
    Json used = Json::array();
    if (unlit_) used.push_back("KHR_materials_unlit");
    if (!lights_.empty()) used.push_back("KHR_lights_punctual");
    Json out = {{"asset", {{"version", "2.0"}, {"generator", scene.generator}}}};
    if (!used.empty()) out["extensionsUsed"] = std::move(used);
    if (!scene.extras.is_null()) out["asset"]["extras"] = scene.extras;
    if (!lights_.empty())
      out["extensions"] = {{"KHR_lights_punctual", {{"lights", std::move(lights_)}}}};
    out["scene"] = 0;
    out["scenes"] = std::move(scenes);
    out["nodes"] = std::move(nodes);
    if (!cameras_.empty()) out["cameras"] = std::move(cameras_);
    out["meshes"] = std::move(meshes_);
    out["materials"] = std::move(materials_);
    out["accessors"] = std::move(accessors_);
    out["bufferViews"] = std::move(views_);
    out["buffers"] = std::move(buffers);
    return out;
  }

  /// Chunks are padded to four bytes: the text with blanks; the numbers are of four bytes.
  Result<std::string> file_of(std::string head) const {
    head.resize((head.size() + 3) / 4 * 4, ' ');
    const uint64_t all = 12 + 8 + head.size() + 8 + binary_.size();
    if (all > limits::glb_bytes)
      return problem(
          "the file would have more than 4 GiB, which GLB cannot: take a coarser "
          "patch_edge_m");
    std::string out;
    out.reserve(all);
    const auto word = [&](uint64_t value) {
      const auto four = static_cast<uint32_t>(value);
      out.append(reinterpret_cast<const char*>(&four), sizeof four);
    };
    word(glb_magic);
    word(glb_version);
    word(all);
    word(head.size());
    word(chunk_json);
    out += head;
    word(binary_.size());
    word(chunk_binary);
    out += binary_;
    return out;
  }

  Json nodes_ = Json::array(), children_ = Json::array(), meshes_ = Json::array(),
       materials_ = Json::array(), lights_ = Json::array(), cameras_ = Json::array(),
       accessors_ = Json::array(), views_ = Json::array();
  std::map<std::string, int64_t> material_numbers_;
  bool unlit_ = false;
  std::string binary_;
};

}  // namespace

Result<std::string> glb_bytes_of(const GlbScene& scene) {
  return GlbWriter().write(scene);
}

Result<void> write_glb(const std::filesystem::path& path, const GlbScene& scene) {
  const auto bytes = glb_bytes_of(scene);
  if (!bytes) return bytes.problem();
  return write_file_atomically(path, bytes.value());
}

}  // namespace luxodus
