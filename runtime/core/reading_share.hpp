// Progress of reading files: bytes to read and bytes read. Readers add to it, another thread reads
// it. All members are thread-safe.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <optional>

namespace luxodus {

class ReadingShare {
 public:
  /// Announces bytes of files whose own reading begins later; expect() then takes from this amount.
  void foresee(uint64_t bytes) {
    expected_ += bytes;
    foreseen_ += bytes;
  }
  /// Announces a file whose size is not known before its own reading begins.
  void foresee_unknown() { ++unknown_; }
  /// The size of such a file is known now.
  void know() {
    uint64_t before = unknown_;
    while (before > 0 && !unknown_.compare_exchange_weak(before, before - 1)) {
    }
  }
  /// Whether the sizes of all announced files are known.
  bool all_known() const { return unknown_ == 0; }
  /// A file of this size is read now: taken from what was announced, the rest added.
  void expect(uint64_t bytes) {
    uint64_t before = foreseen_;
    while (!foreseen_.compare_exchange_weak(before, before - std::min(before, bytes))) {
    }
    expected_ += bytes - std::min(before, bytes);
  }
  /// This many bytes have been read.
  void add(uint64_t bytes) { read_ += bytes; }
  /// From 0 to 1; nothing if no bytes are expected.
  std::optional<double> share() const {
    const uint64_t all = expected_;
    if (all == 0) return std::nullopt;
    return std::min(1.0, static_cast<double>(read_) / static_cast<double>(all));
  }

 private:
  std::atomic<uint64_t> expected_ = 0, read_ = 0;
  std::atomic<uint64_t> foreseen_ = 0;  // expected bytes whose reading has not begun
  std::atomic<uint64_t> unknown_ = 0;   // number of files
};

/// Progress of one file: expected on construction, reported by at(), and complete on destruction.
/// Does nothing if `all` is null.
class ReadingPart {
 public:
  ReadingPart(ReadingShare* all, uint64_t bytes) : all_(all), bytes_(bytes) {
    if (all_ != nullptr) all_->expect(bytes_);
  }
  ~ReadingPart() { at(bytes_); }
  ReadingPart(const ReadingPart&) = delete;

  /// Reports that the file is read up to `bytes`; progress never goes back.
  void at(uint64_t bytes) {
    bytes = std::min(bytes, bytes_);
    if (all_ == nullptr || bytes <= told_) return;
    all_->add(bytes - told_);
    told_ = bytes;
  }
  void at_share(double share) {
    at(static_cast<uint64_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(bytes_)));
  }

 private:
  ReadingShare* all_;
  uint64_t bytes_, told_ = 0;
};

}  // namespace luxodus
