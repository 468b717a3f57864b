// Text as photometric files carry it: bytes of unknown age and encoding, numbers with commas or
// points, colour notes for people. Shared by the EULUMDAT and the IES reader. Pure functions; any
// thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

/// All bytes of a file. Errors: it cannot be opened, is no file, or is larger than any luminaire
/// (16 MiB).
Result<std::string> read_photometric_bytes(const std::filesystem::path& path);

/// The lines of a text as UTF-8, without line ends: CRLF, LF and CR end a line, a UTF-8 mark and a
/// DOS end-of-file sign are dropped, bytes that are no UTF-8 are taken for Latin-1. Errors: UTF-16,
/// or a NUL byte: not a text.
Result<std::vector<std::string>> photometric_lines(std::string_view bytes, const std::string& file);

/// Without blanks at both ends, and without one pair of double quotes around it.
std::string_view bare(std::string_view text);

/// A finite decimal number that fills the whole text. `comma`: "2,5" is read as 2.5.
std::optional<double> decimal(std::string_view text, bool comma);

/// A number for messages: up to six digits, no padding.
std::string shown(double value);

/// Correlated colour temperature [K] in "4000 K", "3000", or a colour code such as "840".
std::optional<double> colour_temperature_k(std::string_view text);

/// Lower end of the general colour rendering index in "80-89", "Ra > 80", "1B", or a code such as
/// "840".
std::optional<double> colour_rendering(std::string_view text);

}  // namespace luxodus
