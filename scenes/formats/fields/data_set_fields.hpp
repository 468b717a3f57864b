// What the two readers of data sets share: fields as found in a file, and messages about them.
// Private to data_set*.cpp. Plain values and pure functions; any thread.
#pragma once

#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/core/result.hpp"
#include "runtime/core/text.hpp"
#include "scenes/formats/fields/data_set.hpp"

namespace luxodus::data_set {

struct Field {
  std::string name;
  std::vector<float> value;  // x fastest
};

struct Grid {
  uint64_t nx = 0, ny = 0, nz = 0;
  glm::dvec3 origin{0};
  glm::dvec3 spacing{0};
  std::vector<Field> fields;
  std::vector<std::string> files_read;
};

Result<Grid> read_nrrd(const std::string& path, const DataSetOptions& options);
Result<Grid> read_vti(const std::string& path);

bool is_known_field(std::string_view name);

/// Whether such a grid is taken. Sides are cells.
Result<void> check_grid(uint64_t nx, uint64_t ny, uint64_t nz);
/// Whether arrays of so many cells fit the memory of this machine. To be asked before they are
/// made: a sparse file claims gigabytes in a few blocks of a disk.
Result<void> check_memory(uint64_t cells, uint64_t fields);

enum class SampleType { uint8, float32, float64 };

inline size_t bytes_of(SampleType type) {
  return type == SampleType::uint8 ? 1 : type == SampleType::float32 ? 4 : 8;
}

/// One little-endian sample. A double beyond float's range becomes infinite, and is rejected as
/// such.
inline float sample_at(const char* bytes, SampleType type) {
  if (type == SampleType::uint8) return static_cast<float>(static_cast<unsigned char>(*bytes));
  if (type == SampleType::float32) {
    float v;
    std::memcpy(&v, bytes, sizeof v);
    return v;
  }
  double v;
  std::memcpy(&v, bytes, sizeof v);
  return static_cast<float>(v);
}

inline bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

using luxodus::trimmed;

inline std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  size_t at = 0;
  while (at < text.size()) {
    while (at < text.size() && is_space(text[at])) ++at;
    const size_t first = at;
    while (at < text.size() && !is_space(text[at])) ++at;
    if (at > first) words.push_back(text.substr(first, at - first));
  }
  return words;
}

/// Parses the whole text as a number, independent of the locale.
template <class T>
std::optional<T> number_in(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Parses exactly `count` numbers separated by blanks, or none.
template <class T>
std::optional<std::vector<T>> numbers_in(std::string_view text, size_t count) {
  std::vector<T> values;
  for (const std::string_view word : words_of(text)) {
    const std::optional<T> value = number_in<T>(word);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  if (values.size() != count) return std::nullopt;
  return values;
}

}  // namespace luxodus::data_set
