#include "tests/fuzz/fuzz_codec.hpp"

#include <vector>

#include "proto/codec.hpp"
#include "tests/fuzz/must.hpp"

namespace luxodus::test {

bool fuzz_one(std::span<const std::byte> bytes) {
  Codec codec;
  (void)codec.open_frame(bytes);
  if (bytes.size() < limits::check_bytes) return false;
  // A peer can make a valid check: the input after it is what is tested.
  std::vector<std::byte> sealed(bytes.begin(), bytes.end());
  Codec::seal(sealed);
  const auto frame = codec.open_frame(sealed);
  if (!frame) return false;
  std::vector<std::byte> again(limits::frame_head_bytes);
  again.resize(codec.encode(frame->envelope, {}, again));
  const auto envelope = codec.open_frame(again);
  must(envelope.ok() && envelope->envelope == frame->envelope, "an envelope changed its meaning");

  const auto message = codec.open_message(frame->body);
  if (!message) return false;
  must(message->payload.size() <= frame->body.size(), "a payload is longer than its frame");
  again.resize(limits::message_bytes);
  const auto encoded = codec.encode(message->message, again);
  must(encoded.ok(), "what was understood cannot be said");
  const auto decoded = codec.open_message(std::span(again).first(encoded.value()));
  must(decoded.ok() && decoded->message == message->message, "a message changed its meaning");
  return true;
}

}  // namespace luxodus::test
