// Neither library touches the file system: they fill memory, and write_file_atomically writes it.
// OpenEXR reports errors by exceptions, libpng by longjmp; neither leaves this file.
#include "scenes/formats/images/write_image.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <stdexcept>

#include "runtime/core/output_text.hpp"

namespace luxodus {
namespace {

constexpr float half_largest = 65504.0f;
// OpenEXR stores names with a terminating zero, and rejects names longer than 255.
constexpr size_t max_exr_name_bytes = 255;
// Attributes that the library itself needs; a text may not replace them.
constexpr std::array<const char*, 16> exr_reserved = {
    "channels",   "compression", "dataWindow",        "displayWindow", "lineOrder",
    "name",       "type",        "pixelAspectRatio",  "version",       "screenWindowCenter",
    "chunkCount", "tiles",       "screenWindowWidth", "view",          "preview",
    "envmap"};

class MemoryOut : public Imf::OStream {
 public:
  MemoryOut() : Imf::OStream("memory") {}
  void write(const char data[], int n) override {
    const auto size = static_cast<size_t>(n);
    if (at_ + size > bytes_.size()) bytes_.resize(at_ + size);
    std::memcpy(bytes_.data() + at_, data, size);
    at_ += size;
  }
  uint64_t tellp() override { return at_; }
  void seekp(uint64_t position) override { at_ = static_cast<size_t>(position); }
  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
  size_t at_ = 0;
};

/// The number of pixels, or a message if the edges are out of range.
Result<uint64_t> pixel_count(int64_t width, int64_t height, const SourcePlace& place) {
  if (width < 1 || height < 1 || width > limits::max_image_edge ||
      height > limits::max_image_edge ||
      static_cast<uint64_t>(width * height) > limits::max_image_pixels) {
    return problem_in(place, "a picture of " + std::to_string(width) + " x " +
                                 std::to_string(height) +
                                 " pixels is not possible; edges are 1 to " +
                                 std::to_string(limits::max_image_edge) + " and at most " +
                                 std::to_string(limits::max_image_pixels) + " pixels in all");
  }
  return static_cast<uint64_t>(width * height);
}

Result<void> check_exr_name(const std::string& name, std::set<std::string>& names,
                            const SourcePlace& place) {
  if (name.empty() || name.size() > max_exr_name_bytes || name.find('\0') != std::string::npos) {
    return problem_in(place,
                      "'" + clean_utf8(name) + "' cannot name anything in an EXR picture; " +
                          "names have 1 to 255 bytes and no zero byte",
                      ProblemKind::bug);
  }
  if (!names.insert(name).second) {
    return problem_in(place, "'" + clean_utf8(name) + "' is there twice; names must differ",
                      ProblemKind::bug);
  }
  return {};
}

Result<void> check_exr(const ExrImage& image, const SourcePlace& place) {
  const Result<uint64_t> pixels = pixel_count(image.width, image.height, place);
  if (!pixels) return pixels.problem();
  if (image.channels.empty() || image.channels.size() > limits::max_exr_channels) {
    return problem_in(
        place, "a picture needs 1 to " + std::to_string(limits::max_exr_channels) + " channels",
        ProblemKind::bug);
  }
  std::set<std::string> channel_names;
  for (const ExrChannel& channel : image.channels) {
    if (auto good = check_exr_name(channel.name, channel_names, place); !good)
      return good.problem();
    const std::string name = "channel '" + clean_utf8(channel.name) + "'";
    if (channel.values.size() != pixels.value()) {
      return problem_in(place,
                        name + " has " + std::to_string(channel.values.size()) + " values for " +
                            std::to_string(pixels.value()) + " pixels",
                        ProblemKind::bug);
    }
    const auto beyond = [](float v) { return std::isfinite(v) && std::abs(v) > half_largest; };
    if (image.half && std::any_of(channel.values.begin(), channel.values.end(), beyond)) {
      return problem_in(
          place, name + " has a value beyond 65504, the largest half float; " + "write full floats",
          ProblemKind::bug);
    }
  }
  std::set<std::string> names = {"unit", "chromaticities", "whitePoint", "whiteLuminance"};
  names.insert(exr_reserved.begin(), exr_reserved.end());
  for (const auto& [key, text] : image.text) {
    if (auto good = check_exr_name(key, names, place); !good) return good.problem();
  }
  for (const auto& [key, number] : image.numbers) {
    if (auto good = check_exr_name(key, names, place); !good) return good.problem();
  }
  return {};
}

Imf::Header exr_header(const ExrImage& image) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  if (!image.unit.empty()) header.insert("unit", Imf::StringAttribute(clean_utf8(image.unit)));
  if (image.chromaticities) {
    const Chromaticities& c = *image.chromaticities;
    const auto v = [](const std::array<float, 2>& xy) { return Imath::V2f(xy[0], xy[1]); };
    Imf::addChromaticities(header, {v(c.red), v(c.green), v(c.blue), v(c.white)});
    header.insert("whitePoint", Imf::V2fAttribute(v(c.white)));
  }
  if (image.white_luminance_cd_m2) {
    Imf::addWhiteLuminance(header, *image.white_luminance_cd_m2);
  }
  for (const auto& [key, text] : image.text) {
    header.insert(key, Imf::StringAttribute(clean_utf8(text)));
  }
  for (const auto& [key, number] : image.numbers) {
    header.insert(key, Imf::DoubleAttribute(number));
  }
  return header;
}

Imf::Slice float_slice(float* values, size_t width) {
  return {Imf::FLOAT, reinterpret_cast<char*>(values), sizeof(float), sizeof(float) * width};
}

void write_exr_pixels(const ExrImage& image, Imf::Header& header, MemoryOut& out) {
  const auto width = static_cast<size_t>(image.width);
  const size_t pixels = width * static_cast<size_t>(image.height);
  Imf::FrameBuffer frame;
  std::vector<std::vector<half>> halves;
  halves.reserve(image.channels.size());
  for (const ExrChannel& channel : image.channels) {
    header.channels().insert(channel.name, Imf::Channel(image.half ? Imf::HALF : Imf::FLOAT));
    if (!image.half) {
      // The library's slices are not const; writing only reads them.
      frame.insert(channel.name, float_slice(const_cast<float*>(channel.values.data()), width));
      continue;
    }
    std::vector<half>& values = halves.emplace_back(pixels);
    std::copy(channel.values.begin(), channel.values.end(), values.begin());
    frame.insert(channel.name, Imf::Slice(Imf::HALF, reinterpret_cast<char*>(values.data()),
                                          sizeof(half), sizeof(half) * width));
  }
  Imf::OutputFile file(out, header, 0);
  file.setFrameBuffer(frame);
  file.writePixels(image.height);
}

// ---- PNG --------------------------------------------------------------------------------------

struct PngSink {
  std::vector<std::byte> bytes;
  std::string error;
  bool out_of_memory = false;
};

extern "C" {
static void png_take(png_structp png, png_bytep data, png_size_t size) noexcept {
  auto* sink = static_cast<PngSink*>(png_get_io_ptr(png));
  try {
    const auto* first = reinterpret_cast<const std::byte*>(data);
    sink->bytes.insert(sink->bytes.end(), first, first + size);
  } catch (...) {
    sink->out_of_memory = true;
  }
}

static void png_flush_nothing(png_structp) noexcept {}

static void png_fail(png_structp png, png_const_charp message) {
  static_cast<PngSink*>(png_get_error_ptr(png))->error = message;
  png_longjmp(png, 1);
}

static void png_warn_nothing(png_structp, png_const_charp) noexcept {}
}

/// The part of libpng that may jump. Holds no object with a destructor, because longjmp skips them.
bool png_write(png_structp png, png_infop info, PngSink& sink, const PngImage& image,
               png_textp texts, int text_count) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_write_fn(png, &sink, png_take, png_flush_nothing);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width),
               static_cast<png_uint_32>(image.height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  if (text_count > 0) png_set_text(png, info, texts, text_count);
  png_write_info(png, info);
  const size_t row_bytes = static_cast<size_t>(image.width) * 3;
  for (int row = 0; row < image.height; ++row) {
    png_write_row(png, image.rgb.data() + static_cast<size_t>(row) * row_bytes);
  }
  png_write_end(png, info);
  return true;
}

Result<void> check_png(const PngImage& image, const SourcePlace& place) {
  const Result<uint64_t> pixels = pixel_count(image.width, image.height, place);
  if (!pixels) return pixels.problem();
  if (image.rgb.size() != pixels.value() * 3) {
    return problem_in(place,
                      "a picture of " + std::to_string(pixels.value()) + " pixels has " +
                          std::to_string(image.rgb.size()) + " bytes, not three a pixel",
                      ProblemKind::bug);
  }
  for (const auto& [key, text] : image.text) {
    const bool printable =
        std::all_of(key.begin(), key.end(), [](char c) { return c >= 32 && c < 127; });
    if (key.empty() || key.size() > 79 || !printable || key.front() == ' ' || key.back() == ' ') {
      return problem_in(place,
                        "'" + clean_utf8(key) + "' cannot be the key of a text in a PNG; " +
                            "keys have 1 to 79 printable ASCII characters, no space at an end",
                        ProblemKind::bug);
    }
  }
  return {};
}

}  // namespace

const ExrChannel* ExrImage::find(const std::string& name) const {
  for (const ExrChannel& channel : channels) {
    if (channel.name == name) return &channel;
  }
  return nullptr;
}

Result<void> write_exr(const std::filesystem::path& path, const ExrImage& image) {
  const SourcePlace place{path.string(), 0};
  if (auto good = check_exr(image, place); !good) return good.problem();
  MemoryOut out;
  try {
    Imf::Header header = exr_header(image);
    write_exr_pixels(image, header, out);
  } catch (const std::exception& error) {
    return problem_in(place, std::string("cannot make this EXR picture: ") + error.what(),
                      ProblemKind::system);
  }
  return write_file_atomically(path, std::span<const std::byte>(out.bytes()));
}

Result<std::vector<std::byte>> encode_png(const PngImage& image, const SourcePlace& place) {
  if (auto good = check_png(image, place); !good) return good.problem();
  std::vector<std::string> values;
  for (const auto& [key, text] : image.text) values.push_back(clean_utf8(text));
  std::vector<png_text> texts(image.text.size());
  for (size_t i = 0; i < texts.size(); ++i) {
    // ASCII goes into tEXt, which every program shows; other text needs iTXt, which is UTF-8.
    const bool ascii = std::all_of(values[i].begin(), values[i].end(),
                                   [](char c) { return static_cast<signed char>(c) >= 0; });
    texts[i].compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
    texts[i].key = const_cast<char*>(image.text[i].first.c_str());
    texts[i].text = values[i].data();
    texts[i].text_length = ascii ? values[i].size() : 0;
    texts[i].itxt_length = ascii ? 0 : values[i].size();
  }
  PngSink sink;
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, png_fail, png_warn_nothing);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  const bool written = info != nullptr && png_write(png, info, sink, image, texts.data(),
                                                    static_cast<int>(texts.size()));
  png_destroy_write_struct(&png, &info);
  if (!written || sink.out_of_memory) {
    return problem_in(place,
                      "cannot make this PNG picture: " +
                          (sink.error.empty() ? std::string("out of memory") : sink.error),
                      sink.error.empty() ? ProblemKind::no_room : ProblemKind::system);
  }
  return std::move(sink.bytes);
}

Result<void> write_png(const std::filesystem::path& path, const PngImage& image) {
  Result<std::vector<std::byte>> bytes = encode_png(image, {path.string(), 0});
  if (!bytes) return bytes.problem();
  return write_file_atomically(path, std::span<const std::byte>(bytes.value()));
}

}  // namespace luxodus
