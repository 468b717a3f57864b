// Turns values into bytes and back: the only reader and writer of Cap'n Proto. Bytes from outside
// are decoded once, into plain values, within limits that follow from their length. Malformed bytes
// are a Problem, never an exception, and never more work than their length allows. Misaligned bytes
// are copied first, since the network hands out frames at any address. Memory is allocated for text
// and lists only, and not for lists of leases if earlier ones were given back.
// Thread rule: a Codec holds scratch memory and belongs to one node.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "proto/messages.hpp"
#include "runtime/core/hash.hpp"
#include "runtime/core/result.hpp"

namespace luxodus {

/// An envelope, and where in the frame the piece of message behind it begins.
struct OpenedFrame {
  Envelope envelope;
  std::span<const std::byte> body;
};

/// A message, and the payload behind it, which lies in the bytes that were decoded.
struct OpenedMessage {
  Message message;
  std::span<const std::byte> payload;
};

/// Memory of lists of numbers that are no longer needed. The next lists are read into it.
class SpareLists {
 public:
  /// An empty list with room for so many numbers.
  std::vector<uint64_t> take(size_t numbers);
  void give_back(std::vector<uint64_t>&& list);

 private:
  std::vector<std::vector<uint64_t>> lists_;
};

class Codec {
 public:
  Codec();

  /// Writes what goes before `body` in a frame, the check and the envelope, to the front of `out`,
  /// and returns its bytes, a multiple of 8. Requires: room for limits::frame_head_bytes.
  size_t encode(const Envelope& envelope, std::span<const std::byte> body,
                std::span<std::byte> out);
  /// Writes the check of a frame anew, over its first word. Requires: at least that.
  static void seal(std::span<std::byte> frame);

  /// Writes a message to the front of `out` and returns its bytes, a multiple of 8.
  /// Errors: longer than `out` or than limits::message_bytes, or a list or text over its limit.
  Result<size_t> encode(const Message& message, std::span<std::byte> out);

  /// Reads check and envelope. Errors: the check does not hold, or no envelope within the limits
  /// follows it.
  Result<OpenedFrame> open_frame(std::span<const std::byte> frame);

  /// Reads a message; what follows it is its payload. Errors: no message within the limits.
  Result<OpenedMessage> open_message(std::span<const std::byte> bytes);
  /// Takes the memory of a message's leases, for messages that are opened later.
  void take_back(std::vector<uint64_t>&& leases) { spare_.give_back(std::move(leases)); }

 private:
  /// One segment of words at the front of `bytes`, at an address that words may have.
  struct Segment {
    const std::byte* begin = nullptr;
    size_t bytes = 0;
  };
  Result<Segment> first_segment(std::span<const std::byte> bytes, size_t limit);

  std::unique_ptr<uint64_t[]> aligned_;   // copies of what came misaligned
  std::unique_ptr<uint64_t[]> building_;  // all zero between calls
  Hasher check_;
  SpareLists spare_;
};

}  // namespace luxodus
