#include "proto/codec.hpp"

#include <catch2/catch.hpp>
#include <cstring>

#include "tests/fuzz/samples.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

using Bytes = std::vector<std::byte>;

Bytes encoded(Codec& codec, const Message& message) {
  Bytes out(limits::message_bytes);
  out.resize(codec.encode(message, out).value());
  return out;
}

}  // namespace

TEST_CASE("every message is read as it was written", "[proto][codec]") {
  Codec codec;
  const auto samples = sample_messages();
  CHECK(samples.size() == std::variant_size_v<Message>);
  for (size_t i = 0; i < samples.size(); ++i) {
    INFO("message " << i);
    CHECK(samples[i].index() == i);  // one of each
    const auto read = codec.open_message(encoded(codec, samples[i]));
    REQUIRE(read.ok());
    CHECK(read->message == samples[i]);
    CHECK(read->payload.empty());
  }
}

TEST_CASE("an envelope is read as it was written, and has the bytes it is said to have",
          "[proto][codec]") {
  Codec codec;
  Bytes out(limits::frame_head_bytes);
  const size_t bytes = codec.encode(sample_envelope(), {}, out);
  CHECK(bytes == limits::check_bytes + 104);
  const auto read = codec.open_frame(std::span(out).first(bytes));
  REQUIRE(read.ok());
  CHECK(read->envelope == sample_envelope());
  CHECK(read->body.empty());
}

TEST_CASE("a frame is read at any address, and its payload behind its message", "[proto][codec]") {
  Codec codec;
  const Bytes payload(1001, std::byte{7});
  const Message message = Flush{1, 2, {3, 4}};
  const Bytes frame = sample_frame(codec, message, payload);
  for (size_t offset = 0; offset < 8; ++offset) {
    INFO("offset " << offset);
    std::vector<uint64_t> memory(frame.size() / 8 + 2);
    const auto place = std::as_writable_bytes(std::span(memory)).subspan(offset, frame.size());
    std::memcpy(place.data(), frame.data(), frame.size());
    const auto opened = codec.open_frame(place);
    REQUIRE(opened.ok());
    CHECK(opened->envelope == sample_envelope());
    const auto read = codec.open_message(opened->body);
    REQUIRE(read.ok());
    CHECK(read->message == message);
    CHECK(Bytes(read->payload.begin(), read->payload.end()) == payload);
  }
}

TEST_CASE("a frame of which any bit has changed is refused", "[proto][codec]") {
  Codec codec;
  Bytes frame = sample_frame(codec, Flush{1, 2, {3, 4}}, Bytes(20, std::byte{7}));
  REQUIRE(codec.open_frame(frame).ok());
  for (size_t bit = 0; bit < 8 * frame.size(); ++bit) {
    const std::byte turned{static_cast<uint8_t>(1u << (bit % 8))};
    frame[bit / 8] ^= turned;
    CHECK_FALSE(codec.open_frame(frame).ok());
    frame[bit / 8] ^= turned;
  }
}

TEST_CASE("a frame that is cut short anywhere is refused", "[proto][codec]") {
  Codec codec;
  for (const Message& message : sample_messages()) {
    const Bytes whole = encoded(codec, message);
    for (size_t bytes = 0; bytes < whole.size(); ++bytes) {
      const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(bytes));
      CHECK_FALSE(codec.open_message(cut).ok());
    }
  }
}

TEST_CASE("more than one segment is refused", "[proto][codec]") {
  Codec codec;
  Bytes bytes = encoded(codec, Bye{});
  bytes[0] = std::byte{1};
  CHECK_FALSE(codec.open_message(bytes).ok());
}

TEST_CASE("a message of a later version is refused, not misread", "[proto][codec]") {
  Codec codec;
  Bytes bytes = encoded(codec, Bye{});
  REQUIRE(bytes.size() >= 24);
  bytes[16] = bytes[17] = std::byte{0xff};  // the union's tag: behind segment table and root
  const auto read = codec.open_message(bytes);
  REQUIRE_FALSE(read.ok());
  CHECK(read.problem().what.find("no such message") != std::string::npos);
}

TEST_CASE("lists and texts over their limits are not sent", "[proto][codec]") {
  Codec codec;
  Bytes out(limits::message_bytes);
  CHECK(codec.encode(LeasesFenced{std::vector<uint64_t>(limits::leases)}, out).ok());
  CHECK_FALSE(codec.encode(LeasesFenced{std::vector<uint64_t>(limits::leases + 1)}, out).ok());
  CHECK_FALSE(
      codec.encode(Flush{1, 2, {}, std::vector<uint64_t>(limits::tally_shards + 1)}, out).ok());
  CHECK_FALSE(codec.encode(RunEnded{1, std::string(limits::text_bytes + 1, 'x')}, out).ok());
  CHECK_FALSE(codec.encode(Message{AskStatus{}}, std::span(out).first(8)).ok());
  CHECK(codec.encode(Message{AskStatus{}}, out).ok());  // and the codec still works
}

TEST_CASE("the longest messages fit into a message", "[proto][codec]") {
  Codec codec;
  Beat beat;
  while (beat.pools.size() < beat.pools.capacity()) beat.pools.push_back({});
  for (const Message& message :
       {Message{beat},
        Message{Flush{1, 2, std::vector<uint64_t>(limits::leases),
                      std::vector<uint64_t>(limits::tally_shards)}},
        Message{LinkChanges{std::vector<LinkChange>(limits::link_changes)}},
        Message{FlushRefused{std::vector<uint64_t>(limits::leases),
                             std::string(limits::text_bytes, 'x')}}}) {
    Bytes out(limits::message_bytes);
    const auto bytes = codec.encode(message, out);
    REQUIRE(bytes.ok());
    const auto read = codec.open_message(std::span(out).first(bytes.value()));
    REQUIRE(read.ok());
    CHECK(read->message == message);
  }
}

TEST_CASE("a peer's text cannot steer an operator's terminal", "[proto][codec]") {
  Codec codec;
  const auto read = codec.open_message(encoded(codec, RunEnded{1, "\x1b[2Jgone\n"}));
  REQUIRE(read.ok());
  CHECK(std::get<RunEnded>(read->message).text == "?[2Jgone?");
}
