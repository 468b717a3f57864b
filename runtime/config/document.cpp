#include "runtime/config/document.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

namespace luxodus::config {

Result<std::string> text_of_file(const std::filesystem::path& file, size_t most_bytes) {
  std::error_code failed;
  if (std::filesystem::is_directory(file, failed))
    return Problem{{file.string(), 0}, "is a folder"};
  std::ifstream in(file, std::ios::binary);
  if (!in)
    return Problem{{file.string(), 0}, std::string("cannot be read: ") + std::strerror(errno)};
  // One byte more than is allowed shows that there is too much, whatever the file says of its size.
  std::string text(most_bytes + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) return Problem{{file.string(), 0}, "cannot be read to its end"};
  text.resize(static_cast<size_t>(in.gcount()));
  return text;
}

}  // namespace luxodus::config
