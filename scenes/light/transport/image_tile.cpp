#include "scenes/light/transport/image_tile.hpp"

#include <algorithm>
#include <cstring>

namespace luxodus {

namespace {

constexpr uint64_t tile_magic = 0x31'6c69'7478'756c;  // "luxtil1"

struct TileHeader {
  uint64_t magic;
  uint32_t width, height;
  uint32_t channels, unused;
};
static_assert(sizeof(TileHeader) == 24);

/// A tile with its size but without texels.
ImageTile outline(const Image& image, uint32_t tile) {
  const auto column = static_cast<int>(tile % tile_columns(image));
  const auto row = static_cast<int>(tile / tile_columns(image));
  return {std::min(limits::tile_side, image.width - column * limits::tile_side),
          std::min(limits::tile_side, image.height - row * limits::tile_side),
          image.channels,
          {}};
}

/// Index of a tile's row among the picture's texels.
size_t row_begin(const Image& image, uint32_t tile, int row) {
  const size_t x = tile % tile_columns(image) * limits::tile_side;
  const size_t y = tile / tile_columns(image) * limits::tile_side + static_cast<size_t>(row);
  return (y * static_cast<size_t>(image.width) + x) * static_cast<size_t>(image.channels);
}

size_t row_floats(const ImageTile& tile) {
  return static_cast<size_t>(tile.width) * static_cast<size_t>(tile.channels);
}

}  // namespace

ImageTile cut_tile(const Image& image, uint32_t tile) {
  ImageTile out = outline(image, tile);
  for (int row = 0; row < out.height; ++row) {
    const float* from = &image.texels[row_begin(image, tile, row)];
    out.texels.insert(out.texels.end(), from, from + row_floats(out));
  }
  return out;
}

void place_tile(const ImageTile& from, uint32_t tile, Image& image) {
  for (int row = 0; row < from.height; ++row)
    std::copy_n(&from.texels[static_cast<size_t>(row) * row_floats(from)], row_floats(from),
                &image.texels[row_begin(image, tile, row)]);
}

std::vector<std::byte> encode_tile(const ImageTile& tile) {
  const TileHeader header{tile_magic, static_cast<uint32_t>(tile.width),
                          static_cast<uint32_t>(tile.height), static_cast<uint32_t>(tile.channels),
                          0};
  std::vector<std::byte> out(sizeof header + tile.texels.size() * sizeof(float));
  std::memcpy(out.data(), &header, sizeof header);
  std::memcpy(out.data() + sizeof header, tile.texels.data(), tile.texels.size() * sizeof(float));
  return out;
}

Result<ImageTile> decode_tile(std::span<const std::byte> bytes, const Image& image, uint32_t tile) {
  TileHeader header{};
  if (bytes.size() < sizeof header) return problem("a tile of a picture is cut short");
  std::memcpy(&header, bytes.data(), sizeof header);
  bytes = bytes.subspan(sizeof header);
  if (header.magic != tile_magic) return problem("these bytes are no tile of a picture");
  ImageTile out = outline(image, tile);
  const size_t texels = row_floats(out) * static_cast<size_t>(out.height);
  if (header.width != static_cast<uint32_t>(out.width) ||
      header.height != static_cast<uint32_t>(out.height) ||
      header.channels != static_cast<uint32_t>(out.channels) || header.unused != 0)
    return problem("a tile does not belong to this picture");
  if (bytes.size() != texels * sizeof(float))
    return problem("a tile of a picture has not the length that it says");
  out.texels.resize(texels);
  std::memcpy(out.texels.data(), bytes.data(), bytes.size());
  if (!std::all_of(out.texels.begin(), out.texels.end(), [](float v) { return v >= 0 && v <= 1; }))
    return problem("a tile of a picture has a texel outside 0 to 1");
  return out;
}

}  // namespace luxodus
