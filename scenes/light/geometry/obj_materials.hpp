// Finds faults in the text of mesh files that Assimp would silently skip or crash on, before Assimp
// reads them. Internal to the import of meshes. Messages do not quote the text, because the file
// may be one that the reader of the message must not see; they do quote names read from a mesh. No
// shared state; any thread.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

/// The extension of a file name in lower case: ".obj".
std::string mesh_ending(const std::string& path);

/// Facts about materials from an OBJ and its material libraries (MTL). For a material without a
/// colour Assimp would make up a grey.
class ObjMaterials {
 public:
  explicit ObjMaterials(std::string obj) : obj_(std::move(obj)) {}

  /// A line of the OBJ, after its first word: "mtllib", "usemtl".
  void names_library(std::string_view rest);
  void uses(std::string_view rest, int line);
  /// Reads an existing MTL file.
  void add_library(const std::string& path);
  /// Whether they give the colour of this material. Errors: why they do not, and where.
  Result<void> has_colour(const std::string& material) const;

 private:
  struct Declared {
    SourcePlace place;
    bool has_colour = false;
    bool has_picture = false;  // a texture for its colour
  };

  std::string obj_;
  std::vector<std::string> libraries_;    // as named
  std::vector<std::string> read_;         // files
  std::map<std::string, int> first_use_;  // lines of the OBJ
  std::map<std::string, Declared> declared_;
};

/// Checks an OBJ. Faults: a coordinate of a vertex or texture vertex that is a word or not finite
/// (Assimp skips such a line, which shifts the indices of all later faces, or reads 0); more
/// objects and groups than limits::obj_groups. `materials` gets what the file says about materials.
Result<void> check_obj(const std::string& path, ObjMaterials& materials);

/// Checks an MTL. Fault: anything before the first `newmtl`, which makes Assimp write to a material
/// that does not exist.
Result<void> check_mtl(const std::string& path);

/// Checks a glTF, text or binary. Faults: no JSON, JSON nested too deep, nodes that form no tree or
/// too deep a tree. Assimp processes both recursively, and copies a node each time it is
/// referenced.
Result<void> check_gltf(const std::string& path);

}  // namespace luxodus
