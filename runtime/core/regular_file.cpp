#include "runtime/core/regular_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace luxodus {

namespace {

/// Bytes per read() call; Linux transfers at most 2 GiB.
constexpr size_t largest_read_bytes = size_t{1} << 30;

template <class Bytes>
Result<Bytes> read_all(const std::filesystem::path& path, uint64_t max_bytes) {
  auto file = open_regular_file(path);
  if (!file) return file.problem();
  const auto too_long = [&] {
    return problem_in(path, "this file is longer than " + std::to_string(max_bytes) +
                                " bytes, the most that is read from a file of its kind");
  };
  if (file->bytes > max_bytes) return too_long();
  // The size is only a hint: files of /proc report none, and any file may grow while it is read.
  Bytes bytes;
  size_t filled = 0;
  uint64_t wanted = file->bytes + 1;
  while (true) {
    if (filled == bytes.size()) {
      wanted = std::min(std::max<uint64_t>(wanted, filled + filled / 2 + 4096), max_bytes + 1);
      bytes.resize(static_cast<size_t>(wanted));
    }
    const ssize_t n = ::read(file->descriptor.number(), bytes.data() + filled,
                             std::min(bytes.size() - filled, largest_read_bytes));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return system_problem(path, "this file cannot be read", errno);
    if (n == 0) break;
    filled += static_cast<size_t>(n);
    if (filled > max_bytes) return too_long();
  }
  bytes.resize(filled);
  return bytes;
}

}  // namespace

Result<RegularFile> open_regular_file(const std::filesystem::path& path) {
  if (path.native().find('\0') != std::string::npos)
    return problem_in(path, "a path cannot hold a zero byte");
  // O_NONBLOCK: otherwise open() would wait for a pipe's writer before its type is checked.
  FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (!file.valid()) return system_problem(path, "this file cannot be read", errno);
  struct stat about {};
  if (::fstat(file.number(), &about) != 0)
    return system_problem(path, "this file cannot be read", errno);
  if (S_ISDIR(about.st_mode)) return system_problem(path, "this file cannot be read", EISDIR);
  if (!S_ISREG(about.st_mode))
    return problem_in(path,
                      "this is no file but a pipe, a socket or a device: copy what it gives into a "
                      "file, and name that");
  return RegularFile{std::move(file), static_cast<uint64_t>(about.st_size)};
}

Result<uint64_t> size_of_regular_file(const std::filesystem::path& path) {
  const auto file = open_regular_file(path);
  if (file) return file->bytes;
  if (file.problem().kind != ProblemKind::not_found) return file.problem();
  return problem_in(path, "there is no such file", ProblemKind::not_found);
}

Result<std::string> read_regular_file(const std::filesystem::path& path, uint64_t max_bytes) {
  return read_all<std::string>(path, max_bytes);
}

Result<std::vector<std::byte>> read_whole_file(const std::filesystem::path& path,
                                               uint64_t max_bytes) {
  return read_all<std::vector<std::byte>>(path, max_bytes);
}

}  // namespace luxodus
