// The process that needs a folder holds a lock (flock) on it, which the system releases when the
// process dies: a folder that can be locked is abandoned. A folder that was just made may not be
// locked yet.
#include "actors/import/answer_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>
#include <string>
#include <system_error>
#include <vector>

namespace luxodus {

namespace {

namespace fs = std::filesystem;

constexpr const char* prefix = "luxodus-ifc-";
/// Time from making a folder to locking it: microseconds, but a machine may be suspended between
/// [s].
constexpr time_t locked_after_s = 60;

fs::path base_folder() {
  std::error_code failed;
  const fs::path base = fs::temp_directory_path(failed);
  return failed ? fs::path("/tmp") : base;
}

/// An open folder of ours with the lock; invalid if another process holds it, or it is not a folder
/// of this user.
FileDescriptor locked(const fs::path& folder, struct stat& about) {
  FileDescriptor file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  const bool ours = file.valid() && ::fstat(file.number(), &about) == 0 &&
                    about.st_uid == ::geteuid() && ::flock(file.number(), LOCK_EX | LOCK_NB) == 0;
  return ours ? std::move(file) : FileDescriptor();
}

void remove_stale(const fs::path& base) {
  std::error_code failed;
  std::vector<fs::path> left;
  for (fs::directory_iterator at(base, failed), end; !failed && at != end; at.increment(failed))
    if (at->path().filename().string().starts_with(prefix)) left.push_back(at->path());
  for (const fs::path& folder : left) {
    struct stat about {};
    const FileDescriptor lock = locked(folder, about);
    if (lock.valid() && std::time(nullptr) - about.st_mtime > locked_after_s)
      fs::remove_all(folder, failed);
  }
}

}  // namespace

AnswerFolder::AnswerFolder() {
  const fs::path base = base_folder();
  remove_stale(base);
  std::string name = (base / (std::string(prefix) + "XXXXXX")).string();
  if (::mkdtemp(name.data()) == nullptr) return;
  path_ = name;
  struct stat about {};
  held_ = locked(path_, about);
}

AnswerFolder::~AnswerFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

}  // namespace luxodus
