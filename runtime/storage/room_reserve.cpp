#include "runtime/storage/room_reserve.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>

namespace luxodus {

Result<void> RoomReserve::take(const std::filesystem::path& folder, uint64_t bytes) {
  release();
  descriptor_ = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor_ < 0) return {};
  if (::fallocate(descriptor_, 0, 0, static_cast<off_t>(bytes)) == 0) return {};
  const int error = errno;
  release();
  if (error != ENOSPC && error != EDQUOT) return {};
  constexpr uint64_t mebibyte = 1 << 20;
  return problem_in(folder,
                    "the results may take " + std::to_string((bytes + mebibyte - 1) / mebibyte) +
                        " MiB, and this disk has less room: free some space",
                    ProblemKind::no_room);
}

void RoomReserve::release() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

}  // namespace luxodus
