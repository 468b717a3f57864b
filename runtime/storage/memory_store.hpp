// A store in memory, over bytes that the caller owns: the disk of a simulation or a test. Thread
// rule: one thread.
#pragma once

#include <cstring>
#include <vector>

#include "runtime/storage/append_store.hpp"

namespace luxodus {

class MemoryStore final : public AppendStore {
 public:
  /// Requires: `bytes` outlive this.
  explicit MemoryStore(std::vector<std::byte>& bytes) : bytes_(bytes) {}

  uint64_t size() const override { return bytes_.size(); }
  Result<void> read(uint64_t offset, std::span<std::byte> into) override {
    if (offset > bytes_.size() || into.size() > bytes_.size() - offset)
      return problem("ends before what should be there");
    std::memcpy(into.data(), bytes_.data() + offset, into.size());
    return {};
  }
  Result<void> append(std::span<const std::byte> bytes) override {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return {};
  }
  Result<void> truncate(uint64_t size) override {
    bytes_.resize(size);
    return {};
  }

 private:
  std::vector<std::byte>& bytes_;
};

}  // namespace luxodus
