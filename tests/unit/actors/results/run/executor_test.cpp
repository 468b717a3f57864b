// Work given out in pieces: numbering of batches, and states as bytes.
#include "actors/results/run/executor.hpp"

#include <catch2/catch.hpp>

using namespace luxodus;

namespace {

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

}  // namespace

TEST_CASE("a batch of a state is found by its number", "[run]") {
  const BatchRange batches[] = {
      {0, 0, 0, 1}, {3, 0, 7, 1}, {0, 5, 1, 1}, {8191, (1 << 19) - 1, (1 << 30) - 1, 1}};
  for (const BatchRange& batch : batches) {
    const int64_t number = number_of(batch);
    CHECK(number >= 0);
    CHECK(batch_of(number) == batch);
  }
}

TEST_CASE("batches of a group have consecutive numbers", "[run]") {
  const int64_t first = number_of({2, 4, 10, 3});
  CHECK(batch_of(first + 2) == BatchRange{2, 4, 12, 1});
  CHECK(number_of({2, 4, 13, 1}) == first + 3);
  CHECK(number_of({3, 4, 10, 1}) != first);
}

TEST_CASE("a state is read back from its bytes, and named by them", "[run]") {
  const StateObject state{18'446'744'073'709'551'615u, "{\"scenario\": \"fire\"}\nmore"};
  const std::string bytes = state.bytes();
  const auto read = StateObject::parse(bytes_of(bytes));
  REQUIRE(read.ok());
  CHECK(read.value() == state);
  CHECK(read.value().id() == state.id());
  CHECK(StateObject{1, state.text}.id() != state.id());
  CHECK(StateObject{state.seed, "{}"}.id() != state.id());
}

TEST_CASE("malformed bytes of a state are rejected with a message", "[run]") {
  for (const std::string text : {"", "12", "twelve\n{}", "-1\n{}", "99999999999999999999\n{}"}) {
    const auto read = StateObject::parse(bytes_of(text));
    REQUIRE_FALSE(read.ok());
    CHECK(read.problem().what.find("begins with its seed") != std::string::npos);
  }
}
