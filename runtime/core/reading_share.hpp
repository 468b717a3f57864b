// How far the reading of files is: bytes that are to be read, and those that are. Readers add to
// it, another thread looks at it. All members are thread-safe.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <optional>

namespace luxodus {

class ReadingShare {
 public:
  /// So much is to be read of files that are known before their own reading begins: what is
  /// expected later is of it.
  void foresee(uint64_t bytes) {
    expected_ += bytes;
    foreseen_ += bytes;
  }
  /// A file is to be read whose bytes are not known before its own reading begins.
  void foresee_unknown() { ++unknown_; }
  /// The bytes of such a file are known now.
  void know() {
    uint64_t before = unknown_;
    while (before > 0 && !unknown_.compare_exchange_weak(before, before - 1)) {
    }
  }
  /// Whether no file is to be read beyond what is expected, as far as anybody foresees.
  bool all_known() const { return unknown_ == 0; }
  /// So much is to be read now: of what was foreseen, and more where that is less.
  void expect(uint64_t bytes) {
    uint64_t before = foreseen_;
    while (!foreseen_.compare_exchange_weak(before, before - std::min(before, bytes))) {
    }
    expected_ += bytes - std::min(before, bytes);
  }
  /// So much of it has been read.
  void add(uint64_t bytes) { read_ += bytes; }
  /// From 0 to 1; nothing where nothing is expected.
  std::optional<double> share() const {
    const uint64_t all = expected_;
    if (all == 0) return std::nullopt;
    return std::min(1.0, static_cast<double>(read_) / static_cast<double>(all));
  }

 private:
  std::atomic<uint64_t> expected_ = 0, read_ = 0;
  std::atomic<uint64_t> foreseen_ = 0;  // of what is expected, what no reading has begun with
  std::atomic<uint64_t> unknown_ = 0;   // files
};

/// One file of those that are read: expected when this is made, read as it is told, and all of it
/// at the latest when this ends. Does nothing where `all` is null.
class ReadingPart {
 public:
  ReadingPart(ReadingShare* all, uint64_t bytes) : all_(all), bytes_(bytes) {
    if (all_ != nullptr) all_->expect(bytes_);
  }
  ~ReadingPart() { at(bytes_); }
  ReadingPart(const ReadingPart&) = delete;

  /// Read up to here; what was told before and more is not undone.
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
