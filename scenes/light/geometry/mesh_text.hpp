// What the texts of meshes must not say, found before Assimp sees them: it would pass over it
// silently, or crash. Internal to the reading of meshes. Texts are not quoted in messages: they may
// be of files that the reader of a message must not see. Names are, of what was read as a mesh. Any
// thread.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

/// The ending of a file's name in small letters: ".obj".
std::string mesh_ending(const std::string& path);

/// What an OBJ and its material libraries (MTL) say of materials. For a material without a colour
/// Assimp would give a grey of its own.
class ObjMaterials {
 public:
  explicit ObjMaterials(std::string obj) : obj_(std::move(obj)) {}

  /// A line of the OBJ, after its first word: "mtllib", "usemtl".
  void names_library(std::string_view rest);
  void uses(std::string_view rest, int line);
  /// Reads an MTL that is there.
  void add_library(const std::string& path);
  /// Whether they give the colour of this material. Errors: why they do not, and where.
  Result<void> has_colour(const std::string& material) const;

 private:
  struct Declared {
    SourcePlace place;
    bool has_colour = false;
    bool has_picture = false;  // of its colour
  };

  std::string obj_;
  std::vector<std::string> libraries_;    // as named
  std::vector<std::string> read_;         // files
  std::map<std::string, int> first_use_;  // lines of the OBJ
  std::map<std::string, Declared> declared_;
};

/// An OBJ: a coordinate that is a word, or not finite, in a vertex or texture vertex (Assimp passes
/// over such a line, and every face after it would mean other vertices than the file does, or takes
/// 0 for it); more objects and groups than limits::obj_groups. `materials` gets what it says of
/// them.
Result<void> check_obj(const std::string& path, ObjMaterials& materials);

/// An MTL: anything before the first `newmtl`, where Assimp writes to a material that there is not.
Result<void> check_mtl(const std::string& path);

/// A glTF, text or binary: no JSON, JSON nested too deep, nodes that form no tree or one too deep.
/// Assimp follows both by recursion, and copies a node each time that it is named.
Result<void> check_gltf(const std::string& path);

}  // namespace luxodus
