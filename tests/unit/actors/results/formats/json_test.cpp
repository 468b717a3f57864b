// Our JSON value against nlohmann's, which writes the same bytes and reads the same values.
#include "actors/results/formats/json.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

using luxodus::Json;
using Theirs = nlohmann::ordered_json;

namespace {

std::string dump_theirs(const Theirs& value, int indent) {
  return value.dump(indent, ' ', false, Theirs::error_handler_t::replace);
}

/// A document as text, of all kinds of values, some of them nested.
std::string random_text(std::mt19937_64& random, int depth) {
  const auto below = [&](uint64_t n) { return static_cast<int>(random() % n); };
  switch (below(depth > 0 ? 9 : 6)) {
    case 0:
      return "null";
    case 1:
      return below(2) == 0 ? "true" : "false";
    case 2:
      return std::to_string(static_cast<int64_t>(random()) >> below(64));
    case 3:
      return std::to_string(random() >> below(64));
    case 4:
      return dump_theirs(
          std::ldexp(static_cast<double>(static_cast<int64_t>(random())), below(200) - 160), -1);
    case 5: {
      std::string text;
      for (int i = below(12); i > 0; --i) text += static_cast<char>(random());
      return dump_theirs(text, -1);
    }
    case 6:
    case 7: {
      std::string out = "{";
      for (int i = 0, n = below(5); i < n; ++i)
        out += (i > 0 ? "," : "") + ("\"key " + std::to_string(below(4))) +
               "\": " + random_text(random, depth - 1);
      return out + "}";
    }
    default: {
      std::string out = "[";
      for (int i = 0, n = below(5); i < n; ++i)
        out += (i > 0 ? "," : "") + random_text(random, depth - 1);
      return out + "]";
    }
  }
}

}  // namespace

TEST_CASE("JSON is read and written in the same bytes as nlohmann's", "[format][json]") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 2000; ++i) {
    std::string text = random_text(random, 4);
    INFO(text);
    for (const int indent : {-1, 0, 2})
      REQUIRE(Json::parse(text).dump(indent) == dump_theirs(Theirs::parse(text), indent));
    // Both reject damaged text.
    text[random() % text.size()] = static_cast<char>(random());
    const Theirs theirs = Theirs::parse(text, nullptr, false);
    const Json ours = Json::parse(text);
    REQUIRE(ours.is_discarded() == theirs.is_discarded());
    if (!theirs.is_discarded()) REQUIRE(ours.dump(1) == dump_theirs(theirs, 1));
  }
}

TEST_CASE("initializer lists make the same JSON as nlohmann's", "[format][json]") {
  const std::vector<double> list = {1, 0.1, -0.0, 1e300, 5e-324, NAN, INFINITY};
  const auto build = [&](auto kind) {
    using Kind = decltype(kind);
    Kind out = {{"a", 1},
                {"b", {1, 2.5f, true, nullptr}},
                {"pair", {"x", "y"}},
                {"nested", {{"c", uint64_t{1} << 63}, {"d", "\x01 \xff \" \\ \n \x7f"}}},
                {"a", "the second of two"},
                {"none", {}},
                {"list", list}};
    out["new"]["deep"] = -3;
    out["array"].push_back({{"k", "v"}});
    out["array"].push_back(Kind::array({1, 2}));
    out.update(Kind{{"a", 7}, {"z", Kind::object()}});
    out.erase("pair");
    out["count"] = out["array"].size();
    out["copy"] = out["nested"];
    out["wrapped"] = Kind{"x"};
    return out;
  };
  CHECK(build(Json()).dump(2) == dump_theirs(build(Theirs()), 2));
}

TEST_CASE("JSON is read by key, place and path, and throws for other kinds", "[format][json]") {
  const Json json = Json::parse(R"({"a": [1, {"b": "x"}], "n": -2, "t": true, "r": 0.5})");
  CHECK(json["a"][1]["b"] == "x");
  CHECK(json.at_path("a/1/b")->get<std::string>() == "x");
  CHECK(json.at_path("a/2") == nullptr);
  CHECK(json.at_path("a/x") == nullptr);
  CHECK(json.at_path("n/0") == nullptr);
  CHECK(json.value("n", 0) == -2);
  CHECK(json.value("m", 4.0) == 4);
  CHECK(json.value("m", "none") == "none");
  CHECK(json["n"] == -2.0);
  CHECK(json["t"].get<bool>());
  CHECK_THROWS_AS(json["m"], Json::exception);
  CHECK_THROWS_AS(json["a"][2], Json::exception);
  CHECK_THROWS_AS(json["a"].items(), Json::exception);
  CHECK_THROWS_AS(json["a"].get<double>(), Json::exception);
  CHECK_THROWS_AS(json["n"].get<std::string>(), Json::exception);
  std::string keys;
  for (auto at = json.begin(); at != json.end(); ++at) keys += at.key();
  CHECK(keys == "antr");
  CHECK(Json::parse("{").is_discarded());
}

TEST_CASE("JSON with excessive nesting is rejected", "[format][json][hostile]") {
  const auto nested = [](size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
  };
  CHECK(Json::parse(nested(luxodus::limits::json_nesting)).is_array());
  CHECK(Json::parse(nested(luxodus::limits::json_nesting + 1)).is_discarded());
  CHECK(Json::parse(std::string(10'000'000, '[')).is_discarded());
}
