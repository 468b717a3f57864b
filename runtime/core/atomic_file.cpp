// Order of steps, and why: (1) open the folder, so that it can be synced later and cannot be
// swapped meanwhile; (2) create a file in it that has no name (O_TMPFILE), so that nothing is left
// of a process that is killed; (3) write, fsync: the data is on the disk before any name points to
// it; (4) give it a temporary name and rename that over the target; (5) fsync the folder: the name
// is on the disk. Until (4) the target is untouched.
// Where the file system does not support O_TMPFILE, the file has a temporary name from step (2) on,
// and every failure removes it. A process that is killed leaves it behind; the file is locked while
// its writer lives, so that others can tell which are stale.
#include "runtime/core/atomic_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include "runtime/core/file_descriptor.hpp"
#include "runtime/core/output_path.hpp"

namespace luxodus {
namespace {

// A stale temporary file of a crashed process with our process id costs one attempt each.
constexpr int max_temporary_name_attempts = 1000;
// Linux transfers at most 2^31 - 4096 bytes per call; smaller pieces answer signals sooner.
constexpr size_t transfer_bytes = size_t{1} << 26;
constexpr std::string_view temporary_prefix = ".luxodus-", temporary_suffix = ".tmp";

/// Advice for a file that cannot be written, by errno.
std::string_view advice(int error) {
  switch (error) {
    case ENOENT:
      return "; create the folder first or correct the path";
    case EACCES:
    case EPERM:
      return "; choose a place you may write to";
    case ENOSPC:
    case EDQUOT:
      return "; free some space or choose another disk";
    case EROFS:
      return "; choose a place on a writable disk";
    case ENAMETOOLONG:
      return "; choose a shorter name";
    case ENOTDIR:
      return "; a part of the path is a file, not a folder";
    default:
      return "";
  }
}

Problem write_problem(const std::filesystem::path& path, int error) {
  Problem problem = system_problem(path, "cannot write this file", error);
  problem.what += advice(error);
  return problem;
}

bool holds_nul(const std::filesystem::path& path) {
  return path.native().find('\0') != std::string::npos;
}

/// Writes all bytes. Returns 0 or the errno.
int write_all(int fd, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), std::min(bytes.size(), transfer_bytes));
    if (n < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    bytes = bytes.subspan(static_cast<size_t>(n));
  }
  return 0;
}

/// Writes all bytes at an offset; the file position does not move. Returns 0 or the errno.
int write_all_at(int fd, uint64_t offset, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::pwrite(fd, bytes.data(), std::min(bytes.size(), transfer_bytes),
                               static_cast<off_t>(offset));
    if (n < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    offset += static_cast<uint64_t>(n);
    bytes = bytes.subspan(static_cast<size_t>(n));
  }
  return 0;
}

/// The file to be replaced; `mode` is set if it exists.
struct Target {
  std::filesystem::path path;
  mode_t mode = 0;
  bool exists = false;
};

Result<Target> find_target(const std::filesystem::path& path) {
  Target target{path, 0, false};
  struct stat about {};
  if (::lstat(path.c_str(), &about) != 0) {
    if (errno == ENOENT) return target;
    return write_problem(path, errno);
  }
  if (auto ok = can_be_replaced(about); !ok) return problem_in(path, ok.problem());
  target.mode = about.st_mode & 0777;
  target.exists = true;
  return target;
}

/// Opens the folder of a file without following a link in its place: results may lie in subfolders,
/// and a link among them would lead out of the folder that the user named.
Result<int> open_parent(const std::filesystem::path& path) {
  std::filesystem::path parent = path.parent_path();
  if (parent.empty()) parent = ".";
  const int folder = ::open(parent.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder >= 0) return folder;
  const int error = errno;
  struct stat about {};
  if (::lstat(parent.c_str(), &about) == 0 && S_ISLNK(about.st_mode))
    return problem_in(path,
                      "its folder is a symbolic link, and links are not followed; name the "
                      "folder that it leads to");
  return write_problem(path, error);
}

/// A temporary name. It does not contain the target's name, which may already be of the maximum
/// length.
std::string next_temporary_name() {
  static std::atomic<uint64_t> counter{0};
  std::string name(temporary_prefix);
  name += std::to_string(::getpid()) + "-" + std::to_string(counter++);
  return name.append(temporary_suffix);
}

/// Makes a new file in the folder, without a name if possible; otherwise sets `name`. Returns the
/// descriptor, or -1 with errno set.
int create_temporary(int folder, std::string& name) {
  name.clear();
  const int unnamed = ::openat(folder, ".", O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  // EISDIR: a kernel that does not know the flag.
  if (unnamed >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL)) return unnamed;
  for (int attempt = 0; attempt < max_temporary_name_attempts; ++attempt) {
    name = next_temporary_name();
    const int fd = ::openat(folder, name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd < 0 && errno == EEXIST) continue;
    // Between open and flock, a cleaner of stale files may have removed it.
    struct stat about {};
    if (fd < 0 || ::flock(fd, LOCK_EX | LOCK_NB) != 0 || ::fstat(fd, &about) != 0 ||
        about.st_nlink > 0)
      return fd;
    ::close(fd);
  }
  name.clear();
  return -1;
}

/// Gives an unnamed file a temporary name. Returns 0 or the errno.
int name_file(int fd, int folder, std::string& name) {
  const std::string handle = "/proc/self/fd/" + std::to_string(fd);
  for (int attempt = 0; attempt < max_temporary_name_attempts; ++attempt) {
    const std::string fresh = next_temporary_name();
    if (::linkat(AT_FDCWD, handle.c_str(), folder, fresh.c_str(), AT_SYMLINK_FOLLOW) == 0) {
      name = fresh;
      return 0;
    }
    if (errno != EEXIST) return errno;
  }
  return EEXIST;
}

}  // namespace

Result<void> can_be_replaced(const struct stat& about) {
  if (S_ISREG(about.st_mode)) return {};
  if (S_ISLNK(about.st_mode))
    return problem(
        "this is a symbolic link, and links are not followed; remove it, or name the file that "
        "it leads to");
  if (S_ISDIR(about.st_mode)) return problem("this is a folder; name a file in it");
  return problem("this is a device or a pipe; only regular files are written");
}

/// Everything that is open while a file is being written.
struct AtomicFile::State {
  State(std::filesystem::path path, Target found, int folder_fd)
      : asked_for(std::move(path)), target(std::move(found)), folder(folder_fd) {}
  ~State() {
    if (!temporary.empty()) ::unlinkat(folder.number(), temporary.c_str(), 0);
  }

  std::filesystem::path asked_for;
  Target target;
  FileDescriptor folder;
  FileDescriptor file;
  std::string temporary;  // empty while it has no name, and once it has the target's
  int failed = 0;         // errno of the first piece that could not be written
};

AtomicFile::AtomicFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
AtomicFile::AtomicFile(AtomicFile&&) noexcept = default;
AtomicFile::~AtomicFile() = default;

Result<AtomicFile> AtomicFile::create(const std::filesystem::path& path) {
  if (path.empty() || path.filename().empty()) {
    return problem_in(path, "no file is named here; add a file name to the path");
  }
  if (holds_nul(path)) return problem_in(path, "a path cannot hold a zero byte");
  Result<Target> target = find_target(path);
  if (!target) return target.problem();

  const Result<int> folder = open_parent(path);
  if (!folder) return folder.problem();
  auto state = std::make_unique<State>(path, std::move(target).value(), folder.value());
  std::string name;
  const int fd = create_temporary(folder.value(), name);
  if (fd < 0) return write_problem(path, errno);
  state->file = FileDescriptor(fd);
  state->temporary = std::move(name);
  return AtomicFile(std::move(state));
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  if (state_->failed == 0) state_->failed = write_all(state_->file.number(), bytes);
}

void AtomicFile::write_at(uint64_t offset, std::span<const std::byte> bytes) {
  if (state_->failed == 0) state_->failed = write_all_at(state_->file.number(), offset, bytes);
}

Result<void> AtomicFile::commit() {
  State& s = *state_;
  if (const int error = s.failed != 0 ? s.failed : finish(s)) {
    return write_problem(s.asked_for, error);
  }
  s.temporary.clear();
  // EINVAL: the file system does not support syncing a folder, and nothing better can be done.
  if (::fsync(s.folder.number()) != 0 && errno != EINVAL) {
    return system_problem(s.asked_for, "the file is written, but its folder could not be synced",
                          errno);
  }
  return {};
}

/// Steps 3 and 4. Returns 0 or the errno of the step that failed.
int AtomicFile::finish(State& s) {
  if (s.target.exists && ::fchmod(s.file.number(), s.target.mode) != 0) return errno;
  if (::fsync(s.file.number()) != 0) return errno;
  if (s.temporary.empty())
    if (const int error = name_file(s.file.number(), s.folder.number(), s.temporary)) return error;
  if (!s.file.close()) return errno;
  const std::string name = s.target.path.filename().string();
  if (::renameat(s.folder.number(), s.temporary.c_str(), s.folder.number(), name.c_str()) != 0)
    return errno;
  return 0;
}

std::filesystem::path behind_links(const std::filesystem::path& path) {
  std::filesystem::path parent = path.parent_path();
  std::error_code error;
  parent = std::filesystem::canonical(parent.empty() ? "." : parent, error);
  return error ? path : parent / path.filename();
}

void remove_stale_temporaries(const std::filesystem::path& folder) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(temporary_prefix) || !name.ends_with(temporary_suffix)) continue;
    const FileDescriptor file(
        ::open(entry.path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat about {};
    const bool stale = file.valid() && ::fstat(file.number(), &about) == 0 &&
                       S_ISREG(about.st_mode) && ::flock(file.number(), LOCK_EX | LOCK_NB) == 0;
    if (stale) ::unlink(entry.path().c_str());
  }
}

Result<void> write_file_atomically(const std::filesystem::path& path,
                                   std::span<const std::byte> bytes) {
  auto file = AtomicFile::create(path);
  if (!file) return file.problem();
  file->write(bytes);
  return file->commit();
}

Result<void> write_file_atomically(const std::filesystem::path& path, std::string_view text) {
  return write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace luxodus
