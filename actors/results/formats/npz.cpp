#include "actors/results/formats/npz.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "actors/results/formats/stored_zip.hpp"

namespace luxodus {

namespace {

/// The header ends at a multiple of this.
constexpr size_t alignment = 64;

void put_word(std::string& to, uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) to += static_cast<char>(value >> (8 * i) & 0xff);
}

std::string npy_of(NpyArray array) {
  std::string shape;
  for (const size_t length : array.shape) shape += fmt::format("{}, ", length);
  std::string header =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", array.type, shape);
  constexpr size_t before = 10;  // magic, version, length of the header
  header.append(alignment - 1 - (before + header.size()) % alignment, ' ');
  header += '\n';
  std::string out = "\x93NUMPY";
  out += '\1';
  out += '\0';
  put_word(out, header.size(), 2);
  array.bytes.insert(0, out + header);
  return std::move(array.bytes);
}

/// Code points; bytes that are no UTF-8 become U+FFFD.
std::vector<uint32_t> code_points(std::string_view text) {
  std::vector<uint32_t> out;
  for (size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const size_t length = first < 0x80 ? 1 : first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    uint32_t code = length == 1 ? first : first & (0xffu >> (length + 1));
    bool good = (first < 0x80 || (first >= 0xc2 && first < 0xf5)) && i + length <= text.size();
    for (size_t k = 1; good && k < length; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      good = (next & 0xc0) == 0x80;
      code = code << 6 | (next & 0x3f);
    }
    good = good && code <= 0x10ffff && (code < 0xd800 || code > 0xdfff);
    out.push_back(good ? code : 0xfffd);
    i += good ? length : 1;
  }
  return out;
}

/// NumPy drops trailing zeros of a text.
NpyArray texts_of(std::string name, std::vector<size_t> shape,
                  const std::vector<std::vector<uint32_t>>& texts) {
  size_t longest = 1;
  for (const auto& text : texts) longest = std::max(longest, text.size());
  NpyArray out{std::move(name), fmt::format("<U{}", longest), std::move(shape), {}};
  for (const auto& text : texts)
    for (size_t i = 0; i < longest; ++i) put_word(out.bytes, i < text.size() ? text[i] : 0, 4);
  return out;
}

}  // namespace

NpyArray npy_numbers(std::string name, const std::vector<double>& values) {
  NpyArray out{std::move(name), "<f8", {values.size()}, {}};
  for (const double value : values) put_word(out.bytes, std::bit_cast<uint64_t>(value), 8);
  return out;
}

NpyArray npy_truths(std::string name, std::vector<size_t> shape, const std::vector<char>& values) {
  return {std::move(name), "|b1", std::move(shape), std::string(values.begin(), values.end())};
}

NpyArray npy_bytes(std::string name, std::vector<size_t> shape, std::string values) {
  return {std::move(name), "|u1", std::move(shape), std::move(values)};
}

NpyArray npy_text(std::string name, std::string_view text) {
  return texts_of(std::move(name), {}, {code_points(text)});
}

NpyArray npy_texts(std::string name, const std::vector<std::string>& texts) {
  std::vector<std::vector<uint32_t>> codes;
  for (const std::string& text : texts) codes.push_back(code_points(text));
  return texts_of(std::move(name), {texts.size()}, codes);
}

Result<std::string> npz_of(std::vector<NpyArray> arrays) {
  size_t bytes = 0;
  for (const NpyArray& array : arrays) bytes += array.bytes.size();
  if (bytes > limits::max_npz_bytes)
    return problem(fmt::format("the arrays take more than the {} bytes of a file for NumPy",
                               limits::max_npz_bytes));
  std::vector<std::pair<std::string, std::string>> files;
  for (NpyArray& array : arrays) {
    const std::string name = array.name + ".npy";
    files.emplace_back(name, npy_of(std::move(array)));
  }
  return stored_zip(files);
}

}  // namespace luxodus
