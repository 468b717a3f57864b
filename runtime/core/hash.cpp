// XXH3 is compiled here, for the instruction set of this program: Debian's library has it for the
// oldest processors, and takes three times as long for 4 kB and more. Every frame is hashed at both
// its ends, and every object once more. The values are the same.
#include "runtime/core/hash.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace luxodus {

struct Hasher::State {
  XXH3_state_t xxh;
};

Hasher::Hasher() : state_(new State, [](State* state) { delete state; }) {
  XXH3_INITSTATE(&state_->xxh);
  reset();
}

void Hasher::reset() {
  XXH3_64bits_reset(&state_->xxh);
}

void Hasher::add(const void* bytes, size_t count) {
  XXH3_64bits_update(&state_->xxh, bytes, count);
}

uint64_t Hasher::value() const {
  return XXH3_64bits_digest(&state_->xxh);
}

uint64_t hash_of(std::span<const std::byte> bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

}  // namespace luxodus
