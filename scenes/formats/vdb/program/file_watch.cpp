#include "scenes/formats/vdb/program/file_watch.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <optional>
#include <system_error>

#include "runtime/core/isolated_job.hpp"

namespace luxodus::vdb {
namespace {

/// The descriptor of a file that this process has open.
std::optional<int> descriptor_of(const struct stat& file) {
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", failed)) {
    const std::string name = entry.path().filename().string();
    int number = -1;
    (void)std::from_chars(name.data(), name.data() + name.size(), number);
    struct stat other {};
    if (number > 2 && ::fstat(number, &other) == 0 && other.st_dev == file.st_dev &&
        other.st_ino == file.st_ino)
      return number;
  }
  return std::nullopt;
}

}  // namespace

FileWatch::FileWatch(const std::string& file, double share) : share_(share) {
  struct stat known {};
  if (::stat(file.c_str(), &known) != 0 || known.st_size <= 0) return;
  if (const auto descriptor = descriptor_of(known))
    thread_ = std::thread([this, number = *descriptor, bytes = static_cast<double>(known.st_size)] {
      look(number, bytes);
    });
}

FileWatch::~FileWatch() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
  if (!thread_.joinable()) return;
  thread_.join();
  tell_share(share_);
}

void FileWatch::look(int descriptor, double bytes) {
  constexpr std::chrono::milliseconds pause{100};
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, pause, [this] { return over_; })) {
    const auto at = static_cast<double>(::lseek(descriptor, 0, SEEK_CUR));
    tell_share(share_ * std::clamp(at / bytes, 0.0, 1.0));
  }
}

}  // namespace luxodus::vdb
