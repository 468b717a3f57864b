// Text in photometric files: bytes of unknown encoding, numbers with commas or points, colour notes
// for people. Shared by the EULUMDAT and the IES reader. PhotometricNumbers is for one thread; all
// else are pure functions; any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

/// Reads all bytes of a file. Errors: `not_found`; it cannot be opened, is not a file, or is larger
/// than any luminaire's (16 MiB).
Result<std::string> read_photometric_bytes(const std::filesystem::path& path);

/// The text behind a byte order mark of UTF-8, where there is one.
std::string_view without_byte_order_mark(std::string_view text);

/// The lines of a text as UTF-8, without line ends: CRLF, LF, CR and CR CR LF end a line; a byte
/// order mark and a DOS end-of-file character are dropped; bytes that are not UTF-8 are read as
/// Latin-1. Errors: UTF-16, or a NUL byte: not a text.
Result<std::vector<std::string>> photometric_lines(std::string_view bytes, const std::string& file);

/// Strips blanks and line ends at both ends, and one pair of double quotes.
std::string_view bare(std::string_view text);

/// A finite decimal number that fills the whole text. `comma`: "2,5" is read as 2.5.
std::optional<double> decimal(std::string_view text, bool comma);

/// A number for messages: up to six digits, no padding.
std::string shown(double value);

/// Parses and checks the numbers of a photometric file. The first fault is kept; after it numbers
/// are 0.
class PhotometricNumbers {
 public:
  explicit PhotometricNumbers(std::string file) : file_(std::move(file)) {}

  void fail(int line, std::string what) { fail(problem_in(file_, line, std::move(what))); }
  void fail(Problem problem) {
    if (!fault_) fault_ = std::move(problem);
  }
  const std::optional<Problem>& fault() const { return fault_; }

  /// A number within limits. `comma`: as of decimal.
  double number(int line, std::string_view text, bool comma, const std::string& what, double low,
                double high);
  int whole(int line, double value, const std::string& what);

 private:
  std::string file_;
  std::optional<Problem> fault_;
};

/// Correlated colour temperature [K] in "4000 K", "3000", or a colour code such as "840".
std::optional<double> colour_temperature_k(std::string_view text);

/// Lower end of the general colour rendering index in "80-89", "Ra > 80", "1B", or a code such as
/// "840".
std::optional<double> colour_rendering(std::string_view text);

}  // namespace luxodus
