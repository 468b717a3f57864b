// What the texts of meshes must not say, found before Assimp sees them: it would pass over it
// silently, or crash. Internal to the reading of meshes. Texts are not quoted in messages: they may
// be of files that the reader of a message must not see. Any thread.
#pragma once

#include <optional>
#include <string>

#include "runtime/core/result.hpp"

namespace luxodus {

/// The ending of a file's name in small letters: ".obj".
std::string mesh_ending(const std::string& path);

/// An OBJ: a coordinate that is a word, or not finite, in a vertex or texture vertex (Assimp passes
/// over such a line, and every face after it would mean other vertices than the file does, or takes
/// 0 for it); more objects and groups than limits::obj_groups.
std::optional<Problem> fault_of_obj(const std::string& path);

/// An MTL: anything before the first `newmtl`, where Assimp writes to a material that there is not.
std::optional<Problem> fault_of_mtl(const std::string& path);

/// A glTF, text or binary: no JSON, JSON nested too deep, nodes that form no tree or one too deep.
/// Assimp follows both by recursion, and copies a node each time that it is named.
std::optional<Problem> fault_of_gltf(const std::string& path);

}  // namespace luxodus
