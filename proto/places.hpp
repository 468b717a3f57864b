// Where the fields of a struct lie in Cap'n Proto's bytes, found once in the schema by the names of
// its list (field_list.hpp). A list and a schema that disagree are a programmer's mistake: the
// first codec of the program throws. Immutable after that; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "proto/messages.hpp"

namespace luxodus {

struct StructPlaces;

/// Where a field lies: the offset of a number in units of its size, the bit of a bool, or the index
/// of a pointer.
struct FieldPlace {
  uint32_t at = 0;
  std::unique_ptr<const StructPlaces> items;  // of a list of structs
};

struct StructPlaces {
  uint16_t data_words = 0;
  uint16_t pointers = 0;
  std::vector<FieldPlace> fields;  // in the order of the list
};

/// A message is a struct behind a pointer of the union, or is itself the union's only value.
struct MessagePlaces {
  bool behind_pointer = false;
  uint32_t pointer = 0;
  StructPlaces body;
};

struct WirePlaces {
  StructPlaces envelope;
  StructPlaces message;  // the struct with the union; none of its fields
  uint32_t which = 0;    // place of the number that says which message it is
  std::array<MessagePlaces, std::variant_size_v<Message>> messages;
};

/// Errors: throws std::logic_error if a list and the schema disagree.
const WirePlaces& wire_places();

}  // namespace luxodus
