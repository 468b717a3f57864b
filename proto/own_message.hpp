// Messages of an application's own Cap'n Proto schemas. They travel as the payload of an
// AppMessage, which carries the id of their struct, so that no number has to be agreed upon. What
// comes from another node is read within limits that follow from its length. Header only: an
// application that sends bytes alone needs no Cap'n Proto. Pure; any thread.
#pragma once

#include <capnp/message.h>
#include <capnp/schema.h>
#include <capnp/serialize.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>

#include "runtime/core/result.hpp"

namespace luxodus {

/// The id of a struct, which its schema gives.
template <class Struct>
uint64_t schema_of() {
  return capnp::typeId<Struct>();
}

/// A written message.
class OwnMessage {
 public:
  OwnMessage(uint64_t schema, kj::Array<capnp::word> words)
      : schema_(schema), words_(std::move(words)) {}

  uint64_t schema() const { return schema_; }
  std::span<const std::byte> bytes() const {
    return {reinterpret_cast<const std::byte*>(words_.begin()), words_.asBytes().size()};
  }

 private:
  uint64_t schema_;
  kj::Array<capnp::word> words_;
};

/// Writes a message: `fill` sets its fields, `write_own<Ping>([](Ping::Builder ping) { ... })`.
template <class Struct, class Fill>
OwnMessage write_own(Fill&& fill) {
  capnp::MallocMessageBuilder builder;
  fill(builder.initRoot<Struct>());
  return {schema_of<Struct>(), capnp::messageToFlatArray(builder)};
}

/// Reads a message: `use` gets it as Struct::Reader, valid during the call. Errors: another schema
/// than that of Struct; bytes that are no such message. The latter may be found while `use` reads.
template <class Struct, class Use>
Result<void> read_own(uint64_t schema, std::span<const std::byte> bytes, Use&& use) {
  if (schema != schema_of<Struct>())
    return problem("a message is of another schema than the one that it is read by");
  constexpr size_t word = sizeof(capnp::word);
  constexpr uint64_t spare_words = 16;  // the root is visited more than once
  kj::Array<capnp::word> copy;
  const auto* begin = reinterpret_cast<const capnp::word*>(bytes.data());
  if (reinterpret_cast<uintptr_t>(bytes.data()) % word != 0) {
    copy = kj::heapArray<capnp::word>(bytes.size() / word);
    std::memcpy(copy.begin(), bytes.data(), copy.size() * word);
    begin = copy.begin();
  }
  capnp::ReaderOptions options;
  options.traversalLimitInWords = bytes.size() / word + spare_words;
  try {
    capnp::FlatArrayMessageReader reader(kj::arrayPtr(begin, bytes.size() / word), options);
    use(reader.getRoot<Struct>());
    return {};
  } catch (const kj::Exception& e) {
    return problem(std::string("malformed message: ") + e.getDescription().cStr());
  }
}

}  // namespace luxodus
