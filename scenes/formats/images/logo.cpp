#include "scenes/formats/images/logo.hpp"

#include "scenes/formats/images/page_picture.hpp"

namespace luxodus {

Result<std::string> read_logo(const std::filesystem::path& path) {
  auto picture = read_page_picture(path, "a logo", limits::logo_bytes, limits::logo_side);
  if (!picture) return picture.problem();
  return std::move(picture->png);
}

}  // namespace luxodus
