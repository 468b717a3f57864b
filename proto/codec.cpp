// A frame's words are trusted in this order: first its segment table (here, by hand: one segment,
// no longer than the bytes at hand and the limit), then the pointers within (Cap'n Proto, with a
// traversal limit of the segment's own words, so that pointers which meet cannot multiply work),
// then the values (here: enumerations, limits of numbers, lists and texts).
// Structs are written and read by the lists of fields beside them, at the places that the schema
// gives (places.hpp), with what Cap'n Proto's generated accessors call: StructBuilder and
// StructReader. AnyStruct, which is meant for this, takes a fifth longer for a short message.
#include "proto/codec.hpp"

#include <capnp/any.h>
#include <capnp/message.h>
#include <capnp/serialize.h>

#include <array>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

#include "proto/places.hpp"

namespace luxodus {

namespace {

constexpr size_t word = sizeof(uint64_t);
static_assert(word == sizeof(capnp::word));

/// Messages are a struct, lists of structs, and text: depth 4. Deeper is malformed.
constexpr int max_nesting = 8;

/// Cap'n Proto counts the words it visits; every word is visited once, and the roots a few times.
constexpr uint64_t spare_words = 16;

using capnp::_::StructBuilder;
using capnp::_::StructReader;

capnp::_::StructSize size_of(const StructPlaces& places) {
  return {places.data_words, places.pointers};
}

Problem malformed(std::string what) {
  return {{}, "malformed frame: " + std::move(what)};
}

/// Out of line: what is rare does not stand between the steps of reading.
[[noreturn, gnu::noinline, gnu::cold]] void refuse(const char* what, const char* of) {
  throw malformed(std::string(what) + of);
}

// ---- values to words

/// Writes one field after the other into the words of a new struct. A list or text that the other
/// side would refuse is thrown as a Problem.
class FieldWriter {
 public:
  FieldWriter(StructBuilder out, const StructPlaces& places)
      : out_(out), place_(places.fields.data()) {}

  template <class Value>
  void operator()(const char*, const Value& value, const char* = "", AtMost limit = {}) {
    if constexpr (std::is_same_v<Value, std::string>) limit.count = limits::text_bytes;
    if constexpr (requires { value.size(); })
      if (value.size() > limit.count)
        throw problem("a message has a list or a text over its limit");
    if constexpr (Listed<Value>)
      Value::fields(*this, value);
    else
      write(*place_++, value);
  }

 private:
  void write(const FieldPlace& place, bool value) { out_.setDataField<bool>(place.at, value); }
  void write(const FieldPlace& place, Number auto value) {
    const auto number = number_of(value);
    out_.setDataField<std::remove_const_t<decltype(number)>>(place.at, number);
  }
  void write(const FieldPlace& place, const std::string& text) {
    pointer(place).setAs<capnp::Text>(text.c_str());
  }
  void write(const FieldPlace& place, const std::vector<uint64_t>& numbers) {
    const auto size = static_cast<unsigned>(numbers.size());
    auto out = pointer(place).initAs<capnp::List<uint64_t>>(size);
    for (unsigned i = 0; i < size; ++i) out.set(i, numbers[i]);
  }
  void write(const FieldPlace& place, const StructList auto& structs) {
    auto out = out_.getPointerField(place.at).initStructList(static_cast<unsigned>(structs.size()),
                                                             size_of(*place.items));
    unsigned i = 0;
    for (const auto& item : structs)
      for_each_field(FieldWriter(out.getStructElement(i++), *place.items), item);
  }

  capnp::AnyPointer::Builder pointer(const FieldPlace& place) {
    return capnp::AnyPointer::Builder(out_.getPointerField(place.at));
  }

  StructBuilder out_;
  const FieldPlace* place_;
};

void write(capnp::_::PointerBuilder root, const Envelope& envelope) {
  const StructPlaces& places = wire_places().envelope;
  Envelope::fields(FieldWriter(root.initStruct(size_of(places)), places), envelope);
}

void write(capnp::_::PointerBuilder root, const Message& message) {
  const WirePlaces& wire = wire_places();
  const auto which = static_cast<uint16_t>(message.index());
  const MessagePlaces& places = wire.messages[which];
  StructBuilder out = root.initStruct(size_of(wire.message));
  out.setDataField<uint16_t>(wire.which, which);
  if (places.behind_pointer)
    out = out.getPointerField(places.pointer).initStruct(size_of(places.body));
  std::visit([&](const auto& m) { for_each_field(FieldWriter(out, places.body), m); }, message);
}

// ---- words to values; what breaks a limit is thrown as a Problem and caught at the boundary below

/// Reads one field after the other. What the words of a struct do not reach is 0 or empty.
class FieldReader {
 public:
  FieldReader(const StructReader& in, const StructPlaces& places, SpareLists& spare)
      : in_(in), place_(places.fields.data()), spare_(spare) {}

  template <class Value>
  void operator()(const char* name, Value& value, const char* = "", AtMost limit = {}) {
    if constexpr (Listed<Value>)
      Value::fields(*this, value);
    else
      read(*place_++, value, name, limit);
  }

 private:
  void read(const FieldPlace& place, bool& value, const char*, AtMost) {
    value = in_.getDataField<bool>(place.at);
  }
  template <Number Value>
  void read(const FieldPlace& place, Value& value, const char* name, AtMost limit) {
    const auto number = in_.getDataField<decltype(number_of(value))>(place.at);
    if (limit.count != 0 && number > limit.count) refuse("too many ", limit.what);
    if constexpr (std::is_enum_v<Value>)
      if (number > number_of(last_value<Value>)) refuse("no such ", name);
    if constexpr (std::is_class_v<Value>)
      value = {number};
    else
      value = static_cast<Value>(number);
  }
  void read(const FieldPlace& place, std::string& value, const char*, AtMost) {
    const auto text = pointer(place).getAs<capnp::Text>();
    if (text.size() > limits::text_bytes) refuse("a text is too long", "");
    value.assign(text.begin(), text.end());
    // It is logged: a peer may not write control characters to an operator's terminal.
    for (char& c : value)
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  void read(const FieldPlace& place, std::vector<uint64_t>& value, const char*, AtMost limit) {
    const auto list = pointer(place).getAs<capnp::List<uint64_t>>();
    if (list.size() > limit.count) refuse("too many ", limit.what);
    value = spare_.take(list.size());
    for (const uint64_t number : list) value.push_back(number);
  }
  template <StructList Structs>
  void read(const FieldPlace& place, Structs& value, const char*, AtMost limit) {
    const auto list =
        in_.getPointerField(place.at).getList(capnp::ElementSize::INLINE_COMPOSITE, nullptr);
    if (list.size() > limit.count) refuse("too many ", limit.what);
    if constexpr (requires { value.reserve(0); }) value.reserve(list.size());
    for (unsigned i = 0; i < list.size(); ++i) {
      ItemOf<Structs> item;
      for_each_field(FieldReader(list.getStructElement(i), *place.items, spare_), item);
      value.push_back(item);
    }
  }

  capnp::AnyPointer::Reader pointer(const FieldPlace& place) const {
    return capnp::AnyPointer::Reader(in_.getPointerField(place.at));
  }

  const StructReader& in_;
  const FieldPlace* place_;
  SpareLists& spare_;
};

template <class Struct>
Result<OpenedMessage> read_as(const StructReader& in, const StructPlaces& places,
                              SpareLists& spare) {
  // Read where it will stay: to copy what was just written in parts stalls the processor.
  Result<OpenedMessage> out(OpenedMessage{Struct{}, {}});
  for_each_field(FieldReader(in, places, spare), *std::get_if<Struct>(&out->message));
  return out;
}

template <class... Structs>
constexpr auto readers_of(const std::variant<Structs...>*) {
  return std::array{&read_as<Structs>...};
}

Result<OpenedMessage> read_message(const StructReader& in, SpareLists& spare) {
  static constexpr auto readers = readers_of(static_cast<const Message*>(nullptr));
  const WirePlaces& wire = wire_places();
  const auto which = in.getDataField<uint16_t>(wire.which);
  if (which >= readers.size()) refuse("no such ", "message");
  const MessagePlaces& places = wire.messages[which];
  if (!places.behind_pointer) return readers[which](in, places.body, spare);
  return readers[which](in.getPointerField(places.pointer).getStruct(nullptr), places.body, spare);
}

Result<OpenedFrame> read_envelope(const StructReader& in, SpareLists& spare) {
  OpenedFrame out;
  Envelope::fields(FieldReader(in, wire_places().envelope, spare), out.envelope);
  return out;
}

// ---- the boundary

template <class Value>
Result<size_t> encode_segment(const Value& value, std::span<uint64_t> scratch,
                              std::span<std::byte> out) {
  // The builder gives the scratch back zeroed, as it must find it.
  capnp::MallocMessageBuilder builder(
      kj::arrayPtr(reinterpret_cast<capnp::word*>(scratch.data()), scratch.size()));
  write(capnp::_::PointerHelpers<capnp::AnyPointer>::getInternalBuilder(
            builder.getRoot<capnp::AnyPointer>()),
        value);
  const auto segments = builder.getSegmentsForOutput();
  const auto bytes = segments[0].asBytes();
  const size_t total = word + bytes.size();
  if (segments.size() != 1 || total > out.size())
    return problem("a message is longer than its buffer");
  const uint32_t table[2] = {0, static_cast<uint32_t>(segments[0].size())};
  std::memcpy(out.data(), table, word);
  std::memcpy(out.data() + word, bytes.begin(), bytes.size());
  return total;
}

template <class Value>
Result<Value> decode_segment(const std::byte* begin, size_t bytes, SpareLists& spare,
                             Result<Value> (*read)(const StructReader&, SpareLists&)) {
  try {
    const size_t words = bytes / word;
    capnp::ReaderOptions options;
    options.traversalLimitInWords = words + spare_words;
    options.nestingLimit = max_nesting;
    capnp::FlatArrayMessageReader reader(
        kj::arrayPtr(reinterpret_cast<const capnp::word*>(begin), words), options);
    return read(capnp::_::PointerHelpers<capnp::AnyPointer>::getInternalReader(
                    reader.getRoot<capnp::AnyPointer>())
                    .getStruct(nullptr),
                spare);
  } catch (const kj::Exception& e) {
    return malformed(e.getDescription().cStr());
  } catch (const Problem& problem) {
    return problem;
  }
}

}  // namespace

std::vector<uint64_t> SpareLists::take(size_t numbers) {
  std::vector<uint64_t> list;
  if (!lists_.empty() && numbers > 0) {
    list = std::move(lists_.back());
    lists_.pop_back();
  }
  constexpr size_t few = 16;  // a longer list is of a flush: the next one may be as long as any
  list.reserve(numbers > few ? limits::leases : numbers);
  return list;
}

void SpareLists::give_back(std::vector<uint64_t>&& list) {
  constexpr size_t max_kept = 256;  // 2 MB of the longest; more flushes seldom wait at once
  if (list.capacity() == 0 || lists_.size() == max_kept) return;
  list.clear();
  lists_.push_back(std::move(list));
}

constexpr size_t scratch_words = limits::message_bytes / word;

Codec::Codec()
    : aligned_(std::make_unique<uint64_t[]>(scratch_words)),
      building_(std::make_unique<uint64_t[]>(scratch_words)) {
  (void)wire_places();  // a list that the schema contradicts ends the start-up, not a link
}

size_t Codec::encode(const Envelope& envelope, std::span<const std::byte> body,
                     std::span<std::byte> out) {
  const std::span<std::byte> room = out.subspan(limits::check_bytes);
  const size_t bytes = encode_segment(envelope, {building_.get(), scratch_words}, room).value();
  check_.reset();
  check_.add(room.data(), bytes);
  check_.add(body.data(), body.size());
  const uint64_t check = check_.value();
  std::memcpy(out.data(), &check, sizeof check);
  return limits::check_bytes + bytes;
}

namespace {
uint64_t check_of(std::span<const std::byte> frame) {
  return hash_of(frame.subspan(limits::check_bytes));  // as Hasher
}
}  // namespace

void Codec::seal(std::span<std::byte> frame) {
  const uint64_t check = check_of(frame);
  std::memcpy(frame.data(), &check, sizeof check);
}

Result<size_t> Codec::encode(const Message& message, std::span<std::byte> out) {
  try {
    return encode_segment(message, {building_.get(), scratch_words}, out);
  } catch (const Problem& problem) {
    return problem;
  }
}

Result<Codec::Segment> Codec::first_segment(std::span<const std::byte> bytes, size_t limit) {
  uint32_t table[2];  // segments less one, words of the first
  if (bytes.size() < word) return malformed("shorter than a word");
  std::memcpy(table, bytes.data(), word);
  if (table[0] != 0) return malformed("more than one segment");
  const uint64_t size = word + uint64_t{table[1]} * word;
  if (size > bytes.size()) return malformed("cut short");
  if (size > limit) return malformed("too long");
  if (reinterpret_cast<uintptr_t>(bytes.data()) % word == 0) return Segment{bytes.data(), size};
  std::memcpy(aligned_.get(), bytes.data(), size);
  return Segment{reinterpret_cast<const std::byte*>(aligned_.get()), size};
}

Result<OpenedFrame> Codec::open_frame(std::span<const std::byte> frame) {
  uint64_t check = 0;
  if (frame.size() < limits::check_bytes) return malformed("shorter than a check");
  std::memcpy(&check, frame.data(), sizeof check);
  if (check != check_of(frame)) return malformed("harmed on its way: its check does not hold");
  frame = frame.subspan(limits::check_bytes);
  const auto segment = first_segment(frame, limits::envelope_bytes);
  if (!segment) return segment.problem();
  auto opened = decode_segment(segment->begin, segment->bytes, spare_, read_envelope);
  if (opened) opened->body = frame.subspan(segment->bytes);
  return opened;
}

Result<OpenedMessage> Codec::open_message(std::span<const std::byte> bytes) {
  const auto segment = first_segment(bytes, limits::message_bytes);
  if (!segment) return segment.problem();
  auto opened = decode_segment(segment->begin, segment->bytes, spare_, read_message);
  if (opened) opened->payload = bytes.subspan(segment->bytes);
  return opened;
}

}  // namespace luxodus
