// An append-only store that survives a crash: the interface between a journal and a disk. A
// simulation uses one that tears writes and fills up. Thread rule: one node's thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

class AppendStore {
 public:
  virtual ~AppendStore() = default;

  virtual uint64_t size() const = 0;
  /// Fills `into` from `offset` on. Errors: too few bytes there, a failed read.
  virtual Result<void> read(uint64_t offset, std::span<std::byte> into) = 0;
  /// Appends. On success the bytes are durable. After an error the store may end in a part of them.
  /// Errors: a full disk, a failed write or sync.
  virtual Result<void> append(std::span<const std::byte> bytes) = 0;
  /// Truncates to `size`, durably. Errors: a failed write or sync.
  virtual Result<void> truncate(uint64_t size) = 0;
};

/// A store in a file, which is locked while it is open.
class FileStore final : public AppendStore {
 public:
  /// Opens or creates it. Errors: no such folder, no permission, not a regular file (links are not
  /// followed), another process has it open.
  static Result<std::unique_ptr<FileStore>> open(const std::filesystem::path& path);
  ~FileStore() override;
  FileStore(const FileStore&) = delete;
  FileStore& operator=(const FileStore&) = delete;

  uint64_t size() const override { return size_; }
  Result<void> read(uint64_t offset, std::span<std::byte> into) override;
  Result<void> append(std::span<const std::byte> bytes) override;
  Result<void> truncate(uint64_t size) override;

 private:
  FileStore(std::filesystem::path path, int descriptor, uint64_t size)
      : path_(std::move(path)), descriptor_(descriptor), size_(size) {}
  Problem problem(const char* what) const;

  const std::filesystem::path path_;
  const int descriptor_;
  uint64_t size_;
};

}  // namespace luxodus
