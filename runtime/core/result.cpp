#include "runtime/core/result.hpp"

namespace luxodus {

namespace {

/// Bytes at `at` that form one control character: 1 for those of ASCII, 2 for those that UTF-8
/// spells as C2 80 to C2 9F (some terminals take C2 9B for "escape ["), otherwise 0.
size_t control_bytes(const std::string& text, size_t at) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(at) < 0x20 || byte(at) == 0x7F) return 1;
  if (byte(at) != 0xC2 || at + 1 == text.size()) return 0;
  return byte(at + 1) >= 0x80 && byte(at + 1) <= 0x9F ? 2 : 0;
}

std::string without_controls(const std::string& text) {
  constexpr char digits[] = "0123456789ABCDEF";
  std::string out;
  for (size_t at = 0; at < text.size();) {
    const size_t bytes = control_bytes(text, at);
    if (bytes == 0) out += text[at++];
    for (const size_t end = at + bytes; at < end && bytes > 0; ++at) {
      const auto byte = static_cast<unsigned char>(text[at]);
      out += {'\\', 'x', digits[byte / 16], digits[byte % 16]};
    }
  }
  return out;
}

}  // namespace

std::string Problem::text() const {
  std::string out = where.file;
  if (where.line > 0) out += ":" + std::to_string(where.line);
  return without_controls(out.empty() ? what : out + ": " + what);
}

}  // namespace luxodus
