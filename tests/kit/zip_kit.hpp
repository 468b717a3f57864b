// ZIP files made byte by byte (APPNOTE.TXT 4.3), so that tests can make invalid ones: paths that
// leave the archive, entries that expand enormously, wrong sizes. Any thread.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace luxodus::test {

struct ZipEntry {
  std::string name;
  std::string data;       // as stored in the file
  bool deflated = false;  // `data` is a deflate stream of `plain_bytes` bytes
  uint32_t plain_bytes = 0;
  uint32_t plain_crc = 0;
};

/// CRC-32 of ZIP, continued from `before`.
inline uint32_t crc32_of(std::string_view text, uint32_t before = 0) {
  uint32_t crc = ~before;
  for (const char c : text) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

/// An entry of zero bytes, 258 for each 13 bits: a match of length 258 at distance 1 in the fixed
/// Huffman code of RFC 1951.
inline ZipEntry swelling_entry(const std::string& name, uint32_t matches) {
  ZipEntry out;
  out.name = name;
  out.deflated = true;
  uint32_t held = 0, count = 0;
  const auto bit = [&](uint32_t value) {
    held |= value << count;
    if (++count < 8) return;
    out.data += static_cast<char>(held);
    held = count = 0;
  };
  const auto code = [&](uint32_t value, int bits) {  // Huffman codes: highest bit first
    for (int i = bits - 1; i >= 0; --i) bit((value >> i) & 1);
  };
  bit(1), bit(1), bit(0);  // the last block, fixed codes
  code(0x30, 8);           // a literal 0
  for (uint32_t i = 0; i < matches; ++i) code(0xc5, 8), code(0, 5);
  code(0, 7);  // end of block
  while (count != 0) bit(0);
  out.plain_bytes = 1 + 258 * matches;
  const std::string zeros(258, '\0');
  out.plain_crc = crc32_of(std::string_view(zeros).substr(0, 1));
  for (uint32_t i = 0; i < matches; ++i) out.plain_crc = crc32_of(zeros, out.plain_crc);
  return out;
}

inline std::string zip_of(const std::vector<ZipEntry>& entries) {
  std::string out, directory;
  const auto put = [](std::string& to, uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) to += static_cast<char>(value >> (8 * i));
  };
  for (const ZipEntry& e : entries) {
    const uint32_t crc = e.deflated ? e.plain_crc : crc32_of(e.data);
    const uint64_t plain = e.deflated ? e.plain_bytes : e.data.size();
    const auto common = [&](std::string& to) {
      put(to, 20, 2), put(to, 0x800, 2), put(to, e.deflated ? 8 : 0, 2);  // version, UTF-8, method
      put(to, 0, 2), put(to, 0x5821, 2), put(to, crc, 4);
      put(to, e.data.size(), 4), put(to, plain, 4), put(to, e.name.size(), 2), put(to, 0, 2);
    };
    const uint64_t at = out.size();
    put(out, 0x04034b50, 4), common(out);
    out += e.name + e.data;
    put(directory, 0x02014b50, 4), put(directory, 20, 2), common(directory);
    put(directory, 0, 2), put(directory, 0, 2), put(directory, 0, 2), put(directory, 0, 4);
    put(directory, at, 4);
    directory += e.name;
  }
  const uint64_t at = out.size();
  out += directory;
  put(out, 0x06054b50, 4), put(out, 0, 4), put(out, entries.size(), 2), put(out, entries.size(), 2);
  put(out, directory.size(), 4), put(out, at, 4), put(out, 0, 2);
  return out;
}

}  // namespace luxodus::test
