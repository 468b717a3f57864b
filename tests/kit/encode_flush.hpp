// Encodes a flush at once, for threads without other work. One thread per object.
#pragma once

#include <cstddef>
#include <vector>

#include "actors/cast/tally/flush_codec.hpp"

namespace luxodus::test {

/// Moves totals into the bytes of a flush.
inline std::vector<std::byte> encode_flush(Totals& totals) {
  FlushEncoder encoder(totals.groups(), totals.layout().totals());
  encoder.begin(totals);
  while (!encoder.step(totals.layout().totals())) {
  }
  return encoder.bytes();
}

}  // namespace luxodus::test
