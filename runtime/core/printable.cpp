#include "runtime/core/printable.hpp"

namespace luxodus {

namespace {

/// Bytes at `at` that form one control character; 0 where none begins.
size_t control_bytes(std::string_view text, size_t at) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(at) < 0x20 || byte(at) == 0x7F) return 1;
  if (byte(at) != 0xC2 || at + 1 == text.size()) return 0;
  return byte(at + 1) >= 0x80 && byte(at + 1) <= 0x9F ? 2 : 0;
}

}  // namespace

std::string printable(std::string_view text, std::string_view kept) {
  constexpr char digits[] = "0123456789ABCDEF";
  std::string out;
  for (size_t at = 0; at < text.size();) {
    const size_t bytes = control_bytes(text, at);
    if (bytes == 0 || kept.find(text[at]) != std::string_view::npos) {
      out += text[at++];
      continue;
    }
    for (const size_t end = at + bytes; at < end; ++at) {
      const auto byte = static_cast<unsigned char>(text[at]);
      out += {'\\', 'x', digits[byte / 16], digits[byte % 16]};
    }
  }
  return out;
}

}  // namespace luxodus
