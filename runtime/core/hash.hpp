// Content hashes: XXH3 of Debian's xxhash, 64 bits. Equal content, equal hash, on every machine.
#pragma once

#include <xxhash.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "runtime/core/ids.hpp"

namespace luxodus {

class Hasher {
 public:
  Hasher() : state_(XXH3_createState(), XXH3_freeState) { reset(); }

  /// Forgets what was added.
  void reset() { XXH3_64bits_reset(state_.get()); }

  void add(const void* bytes, size_t count) { XXH3_64bits_update(state_.get(), bytes, count); }
  void add(uint64_t v) { add(&v, sizeof v); }
  /// Length first, so that two strings never run together.
  void add(std::string_view text) {
    add(static_cast<uint64_t>(text.size()));
    add(text.data(), text.size());
  }
  uint64_t value() const { return XXH3_64bits_digest(state_.get()); }

 private:
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

/// The name of an object with these bytes, by which they are known to be right.
inline ObjectId object_id_of(std::span<const std::byte> bytes) {
  return {XXH3_64bits(bytes.data(), bytes.size())};
}

}  // namespace luxodus
