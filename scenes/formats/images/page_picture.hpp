// Pictures of others that pages embed, logos and floor plans: the pixels of a PNG file, encoded
// again. Nothing of the file itself reaches a page but its pixels, so that a hostile file brings
// nothing along: drawings (SVG) may hold scripts and names of other files, and are refused. Any
// thread.
#pragma once

#include <filesystem>
#include <string>

#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Of a floor plan [bytes, pixels]: it stands in every plan as text. 3000 pixels of 0.02 m are 60
/// m.
inline constexpr uint64_t backdrop_bytes = uint64_t{4} << 20;
inline constexpr int backdrop_side = 3000;
/// Of all drawings of a scene, as pages get them [bytes]: pages hold them in memory, and a third
/// more as text.
inline constexpr uint64_t backdrops_bytes = uint64_t{32} << 20;
/// Lines of a drawing that are shown, the longest; each takes so much at most [bytes].
inline constexpr size_t backdrop_lines = 20'000;
inline constexpr uint64_t backdrop_line_bytes = 100;
}  // namespace limits

struct PagePicture {
  std::string png;  // bytes of a new file: sRGB, on white where the picture is transparent
  int width = 0, height = 0;
};

/// `what`: "a logo", for messages.
/// Errors: a file that is missing, larger than these, damaged, or no PNG.
Result<PagePicture> read_page_picture(const std::filesystem::path& path, const std::string& what,
                                      uint64_t max_bytes, int max_side);

/// A floor plan. Errors: as read_page_picture.
Result<PagePicture> read_backdrop_picture(const std::filesystem::path& path);

}  // namespace luxodus
