#include "runtime/core/printable.hpp"

#include <algorithm>
#include <cstdint>

namespace luxodus {

namespace {

/// Number of bytes at `at` that form one control character; 0 if there is none.
size_t control_bytes(std::string_view text, size_t at) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(at) < 0x20 || byte(at) == 0x7F) return 1;
  if (byte(at) != 0xC2 || at + 1 == text.size()) return 0;
  return byte(at + 1) >= 0x80 && byte(at + 1) <= 0x9F ? 2 : 0;
}

void add_escaped(std::string& out, std::string_view bytes) {
  constexpr char digits[] = "0123456789ABCDEF";
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    out += {'\\', 'x', digits[byte / 16], digits[byte % 16]};
  }
}

}  // namespace

std::string printable(std::string_view text, std::string_view kept) {
  std::string out;
  for (size_t at = 0; at < text.size();) {
    const size_t bytes = control_bytes(text, at);
    if (bytes == 0 || kept.find(text[at]) != std::string_view::npos) {
      out += text[at++];
      continue;
    }
    add_escaped(out, text.substr(at, bytes));
    at += bytes;
  }
  return out;
}

size_t utf8_length(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<uint8_t>(text[i]); };
  const auto continues = [&](size_t i, uint8_t low = 0x80, uint8_t high = 0xBF) {
    return i < text.size() && byte(i) >= low && byte(i) <= high;
  };
  const uint8_t first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return continues(1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    const uint8_t low = first == 0xE0 ? 0xA0 : 0x80;
    const uint8_t high = first == 0xED ? 0x9F : 0xBF;
    return continues(1, low, high) && continues(2) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    const uint8_t low = first == 0xF0 ? 0x90 : 0x80;
    const uint8_t high = first == 0xF4 ? 0x8F : 0xBF;
    return continues(1, low, high) && continues(2) && continues(3) ? 4 : 0;
  }
  return 0;
}

std::string excerpt(std::string_view text, size_t max_bytes) {
  std::string out;
  for (size_t at = 0; at < text.size();) {
    const size_t control = control_bytes(text, at);
    const size_t character = utf8_length(text.substr(at));
    const size_t bytes = std::max({control, character, size_t{1}});
    if (at + bytes > max_bytes) return out + "...";
    if (control > 0 || character == 0)
      add_escaped(out, text.substr(at, bytes));
    else
      out += text.substr(at, bytes);
    at += bytes;
  }
  return out;
}

}  // namespace luxodus
