// Assimp opens files only through a gate that knows our limits, and is asked for as little as
// possible (parse, validate, triangulate). All arithmetic on positions is ours, in double.
#include "scenes/light/geometry/assimp_import.hpp"

#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <cmath>
#include <filesystem>
#include <new>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "runtime/core/isolated_job.hpp"
#include "runtime/core/printable.hpp"
#include "scenes/light/geometry/mesh_text.hpp"

namespace luxodus {
namespace {

namespace fs = std::filesystem;

/// Lets Assimp open regular files within the limit and remembers which; a refusal is kept for the
/// message, because Assimp itself only says that it could not open the file.
class GuardedFiles : public Assimp::DefaultIOSystem {
 public:
  /// `obj`: the OBJ that is read, whose other files are MTL; "" for other kinds.
  explicit GuardedFiles(std::string obj) : obj_(std::move(obj)) {}

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    std::error_code error;
    const bool regular = fs::is_regular_file(file, error);
    const uint64_t bytes = regular ? fs::file_size(file, error) : 0;
    if (!regular || error) return nullptr;
    if (bytes > limits::mesh_file_bytes) {
      fault_ = problem_in(
          file, fmt::format("it has {} bytes, the most are {}", bytes, limits::mesh_file_bytes));
      return nullptr;
    }
    if (std::find(opened_.begin(), opened_.end(), file) == opened_.end()) {
      opened_.push_back(file);
      allow_more(import_limits(bytes));
    }
    if (!obj_.empty() && obj_ != file && !fault_)
      if (auto ok = check_mtl(file); !ok) fault_ = ok.problem();
    if (fault_) return nullptr;
    return Assimp::DefaultIOSystem::Open(file, mode);
  }

  const std::optional<Problem>& fault() const { return fault_; }
  const std::vector<std::string>& opened() const { return opened_; }

 private:
  std::string obj_;
  std::optional<Problem> fault_;
  std::vector<std::string> opened_;
};

/// Reports progress to the parent process: Assimp's work counts for about two thirds of the job;
/// reading an OBJ's bytes is the first half of that.
class ToldProgress : public Assimp::ProgressHandler {
 public:
  bool Update(float share) override {
    constexpr double of_all = 2.0 / 3;
    if (share >= 0) tell_share(of_all * static_cast<double>(share));
    return true;  // continue reading
  }
};

std::string text_of(const aiString& text) {
  return {text.data, text.length};
}

Transform transform_of(const aiMatrix4x4& m) {
  Transform out;
  out.linear = glm::dmat3(glm::dvec3(m.a1, m.b1, m.c1), glm::dvec3(m.a2, m.b2, m.c2),
                          glm::dvec3(m.a3, m.b3, m.c3));
  out.offset = {m.a4, m.b4, m.c4};
  return out;
}

/// Step between neighbouring floats at a coordinate.
double float_step(double coordinate) {
  const auto magnitude = static_cast<float>(std::abs(coordinate));
  return static_cast<double>(std::nextafter(magnitude, INFINITY)) - static_cast<double>(magnitude);
}

/// Walks the tree of nodes and copies what it places.
class Collector {
 public:
  /// `obj`: what an OBJ and its libraries say about its materials; null for other formats.
  Collector(const aiScene& scene, const std::string& path, double metres_per_unit, UpAxis up,
            const ObjMaterials* obj)
      : scene_(scene),
        path_(path),
        obj_(obj),
        to_scene_(to_z_up(up) * scaling(glm::dvec3(metres_per_unit))),
        metres_per_unit_(metres_per_unit) {}

  Result<std::vector<ImportedPart>> collect() {
    if (scene_.mRootNode == nullptr) return problem("the file holds no objects");
    std::vector<std::pair<const aiNode*, Transform>> open = {{scene_.mRootNode, to_scene_}};
    while (!open.empty()) {
      const auto [node, above] = open.back();
      open.pop_back();
      const Transform here = above * transform_of(node->mTransformation);
      for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        if (auto ok = add_part(*node, node->mMeshes[i], here); !ok) return ok.problem();
      }
      // Reversed, so that the stack gives children in the file's order.
      for (unsigned i = node->mNumChildren; i-- > 0;) open.push_back({node->mChildren[i], here});
    }
    if (parts_.empty() && homeless_degenerates_ > 0) {
      return problem(
          fmt::format("all {} triangles are degenerate: none has an area", homeless_degenerates_));
    }
    if (parts_.empty()) {
      return problem("the file holds no triangles: points, lines and empty objects are not read");
    }
    parts_.front().degenerate_triangles += homeless_degenerates_;
    return std::move(parts_);
  }

 private:
  Problem problem(std::string what) const { return problem_in(path_, std::move(what)); }

  std::string part_name(const aiNode& node, const aiMesh& mesh) const {
    std::string name = text_of(node.mName);
    const std::string mesh_name = text_of(mesh.mName);
    if (name.empty()) name = mesh_name;
    if (node.mNumMeshes > 1 && !mesh_name.empty() && mesh_name != name) name += "/" + mesh_name;
    return name.empty() ? "part" : name;
  }

  std::string unique_name(const std::string& wish) {
    std::string name = wish;
    while (times_used_.contains(name)) name = fmt::format("{}#{}", wish, ++times_used_[wish]);
    times_used_[name] = 1;
    return name;
  }

  Result<void> add_part(const aiNode& node, unsigned index, const Transform& place) {
    const aiMesh& from = *scene_.mMeshes[index];
    vertices_ += from.mNumVertices;
    triangles_ += from.mNumFaces;
    if (vertices_ > limits::mesh_vertices || triangles_ > limits::mesh_triangles ||
        parts_.size() >= limits::mesh_parts) {
      return problem(
          fmt::format("more than {} vertices, {} triangles or {} parts: simplify or split the file",
                      limits::mesh_vertices, limits::mesh_triangles, limits::mesh_parts));
    }
    ImportedPart part;
    part.name = part_name(node, from);
    if (!place.usable()) {
      return problem(
          fmt::format("part \"{}\": its node is scaled by 0 or not finite", excerpt(part.name)));
    }
    if (auto ok = copy_triangles(from, part); !ok) return ok.problem();
    if (part.mesh.triangles.empty()) return {};
    apply(place, part.mesh);
    // Finite numbers in the file may overflow when they are transformed.
    if (auto ok = check_positions(part); !ok) return ok.problem();
    join_identical_vertices(part.mesh);
    part.degenerate_triangles = clean_mesh(part.mesh);
    if (part.mesh.triangles.empty()) {
      homeless_degenerates_ += part.degenerate_triangles;
      return {};
    }
    if (auto ok = copy_material(from.mMaterialIndex, part); !ok) return ok.problem();
    part.name = unique_name(part.name);
    parts_.push_back(std::move(part));
    return {};
  }

  Result<void> copy_triangles(const aiMesh& from, ImportedPart& part) const {
    Mesh& mesh = part.mesh;
    mesh.positions.reserve(from.mNumVertices);
    for (unsigned i = 0; i < from.mNumVertices; ++i) {
      const aiVector3D& p = from.mVertices[i];
      mesh.positions.push_back({p.x, p.y, p.z});
    }
    if (auto ok = check_positions(part); !ok) return ok.problem();
    if (auto ok = check_precision(part); !ok) return ok.problem();
    if (from.HasTextureCoords(0)) {
      for (unsigned i = 0; i < from.mNumVertices; ++i) {
        const aiVector3D& uv = from.mTextureCoords[0][i];
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
          return problem(
              fmt::format("part \"{}\": the texture coordinate of vertex {} is not a finite number",
                          excerpt(part.name), i + 1));
        }
        mesh.texture_uv.push_back({uv.x, uv.y});
      }
    }
    mesh.triangles.reserve(from.mNumFaces);
    for (unsigned i = 0; i < from.mNumFaces; ++i) {
      const aiFace& face = from.mFaces[i];
      if (face.mNumIndices != 3) continue;  // points and lines
      const glm::uvec3 t(face.mIndices[0], face.mIndices[1], face.mIndices[2]);
      if (std::max({t.x, t.y, t.z}) >= from.mNumVertices) {
        return problem(fmt::format("part \"{}\": triangle {} names a vertex that does not exist",
                                   excerpt(part.name), i + 1));
      }
      mesh.triangles.push_back(t);
    }
    return {};
  }

  Result<void> check_positions(const ImportedPart& part) const {
    for (size_t i = 0; i < part.mesh.positions.size(); ++i) {
      if (is_finite(part.mesh.positions[i])) continue;
      return problem(fmt::format("part \"{}\": the position of vertex {} is not a finite number",
                                 excerpt(part.name), i + 1));
    }
    return {};
  }

  Result<void> check_precision(const ImportedPart& part) const {
    for (const glm::dvec3& p : part.mesh.positions) {
      const double farthest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      const double step_m = float_step(farthest) * metres_per_unit_;
      if (step_m <= limits::mesh_coordinate_step_m) continue;
      return problem(fmt::format(
          "part \"{}\": a coordinate of {:g} is known to {:.3g} m only; export the model "
          "about an origin of its own and move it in the scene",
          excerpt(part.name), farthest, step_m));
    }
    return {};
  }

  /// Whether the file gives the colour of a material. Where it is in a picture, its base colour
  /// alone would be another one.
  Result<void> has_colour(const aiMaterial& material, const std::string& name) const {
    if (obj_ != nullptr) return obj_->has_colour(name);
    if (material.GetTextureCount(aiTextureType_BASE_COLOR) == 0 &&
        material.GetTextureCount(aiTextureType_DIFFUSE) == 0)
      return {};
    return problem("the colour of the material '" + excerpt(name) +
                   "' is in a picture (\"baseColorTexture\" or \"diffuseTexture\"), and pictures "
                   "are not read");
  }

  Result<void> copy_material(unsigned index, ImportedPart& part) const {
    if (index >= scene_.mNumMaterials) return {};
    const aiMaterial& material = *scene_.mMaterials[index];
    aiString name;
    if (material.Get(AI_MATKEY_NAME, name) == AI_SUCCESS) part.material_name = text_of(name);
    // The name that Assimp invents if the file has no material.
    if (part.material_name == AI_DEFAULT_MATERIAL_NAME) {
      part.material_name.clear();
      return {};
    }
    if (auto ok = has_colour(material, part.material_name); !ok) {
      part.no_colour = ok.problem();
      return {};
    }
    aiColor4D colour;
    if (material.Get(AI_MATKEY_BASE_COLOR, colour) != AI_SUCCESS &&
        material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) != AI_SUCCESS) {
      return {};
    }
    for (const float c : {colour.r, colour.g, colour.b}) {
      if (c >= 0 && c <= 1) continue;  // NaN fails
      return problem(
          fmt::format("material \"{}\": a component of its base colour is {}: give 0 to 1",
                      excerpt(part.material_name), c));
    }
    part.base_colour = glm::dvec3(colour.r, colour.g, colour.b);
    return {};
  }

  const aiScene& scene_;
  const std::string& path_;
  const ObjMaterials* obj_;
  Transform to_scene_;
  double metres_per_unit_;
  uint64_t vertices_ = 0, triangles_ = 0;
  int64_t homeless_degenerates_ = 0;
  std::unordered_map<std::string, int> times_used_;
  std::vector<ImportedPart> parts_;
};

}  // namespace

Result<std::vector<ImportedPart>> import_by_assimp(const std::string& path, double metres_per_unit,
                                                   UpAxis up,
                                                   std::vector<std::string>& files_read) {
  const bool is_obj = mesh_ending(path) == ".obj";
  ObjMaterials materials(path);
  if (auto ok = is_obj ? check_obj(path, materials) : check_gltf(path); !ok) return ok.problem();
  Assimp::Importer importer;
  auto* files = new GuardedFiles(is_obj ? path : "");  // the importer owns it from here
  importer.SetIOHandler(files);
  importer.SetProgressHandler(new ToldProgress);  // also owned by the importer
  // Normals would keep vertices of equal position apart; the other components are not read.
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                  aiComponent_COLORS | aiComponent_BONEWEIGHTS |
                                  aiComponent_ANIMATIONS | aiComponent_LIGHTS |
                                  aiComponent_CAMERAS);
  const aiScene* scene = importer.ReadFile(
      path, aiProcess_Triangulate | aiProcess_RemoveComponent | aiProcess_ValidateDataStructure);
  files_read = files->opened();
  if (files->fault()) return *files->fault();
  if (scene == nullptr) {
    const std::string why = importer.GetErrorString();
    if (why.find("bad_alloc") != std::string::npos) throw std::bad_alloc();  // Assimp kept the text
    return problem_in(path, "cannot be read: " + excerpt(why, 200));
  }
  for (const std::string& file : files_read)
    if (is_obj && file != path) materials.add_library(file);
  return Collector(*scene, path, metres_per_unit, up, is_obj ? &materials : nullptr).collect();
}

}  // namespace luxodus
