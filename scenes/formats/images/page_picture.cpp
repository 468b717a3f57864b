#include "scenes/formats/images/page_picture.hpp"

#include "runtime/core/regular_file.hpp"
#include "scenes/formats/images/image_file.hpp"
#include "scenes/formats/images/write_image.hpp"
#include "scenes/light/optics/chromaticity.hpp"

namespace luxodus {

namespace {

PngImage on_white(const Image& image) {
  PngImage out;
  out.width = image.width;
  out.height = image.height;
  const auto channels = static_cast<size_t>(image.channels);
  const size_t pixels = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
  out.rgb.reserve(3 * pixels);
  for (size_t i = 0; i < pixels; ++i) {
    const float* texel = &image.texels[i * channels];
    const double alpha = channels == 4 ? static_cast<double>(texel[3]) : 1;
    for (size_t c = 0; c < 3; ++c)
      out.rgb.push_back(
          srgb_byte(alpha * static_cast<double>(texel[channels == 1 ? 0 : c]) + (1 - alpha)));
  }
  return out;
}

}  // namespace

Result<PagePicture> read_page_picture(const std::filesystem::path& path, const std::string& what,
                                      uint64_t max_bytes, int max_side) {
  const SourcePlace place{path.string(), 0};
  const auto size = size_of_regular_file(path);
  if (!size) return size.problem();
  if (size.value() > max_bytes)
    return problem_in(
        place, what + " has at most " + std::to_string(max_bytes >> 20) + " MiB; make it smaller");
  const auto image = read_png(path.string());
  if (!image)
    return problem_in(image.problem().where,
                      image.problem().what + "; " + what + " is a PNG picture: convert it to one");
  if (image->width > max_side || image->height > max_side)
    return problem_in(place, what + " has at most " + std::to_string(max_side) +
                                 " pixels a side; make it smaller");
  const auto png = encode_png(on_white(image.value()), place);
  if (!png) return png.problem();
  return PagePicture{
      {reinterpret_cast<const char*>(png->data()), png->size()}, image->width, image->height};
}

Result<PagePicture> read_backdrop_picture(const std::filesystem::path& path) {
  return read_page_picture(path, "a floor plan", limits::backdrop_bytes, limits::backdrop_side);
}

}  // namespace luxodus
