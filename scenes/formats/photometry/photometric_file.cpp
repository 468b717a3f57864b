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

/// The text without a byte order mark and blanks before it.
std::string_view from_first_sign(std::string_view bytes) {
  const std::string_view text = without_byte_order_mark(bytes);
  return text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
}

/// What a file is that is neither EULUMDAT nor LM-63, and what to do; none where it may be one.
std::optional<std::string> other_format(std::string_view bytes) {
  const std::string_view text = from_first_sign(bytes);
  if (text.starts_with("PK\x03\x04"))
    return "this is a ZIP archive; a GLDF container must have a name that ends with .gldf";
  const auto closes = [&](const char* mark) { return text.find(mark) != std::string_view::npos; };
  const bool xml = text.starts_with('<') && (closes("</") || closes("/>"));
  const bool json = text.starts_with('{') && closes("}");
  if (!xml && !json) return std::nullopt;
  constexpr size_t head_bytes = 1 << 16;
  const std::string_view head = text.substr(0, head_bytes);
  const auto names = [&](const char* word) { return head.find(word) != std::string_view::npos; };
  if (names("IESTM33") || names("IESTM-33") || names("TM-33") || names("LuminaireOpticalData"))
    return "this is ANSI/IES TM-33 (or ATLA S001, UNI 11733), which is not read: ask the maker for "
           "LM-63 (.ies) or EULUMDAT (.ldt)";
  return std::string("this is ") + (xml ? "XML" : "JSON") +
         ", and neither EULUMDAT nor IES LM-63: ask the maker for LM-63 (.ies) or EULUMDAT (.ldt)";
}

}  // namespace

Result<PhotometricFile> read_photometric_file(const std::filesystem::path& path,
                                              std::optional<int> lamp_set) {
  const Result<std::string> bytes = read_photometric_bytes(path);
  if (!bytes) return bytes.problem();
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  Result<PhotometricFile> file =
      extension == ".ies" && !other_format(bytes.value())
          ? read_ies(bytes.value(), path.string(), path.parent_path())
          : photometric_file_of(bytes.value(), path.string(), path.parent_path(), lamp_set);
  if (file) file->files_read.insert(file->files_read.begin(), path);
  return file;
}

Result<PhotometricFile> photometric_file_of(std::string_view bytes, const std::string& file,
                                            const std::filesystem::path& folder,
                                            std::optional<int> lamp_set) {
  if (auto other = other_format(bytes)) return problem_in(file, 1, std::move(*other));
  return has_tilt_line(bytes) ? read_ies(bytes, file, folder) : read_ldt(bytes, file, lamp_set);
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
