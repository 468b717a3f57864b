// libpng reports errors by longjmp: everything that owns memory lives in a state outside the
// functions that jump, which have only plain locals.
#include "scenes/formats/images/image_file.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <filesystem>
#include <vector>

#include "runtime/core/regular_file.hpp"

namespace luxodus {
namespace {

/// Deflate expands at most 1032-fold (a match of 258 bytes from two bits); beyond this a file
/// declares pixels that it cannot contain.
constexpr uint64_t largest_expansion = 1040;

struct DecodeState {
  std::vector<unsigned char> file;
  size_t at = 0;
  char message[200] = "";
  uint32_t width = 0, height = 0;
  int channels = 0;
  int bytes_per_sample = 0;
  double gamma = 0;  // of the gAMA chunk; 0: sRGB
  std::vector<unsigned char> pixels;
  std::vector<unsigned char*> rows;
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) noexcept {
  auto* state = static_cast<DecodeState*>(png_get_error_ptr(png));
  std::strncpy(state->message, message, sizeof state->message - 1);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) noexcept {}

void on_read(png_structp png, png_bytep to, size_t count) noexcept {
  auto* state = static_cast<DecodeState*>(png_get_io_ptr(png));
  if (count > state->file.size() - state->at) png_error(png, "the file is cut short");
  std::memcpy(to, state->file.data() + state->at, count);
  state->at += count;
}

/// Reads the header and requests plain samples. Returns false with a message.
bool begin(png_structp png, png_infop info, DecodeState& state) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_read_fn(png, &state, on_read);
  png_set_user_limits(png, limits::image_side, limits::image_side);
  png_read_info(png, info);
  state.width = png_get_image_width(png, info);
  state.height = png_get_image_height(png, info);
  const uint64_t raw_bytes = static_cast<uint64_t>(png_get_rowbytes(png, info)) * state.height;
  if (static_cast<uint64_t>(state.width) * state.height > limits::image_pixels) {
    png_error(png, "more than 64 megapixels");
  }
  if (raw_bytes > largest_expansion * state.file.size()) png_error(png, "the file is cut short");
  double gamma = 0;
  const bool says_gamma = png_get_gAMA(png, info, &gamma) != 0;
  const bool says_srgb = png_get_valid(png, info, PNG_INFO_sRGB) != 0;
  // Writers that lack the sRGB chunk state 1/2.2 for it.
  if (says_gamma && !says_srgb && std::abs(gamma * 2.2 - 1) > 0.05) state.gamma = gamma;
  png_set_expand(png);  // palettes to RGB, small samples to 8 bits, transparent colours to alpha
  const int colour = png_get_color_type(png, info);
  const bool alpha =
      (colour & PNG_COLOR_MASK_ALPHA) != 0 || png_get_valid(png, info, PNG_INFO_tRNS) != 0;
  if (alpha) png_set_gray_to_rgb(png);  // an Image has 1, 3 or 4 channels
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  state.channels = png_get_channels(png, info);
  state.bytes_per_sample = png_get_bit_depth(png, info) == 16 ? 2 : 1;
  return true;
}

/// Requires: rows for the whole picture.
bool decode(png_structp png, DecodeState& state) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_read_image(png, state.rows.data());
  png_read_end(png, nullptr);
  return true;
}

void make_rows(DecodeState& state) {
  const size_t row_bytes = static_cast<size_t>(state.width) * static_cast<size_t>(state.channels) *
                           static_cast<size_t>(state.bytes_per_sample);
  state.pixels.resize(row_bytes * state.height);
  for (uint32_t y = 0; y < state.height; ++y)
    state.rows.push_back(state.pixels.data() + y * row_bytes);
}

Result<void> load(const std::string& path, DecodeState& state) {
  if (const auto size = size_of_regular_file(path); !size) return size.problem();
  auto bytes = read_regular_file(path, limits::image_file_bytes);
  if (!bytes) return bytes.problem();
  state.file.assign(bytes->begin(), bytes->end());
  if (state.file.size() < 8 || png_sig_cmp(state.file.data(), 0, 8) != 0)
    return problem_in(path, "this is not a PNG file");
  return {};
}

/// Linear value of every sample of one or two bytes.
std::vector<float> linear_table(const DecodeState& state) {
  std::vector<float> table(state.bytes_per_sample == 2 ? 65536 : 256);
  const auto most = static_cast<double>(table.size() - 1);
  for (size_t i = 0; i < table.size(); ++i) {
    const double v = static_cast<double>(i) / most;
    table[i] =
        static_cast<float>(state.gamma > 0 ? std::pow(v, 1 / state.gamma) : linear_from_srgb(v));
  }
  return table;
}

Image linear_image(const DecodeState& state) {
  Image image;
  image.width = static_cast<int>(state.width);
  image.height = static_cast<int>(state.height);
  image.channels = state.channels;
  const std::vector<float> table = linear_table(state);
  const bool wide = state.bytes_per_sample == 2;
  const size_t samples = state.pixels.size() / (wide ? 2 : 1);
  const auto channels = static_cast<size_t>(state.channels);
  image.texels.resize(samples);
  for (size_t i = 0; i < samples; ++i) {
    // PNG writes the high byte first.
    const size_t v = wide ? static_cast<size_t>(state.pixels[2 * i]) << 8 | state.pixels[2 * i + 1]
                          : state.pixels[i];
    const bool alpha = channels == 4 && i % 4 == 3;
    image.texels[i] =
        alpha ? static_cast<float>(v) / static_cast<float>(table.size() - 1) : table[v];
  }
  return image;
}

}  // namespace

double linear_from_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

Result<Image> read_png(const std::string& path) {
  DecodeState state;
  Result<void> loaded = load(path, state);
  if (!loaded) return loaded.problem();
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &state, on_error, on_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  bool good = info != nullptr && begin(png, info, state);
  if (good) {
    make_rows(state);
    good = decode(png, state);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  if (!good) return problem_in(path, fmt::format("the PNG cannot be read: {}", state.message));
  return linear_image(state);
}

}  // namespace luxodus
