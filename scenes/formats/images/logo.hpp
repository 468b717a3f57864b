// The logo of a project, as a report embeds it: see page_picture.hpp. Any thread.
#pragma once

#include <filesystem>
#include <string>

#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Of a logo [bytes]: it stands in every report as text.
inline constexpr uint64_t logo_bytes = uint64_t{4} << 20;
/// Of a logo [pixels]: 12 cm wide at 400 dots per inch.
inline constexpr int logo_side = 2000;
}  // namespace limits

/// The bytes of a new PNG (sRGB, on white where the file is transparent).
/// Errors: a file that is missing, larger than the limits, damaged, or no PNG.
Result<std::string> read_logo(const std::filesystem::path& path);

}  // namespace luxodus
