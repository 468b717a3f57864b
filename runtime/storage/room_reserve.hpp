// Disk space reserved for the last save: taken before the work and released just before that save,
// so that a disk that has filled up meanwhile does not prevent it. The file has no name and
// vanishes with its process. Thread rule: one thread at a time.
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

  /// Reserves `bytes` on the disk of a folder, and releases any earlier reservation. On a file
  /// system without reservations it does nothing and succeeds. Errors: not enough space.
  Result<void> take(const std::filesystem::path& folder, uint64_t bytes);
  void release();
  bool held() const { return descriptor_ >= 0; }

 private:
  int descriptor_ = -1;
};

}  // namespace luxodus
