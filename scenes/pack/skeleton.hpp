// The part of a packed scene that every machine keeps: all that the description says but the
// triangles, and what compiling left of those. As bytes for a file, and back. Bytes are held to
// what can be held cheaply (lengths, words, places in lists); whether values make sense is found
// when the scene is compiled. Any thread.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "scenes/transport/packed_geometry.hpp"

namespace luxodus {

struct Skeleton {
  SceneDescription description;  // objects without triangles; `packed` not set
  PackedGeometry geometry;       // `file` not set
};

std::vector<std::byte> encode_skeleton(const SceneDescription& description,
                                       const PackedGeometry& geometry);

/// Errors: bytes that no scene was written as.
Result<Skeleton> decode_skeleton(std::span<const std::byte> bytes);

}  // namespace luxodus
