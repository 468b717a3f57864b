#include "scenes/formats/photometry/photometric_text.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

#include "runtime/core/printable.hpp"
#include "runtime/core/regular_file.hpp"

namespace luxodus {
namespace {

// The largest sensible web (0.5 degree steps all around) is 3 MB of text; a file 10 times as large
// is of another kind.
constexpr std::uintmax_t max_file_bytes = 16u << 20;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\n' || c == '\r';
}

bool is_utf8(std::string_view text) {
  for (size_t i = 0; i < text.size();) {
    const size_t length = utf8_length(text.substr(i));
    if (length == 0) return false;
    i += length;
  }
  return true;
}

std::string from_latin1(std::string_view text) {
  std::string out;
  for (char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x80) {
      out += c;
    } else {
      out += static_cast<char>(0xC0 | (code >> 6));
      out += static_cast<char>(0x80 | (code & 0x3F));
    }
  }
  return out;
}

/// The runs of digits in a text, each with its start; fractions are not split off.
struct DigitRun {
  size_t start;
  size_t length;
  int value;
};

std::vector<DigitRun> digit_runs(std::string_view text) {
  std::vector<DigitRun> runs;
  for (size_t i = 0; i < text.size();) {
    if (!is_digit(text[i])) {
      ++i;
      continue;
    }
    const size_t start = i;
    while (i < text.size() && is_digit(text[i])) ++i;
    int value = -1;
    if (i - start <= 6) std::from_chars(text.data() + start, text.data() + i, value);
    runs.push_back({start, i - start, value});
  }
  return runs;
}

/// "840": rendering 80, colour 4000 K (the usual lamp code); the range excludes article numbers.
bool is_colour_code(const DigitRun& run) {
  const int colour = run.value % 100;
  return run.length == 3 && run.value >= 600 && colour >= 18 && colour <= 80;
}

}  // namespace

Result<std::string> read_photometric_bytes(const std::filesystem::path& path) {
  const SourcePlace place{path.string(), 0};
  const auto size = size_of_regular_file(path);
  if (!size && size.problem().kind == ProblemKind::not_found)
    return problem_in(place, "no such photometric file; check the path, it is taken from the scene",
                      ProblemKind::not_found);
  if (!size) return size.problem();
  if (size.value() > max_file_bytes) {
    return problem_in(place,
                      "the file is larger than 16 MiB, more than any photometric file needs");
  }
  return read_regular_file(path, max_file_bytes);
}

std::string_view without_byte_order_mark(std::string_view text) {
  return text.substr(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
}

Result<std::vector<std::string>> photometric_lines(std::string_view bytes,
                                                   const std::string& file) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    return problem_in(file, 1, "the text is UTF-16; save it as UTF-8 or Latin-1");
  }
  bytes = without_byte_order_mark(bytes);
  const bool utf8 = is_utf8(bytes);
  std::vector<std::string> lines;
  size_t start = 0;
  for (size_t i = 0; i <= bytes.size(); ++i) {
    if (i < bytes.size() && bytes[i] == '\0') {
      return problem_in(file, static_cast<int>(lines.size()) + 1,
                        "a NUL byte: this is no text file; export it again as plain text");
    }
    const bool end = i == bytes.size() || bytes[i] == '\x1A';  // 1A: DOS end of file
    if (!end && bytes[i] != '\n' && bytes[i] != '\r') continue;
    const std::string_view line = bytes.substr(start, i - start);
    if (!end || !line.empty()) lines.push_back(utf8 ? std::string(line) : from_latin1(line));
    if (end) break;
    // Copying in text mode between systems turns CR LF into CR CR LF: one end, not an empty line.
    const std::string_view rest = bytes.substr(i);
    if (rest.starts_with("\r\r\n"))
      i += 2;
    else if (rest.starts_with("\r\n"))
      ++i;
    start = i + 1;
  }
  return lines;
}

std::string_view bare(std::string_view text) {
  const auto strip = [&text] {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  };
  strip();
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
    text = text.substr(1, text.size() - 2);
    strip();
  }
  return text;
}

std::optional<double> decimal(std::string_view text, bool comma) {
  std::string digits(bare(text));
  if (comma && digits.find('.') == std::string::npos) {
    const size_t at = digits.find(',');
    if (at != std::string::npos) digits[at] = '.';
  }
  if (digits.starts_with('+')) digits.erase(0, 1);
  double value = 0;
  const char* end = digits.data() + digits.size();
  const auto [rest, error] = std::from_chars(digits.data(), end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string shown(double value) {
  char buffer[32];
  const auto [end, error] =
      std::to_chars(buffer, buffer + sizeof(buffer), value, std::chars_format::general, 6);
  return error == std::errc() ? std::string(buffer, end) : std::string("?");
}

double PhotometricNumbers::number(int line, std::string_view text, bool comma,
                                  const std::string& what, double low, double high) {
  if (fault_) return 0;
  const std::optional<double> value = decimal(text, comma);
  if (value && *value >= low && *value <= high) return *value;
  fail(line, what + (value ? " must lie between " + shown(low) + " and " + shown(high) + ", not " +
                                 shown(*value)
                           : " must be a number"));
  return 0;
}

int PhotometricNumbers::whole(int line, double value, const std::string& what) {
  if (!fault_ && value != std::floor(value))
    fail(line, what + " must be a whole number, not " + shown(value));
  return static_cast<int>(value);
}

std::optional<double> colour_temperature_k(std::string_view text) {
  const std::vector<DigitRun> runs = digit_runs(text);
  for (const DigitRun& run : runs) {
    // 1000 K is barely glowing, 20000 K is the bluest sky.
    if (run.value >= 1000 && run.value <= 20000) return run.value;
  }
  for (const DigitRun& run : runs) {
    if (is_colour_code(run)) return 100.0 * (run.value % 100);
  }
  return std::nullopt;
}

std::optional<double> colour_rendering(std::string_view text) {
  text = bare(text);
  const std::vector<DigitRun> runs = digit_runs(text);
  // Groups of CIE 29.2: 1A Ra >= 90, 1B >= 80, 2A >= 70, 2B >= 60, 3 >= 40, 4 >= 20.
  if (!runs.empty() && runs.front().start == 0 && runs.front().length == 1) {
    const bool lower_half = text.size() > 1 && (text[1] == 'B' || text[1] == 'b');
    switch (runs.front().value) {
      case 1:
        return lower_half ? 80 : 90;
      case 2:
        return lower_half ? 60 : 70;
      case 3:
        return 40;
      case 4:
        return 20;
      default:
        return std::nullopt;
    }
  }
  for (const DigitRun& run : runs) {
    if (run.value >= 20 && run.value <= 100) return run.value;
    if (is_colour_code(run)) return 10.0 * (run.value / 100);
  }
  return std::nullopt;
}

}  // namespace luxodus
