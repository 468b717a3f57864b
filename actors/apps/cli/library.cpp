#include "actors/apps/cli/library.hpp"

#include <system_error>

namespace luxodus::cli {

namespace fs = std::filesystem;

fs::path shared_folder() {
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  return (program.parent_path() / "../share/luxodus").lexically_normal();
}

std::string find_scene(const std::string& name) {
  std::error_code ignored;
  if (name.empty() || fs::path(name).is_absolute() || fs::exists(name, ignored)) return name;
  const fs::path shared = shared_folder();
  for (const fs::path& file : {shared / "scenes/library" / (name + ".toml"),
                               shared / "scenes/library" / name, shared / name})
    if (fs::is_regular_file(file, ignored)) return file.string();
  return name;
}

}  // namespace luxodus::cli
