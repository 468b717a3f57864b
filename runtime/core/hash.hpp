// Content hashes: XXH3, 64 bits. Equal content has an equal hash on every machine. Thread rule: a
// Hasher belongs to one thread; the functions are pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "runtime/core/ids.hpp"

namespace luxodus {

class Hasher {
 public:
  Hasher();

  /// Forgets what was added.
  void reset();

  void add(const void* bytes, size_t count);
  void add(uint64_t v) { add(&v, sizeof v); }
  /// The length is hashed first, so that two strings never run together.
  void add(std::string_view text) {
    add(static_cast<uint64_t>(text.size()));
    add(text.data(), text.size());
  }
  /// Of all that was added, as hash_of() it in one piece.
  uint64_t value() const;

 private:
  struct State;
  std::unique_ptr<State, void (*)(State*)> state_;
};

uint64_t hash_of(std::span<const std::byte> bytes);

/// The id of an object with these bytes; a receiver verifies the bytes by it.
inline ObjectId object_id_of(std::span<const std::byte> bytes) {
  return {hash_of(bytes)};
}

}  // namespace luxodus
