// The part of a packed scene that every machine keeps: all that the description says but triangles,
// arrays of data sets and texels, and what compiling left of those. As bytes for a file, and back.
// Bytes are held to what a reader of scenes would have let pass (check_skeleton.hpp): lengths,
// words, places in lists, numbers in their ranges. Any thread.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "scenes/light/transport/packed_scene.hpp"

namespace luxodus {

struct Skeleton {
  SceneDescription description;  // without what is in objects; `packed` not set
  PackedScene packed;            // `file` not set
};

std::vector<std::byte> encode_skeleton(const SceneDescription& description,
                                       const PackedScene& packed);

/// Errors: bytes that no scene was written as.
Result<Skeleton> decode_skeleton(std::span<const std::byte> bytes);

}  // namespace luxodus
