#include "actors/apps/view/page_message.hpp"

#include <catch2/catch.hpp>

#include "runtime/core/random.hpp"

using namespace luxodus;

namespace {

std::string refused(const std::string& text) {
  const auto message = decode_page_message(text);
  INFO(text);
  REQUIRE_FALSE(message.ok());
  return message.problem().what;
}

}  // namespace

TEST_CASE("undoing, additions of types, and ids of questions are decoded within limits", "[view]") {
  const auto history = decode_page_message(R"({"type":"history","done":3})");
  REQUIRE(history.ok());
  CHECK(std::get<HistoryEdit>(history.value()).done == 3);
  CHECK(is_edit(history.value()));
  CHECK(refused(R"({"type":"history","done":-1})").find("done") != std::string::npos);
  CHECK(refused(R"({"type":"history","done":201})").find("done") != std::string::npos);
  CHECK(refused(R"({"type":"history","done":1.5})").find("done") != std::string::npos);
  const auto add = decode_page_message(
      R"({"type":"add","kind":"luminaire","of":"lamp","of_type":true,"position":[1,2,3]})");
  REQUIRE(add.ok());
  CHECK(std::get<AddEdit>(add.value()).of_type);
  CHECK(refused(R"({"type":"add","kind":"sign","of":"x","of_type":1,"position":[1,2,3]})")
            .find("of_type") != std::string::npos);
  const auto judge = decode_page_message(R"({"type":"judge","sign":"exit","id":7})");
  REQUIRE(judge.ok());
  CHECK(std::get<JudgeAsk>(judge.value()).id == 7);
  CHECK_FALSE(is_edit(judge.value()));
  const auto checks = decode_page_message(R"({"type":"checks","id":8})");
  REQUIRE(checks.ok());
  CHECK(std::get<ChecksAsk>(checks.value()).id == 8);
  CHECK_FALSE(is_edit(checks.value()));
  CHECK(refused(R"({"type":"checks","id":-8})").find("id") != std::string::npos);
}

TEST_CASE("valid messages of a viewer are decoded", "[view]") {
  const auto factor = decode_page_message(R"({"type":"factor","group":"lamp","factor":0.25})");
  REQUIRE(factor.ok());
  CHECK(std::get<FactorEdit>(factor.value()).group == "lamp");
  CHECK(std::get<FactorEdit>(factor.value()).factor == 0.25);
  CHECK(is_edit(factor.value()));
  const auto move = decode_page_message(
      R"({"type":"move","kind":"sign","name":"exit","position":[1,2,3],"facing":[0,1,0]})");
  REQUIRE(move.ok());
  CHECK(std::get<MoveEdit>(move.value()).position == glm::dvec3(1, 2, 3));
  CHECK(std::get<MoveEdit>(move.value()).facing == glm::dvec3(0, 1, 0));
  const auto probe = decode_page_message(R"({"type":"probe","id":3,"triangle":9,"front":false})");
  REQUIRE(probe.ok());
  CHECK(std::get<ProbeAsk>(probe.value()).triangle == 9);
  CHECK_FALSE(is_edit(probe.value()));
  CHECK(decode_page_message(R"({"type":"edit","wanted":true})").ok());
  CHECK(decode_page_message(R"({"type":"judge","sign":"exit"})").ok());
  const auto render = decode_page_message(
      R"({"type":"render","id":4,"eye":[1,2,3],"target":[2,2,3],"up":[0,0,1],"fov":55,)"
      R"("width":960,"height":540,"human":true})");
  REQUIRE(render.ok());
  CHECK(std::get<RenderAsk>(render.value()).id == 4);
  CHECK(std::get<RenderAsk>(render.value()).target == glm::dvec3(2, 2, 3));
  CHECK(std::get<RenderAsk>(render.value()).vertical_fov_deg == 55);
  CHECK(std::get<RenderAsk>(render.value()).width == 960);
  CHECK(std::get<RenderAsk>(render.value()).human);
  CHECK_FALSE(is_edit(render.value()));
  const auto stop = decode_page_message(R"({"type":"stop_render"})");
  REQUIRE(stop.ok());
  CHECK_FALSE(is_edit(stop.value()));
  const auto ask = decode_page_message(R"({"type":"suggest","free":["lamp copy"]})");
  REQUIRE(ask.ok());
  CHECK(std::get<SuggestAsk>(ask.value()).free == std::vector<std::string>{"lamp copy"});
  CHECK_FALSE(is_edit(ask.value()));
  CHECK(decode_page_message(R"({"type":"smoke","factor":0})").ok());
  const auto state = decode_page_message(R"({"type":"state","at":60.5})");
  REQUIRE(state.ok());
  CHECK(std::get<StateEdit>(state.value()).at_s == 60.5);
  CHECK(is_edit(state.value()));
  CHECK(decode_page_message(R"({"type":"scenario","name":"dark"})").ok());
  const auto time = decode_page_message(R"({"type":"time","seconds":5})");
  REQUIRE(time.ok());
  CHECK(std::get<TimeEdit>(time.value()).seconds == 5.0);
  CHECK(is_edit(time.value()));
  const auto settled = decode_page_message(R"({"type":"time","seconds":null})");
  REQUIRE(settled.ok());
  CHECK_FALSE(std::get<TimeEdit>(settled.value()).seconds.has_value());
  CHECK(decode_page_message(R"({"type":"save","name":"brighter"})").ok());
  const auto add =
      decode_page_message(R"({"type":"add","kind":"luminaire","of":"lamp","position":[1,2,3]})");
  REQUIRE(add.ok());
  CHECK_FALSE(std::get<AddEdit>(add.value()).is_sign);
  CHECK(std::get<AddEdit>(add.value()).of == "lamp");
  CHECK(std::get<AddEdit>(add.value()).position == glm::dvec3(1, 2, 3));
  CHECK_FALSE(std::get<AddEdit>(add.value()).facing.has_value());
  CHECK(is_edit(add.value()));
  const auto remove = decode_page_message(R"({"type":"remove","name":"lamp copy"})");
  REQUIRE(remove.ok());
  CHECK(std::get<RemoveEdit>(remove.value()).name == "lamp copy");
  CHECK(is_edit(remove.value()));
}

TEST_CASE("all other messages are refused with a reason", "[view]") {
  CHECK(refused("").find("JSON") != std::string::npos);
  CHECK(refused("[]").find("JSON") != std::string::npos);
  CHECK(refused(R"({"type":"shutdown"})").find("no message of this type") != std::string::npos);
  CHECK(refused(R"({"type":"factor","group":"a","factor":11})").find("range") != std::string::npos);
  CHECK(refused(R"({"type":"factor","group":"a","factor":"1"})").find("a number") !=
        std::string::npos);
  CHECK(refused(R"({"type":"factor","group":"","factor":1})").find("1 to 200") !=
        std::string::npos);
  CHECK(refused(R"({"type":"time","seconds":-1})").find("range") != std::string::npos);
  CHECK(refused(R"({"type":"time","seconds":"now"})").find("a number") != std::string::npos);
  CHECK(refused(R"({"type":"smoke","factor":-1})").find("range") != std::string::npos);
  CHECK(refused(R"({"type":"state","at":2e6})").find("range") != std::string::npos);
  CHECK(refused(R"({"type":"state"})").find("\"at\" must be a number") != std::string::npos);
  CHECK(refused(R"({"type":"smoke","factor":1e999})").find("JSON") != std::string::npos);
  CHECK(refused(R"({"type":"move","kind":"sign","name":"a","position":[1,2]})")
            .find("three numbers") != std::string::npos);
  CHECK(refused(R"({"type":"move","kind":"sign","name":"a","position":[1,2,1e9]})").find("1e7") !=
        std::string::npos);
  CHECK(refused(R"({"type":"move","kind":"wall","name":"a","position":[1,2,3]})")
            .find("\"luminaire\"") != std::string::npos);
  CHECK(refused(R"({"type":"add","kind":"flame","of":"a","position":[1,2,3]})")
            .find("\"luminaire\"") != std::string::npos);
  CHECK(refused(R"({"type":"add","kind":"sign","position":[1,2,3]})").find("\"of\"") !=
        std::string::npos);
  CHECK(refused(R"({"type":"add","kind":"sign","of":"a"})").find("three numbers") !=
        std::string::npos);
  CHECK(refused(R"({"type":"add","kind":"sign","of":"a","position":[1,2,3],"facing":[0,1]})")
            .find("three numbers") != std::string::npos);
  CHECK(refused(R"({"type":"remove","name":7})").find("a text") != std::string::npos);
  CHECK(refused(R"({"type":"remove","name":")" + std::string(201, 'x') + "\"}").find("1 to 200") !=
        std::string::npos);
  CHECK(refused(R"({"type":"suggest"})").find("list of texts") != std::string::npos);
  CHECK(refused(R"({"type":"suggest","free":"a"})").find("list of texts") != std::string::npos);
  CHECK(refused(R"({"type":"suggest","free":["a",7]})").find("1 to 200") != std::string::npos);
  std::string many = R"({"type":"suggest","free":["a")";
  for (size_t i = 0; i < limits::view_added; ++i) many += R"(,"a")";
  CHECK(refused(many + "]}").find("not too long") != std::string::npos);
  CHECK(refused(R"({"type":"probe","id":-1,"triangle":0,"front":true})").find("range") !=
        std::string::npos);
  CHECK(refused(R"({"type":"probe","id":1,"triangle":4294967296,"front":true})").find("range") !=
        std::string::npos);
  const auto picture = [](const std::string& target, const std::string& size) {
    return R"({"type":"render","id":4,"eye":[1,2,3],"target":)" + target +
           R"(,"up":[0,0,1],"fov":55,"human":false,)" + size + "}";
  };
  CHECK(decode_page_message(picture("[2,2,3]", R"("width":1024,"height":512)")).ok());
  CHECK(refused(picture("[2,2,3]", R"("width":1024,"height":513)")).find("524288 pixels") !=
        std::string::npos);
  CHECK(refused(picture("[2,2,3]", R"("width":15,"height":64)")).find("16 at least") !=
        std::string::npos);
  CHECK(refused(picture("[2,2,3]", R"("width":4294967297,"height":64)")).find("range") !=
        std::string::npos);
  CHECK(refused(picture("[1,2,3]", R"("width":64,"height":64)")).find("another place") !=
        std::string::npos);
  CHECK(refused(std::string(limits::page_message_bytes + 1, ' ')).find("64 KiB") !=
        std::string::npos);
  CHECK(refused(std::string(60'000, '[')).find("brackets") != std::string::npos);
}

TEST_CASE("random text is refused, and nothing worse", "[view]") {
  const std::string said[] = {
      R"({"type":"move","kind":"sign","name":"exit","position":[1,2,3],"facing":[0,1,0]})",
      R"({"type":"add","kind":"sign","of":"exit","position":[1,2,3],"facing":[0,1,0]})",
      R"({"type":"remove","name":"exit copy"})",
      R"({"type":"render","id":4,"eye":[1,2,3],"target":[2,2,3],"up":[0,0,1],"fov":55,)"
      R"("width":960,"height":540,"human":true})",
      R"({"type":"suggest","free":["lamp copy","lamp copy 2"]})"};
  Random random(1, RandomStream::test);
  for (uint64_t round = 0; round < 20'000; ++round) {
    random.start(round);
    std::string text = said[round % std::size(said)];
    const uint64_t changes = 1 + random.bits() % 6;
    for (uint64_t i = 0; i < changes; ++i) {
      const size_t at = random.bits() % text.size();
      if (random.bits() % 4 == 0)
        text.erase(at, 1 + random.bits() % 8);
      else
        text[at] = static_cast<char>(random.bits() & 0xff);
      if (text.empty()) text = "x";
    }
    const auto message = decode_page_message(text);
    if (!message.ok()) CHECK_FALSE(message.problem().what.empty());
  }
}
