// Content hashes: XXH3 of Debian's xxhash, 64 bits. Equal content has an equal hash on every
// machine. Thread rule: a Hasher belongs to one thread; object_id_of() is pure.
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
  /// The length is hashed first, so that two strings never run together.
  void add(std::string_view text) {
    add(static_cast<uint64_t>(text.size()));
    add(text.data(), text.size());
  }
  uint64_t value() const { return XXH3_64bits_digest(state_.get()); }

 private:
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

/// The id of an object with these bytes; a receiver verifies the bytes by it.
inline ObjectId object_id_of(std::span<const std::byte> bytes) {
  return {XXH3_64bits(bytes.data(), bytes.size())};
}

}  // namespace luxodus
