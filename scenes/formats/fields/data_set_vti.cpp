// Reads VTK XML image data (VTK user's guide, "VTK file formats"). With appended raw bytes such a
// file is not XML, so a general XML parser cannot read it. This scanner knows tags, attributes and
// comments, keeps the stack of open elements, and stops at the appended bytes. Entities, CDATA and
// DOCTYPE are rejected.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "runtime/core/printable.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/formats/fields/data_set_fields.hpp"

namespace luxodus::data_set {
namespace {

constexpr size_t deepest = 32;
constexpr size_t max_attributes = 32;
constexpr size_t max_arrays = 256;

struct Tag {
  std::string_view name;
  std::vector<std::pair<std::string_view, std::string_view>> attributes;
  size_t first = 0;  // position of '<'
  size_t after = 0;  // position after '>'
  bool closes = false;
  bool is_empty = false;

  std::string_view attribute(std::string_view wanted) const {
    for (const auto& [key, value] : attributes) {
      if (key == wanted) return value;
    }
    return {};
  }
};

struct Array {
  std::string_view name, type, format, offset, components;
  std::string_view text;  // between its tags
  bool of_points = false;
  size_t first = 0;
};

/// Decodes base64 text. VTK pads where a stream ends, and may begin another one.
class Base64 {
 public:
  explicit Base64(std::string_view text) : text_(text) {}

  /// Appends up to `count` bytes; false where the text is not base64.
  bool read(size_t count, std::string& out) {
    while (count > 0) {
      if (ready_ == given_ && !next_group()) return false;
      if (ready_ == given_) return true;  // no more text
      out += group_[given_++];
      --count;
    }
    return true;
  }
  bool at_end() {
    if (ready_ != given_) return false;
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    return at_ == text_.size();
  }

 private:
  static int digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
  }

  bool next_group() {
    ready_ = given_ = 0;
    uint32_t bits = 0;
    int digits = 0, pads = 0;
    for (; at_ < text_.size() && digits + pads < 4; ++at_) {
      const char c = text_[at_];
      if (is_space(c)) continue;
      const int d = digit(c);
      if (c == '=') {
        ++pads;
      } else if (d < 0 || pads > 0) {
        return false;
      } else {
        ++digits;
      }
      bits = bits << 6 | static_cast<uint32_t>(std::max(d, 0));
    }
    if (digits + pads == 0) return true;
    if (digits + pads != 4 || digits < 2) return false;
    for (int i = 0; i < digits - 1; ++i) {
      group_[static_cast<size_t>(i)] = static_cast<char>(bits >> (16 - 8 * i) & 255);
    }
    ready_ = static_cast<size_t>(digits - 1);
    return true;
  }

  std::string_view text_;
  size_t at_ = 0;
  std::array<char, 3> group_{};
  size_t ready_ = 0, given_ = 0;
};

class VtiReader {
 public:
  explicit VtiReader(const std::string& path) : path_(path) {}

  Result<Grid> read() {
    if (auto ok = load(); !ok) return ok.problem();
    if (auto ok = scan(); !ok) return ok.problem();
    if (auto ok = doubles(); !ok) return ok.problem();
    if (!seen_image_) return bad(0, "no ImageData element: other kinds of VTK files are not read");
    if (pieces_ != 1) return bad(0, fmt::format("{} pieces: write the grid as one piece", pieces_));
    for (const Array& array : arrays_) {
      if (auto ok = take(array); !ok) return ok.problem();
    }
    if (grid_.fields.empty()) {
      return bad(0,
                 fmt::format(
                     "no array is named extinction, soot_density, albedo or emission; there is: {}",
                     others_.empty() ? "none" : others_));
    }
    return std::move(grid_);
  }

 private:
  Problem bad(size_t at, std::string what, ProblemKind kind = ProblemKind::bad_input) const {
    const auto begin = text_.begin();
    const auto lines =
        std::count(begin, begin + static_cast<ptrdiff_t>(std::min(at, text_.size())), '\n');
    return problem_in(path_, static_cast<int>(lines) + 1, std::move(what), kind);
  }

  Result<void> load() {
    std::error_code error;
    const uint64_t size = std::filesystem::file_size(path_, error);
    if (error || size > limits::vti_file_bytes) {
      return problem_in(path_, fmt::format("the file has {} bytes, the most are {}", size,
                                           limits::vti_file_bytes));
    }
    auto text = read_regular_file(path_, limits::vti_file_bytes);
    if (!text) return text.problem();
    text_ = std::move(text).value();
    grid_.files_read = {path_};
    return {};
  }

  // ---- tags ------------------------------------------------------------------------------------

  size_t skip_spaces(size_t at) const {
    while (at < text_.size() && is_space(text_[at])) ++at;
    return at;
  }
  static bool is_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == ':' || c == '.';
  }
  std::string_view name_at(size_t at) const {
    size_t end = at;
    while (end < text_.size() && is_name(text_[end])) ++end;
    return std::string_view(text_).substr(at, end - at);
  }

  /// The next tag from `at`, past comments and declarations; its name is "" at the end of the text.
  Result<void> next_tag(size_t at, Tag& tag) const {
    for (;;) {
      tag = Tag{};
      tag.first = text_.find('<', at);
      if (tag.first == std::string::npos) {
        tag.first = tag.after = text_.size();
        return {};
      }
      const std::string_view rest = std::string_view(text_).substr(tag.first);
      const bool comment = rest.starts_with("<!--");
      if (!comment && !rest.starts_with("<?")) break;
      const std::string_view ending = comment ? "-->" : "?>";
      const size_t end = text_.find(ending, tag.first + (comment ? 4 : 2));
      if (end == std::string::npos) return bad(tag.first, "a comment or declaration has no end");
      at = end + ending.size();
    }
    size_t here = tag.first + 1;
    tag.closes = here < text_.size() && text_[here] == '/';
    if (tag.closes) ++here;
    tag.name = name_at(here);
    if (tag.name.empty()) return bad(tag.first, "\"<\" begins no tag");
    return read_attributes(here + tag.name.size(), tag);
  }

  Result<void> read_attributes(size_t here, Tag& tag) const {
    for (;;) {
      here = skip_spaces(here);
      if (here < text_.size() && text_[here] == '>') break;
      if (std::string_view(text_).substr(here, 2) == "/>" && !tag.closes) {
        tag.is_empty = true;
        ++here;
        break;
      }
      const std::string_view key = name_at(here);
      size_t quote = skip_spaces(here + key.size());
      const bool equals = quote < text_.size() && text_[quote] == '=';
      quote = skip_spaces(quote + 1);
      if (key.empty() || !equals || quote >= text_.size() ||
          (text_[quote] != '"' && text_[quote] != '\'')) {
        return bad(tag.first, fmt::format("the tag \"{}\" is not well formed", excerpt(tag.name)));
      }
      const size_t end = text_.find(text_[quote], quote + 1);
      if (end == std::string::npos) return bad(tag.first, "an attribute has no closing quote");
      const std::string_view value = std::string_view(text_).substr(quote + 1, end - quote - 1);
      if (value.find_first_of("<&") != std::string_view::npos) {
        return bad(tag.first, "\"<\" and entities in attributes are not read");
      }
      if (tag.attributes.size() >= max_attributes) return bad(tag.first, "too many attributes");
      tag.attributes.emplace_back(key, value);
      here = end + 1;
    }
    tag.after = here + 1;
    return {};
  }

  /// Walks all elements; stops at the appended bytes.
  Result<void> scan() {
    std::vector<std::string_view> open;
    Tag tag;
    for (size_t at = 0;; at = tag.after) {
      if (auto ok = next_tag(at, tag); !ok) return ok.problem();
      if (tag.name.empty()) {
        if (open.empty()) return {};
        return bad(tag.first, fmt::format("the file ends within \"{}\"", excerpt(open.back())));
      }
      if (tag.closes) {
        if (open.empty() || open.back() != tag.name) {
          return bad(tag.first, fmt::format("\"</{}>\" closes nothing", excerpt(tag.name)));
        }
        open.pop_back();
        continue;
      }
      const std::string_view parent = open.empty() ? std::string_view() : open.back();
      bool array_done = false;
      if (auto ok = enter(tag, parent, array_done); !ok) return ok.problem();
      if (tag.name == "AppendedData") return {};
      if (tag.is_empty || array_done) continue;
      if (open.size() >= deepest) return bad(tag.first, "elements are nested too deep");
      open.push_back(tag.name);
    }
  }

  Result<void> enter(Tag& tag, std::string_view parent, bool& array_done) {
    if (parent.empty() && tag.name != "VTKFile") {
      return bad(tag.first, "the outermost element must be VTKFile");
    }
    if (tag.name == "VTKFile") return enter_file(tag);
    if (tag.name == "ImageData" && parent == "VTKFile") return enter_image(tag);
    if (tag.name == "Piece" && parent == "ImageData") return enter_piece(tag);
    if (tag.name == "AppendedData" && parent == "VTKFile") return enter_appended(tag);
    if (tag.name == "DataArray" && (parent == "CellData" || parent == "PointData")) {
      array_done = true;
      return enter_array(tag, parent == "PointData");
    }
    return {};
  }

  Result<void> enter_file(const Tag& tag) {
    if (tag.attribute("type") != "ImageData") {
      return bad(tag.first, fmt::format("a VTK file of type \"{}\": ImageData is read",
                                        excerpt(tag.attribute("type"))));
    }
    if (tag.attribute("byte_order") != "LittleEndian") {
      return bad(tag.first, "byte_order must be LittleEndian");
    }
    if (!tag.attribute("compressor").empty()) {
      return bad(tag.first, "the file is compressed: write it without compression");
    }
    const std::string_view header = tag.attribute("header_type");
    if (!header.empty() && header != "UInt32" && header != "UInt64") {
      return bad(tag.first, "header_type must be UInt32 or UInt64");
    }
    header_bytes_ = header == "UInt64" ? 8 : 4;
    return {};
  }

  Result<void> enter_image(const Tag& tag) {
    if (seen_image_) return bad(tag.first, "a second ImageData element");
    seen_image_ = true;
    extent_text_ = tag.attribute("WholeExtent");
    const auto extent = numbers_in<int64_t>(extent_text_, 6);
    const auto origin = numbers_in<double>(tag.attribute("Origin"), 3);
    const auto spacing = numbers_in<double>(tag.attribute("Spacing"), 3);
    if (!extent) return bad(tag.first, "WholeExtent must be six whole numbers");
    if (!origin) return bad(tag.first, "Origin must be three numbers");
    if (!spacing) return bad(tag.first, "Spacing must be three numbers");
    const auto direction = tag.attribute("Direction");
    if (!direction.empty()) {
      const auto d = numbers_in<double>(direction, 9);
      if (!d || *d != std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1}) {
        return bad(tag.first, "Direction must be 1 0 0 0 1 0 0 0 1: turn the medium in the scene");
      }
    }
    std::array<uint64_t, 3> cells{};
    for (size_t axis = 0; axis < 3; ++axis) {
      const int64_t low = (*extent)[2 * axis], high = (*extent)[2 * axis + 1];
      constexpr int64_t most = 1ll << 40;  // differences cannot overflow; check_grid judges sizes
      if (std::abs(low / 2) > most || std::abs(high / 2) > most || high < low) {
        return bad(tag.first, "WholeExtent must ascend along each axis");
      }
      cells[axis] = static_cast<uint64_t>(high - low);
      const auto i = static_cast<glm::length_t>(axis);
      grid_.spacing[i] = (*spacing)[axis];
      grid_.origin[i] = (*origin)[axis] + (*spacing)[axis] * static_cast<double>(low);
    }
    grid_.nx = cells[0];
    grid_.ny = cells[1];
    grid_.nz = cells[2];
    if (auto ok = check_grid(grid_.nx, grid_.ny, grid_.nz); !ok)
      return bad(tag.first, ok.problem().what);
    return {};
  }

  Result<void> enter_piece(const Tag& tag) {
    ++pieces_;
    if (words_of(tag.attribute("Extent")) != words_of(extent_text_)) {
      return bad(tag.first,
                 "the piece's Extent is not the WholeExtent: write the grid as one piece");
    }
    return {};
  }

  /// Takes the text up to the closing tag; inner elements (value ranges and units) are skipped.
  Result<void> enter_array(Tag& tag, bool of_points) {
    if (arrays_.size() >= max_arrays) return bad(tag.first, "too many arrays");
    Array array{tag.attribute("Name"),
                tag.attribute("type"),
                tag.attribute("format"),
                tag.attribute("offset"),
                tag.attribute("NumberOfComponents"),
                {},
                of_points,
                tag.first};
    size_t at = tag.after;
    for (int depth = tag.is_empty ? 0 : 1; depth > 0;) {
      Tag inner;
      if (auto ok = next_tag(at, inner); !ok) return ok.problem();
      if (inner.name.empty()) return bad(array.first, "the array has no closing tag");
      if (depth == 1) {
        const std::string_view piece =
            trimmed(std::string_view(text_).substr(at, inner.first - at));
        if (!piece.empty() && !array.text.empty()) {
          return bad(inner.first, "the values of an array must not be interrupted");
        }
        if (!piece.empty()) array.text = piece;
      }
      depth += inner.closes ? -1 : inner.is_empty ? 0 : 1;
      at = inner.after;
      if (depth == 0 && inner.name != "DataArray")
        return bad(inner.first, "elements are interlaced");
    }
    tag.after = at;
    arrays_.push_back(array);
    return {};
  }

  Result<void> enter_appended(const Tag& tag) {
    appended_encoding_ = tag.attribute("encoding");
    const size_t mark = skip_spaces(tag.after);
    if (mark >= text_.size() || text_[mark] != '_') {
      return bad(tag.first, "appended data must begin with \"_\"");
    }
    // Raw bytes may hold anything, so the closing tag is searched from the end of the file.
    const size_t end = text_.rfind("</AppendedData");
    if (end == std::string::npos || end <= mark) {
      return bad(tag.first, "the appended data have no closing tag: the file is cut short");
    }
    appended_ = std::string_view(text_).substr(mark + 1, end - mark - 1);
    return {};
  }

  // ---- values ----------------------------------------------------------------------------------

  /// Checked before decoding: each of 256 arrays may claim the same bytes of the file.
  Result<void> doubles() const {
    std::vector<std::string_view> names, offsets;
    for (const Array& array : arrays_) {
      if (!is_known_field(array.name)) continue;
      if (std::find(names.begin(), names.end(), array.name) != names.end())
        return bad(array.first, fmt::format("\"{}\" would be given twice: keep one", array.name));
      names.push_back(array.name);
      if (array.format != "appended") continue;
      if (std::find(offsets.begin(), offsets.end(), array.offset) != offsets.end())
        return bad(array.first,
                   fmt::format("\"{}\" has the same offset as another array: each has bytes of "
                               "its own",
                               array.name));
      offsets.push_back(array.offset);
    }
    return {};
  }

  Result<void> take(const Array& array) {
    if (!is_known_field(array.name)) {
      if (others_.size() < 200) others_ += (others_.empty() ? "" : ", ") + excerpt(array.name);
      return {};
    }
    if (!array.components.empty() && array.components != "1") {
      return bad(array.first, fmt::format("\"{}\" must have one component", array.name));
    }
    SampleType type;
    if (array.type == "Float32") {
      type = SampleType::float32;
    } else if (array.type == "Float64") {
      type = SampleType::float64;
    } else if (array.type == "UInt8") {
      type = SampleType::uint8;
    } else {
      return bad(array.first,
                 fmt::format("\"{}\" is of type \"{}\": Float32, Float64 and UInt8 are read",
                             array.name, excerpt(array.type)));
    }
    if (auto ok = check_memory(grid_.nx * grid_.ny * grid_.nz, 1); !ok)
      return bad(array.first, ok.problem().what, ok.problem().kind);
    const uint64_t one_more = array.of_points ? 1 : 0;
    const uint64_t count = (grid_.nx + one_more) * (grid_.ny + one_more) * (grid_.nz + one_more);
    std::vector<float> values;
    Result<void> ok;
    if (array.format == "ascii") {
      ok = read_ascii(array, count, values);
    } else if (array.format == "binary") {
      ok = read_base64(array, array.text, count, type, true, values);
    } else if (array.format == "appended") {
      ok = read_appended(array, count, type, values);
    } else {
      ok = bad(array.first, fmt::format("unknown format \"{}\"", excerpt(array.format)));
    }
    if (!ok) return ok.problem();
    if (array.of_points) {
      if (ok = check_points(array, values); !ok) return ok.problem();
      values = cells_of_points(values);
    }
    grid_.fields.push_back({std::string(array.name), std::move(values)});
    return {};
  }

  Problem wrong_count(const Array& array, uint64_t count) const {
    return bad(array.first, fmt::format("\"{}\" does not hold the {} values that the grid needs",
                                        array.name, count));
  }

  Result<void> read_ascii(const Array& array, uint64_t count, std::vector<float>& values) const {
    // A value takes at least a digit and a blank.
    if (count > (array.text.size() + 1) / 2) return wrong_count(array, count);
    values.reserve(count);
    size_t at = 0;
    while (at < array.text.size()) {
      size_t end = at;
      while (end < array.text.size() && !is_space(array.text[end])) ++end;
      const std::string_view word = array.text.substr(at, end - at);
      const auto value = number_in<double>(word);
      if (!value) {
        return bad(static_cast<size_t>(word.data() - text_.data()),
                   fmt::format("a value of \"{}\" is not a number", array.name));
      }
      if (values.size() == count) return wrong_count(array, count);
      values.push_back(static_cast<float>(*value));
      while (end < array.text.size() && is_space(array.text[end])) ++end;
      at = end;
    }
    if (values.size() != count) return wrong_count(array, count);
    return {};
  }

  uint64_t claimed_bytes(const char* header) const {
    uint64_t bytes = 0;
    std::memcpy(&bytes, header, header_bytes_);  // little-endian: the low bytes
    return bytes;
  }

  Result<void> read_base64(const Array& array, std::string_view text, uint64_t count,
                           SampleType type, bool whole_text, std::vector<float>& values) const {
    const uint64_t needed = count * bytes_of(type);
    if (needed + header_bytes_ > text.size() / 4 * 3 + 3) return wrong_count(array, count);
    Base64 decoder(text);
    std::string bytes;
    const bool header_read = decoder.read(header_bytes_, bytes);
    if (!header_read || bytes.size() != header_bytes_ || claimed_bytes(bytes.data()) != needed) {
      return wrong_count(array, count);
    }
    bytes.clear();
    bytes.reserve(needed);
    if (!decoder.read(needed, bytes)) {
      return bad(array.first, fmt::format("\"{}\" is not base64", array.name));
    }
    if (bytes.size() != needed || (whole_text && !decoder.at_end()))
      return wrong_count(array, count);
    convert(bytes.data(), count, type, values);
    return {};
  }

  Result<void> read_appended(const Array& array, uint64_t count, SampleType type,
                             std::vector<float>& values) const {
    if (appended_encoding_.empty()) {
      return bad(array.first,
                 fmt::format("\"{}\" is among appended data, of which there are none", array.name));
    }
    const auto offset = number_in<uint64_t>(array.offset);
    if (!offset || *offset > appended_.size()) {
      return bad(array.first,
                 fmt::format("\"{}\" has no offset within the appended data", array.name));
    }
    const std::string_view from = appended_.substr(*offset);
    if (appended_encoding_ == "base64") return read_base64(array, from, count, type, false, values);
    if (appended_encoding_ != "raw") return bad(array.first, "appended data must be raw or base64");
    const uint64_t needed = count * bytes_of(type);
    if (from.size() < header_bytes_ || from.size() - header_bytes_ < needed ||
        claimed_bytes(from.data()) != needed) {
      return wrong_count(array, count);
    }
    convert(from.data() + header_bytes_, count, type, values);
    return {};
  }

  static void convert(const char* bytes, uint64_t count, SampleType type,
                      std::vector<float>& values) {
    values.resize(count);
    for (uint64_t i = 0; i < count; ++i) values[i] = sample_at(bytes + i * bytes_of(type), type);
  }

  /// Called before means are taken, which would hide a negative value.
  Result<void> check_points(const Array& array, const std::vector<float>& points) const {
    for (size_t i = 0; i < points.size(); ++i) {
      if (points[i] >= 0 && points[i] <= 3e38f) continue;  // NaN fails
      return bad(array.first, fmt::format("{} of point {} is {}: give a finite value of 0 or more",
                                          array.name, i, points[i]));
    }
    return {};
  }

  /// Means over the eight corners.
  std::vector<float> cells_of_points(const std::vector<float>& points) const {
    const uint64_t px = grid_.nx + 1, py = grid_.ny + 1;
    std::vector<float> cells;
    cells.reserve(grid_.nx * grid_.ny * grid_.nz);
    for (uint64_t z = 0; z < grid_.nz; ++z) {
      for (uint64_t y = 0; y < grid_.ny; ++y) {
        for (uint64_t x = 0; x < grid_.nx; ++x) {
          double sum = 0;
          for (int corner = 0; corner < 8; ++corner) {
            const uint64_t i =
                (((z + (corner >> 2 & 1)) * py) + y + (corner >> 1 & 1)) * px + x + (corner & 1);
            sum += static_cast<double>(points[i]);
          }
          cells.push_back(static_cast<float>(sum / 8));
        }
      }
    }
    return cells;
  }

  const std::string& path_;
  std::string text_;
  Grid grid_;
  bool seen_image_ = false;
  int pieces_ = 0;
  size_t header_bytes_ = 4;
  std::string_view extent_text_;
  std::vector<Array> arrays_;
  std::string_view appended_encoding_, appended_;
  std::string others_;
};

}  // namespace

Result<Grid> read_vti(const std::string& path) {
  return VtiReader(path).read();
}

}  // namespace luxodus::data_set
