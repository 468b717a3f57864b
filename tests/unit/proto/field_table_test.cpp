// PROTOCOL.md says of messages what their lists of fields say.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "proto/messages.hpp"

using namespace luxodus;

namespace {

template <class Value>
std::string type_of(AtMost limit) {
  if constexpr (std::is_same_v<Value, bool>) {
    return "Bool";
  } else if constexpr (std::is_same_v<Value, std::string>) {
    return fmt::format("Text, at most {} B", limits::text_bytes);
  } else if constexpr (Number<Value>) {
    size_t most = limit.count;
    if constexpr (std::is_enum_v<Value>)
      if (last_value<Value> != Value{0xff}) most = number_of(last_value<Value>);
    return fmt::format("UInt{}{}", 8 * sizeof(Value),
                       most ? fmt::format(", at most {}", most) : "");
  } else {
    return fmt::format("List, at most {} {}", limit.count, limit.what);
  }
}

/// One row of the table for each field: "name | type | meaning |".
struct FieldRows {
  std::vector<std::string>& rows;
  std::string within = {};  // a list of structs: "pools[]."
  std::string prefix = {};

  template <class Value>
  void operator()(const char* name, const Value& value, const char* meaning = "",
                  AtMost limit = {}) const {
    const std::string whole = wire_name(prefix, name);
    if constexpr (Listed<Value>) {
      Value::fields(FieldRows{rows, within, whole}, value);
    } else {
      CHECK(*meaning != 0);
      rows.push_back(
          fmt::format("`{}{}` | {} | {} |", within, whole, type_of<Value>(limit), meaning));
      if constexpr (!Number<Value> && StructList<Value>) {
        const ItemOf<Value> item{};
        for_each_field(FieldRows{rows, whole + "[]."}, item);
      }
    }
  }
};

std::string expected_table() {
  std::string out = "| message | kind | field | type | meaning |\n|---|---|---|---|---|\n";
  std::vector<std::string> last;
  std::string last_name;
  const auto add = [&](const std::string& name, const std::string& kind, const auto& message) {
    std::vector<std::string> rows;
    for_each_field(FieldRows{rows}, message);
    const bool same = !rows.empty() && rows == last;
    if (rows.empty()) out += fmt::format("| {} | {} | | | |\n", name, kind);
    if (same) out += fmt::format("| {} | {} | | | as {} |\n", name, kind, last_name);
    for (size_t i = 0; !same && i < rows.size(); ++i)
      out +=
          i == 0 ? fmt::format("| {} | {} | {}\n", name, kind, rows[i]) : "| | | " + rows[i] + "\n";
    last = rows;
    last_name = name;
  };
  constexpr const char* kinds[] = {"link", "control", "request", "reply", "commit"};
  add("Envelope", "all", Envelope{});
  for_each_message([&](const auto& message) {
    add(message.type.name, kinds[number_of(message.type.kind)], message);
  });
  return out;
}

/// The text below a heading, up to the next.
std::string section(const std::string& heading) {
  std::ifstream in(LUX_SOURCE_DIR "/proto/PROTOCOL.md");
  std::string out;
  bool within = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("## "))
      within = line == "## " + heading;
    else if (within)
      out += line + "\n";
  }
  return out;
}

}  // namespace

TEST_CASE("PROTOCOL.md has the fields of all messages", "[proto][documents]") {
  const std::string expected = expected_table(), text = section("Fields");
  const size_t at = text.find("| message |");
  REQUIRE(at != std::string::npos);
  const bool same = text.substr(at) == expected + "\n";
  if (!same) fmt::print("The table that belongs into proto/PROTOCOL.md:\n\n{}\n", expected);
  CHECK(same);
}

TEST_CASE("PROTOCOL.md says who sends what, and what is answered", "[proto][documents]") {
  const std::string text = section("Messages from end to end");
  for_each_message([&](const auto& message) {
    INFO(message.type.name);
    if (message.type.kind != Kind::link) CHECK(text.find(message.type.name) != std::string::npos);
  });
}
