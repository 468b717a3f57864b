#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "runtime/storage/append_store.hpp"

namespace luxodus {

namespace {

/// Syncs the folder: the name must survive, too, not only the content.
bool sync_folder_of(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool synced = ::fsync(descriptor) == 0;
  ::close(descriptor);
  return synced;
}

}  // namespace

Result<std::unique_ptr<FileStore>> FileStore::open(const std::filesystem::path& path) {
  constexpr int how = O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  const int descriptor = ::open(path.c_str(), how, 0644);
  if (descriptor < 0) return system_problem(path, "cannot open this file to append to", errno);
  struct stat about {};
  const bool regular = ::fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode);
  if (!regular) {
    ::close(descriptor);
    return problem_in(path, "is no regular file");
  }
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    ::close(descriptor);
    return problem_in(path, "another process has this file open: is the run still going on?",
                      ProblemKind::refused);
  }
  std::unique_ptr<FileStore> store(
      new FileStore(path, descriptor, static_cast<uint64_t>(about.st_size)));
  if (!sync_folder_of(path))
    return system_problem(path, "cannot make this file's name durable", errno);
  return store;
}

FileStore::~FileStore() {
  ::close(descriptor_);
}

Problem FileStore::problem(const char* what) const {
  return system_problem(path_, what, errno);
}

Result<void> FileStore::read(uint64_t offset, std::span<std::byte> into) {
  while (!into.empty()) {
    const ssize_t got = ::pread(descriptor_, into.data(), into.size(), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return problem("cannot read this file");
    if (got == 0) return problem_in(path_, "ends before what should be there");
    into = into.subspan(static_cast<size_t>(got));
    offset += static_cast<uint64_t>(got);
  }
  return {};
}

Result<void> FileStore::append(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t put =
        ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(size_));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return problem("cannot write to this file");
    bytes = bytes.subspan(static_cast<size_t>(put));
    size_ += static_cast<uint64_t>(put);
  }
  if (::fdatasync(descriptor_) != 0) return problem("cannot make this file's bytes durable");
  return {};
}

Result<void> FileStore::truncate(uint64_t size) {
  if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0 || ::fdatasync(descriptor_) != 0)
    return problem("cannot cut this file");
  size_ = size;
  return {};
}

}  // namespace luxodus
