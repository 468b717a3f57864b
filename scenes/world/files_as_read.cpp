#include "scenes/world/files_as_read.hpp"

#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <memory>

#include "runtime/core/regular_file.hpp"

namespace luxodus {

namespace {

Problem changed_since(const std::string& path) {
  return problem_in(path, "the scene has changed on disk since it was opened: open it again");
}

FileStamp stamp_from(const struct stat& is) {
  using namespace std::chrono;
  // Times of files come in steps, the coarsest that are known of 2 s.
  constexpr int64_t coarsest_ns = 2'000'000'000, second_ns = 1'000'000'000;
  const int64_t now = nanoseconds(system_clock::now().time_since_epoch()).count();
  FileStamp out;
  out.device = is.st_dev;
  out.inode = is.st_ino;
  out.bytes = static_cast<uint64_t>(is.st_size);
  out.changed_ns = is.st_ctim.tv_sec * second_ns + is.st_ctim.tv_nsec;
  out.sure = now - out.changed_ns > coarsest_ns;
  return out;
}

FileStamp stamp_at(const std::string& path) {
  struct stat is {};
  return ::stat(path.c_str(), &is) == 0 ? stamp_from(is) : FileStamp{};
}

}  // namespace

std::optional<uint64_t> FilesAsRead::hash_of(const std::string& path) const {
  const auto at = files_.find(path);
  return at == files_.end() ? std::nullopt : std::optional(at->second.hash);
}

std::optional<Problem> FilesAsRead::change_on_disk() const {
  for (const auto& [path, file] : files_) {
    if (file.stamp.same_as(stamp_at(path))) continue;
    if (const auto now = hash_of_file(path); !now || now.value() != file.hash)
      return changed_since(path);
  }
  return std::nullopt;
}

std::optional<Problem> FilesAsRead::change_in(const FilesAsRead& later) const {
  for (const auto& [path, file] : files_)
    if (const auto now = later.hash_of(path); now && *now != file.hash) return changed_since(path);
  return std::nullopt;
}

FileStamp stamp_of(int descriptor) {
  struct stat is {};
  return ::fstat(descriptor, &is) == 0 ? stamp_from(is) : FileStamp{};
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
