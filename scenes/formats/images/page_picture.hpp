// Pictures from outside that pages embed, logos and floor plans: the pixels of a PNG file, encoded
// again. Only its pixels reach a page, so that a hostile file carries nothing else along. Drawings
// (SVG) may hold scripts and names of other files, and are rejected. Plain values; any thread.
#pragma once

#include <filesystem>
#include <string>

#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Limits on a floor plan [bytes, pixels]: every plan embeds it as text. 3000 pixels of 0.02 m are
/// 60 m.
inline constexpr uint64_t backdrop_bytes = uint64_t{4} << 20;
inline constexpr int backdrop_side = 3000;
/// All drawings of a scene together, as embedded [bytes]: pages hold them in memory, and a third
/// more as text.
inline constexpr uint64_t backdrops_bytes = uint64_t{32} << 20;
/// Lines of a drawing that are shown, the longest first, and the memory of one [bytes].
inline constexpr size_t backdrop_lines = 20'000;
inline constexpr uint64_t backdrop_line_bytes = 100;
}  // namespace limits

struct PagePicture {
  std::string png;  // bytes of a new file: sRGB, on white where the picture is transparent
  int width = 0, height = 0;
};

/// `what` names it in messages: "a logo".
/// Errors: the file is missing, larger than these limits, damaged, or not a PNG.
Result<PagePicture> read_page_picture(const std::filesystem::path& path, const std::string& what,
                                      uint64_t max_bytes, int max_side);

/// Reads a floor plan. Errors: as read_page_picture.
Result<PagePicture> read_backdrop_picture(const std::filesystem::path& path);

}  // namespace luxodus
