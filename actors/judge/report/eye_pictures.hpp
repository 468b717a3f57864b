// Pictures for a report, from the eye and of the building on its cover, and the scene and scenario
// that they state. It traces nothing. Any thread.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace luxodus {

namespace limits {
/// Largest picture that a report includes [bytes].
inline constexpr uint64_t report_picture_bytes = uint64_t{16} << 20;
/// Largest number of pictures in a report; a camera has up to three.
inline constexpr size_t report_pictures = 60;
}  // namespace limits

/// The camera whose picture is the cover of a report; what a scene calls so takes its place.
inline constexpr const char* cover_camera = "cover";

/// A PNG picture for a report.
struct ReportPicture {
  std::string name;  // file name without ".png"
  std::string png;
};

/// Pictures of `luxodus run` and `render` in folder/run/views, else those of folder/views, by name.
std::vector<ReportPicture> pictures_in(const std::filesystem::path& folder);

/// The uncompressed text that a PNG stores under a key; none if there is none or if the bytes are
/// no PNG.
std::optional<std::string> png_text(std::string_view png, std::string_view key);

}  // namespace luxodus
