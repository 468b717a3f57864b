#include "scenes/light/world/files_as_read.hpp"

#include <unistd.h>
#include <xxhash.h>

#include <array>
#include <cerrno>
#include <memory>

#include "runtime/core/regular_file.hpp"

namespace luxodus {

namespace {

Problem changed_since(const std::string& path) {
  return problem_in(path, "the scene has changed on disk since it was opened: open it again");
}

}  // namespace

std::optional<uint64_t> FilesAsRead::hash_of(const std::string& path) const {
  const auto at = files_.find(path);
  return at == files_.end() ? std::nullopt : std::optional(at->second.hash);
}

Result<void> FilesAsRead::unchanged_on_disk() const {
  for (const auto& [path, file] : files_) {
    if (file.stamp.same_as(stamp_at(path))) continue;
    if (const auto now = hash_of_file(path); !now || now.value() != file.hash)
      return changed_since(path);
  }
  return {};
}

Result<void> FilesAsRead::unchanged_in(const FilesAsRead& later) const {
  for (const auto& [path, file] : files_)
    if (const auto now = later.hash_of(path); now && *now != file.hash) return changed_since(path);
  return {};
}

Result<uint64_t> hash_of_file(const std::string& path) {
  auto file = open_regular_file(path);
  if (!file) return file.problem();
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                       &XXH3_freeState);
  XXH3_64bits_reset(state.get());
  std::array<char, 65536> part;
  ssize_t n = 0;
  while ((n = ::read(file->descriptor.number(), part.data(), part.size())) > 0)
    XXH3_64bits_update(state.get(), part.data(), static_cast<size_t>(n));
  if (n < 0) return system_problem(path, "cannot be read", errno);
  return static_cast<uint64_t>(XXH3_64bits_digest(state.get()));
}

}  // namespace luxodus
