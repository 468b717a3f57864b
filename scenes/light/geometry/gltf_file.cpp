// The bytes of a glTF: its chunks, its buffers, and the numbers of its accessors.
#include "scenes/light/geometry/gltf_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "runtime/core/base64.hpp"
#include "runtime/core/isolated_job.hpp"
#include "runtime/core/printable.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/light/geometry/import.hpp"

namespace luxodus {
namespace {

namespace fs = std::filesystem;

template <class T>
T number_at(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

size_t component_bytes(int type) {
  return type <= 5121 ? 1 : type <= 5123 ? 2 : 4;
}

/// One number of an accessor (glTF 2.0, 3.6.2.2; normalized ones as in 3.11).
double component(const char* bytes, int type, bool normalized) {
  switch (type) {
    case 5120: {
      const double v = number_at<int8_t>(bytes);
      return normalized ? std::max(v / 127, -1.0) : v;
    }
    case 5121: {
      const double v = number_at<uint8_t>(bytes);
      return normalized ? v / 255 : v;
    }
    case 5122: {
      const double v = number_at<int16_t>(bytes);
      return normalized ? std::max(v / 32767, -1.0) : v;
    }
    case 5123: {
      const double v = number_at<uint16_t>(bytes);
      return normalized ? v / 65535 : v;
    }
    case 5125:
      return number_at<uint32_t>(bytes);
    default:
      return static_cast<double>(number_at<float>(bytes));
  }
}

int hex_digit(char c) {
  return c >= '0' && c <= '9'   ? c - '0'
         : c >= 'a' && c <= 'f' ? c - 'a' + 10
         : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                : -1;
}

/// "my%20data.bin" as "my data.bin" (RFC 3986, 2.1).
std::string percent_decoded(std::string_view uri) {
  std::string out;
  for (size_t i = 0; i < uri.size(); ++i) {
    const int high = i + 2 < uri.size() && uri[i] == '%' ? hex_digit(uri[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(uri[i + 2]) : -1;
    if (low >= 0) i += 2;
    out += low >= 0 ? static_cast<char>(high * 16 + low) : uri[i];
  }
  return out;
}

}  // namespace

Transform gltf_placement(const glm::dvec3& translation, const glm::dvec4& rotation,
                         const glm::dvec3& scale) {
  const double length = glm::length(rotation);
  const glm::dvec4 q = length > 0 ? rotation / length : glm::dvec4(0, 0, 0, 1);
  const double x = q.x, y = q.y, z = q.z, w = q.w;
  const glm::dmat3 turn(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w),
                        2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w),
                        2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y));
  return {glm::dmat3(turn[0] * scale.x, turn[1] * scale.y, turn[2] * scale.z), translation};
}

Result<std::string_view> GltfFile::find_json() {
  const std::string_view text = text_;
  if (!text.starts_with("glTF")) return text.substr(text.starts_with("\xef\xbb\xbf") ? 3 : 0);
  // glTF 2.0, 4.4: a chunk begins with its length and its type; the first is the JSON.
  constexpr size_t head = 12, chunk_head = 8;
  constexpr uint32_t is_json = 0x4E4F534A, is_binary = 0x004E4942;
  if (text.size() < head + chunk_head || number_at<uint32_t>(text.data() + 4) != 2 ||
      number_at<uint32_t>(text.data() + head + 4) != is_json)
    return problem("it is no binary glTF 2.0: no chunk of JSON follows its head");
  const size_t length = number_at<uint32_t>(text.data() + head);
  const size_t begin = head + chunk_head;
  if (length > text.size() - begin) return problem("it is cut short: copy it again");
  const size_t next = begin + (length + 3) / 4 * 4;
  if (next + chunk_head <= text.size() &&
      number_at<uint32_t>(text.data() + next + 4) == is_binary) {
    binary_at_ = next + chunk_head;
    binary_bytes_ = number_at<uint32_t>(text.data() + next);
    if (binary_bytes_ > text.size() - binary_at_) return problem("it is cut short: copy it again");
  }
  return text.substr(begin, length);
}

Result<std::string> GltfFile::bytes_at(const std::string& uri) {
  if (uri.starts_with("data:")) {
    const size_t comma = uri.find(',');
    if (comma == std::string::npos || !uri.substr(0, comma).ends_with(";base64"))
      return problem("a buffer that is embedded has to be in base64");
    const std::string_view digits = std::string_view(uri).substr(comma + 1);
    if (auto bytes = from_base64(digits)) return std::move(*bytes);
    return problem("the base64 of an embedded buffer is damaged");
  }
  const size_t colon = uri.find(':');
  if (colon != std::string::npos && colon > 1 && colon < uri.find('/'))
    return problem(
        "a buffer lies at an address of the network, and nothing is fetched: export "
        "the file with its buffers beside it");
  const fs::path folder = fs::path(path_).parent_path();
  std::error_code unknown;
  fs::path file = folder / percent_decoded(uri);
  // Some programs write the name as it is.
  if (!fs::is_regular_file(file, unknown) && fs::is_regular_file(folder / uri, unknown))
    file = folder / uri;
  const uint64_t bytes = fs::is_regular_file(file, unknown) ? fs::file_size(file, unknown) : 0;
  if (std::find(files.begin(), files.end(), file.string()) == files.end()) {
    files.push_back(file.string());
    allow_more(import_limits(std::min(bytes, limits::mesh_file_bytes)));
  }
  return read_regular_file(file, limits::mesh_file_bytes);
}

Result<std::string_view> GltfFile::bytes_of(size_t buffer) {
  const GltfBuffer& said = buffers_[buffer];
  std::string_view bytes;
  if (said.uri) {
    if (!read_[buffer]) {
      auto read = bytes_at(*said.uri);
      if (!read) return read.problem();
      read_[buffer] = std::move(read).value();
    }
    bytes = *read_[buffer];
  } else if (buffer == 0 && binary_at_ > 0) {
    bytes = std::string_view(text_).substr(binary_at_, binary_bytes_);
  } else {
    return problem(fmt::format("buffers[{}] has neither \"uri\" nor a binary part", buffer));
  }
  if (bytes.size() < said.bytes)
    return problem(fmt::format("buffers[{}] has {} bytes and not {}, as is said: copy it again",
                               buffer, bytes.size(), said.bytes));
  return bytes.substr(0, said.bytes);
}

/// The bytes of `count` elements of `size` bytes, each `step` bytes after the one before.
Result<std::string_view> GltfFile::span_of(size_t index, uint64_t offset, uint64_t step,
                                           uint64_t size, uint64_t count) {
  const GltfView& view = views_[index];
  if (view.compressed)
    return problem(
        fmt::format("bufferViews[{}] is compressed by meshopt, which is not read: "
                    "export it without compression",
                    index));
  const auto bytes = bytes_of(view.buffer);
  if (!bytes) return bytes.problem();
  const uint64_t all = bytes->size();
  constexpr uint64_t largest = uint64_t{1} << 32;  // so that no product or sum overflows
  const bool too_large = std::max({view.offset, view.bytes, offset, step, count}) > largest;
  const uint64_t needed = too_large || count == 0 ? 0 : (count - 1) * step + size;
  if (too_large || view.offset > all || view.bytes > all - view.offset || offset > view.bytes ||
      needed > view.bytes - offset)
    return problem(
        fmt::format("bufferViews[{}] is beyond its buffer, or shorter than what is in "
                    "it",
                    index));
  return bytes->substr(view.offset + offset, needed);
}

Result<std::vector<double>> GltfFile::values(size_t index, int numbers) {
  const GltfAccessor& a = accessors[index];
  const auto n = static_cast<size_t>(numbers);
  if (a.numbers != numbers)
    return problem(
        fmt::format("accessors[{}] has elements of another kind than its use needs: {} "
                    "numbers each",
                    index, numbers));
  std::vector<double> out;
  const size_t width = component_bytes(a.type), size = width * n;
  const auto take = [&](std::string_view bytes, uint64_t from, uint64_t to) {
    for (size_t k = 0; k < n; ++k)
      out[to * n + k] = component(bytes.data() + from + k * width, a.type, a.normalized);
  };
  if (!a.view) {
    out.resize(a.count * n);
  } else {
    const uint64_t stride = views_[*a.view].stride;
    const uint64_t step = stride > 0 ? stride : size;
    const auto bytes = span_of(*a.view, a.offset, step, size, a.count);
    if (!bytes) return bytes.problem();
    out.resize(a.count * n);
    for (uint64_t i = 0; i < a.count; ++i) take(bytes.value(), i * step, i);
  }
  if (!a.sparse) return out;
  const GltfSparse& s = *a.sparse;
  const size_t index_width = component_bytes(s.index_type);
  if (s.count > a.count || s.index_type == 5126)
    return problem(fmt::format("accessors[{}]: its sparse part is damaged", index));
  const auto places = span_of(s.indices, s.indices_offset, index_width, index_width, s.count);
  if (!places) return places.problem();
  const auto bytes = span_of(s.values, s.values_offset, size, size, s.count);
  if (!bytes) return bytes.problem();
  for (uint64_t i = 0; i < s.count; ++i) {
    const double place = component(places->data() + i * index_width, s.index_type, false);
    if (!(place >= 0 && place < static_cast<double>(a.count)))
      return problem(fmt::format("accessors[{}]: its sparse part is damaged", index));
    take(bytes.value(), i * size, static_cast<uint64_t>(place));
  }
  return out;
}

}  // namespace luxodus
