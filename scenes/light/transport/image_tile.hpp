// A reflectance texture cut into tiles, the scene parts that machines exchange. Every machine keeps
// a texture's size, and reads texels through a resolver. As bytes, a tile is named by their hash;
// bytes come from other machines and are checked against the texture before use. Pure; any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

namespace limits {
/// Texels along one side of a tile, a power of two: 64 kB at most, the size of a brick of smoke.
inline constexpr int tile_side = 64;
}  // namespace limits

struct ImageTile {
  int width = 0;  // smaller at the picture's right and lower edges
  int height = 0;
  int channels = 0;
  std::vector<float> texels;  // as in Image

  /// Requires: (x, y) of the picture lies in this tile.
  const float* texel(int x, int y) const {
    constexpr int low = limits::tile_side - 1;
    return &texels[static_cast<size_t>(((y & low) * width + (x & low)) * channels)];
  }
};

/// Tiles of a picture, numbered by rows from the top.
inline uint32_t tile_columns(const Image& image) {
  return static_cast<uint32_t>((image.width + limits::tile_side - 1) / limits::tile_side);
}
inline uint32_t tile_rows(const Image& image) {
  return static_cast<uint32_t>((image.height + limits::tile_side - 1) / limits::tile_side);
}
inline uint32_t tile_of(const Image& image, int x, int y) {
  return static_cast<uint32_t>(y / limits::tile_side) * tile_columns(image) +
         static_cast<uint32_t>(x / limits::tile_side);
}

/// Requires: `image` has its texels.
ImageTile cut_tile(const Image& image, uint32_t tile);
/// Copies a tile's texels to their place. Requires: `image` has room for its texels.
void place_tile(const ImageTile& from, uint32_t tile, Image& image);

std::vector<std::byte> encode_tile(const ImageTile& tile);
/// `image` may be without texels. Errors: bytes of another length; texels outside [0, 1].
Result<ImageTile> decode_tile(std::span<const std::byte> bytes, const Image& image, uint32_t tile);

}  // namespace luxodus
