// The lock is flock() on a file in the folder, since the system releases it when the process dies.
// The file is removed at the end; a process that has waited for a file removed meanwhile notices by
// its inode and opens it again.
#include "actors/results/formats/output_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace luxodus {

namespace {

namespace fs = std::filesystem;

constexpr const char* lock_name = ".luxodus.lock";
/// Another process may remove the lock file between our opening and locking it: once is likely,
/// this often is not.
constexpr int max_lock_attempts = 100;

std::string reason(int error) {
  return std::generic_category().message(error);
}

/// The missing parents of `folder` and itself, the outermost first.
std::vector<fs::path> missing_folders(const fs::path& folder) {
  std::vector<fs::path> missing;
  std::error_code error;
  fs::path at = folder;
  while (!at.empty() && !fs::exists(fs::symlink_status(at, error))) {
    missing.insert(missing.begin(), at);
    if (at == at.parent_path()) break;
    at = at.parent_path();
  }
  return missing;
}

/// "process 1234", from the content of the lock file.
std::string holder_of(int file) {
  std::array<char, 128> text{};
  const ssize_t n = ::pread(file, text.data(), text.size() - 1, 0);
  std::string holder(text.data(), n > 0 ? static_cast<size_t>(n) : 0);
  for (char& c : holder)
    if (c < ' ' || c > '~') c = ' ';
  while (holder.ends_with(' ')) holder.pop_back();
  return holder.empty() ? "another process" : holder;
}

std::string own_name() {
  std::array<char, 65> host{};
  ::gethostname(host.data(), host.size() - 1);
  return "process " + std::to_string(::getpid()) + " on " + host.data() + "\n";
}

/// Fails if a planned subfolder exists as something else. A link would lead out of the folder.
Result<void> check_subfolder(const fs::path& path) {
  struct stat about {};
  if (::lstat(path.c_str(), &about) != 0 || S_ISDIR(about.st_mode)) return {};
  return problem_in(path, S_ISLNK(about.st_mode)
                              ? "this is a symbolic link, and links are not followed; results go "
                                "here: remove it, or give another folder"
                              : "this is a file, and results go into a folder of this name: move "
                                "it away, or give another folder");
}

Result<void> check_target(const fs::path& path) {
  struct stat about {};
  if (::lstat(path.c_str(), &about) != 0) return {};
  if (auto ok = can_be_replaced(about); !ok) return problem_in(path, ok.problem());
  return {};
}

}  // namespace

struct OutputFolder::State {
  ~State() {
    if (lock >= 0) {
      // Removed while locked: a process that opens it now notices that it has no name any more.
      ::unlinkat(handle, lock_name, 0);
      ::close(lock);
    }
    if (handle >= 0) ::close(handle);
    for (auto folder = made.rbegin(); folder != made.rend(); ++folder) ::rmdir(folder->c_str());
  }

  fs::path named, path;
  std::vector<fs::path> made;  // the outermost first
  int handle = -1;
  int lock = -1;

  Result<void> make_and_open() {
    std::vector<fs::path> missing = missing_folders(named);
    std::error_code error;
    fs::create_directories(named, error);
    for (fs::path& folder : missing)
      if (fs::is_directory(folder, error)) made.push_back(fs::absolute(folder, error));
    path = fs::canonical(named, error);
    if (!error) handle = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (handle >= 0) return {};
    const int failed = error ? error.value() : errno;
    return problem_in(named, "cannot make this folder: " + reason(failed) + "; give another one",
                      kind_of_errno(failed));
  }

  Result<void> take_lock() {
    for (int attempt = 0; attempt < max_lock_attempts; ++attempt) {
      lock =
          ::openat(handle, lock_name, O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0644);
      if (lock < 0) {
        const int failed = errno;
        return problem_in(named,
                          "cannot write into this folder: " + reason(failed) +
                              "; give another one, or the right to write here",
                          kind_of_errno(failed));
      }
      struct stat open_one {
      }, named_one{};
      if (::fstat(lock, &open_one) != 0 || !S_ISREG(open_one.st_mode)) {
        forget_lock();
        return problem_in(path / lock_name, "this is no regular file: remove it");
      }
      if (::flock(lock, LOCK_EX | LOCK_NB) != 0) {
        // Not every file system has locks; the check of the folder still holds.
        if (errno != EWOULDBLOCK) return {};
        const std::string holder = holder_of(lock);
        forget_lock();
        return problem_in(
            named, holder + " writes into this folder: wait for its end, or give another one");
      }
      const bool same = ::fstatat(handle, lock_name, &named_one, AT_SYMLINK_NOFOLLOW) == 0 &&
                        named_one.st_ino == open_one.st_ino && named_one.st_dev == open_one.st_dev;
      if (same) return say_who();
      forget_lock();
    }
    return problem_in(named,
                      "other processes begin and end in this folder all the time: give "
                      "another one");
  }

 private:
  void forget_lock() {
    ::close(lock);
    lock = -1;
  }
  /// Writes the process into the lock file, which also shows that the disk accepts bytes.
  Result<void> say_who() {
    const std::string who = own_name();
    const ssize_t put = ::ftruncate(lock, 0) == 0 ? ::pwrite(lock, who.data(), who.size(), 0) : -1;
    if (put == static_cast<ssize_t>(who.size())) return {};
    const int failed = put < 0 ? errno : ENOSPC;
    return problem_in(named,
                      "cannot write into this folder: " + reason(failed) +
                          "; free some space, or give another one",
                      kind_of_errno(failed));
  }
};

OutputFolder::OutputFolder(std::unique_ptr<State> state) : state_(std::move(state)) {}
OutputFolder::OutputFolder(OutputFolder&&) noexcept = default;
OutputFolder& OutputFolder::operator=(OutputFolder&&) noexcept = default;
OutputFolder::~OutputFolder() = default;

Result<OutputFolder> OutputFolder::claim(const fs::path& folder, const OutputPlan& plan) {
  auto state = std::make_unique<State>();
  state->named = folder.empty() ? fs::path(".") : folder;
  if (!state->named.has_filename()) state->named = state->named.parent_path();
  if (auto ok = state->make_and_open(); !ok) return ok.problem();
  if (auto ok = state->take_lock(); !ok) return ok.problem();
  for (const std::string& name : plan.folders) {
    if (auto ok = check_subfolder(state->path / name); !ok) return ok.problem();
  }
  for (const std::string& name : plan.files)
    if (auto ok = check_target(state->path / name); !ok) return ok.problem();
  remove_stale_temporaries(state->path);
  for (const std::string& name : plan.folders) remove_stale_temporaries(state->path / name);
  return OutputFolder(std::move(state));
}

const fs::path& OutputFolder::path() const {
  return state_->path;
}

const fs::path& OutputFolder::named() const {
  return state_->named;
}

Result<void> check_output_file(const fs::path& file) {
  const fs::path real = behind_links(file);
  remove_stale_temporaries(real.parent_path());
  // Without commit() it leaves no trace.
  auto trial = AtomicFile::create(real);
  if (!trial) return trial.problem();
  return {};
}

}  // namespace luxodus
