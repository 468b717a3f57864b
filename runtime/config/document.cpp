#include "runtime/config/document.hpp"

#include "runtime/core/regular_file.hpp"

namespace luxodus::config {

Result<std::string> text_of_file(const std::filesystem::path& file, size_t most_bytes) {
  return read_regular_file(file, most_bytes);
}

}  // namespace luxodus::config
