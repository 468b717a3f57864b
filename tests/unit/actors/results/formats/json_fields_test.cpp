// Types that list their fields, written as JSON and read back.
#include "actors/results/formats/json_fields.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace luxodus;

namespace {

enum class Colour { red, green, count };
const char* name_of(Colour colour) {
  return colour == Colour::red ? "red" : "green";
}

struct Part {
  std::string name;
  double width_m = 0, depth_m = 0;  // depth: NaN if unknown
  static constexpr void fields(auto&& field, auto& m) {
    field("name", m.name)("width", m.width_m, {.unit = "m"});
    field("depth", m.depth_m, {.unit = "m", .or_null = true});
    field("area", derived([&m] { return m.width_m * m.depth_m; }), {.or_null = true});
  }
};

struct Forgotten {
  int a = 0, b = 0;
  static constexpr void fields(auto&& field, auto& m) { field("a", m.a); }
};

struct Paint {
  Colour colour = Colour::red;
  std::optional<double> gloss;
  static constexpr void fields(auto&& field, auto& m) {
    field("colour", m.colour)("gloss", m.gloss);
  }
};

struct Thing {
  bool old = false;
  uint64_t seed = 0;
  int floor = 0;
  glm::dvec2 place{0};
  std::vector<Part> parts;
  std::map<std::string, size_t> counts;
  std::optional<Paint> paint;
  std::optional<double> price;
  std::string note;
  static constexpr void fields(auto&& field, auto& m) {
    field("age", either(m.old, "old", "new"))("seed", m.seed)("floor", m.floor);
    field("place", m.place)("parts", m.parts)("counts", m.counts)(in_place, m.paint);
    field("price", m.price, {.or_null = true});
    field("note", m.note, {.or_left_out = true, .max_text = 5});
  }
};

Thing thing() {
  Thing out;
  out.seed = 18'446'744'073'709'551'615u;
  out.floor = -1;
  out.place = {1, 2.5};
  out.parts = {{"leg", 0.5, 2}, {"top", 1, std::nan("")}};
  out.counts = {{"legs", 4}};
  return out;
}

const char* thing_text =
    R"({"age":"new","seed":18446744073709551615,"floor":-1,"place":[1.0,2.5],)"
    R"("parts":[{"name":"leg","width":{"value":0.5,"unit":"m"},)"
    R"("depth":{"value":2.0,"unit":"m"},"area":1.0},)"
    R"({"name":"top","width":{"value":1.0,"unit":"m"},)"
    R"("depth":{"value":null,"unit":"m"},"area":null}],"counts":{"legs":4},"price":null})";

/// What is wrong after a value at a path is set, or removed if it is discarded.
std::string fault(const char* path, const char* key, const Json& value = Json::parse("?")) {
  Json json = Json::parse(thing_text);
  Json& object = *path == '\0' ? json : *json.at_path(path);
  if (value.is_discarded())
    object.erase(key);
  else
    object[key] = value;
  Thing out;
  const auto read = read_fields(json, out);
  return read ? "" : read.problem().what;
}

}  // namespace

TEST_CASE("a type is written by its list of fields, and read back", "[formats][json]") {
  const Json written = json_of(thing());
  CHECK(written.dump() == thing_text);
  Thing read;
  REQUIRE(read_fields(Json::parse(thing_text), read));
  CHECK(json_of(read).dump() == thing_text);
  CHECK(std::isnan(read.parts[1].depth_m));
  CHECK_FALSE(read.paint);
  read.old = true;
  read.note = "oak";
  read.paint = {Colour::green, std::nullopt};
  Json painted = json_of(read);
  CHECK(painted["age"] == "old");
  CHECK(painted["colour"] == "green");
  CHECK_FALSE(painted.contains("gloss"));
  painted["of later versions"] = 3;
  Thing again;
  REQUIRE(read_fields(painted, again));
  CHECK(again.paint->colour == Colour::green);
  CHECK(again.note == "oak");
}

TEST_CASE("what is wrong in a JSON is named with its place", "[formats][json]") {
  CHECK(fault("", "seed") == "it has no \"seed\"");
  CHECK(fault("parts/1", "name") == "parts[1] has no \"name\"");
  CHECK(fault("parts/1", "area") == "parts[1] has no \"area\"");
  CHECK(fault("parts/0", "name", 3) == "parts[0].name is not a text");
  CHECK(fault("parts/0/width", "value", nullptr) == "parts[0].width.value is not a number");
  CHECK(fault("parts/0/width", "unit", "mm") == "parts[0].width.unit is not \"m\"");
  CHECK(fault("parts/0/width", "unit") == "parts[0].width has no \"unit\"");
  CHECK(fault("", "parts", 3) == "parts is not a list");
  CHECK(fault("", "age", "young") == "age is \"young\": unknown");
  CHECK(fault("", "place", Json::array({1, 2, 3})) == "place is not a list of 2 numbers");
  CHECK(fault("", "counts", Json::array()) == "counts is not a table");
  CHECK(fault("counts", "legs", -4) == "counts.legs is not from 0 to 18446744073709551615");
  CHECK(fault("", "floor", 1.5) == "floor is not a whole number");
  CHECK(fault("", "floor", 3e9) == "floor is not from -2147483648 to 2147483647");
  CHECK(fault("", "price") == "it has no \"price\"");
  CHECK(fault("", "colour", "blue") == "colour is \"blue\": unknown");
  // Of a struct that stands in place all fields are there, or none.
  CHECK(fault("", "gloss", 0.5) == "it has no \"colour\"");
}

TEST_CASE("texts and numbers of a JSON have limits", "[formats][json]") {
  CHECK(fault("", "note", "walnut") == "note has more than 5 characters");
  CHECK(fault("parts/0", "name", std::string(limits::field_text + 1, 'x')) ==
        "parts[0].name has more than 20000 characters");
  CHECK(fault("", "price", 1e20) == "price is larger than any number of a result");
  CHECK(fault("", "place", Json::array({0, 1e8})) == "place[1] is farther off than any scene");
  CHECK(fault("", "price", 1e19).empty());
}

TEST_CASE("a list of fields names every member", "[formats][json]") {
  CHECK(fields_listed<Thing>() == members_of<Thing>());
  CHECK(fields_listed<Part>() == members_of<Part>());
  CHECK(fields_listed<Forgotten>() != members_of<Forgotten>());
}
