// APPNOTE.TXT of PKWARE, 4.3: a header before each file, then the directory of all, then its end.
#include "actors/results/formats/stored_zip.hpp"

#include <array>
#include <cstdint>
#include <string_view>

namespace luxodus {

namespace {

/// The polynomial of ISO 3309, bits reversed.
constexpr uint32_t crc_polynomial = 0xedb88320u;

uint32_t crc32_of(std::string_view bytes) {
  static const std::array<uint32_t, 256> table = [] {
    std::array<uint32_t, 256> out{};
    for (uint32_t i = 0; i < out.size(); ++i) {
      uint32_t c = i;
      for (int bit = 0; bit < 8; ++bit) c = (c >> 1) ^ ((c & 1) != 0 ? crc_polynomial : 0);
      out[i] = c;
    }
    return out;
  }();
  uint32_t crc = ~0u;
  for (const char byte : bytes)
    crc = table[(crc ^ static_cast<unsigned char>(byte)) & 0xff] ^ (crc >> 8);
  return ~crc;
}

/// A number in little-endian order.
void put(std::string& to, uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) to += static_cast<char>(value >> (8 * i) & 0xff);
}

/// What the header of a file and its entry in the directory have in common.
void put_common(std::string& to, const std::string& name, const std::string& content) {
  constexpr uint32_t version = 20, stored = 0, midnight = 0, first_day = 0x21;
  put(to, version, 2);
  put(to, 0, 2);  // flags
  put(to, stored, 2);
  put(to, midnight, 2);
  put(to, first_day, 2);
  put(to, crc32_of(content), 4);
  put(to, static_cast<uint32_t>(content.size()), 4);
  put(to, static_cast<uint32_t>(content.size()), 4);
  put(to, static_cast<uint32_t>(name.size()), 2);
  put(to, 0, 2);  // length of the extra field
}

}  // namespace

std::string stored_zip(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string out, directory;
  for (const auto& [name, content] : files) {
    const auto offset = static_cast<uint32_t>(out.size());
    put(out, 0x04034b50, 4);
    put_common(out, name, content);
    out += name + content;
    put(directory, 0x02014b50, 4);
    put(directory, 20, 2);  // version made by
    put_common(directory, name, content);
    put(directory, 0, 2);  // length of the comment
    put(directory, 0, 2);  // disk
    put(directory, 0, 2);  // internal attributes
    put(directory, 0, 4);  // external attributes
    put(directory, offset, 4);
    directory += name;
  }
  const auto begin = static_cast<uint32_t>(out.size());
  const auto count = static_cast<uint32_t>(files.size());
  out += directory;
  put(out, 0x06054b50, 4);
  put(out, 0, 2);
  put(out, 0, 2);
  put(out, count, 2);
  put(out, count, 2);
  put(out, static_cast<uint32_t>(directory.size()), 4);
  put(out, begin, 4);
  put(out, 0, 2);
  return out;
}

}  // namespace luxodus
