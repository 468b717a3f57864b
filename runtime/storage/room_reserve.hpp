// Room on a disk that is kept for what must be written at the end: taken before the work, given
// back just before the last save, so that a disk that has filled up meanwhile does not lose it. The
// file has no name and goes with its process. Thread rule: one thread at a time.
#pragma once

#include <cstdint>
#include <filesystem>

#include "runtime/core/result.hpp"

namespace luxodus {

class RoomReserve {
 public:
  RoomReserve() = default;
  ~RoomReserve() { release(); }
  RoomReserve(const RoomReserve&) = delete;
  RoomReserve& operator=(const RoomReserve&) = delete;

  /// Keeps `bytes` on the disk of a folder; what was kept before is given back. On a file system
  /// that cannot promise room, nothing is kept and nothing is wrong. Errors: there is no such room.
  Result<void> take(const std::filesystem::path& folder, uint64_t bytes);
  void release();
  bool held() const { return descriptor_ >= 0; }

 private:
  int descriptor_ = -1;
};

}  // namespace luxodus
