#include "scenes/formats/photometry/photometric_file.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "scenes/formats/photometry/ies.hpp"
#include "scenes/formats/photometry/ldt.hpp"
#include "scenes/formats/photometry/photometric_text.hpp"

namespace luxodus {
namespace {

/// Every IES file has a line that starts with TILT=; no field of an EULUMDAT file does.
bool has_tilt_line(std::string_view bytes) {
  constexpr std::string_view key = "TILT=";
  const auto same = [](char a, char b) { return std::toupper(static_cast<unsigned char>(a)) == b; };
  for (auto from = bytes.begin();;) {
    const auto at = std::search(from, bytes.end(), key.begin(), key.end(), same);
    if (at == bytes.end()) return false;
    auto before = at;
    while (before != bytes.begin() && (before[-1] == ' ' || before[-1] == '\t')) --before;
    if (before == bytes.begin() || before[-1] == '\n' || before[-1] == '\r') return true;
    from = at + 1;
  }
}

}  // namespace

Result<PhotometricFile> read_photometric_file(const std::filesystem::path& path) {
  const Result<std::string> bytes = read_photometric_bytes(path);
  if (!bytes) return bytes.problem();
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  Result<PhotometricFile> file =
      extension == ".ies" ? read_ies(bytes.value(), path.string(), path.parent_path())
                          : photometric_file_of(bytes.value(), path.string(), path.parent_path());
  if (file) file->files_read.insert(file->files_read.begin(), path);
  return file;
}

Result<PhotometricFile> photometric_file_of(std::string_view bytes, const std::string& file,
                                            const std::filesystem::path& folder) {
  return has_tilt_line(bytes) ? read_ies(bytes, file, folder) : read_ldt(bytes, file);
}

std::optional<std::string> odd_efficacy(const PhotometricFile& file) {
  // White light has at most about 330 lm/W; the best luminaires reach 220.
  constexpr double max_lm_per_w = 300;
  if (!(file.input_watts > 0) || file.flux_lm / file.input_watts <= max_lm_per_w)
    return std::nullopt;
  return "the intensities add up to " + shown(file.flux_lm) + " lm with " +
         shown(file.input_watts) + " W, more than any lamp gives: is a factor of the file wrong?";
}

}  // namespace luxodus
