#include "runtime/core/output_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "runtime/core/printable.hpp"

namespace luxodus {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD

}  // namespace

std::string shortest_number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  std::array<char, 40> buffer;  // the longest shortest form of a double has 24 characters
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end.ptr};
}

std::string power_of_ten(int exponent) {
  using Digits = std::array<std::string_view, 10>;
  static constexpr Digits superscripts = {"⁰", "¹", "²", "³", "⁴",  // 0..4
                                          "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = "10";
  for (const char c : std::to_string(exponent)) {
    out += c == '-' ? std::string_view("⁻") : superscripts[static_cast<size_t>(c - '0')];
  }
  return out;
}

std::string readable_number(double value, int digits) {
  if (std::isnan(value)) return "no value";
  if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
  if (value == 0) return "0";
  digits = std::clamp(digits, 1, 9);
  std::array<char, 40> buffer;
  const auto scientific = std::to_chars(buffer.data(), buffer.data() + buffer.size(),
                                        std::abs(value), std::chars_format::scientific, digits - 1);
  std::string mantissa(buffer.data(), scientific.ptr);
  const size_t e = mantissa.find('e');
  const int exponent = std::stoi(mantissa.substr(e + 1));
  mantissa.resize(e);
  const std::string sign = value < 0 ? "−" : "";
  const auto without_zeros = [](std::string text) {
    if (text.find('.') == std::string::npos) return text;
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
  };
  if (exponent < -3 || exponent > 4) {
    return sign + without_zeros(mantissa) + "·" + power_of_ten(exponent);
  }
  // Rounded to significant digits first, so that 1234 becomes 1230.
  const double rounded = std::stod(mantissa + "e" + std::to_string(exponent));
  const auto fixed = std::to_chars(buffer.data(), buffer.data() + buffer.size(), rounded,
                                   std::chars_format::fixed, std::max(0, digits - 1 - exponent));
  return sign + without_zeros({buffer.data(), fixed.ptr});
}

std::string clean_utf8(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const size_t length = utf8_length(text);
    const auto first = static_cast<uint8_t>(text[0]);
    const bool control = (first < 0x20 && first != '\t' && first != '\n') || first == 0x7F;
    out += length == 0 || control ? replacement : text.substr(0, length);
    text.remove_prefix(std::max<size_t>(length, 1));
  }
  return out;
}

std::string xml_escape(std::string_view text) {
  std::string out;
  for (const char c : clean_utf8(text)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&apos;";
        break;
      case '\t':
        out += "&#9;";
        break;
      case '\n':
        out += "&#10;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace luxodus
