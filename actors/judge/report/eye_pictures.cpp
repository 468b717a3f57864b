#include "actors/judge/report/eye_pictures.hpp"

#include <algorithm>

#include "runtime/core/regular_file.hpp"

namespace luxodus {

namespace {

uint32_t big_endian(std::string_view bytes) {
  uint32_t out = 0;
  for (const char c : bytes.substr(0, 4)) out = out << 8 | static_cast<unsigned char>(c);
  return out;
}

/// Parses an iTXt chunk after its key: compression, language, translated key, text.
std::optional<std::string> international_text(std::string_view rest) {
  if (rest.size() < 2 || rest[0] != '\0') return std::nullopt;
  rest.remove_prefix(2);
  for (int skipped = 0; skipped < 2; ++skipped) {
    const size_t end = rest.find('\0');
    if (end == std::string_view::npos) return std::nullopt;
    rest.remove_prefix(end + 1);
  }
  return std::string(rest);
}

}  // namespace

std::optional<std::string> png_text(std::string_view png, std::string_view key) {
  constexpr std::string_view signature("\x89PNG\r\n\x1a\n", 8);
  if (!png.starts_with(signature)) return std::nullopt;
  png.remove_prefix(signature.size());
  while (png.size() >= 12) {  // length, kind, checksum
    const size_t length = big_endian(png);
    const std::string_view kind = png.substr(4, 4);
    if (length > png.size() - 12) return std::nullopt;
    const std::string_view data = png.substr(8, length);
    png.remove_prefix(12 + length);
    if (kind != "tEXt" && kind != "iTXt") continue;
    const size_t end = data.find('\0');
    if (end == std::string_view::npos || data.substr(0, end) != key) continue;
    const std::string_view rest = data.substr(end + 1);
    return kind == "tEXt" ? std::string(rest) : international_text(rest);
  }
  return std::nullopt;
}

std::vector<ReportPicture> pictures_in(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::vector<ReportPicture> out;
  for (const fs::path& views : {folder / "run" / "views", folder / "views"}) {
    std::error_code failed;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(views, failed))
      if (entry.path().extension() == ".png" && entry.is_regular_file(failed) &&
          entry.file_size(failed) <= limits::report_picture_bytes)
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& path : files) {
      const auto bytes = read_whole_file(path, limits::report_picture_bytes);
      if (bytes && out.size() < limits::report_pictures)
        out.push_back({path.stem().string(),
                       std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size())});
    }
    if (!out.empty()) break;
  }
  return out;
}

}  // namespace luxodus
