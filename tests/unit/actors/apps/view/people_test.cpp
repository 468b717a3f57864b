// People as the page gets them.
#include "actors/apps/view/people.hpp"

#include <catch2/catch.hpp>
#include <cstring>

#include "actors/results/formats/json.hpp"
#include "runtime/core/base64.hpp"

namespace luxodus {

namespace {

/// Walks 1 m/s east from x = 2 m, for a time that begins at 10 s.
PlacedPerson walker(double seconds) {
  PlacedPerson out;
  out.eye_height_m = 1.6;
  out.times_s = {10, 10 + seconds};
  out.feet = {{2, 1, 0.5}, {2 + seconds, 1, 0.5}};
  return out;
}

std::string as_feet(const std::vector<glm::vec3>& places) {
  std::string bytes(places.size() * sizeof(glm::vec3), '\0');
  std::memcpy(bytes.data(), places.data(), bytes.size());
  return base64(bytes);
}

}  // namespace

TEST_CASE("people are at even steps of time, and at their last one where they end", "[view]") {
  const auto text = people_json({walker(0.5)});
  REQUIRE(text);
  const Json json = Json::parse(text.value());
  CHECK(json["step"] == 0.2);
  REQUIRE(json["people"].size() == 1);
  const Json& one = json["people"][0];
  CHECK(one["eye_height"] == 1.6);
  CHECK(one["from"] == 10);
  CHECK(one["to"] == 10.5);
  CHECK(one["feet"] == as_feet({{2, 1, 0.5F}, {2.2F, 1, 0.5F}, {2.4F, 1, 0.5F}, {2.5F, 1, 0.5F}}));
}

TEST_CASE("a person of one moment has one place", "[view]") {
  PlacedPerson one = walker(1);
  one.times_s = {10};
  one.feet = {{2, 1, 0}};
  const auto text = people_json({one});
  REQUIRE(text);
  CHECK(Json::parse(text.value())["people"][0]["feet"] == as_feet({{2, 1, 0}}));
}

TEST_CASE("many places are sent at longer steps", "[view]") {
  // 400 people for an hour are 7.2 million places at 0.2 s.
  const auto text = people_json(std::vector<PlacedPerson>(400, walker(3600)));
  REQUIRE(text);
  const Json json = Json::parse(text.value());
  CHECK(json["step"] == 1.6);
  CHECK(json["people"][0]["feet"].get<std::string>().size() == size_t{2251} * 16);
}

TEST_CASE("nobody is an empty list, and too many people are refused", "[view]") {
  CHECK(people_json({}).value() == R"({"step":0.2,"people":[]})");
  const auto refused = people_json(std::vector<PlacedPerson>(limits::view_people + 1, walker(0)));
  REQUIRE_FALSE(refused);
  CHECK(refused.problem().what.find("20001") != std::string::npos);
}

}  // namespace luxodus
