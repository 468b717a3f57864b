#include "runtime/core/file_stamp.hpp"

#include <sys/stat.h>

#include <chrono>

namespace luxodus {

namespace {
FileStamp stamp_from(const struct stat& is) {
  using namespace std::chrono;
  // File times have a resolution, at worst 2 s.
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

}  // namespace

FileStamp stamp_of(int descriptor) {
  struct stat is {};
  return ::fstat(descriptor, &is) == 0 ? stamp_from(is) : FileStamp{};
}

FileStamp stamp_at(const std::string& path) {
  struct stat is {};
  return ::stat(path.c_str(), &is) == 0 ? stamp_from(is) : FileStamp{};
}

}  // namespace luxodus
