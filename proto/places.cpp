#include "proto/places.hpp"

#include <capnp/schema.h>
#include <proto/wire.capnp.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace luxodus {

namespace {

using SchemaType = capnp::schema::Type::Which;

[[noreturn]] void disagree(const std::string& name) {
  throw std::logic_error("messages.hpp and wire.capnp disagree about " + name);
}

StructPlaces size_in(capnp::StructSchema schema) {
  const auto node = schema.getProto().getStruct();
  return {node.getDataWordCount(), node.getPointerCount(), {}};
}

template <class Value>
constexpr SchemaType schema_type() {
  if constexpr (std::is_same_v<Value, bool>)
    return SchemaType::BOOL;
  else if constexpr (std::is_same_v<Value, std::string>)
    return SchemaType::TEXT;
  else if constexpr (!Number<Value>)
    return SchemaType::LIST;
  else if constexpr (sizeof(Value) == 1)
    return SchemaType::UINT8;
  else if constexpr (sizeof(Value) == 2)
    return SchemaType::UINT16;
  else
    return sizeof(Value) == 4 ? SchemaType::UINT32 : SchemaType::UINT64;
}

template <class Struct>
StructPlaces places_in(capnp::StructSchema schema);

template <class Value>
FieldPlace place_of(capnp::StructSchema::Field field) {
  const std::string name = field.getProto().getName().cStr();
  if (field.getType().which() != schema_type<Value>()) disagree(name);
  FieldPlace place{field.getProto().getSlot().getOffset(), {}};
  if constexpr (schema_type<Value>() == SchemaType::LIST) {
    using Item = ItemOf<Value>;
    const capnp::Type items = field.getType().asList().getElementType();
    if constexpr (Listed<Item>)
      place.items = std::make_unique<StructPlaces>(places_in<Item>(items.asStruct()));
    else if (items.which() != schema_type<Item>())
      disagree(name);
  }
  return place;
}

/// Finds the place of one field after the other in a struct of the schema. `only`, where given, is
/// the place of whatever the list names: the value of the union itself.
struct FieldPlacer {
  capnp::StructSchema schema;
  const capnp::StructSchema::Field* only;
  std::string prefix;
  std::vector<FieldPlace>& out;

  template <class Value>
  void operator()(const char* name, Value& value, const char* = "", AtMost = {}) const {
    const std::string whole = wire_name(prefix, name);
    if constexpr (Listed<Value>) {
      Value::fields(FieldPlacer{schema, only, whole, out}, value);
    } else if (only != nullptr) {
      out.push_back(place_of<Value>(*only));
    } else {
      KJ_IF_MAYBE (field, schema.findFieldByName(whole)) {
        out.push_back(place_of<Value>(*field));
      } else {
        disagree(whole);
      }
    }
  }
};

/// Errors: the list names more fields or fewer than the schema has.
template <class Struct>
std::vector<FieldPlace> places_of(capnp::StructSchema schema,
                                  const capnp::StructSchema::Field* only, size_t fields,
                                  const std::string& name) {
  static_assert(members_listed<Struct>() == members_of<Struct>(),
                "a member is missing in the list of fields beside its struct");
  Struct fresh{};
  std::vector<FieldPlace> out;
  for_each_field(FieldPlacer{schema, only, "", out}, fresh);
  if (out.size() != fields) disagree(name);
  return out;
}

template <class Struct>
StructPlaces places_in(capnp::StructSchema schema) {
  StructPlaces out = size_in(schema);
  out.fields = places_of<Struct>(schema, nullptr, schema.getFields().size(),
                                 schema.getShortDisplayName().cStr());
  return out;
}

template <class Struct>
MessagePlaces message_in(capnp::StructSchema schema, uint16_t number) {
  const capnp::StructSchema::Field field = schema.getUnionFields()[number];
  std::string name = Struct::type.name;
  name[0] = static_cast<char>(name[0] - 'A' + 'a');
  if (field.getProto().getName() != name.c_str() ||
      field.getProto().getDiscriminantValue() != number)
    disagree(name);
  if (field.getType().isStruct())
    return {true, field.getProto().getSlot().getOffset(),
            places_in<Struct>(field.getType().asStruct())};
  const size_t values = field.getType().isVoid() ? 0 : 1;
  return {false, 0, {0, 0, places_of<Struct>(schema, &field, values, name)}};
}

}  // namespace

const WirePlaces& wire_places() {
  static const WirePlaces places = [] {
    const capnp::StructSchema schema = capnp::Schema::from<wire::Message>();
    WirePlaces out;
    out.envelope = places_in<Envelope>(capnp::Schema::from<wire::Envelope>());
    out.message = size_in(schema);
    out.which = schema.getProto().getStruct().getDiscriminantOffset();
    if (schema.getUnionFields().size() != out.messages.size()) disagree("the union of messages");
    uint16_t number = 0;
    for_each_message([&]<class Struct>(const Struct&) {
      out.messages[number] = message_in<Struct>(schema, number);
      ++number;
    });
    return out;
  }();
  return places;
}

}  // namespace luxodus
