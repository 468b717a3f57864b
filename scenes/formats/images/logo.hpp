// Reads a project's logo for reports: see page_picture.hpp. Any thread.
#pragma once

#include <filesystem>
#include <string>

#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Size of a logo [bytes]: every report embeds it as text.
inline constexpr uint64_t logo_bytes = uint64_t{4} << 20;
/// Sides of a logo [pixels]: 12 cm at 400 dots per inch.
inline constexpr int logo_side = 2000;
}  // namespace limits

/// The bytes of a new PNG (sRGB, on white where the file is transparent).
/// Errors: the file is missing, larger than the limits, damaged, or not a PNG.
Result<std::string> read_logo(const std::filesystem::path& path);

}  // namespace luxodus
