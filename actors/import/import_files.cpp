#include "actors/import/import_files.hpp"

#include <fmt/format.h>

#include "runtime/core/atomic_file.hpp"
#include "runtime/core/output_path.hpp"
#include "runtime/core/printable.hpp"

namespace luxodus {

namespace fs = std::filesystem;

std::string toml_text(std::string_view text) {
  std::string out = "\"";
  for (size_t i = 0; i < text.size();) {
    const size_t length = utf8_length(text.substr(i));
    const auto c = static_cast<unsigned char>(text[i]);
    if (length == 0) {
      out += '?';  // not UTF-8, so not allowed in TOML
    } else if (c < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", c);
    } else if (c == '"' || c == '\\') {
      out += '\\';
      out += static_cast<char>(c);
    } else {
      out += text.substr(i, length);
    }
    i += length == 0 ? 1 : length;
  }
  return out + "\"";
}

std::string as_name(std::string_view text, std::string_view otherwise) {
  constexpr size_t most = 120;
  std::string out;
  for (size_t i = 0; i < text.size() && out.size() < most;) {
    const size_t length = utf8_length(text.substr(i));
    const auto c = static_cast<unsigned char>(text[i]);
    const bool control = c < 0x20 || c == 0x7f || c == 0xc2;
    if (length == 0 || (control && length <= 2) || c == '"' || c == '\'' || c == '/' || c == '\\')
      out += '-';
    else
      out += text.substr(i, length);
    i += length == 0 ? 1 : length;
  }
  const size_t from = out.find_first_not_of(" .");
  const size_t to = out.find_last_not_of(' ');
  return from == std::string::npos ? std::string(otherwise) : out.substr(from, to - from + 1);
}

Result<std::string> quoted_from(const fs::path& folder, const fs::path& file) {
  std::error_code failed;
  const fs::path relative = fs::proximate(file, folder, failed);
  const std::string name = (failed ? fs::absolute(file) : relative).generic_string();
  if (name.find_first_of("\"\\\n") != std::string::npos)
    return problem_in(file, "a path with quotes, backslashes or line ends is not imported");
  return "\"" + name + "\"";
}

Result<fs::path> import_folder(const std::string& out) {
  const fs::path folder = behind_links(fs::path(out) / ".").parent_path();
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (!fs::is_directory(folder, failed))
    return problem_in(folder.string(), "this is no folder, and none can be made there");
  return folder;
}

Result<bool> write_unless_there(const fs::path& file, const std::string& text) {
  std::error_code failed;
  if (fs::exists(fs::symlink_status(file, failed))) return true;
  if (auto ok = write_file_atomically(file, std::string_view(text)); !ok) return ok.problem();
  return false;
}

}  // namespace luxodus
