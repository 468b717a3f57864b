// Pictures from the eye that a report takes in, and what they say they show. Any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace luxodus {

namespace limits {
/// Largest picture that a report takes in [bytes].
inline constexpr uint64_t report_picture_bytes = uint64_t{16} << 20;
/// Pictures that a report takes in; cameras have up to three each.
inline constexpr size_t report_pictures = 60;
}  // namespace limits

/// A PNG picture that stands in a report.
struct ReportPicture {
  std::string name;  // of its file, without ".png"
  std::string png;
};

/// Pictures of `luxodus run` and `render` in folder/views and folder/run/views, by name.
std::vector<ReportPicture> pictures_in(const std::filesystem::path& folder);

/// The text that a PNG keeps under a key, uncompressed; none where there is none, or where the
/// bytes are no PNG.
std::optional<std::string> png_text(std::string_view png, std::string_view key);

}  // namespace luxodus
