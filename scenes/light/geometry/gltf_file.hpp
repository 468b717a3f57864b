// What a glTF 2.0 file says, as plain values: its JSON is checked against the format, references
// against the lists that they name. Buffers are read when they are first asked for. Internal to the
// import of meshes, and only used by a process of its own; one thread per object. Messages do not
// quote the text, because the file may be one that the reader of the message must not see; they do
// quote names.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/geometry/transform.hpp"

namespace luxodus {

using GltfIndex = std::optional<size_t>;  // into a list of the file

struct GltfBuffer {
  uint64_t bytes = 0;
  std::optional<std::string> uri;  // none: the binary part of a .glb
};
struct GltfView {
  size_t buffer = 0;
  uint64_t offset = 0, bytes = 0, stride = 0;  // stride 0: tightly packed
  bool compressed = false;                     // by EXT_meshopt_compression
};
struct GltfSparse {
  uint64_t count = 0;
  size_t indices = 0, values = 0;  // views
  uint64_t indices_offset = 0, values_offset = 0;
  int index_type = 0;
};
struct GltfAccessor {
  GltfIndex view;  // none: zeros
  uint64_t offset = 0, count = 0;
  int type = 0;     // 5120 to 5126
  int numbers = 0;  // of one element: 1 to 4
  bool normalized = false;
  std::optional<GltfSparse> sparse;
};
struct GltfPrimitive {
  int mode = 4;
  GltfIndex positions, texture_uv, indices, material;
  std::vector<GltfIndex> morphs;  // displacements of positions
  bool coloured = false;          // has colours of its vertices
  bool compressed = false;        // by KHR_draco_mesh_compression
};
struct GltfMesh {
  std::string name;
  std::vector<GltfPrimitive> primitives;
  std::vector<double> weights;
};
struct GltfNode {
  std::string name;
  GltfIndex mesh, lamp;
  std::vector<size_t> children;
  Transform place;
  std::vector<double> weights;
  GltfIndex instance_translations, instance_rotations, instance_scales;
  bool instanced = false, hidden = false, skinned = false;
};
struct GltfMaterial {
  std::string name;
  glm::dvec3 colour{1};
  bool colour_in_picture = false, emits = false, lets_pass = false;
};
struct GltfLamp {
  std::string name, type;
  double intensity = 1;  // [cd], of directional ones [lx]
  double inner_rad = 0, outer_rad = 0.78539816339744831;
  glm::dvec3 colour{1};
};

/// A place by translation, rotation (a quaternion x, y, z, w) and scale, applied in reverse order.
Transform gltf_placement(const glm::dvec3& translation, const glm::dvec4& rotation,
                         const glm::dvec3& scale);

class GltfFile {
 public:
  /// Reads a .gltf or .glb. Errors: no glTF 2.0, one that is cut short or nests too deep, an
  /// extension that it requires and that is not read, values of wrong kinds, references to what
  /// there is not, nodes that form no trees.
  static Result<GltfFile> read(const std::string& path);

  /// The elements of an accessor, as numbers of the format. Errors: not of `numbers` numbers,
  /// beyond its buffer, compressed, a buffer that cannot be read.
  Result<std::vector<double>> values(size_t accessor, int numbers);

  std::vector<GltfNode> nodes;
  std::vector<size_t> roots;  // of the scene that is shown
  std::vector<GltfMesh> meshes;
  std::vector<GltfAccessor> accessors;
  std::vector<GltfMaterial> materials;
  std::vector<GltfLamp> lamps;
  std::vector<std::string> files;  // that were opened
  size_t scenes = 0, animations = 0;

 private:
  friend class GltfJson;
  GltfFile() = default;

  Problem problem(std::string what) const { return problem_in(path_, std::move(what)); }
  /// The JSON of the text; of a .glb also where its binary part is.
  Result<std::string_view> find_json();
  Result<std::string_view> bytes_of(size_t buffer);
  Result<std::string> bytes_at(const std::string& uri);
  Result<std::string_view> span_of(size_t view, uint64_t offset, uint64_t step, uint64_t size,
                                   uint64_t count);

  std::string path_, text_;
  size_t binary_at_ = 0, binary_bytes_ = 0;  // binary part of a .glb, within text_
  std::vector<GltfBuffer> buffers_;
  std::vector<GltfView> views_;
  std::vector<std::optional<std::string>> read_;  // buffers that are not the binary part
};

}  // namespace luxodus
