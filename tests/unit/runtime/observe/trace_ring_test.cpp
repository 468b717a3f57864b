#include "runtime/observe/trace_ring.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace luxodus;

TEST_CASE("particles are sampled by their id, and none if sampling is off", "[runtime][trace]") {
  const TraceRing ring(8, 1000);
  CHECK(ring.wants(0));
  CHECK(ring.wants(41'000));
  CHECK_FALSE(ring.wants(41'001));
  CHECK_FALSE(TraceRing(8, 0).wants(0));
}

TEST_CASE("a ring keeps the last events, the oldest first", "[runtime][trace]") {
  TraceRing ring(3, 1);
  CHECK(ring.kept().empty());
  for (uint64_t i = 1; i <= 5; ++i) {
    ring.record({microseconds(1), i, 0, 0, TracePhase::moment});
    if (i == 2) CHECK(ring.kept().size() == 2);
  }
  const auto kept = ring.kept();
  REQUIRE(kept.size() == 3);
  CHECK(kept[0].id == 3);
  CHECK(kept[2].id == 5);
  CHECK(ring.recorded() == 5);
}

TEST_CASE("a trace is JSON with one track per node, and spans join by request across nodes",
          "[runtime][trace]") {
  const uint64_t request = 0xfeed;
  const std::vector<TraceTrack> tracks{
      {NodeId{0}, {{microseconds(5), request, 7, 0, TracePhase::begin}}},
      {NodeId{3},
       {{1500, 9, 0, 1, TracePhase::moment}, {microseconds(9), request, 0, 0, TracePhase::end}}}};
  const auto trace = nlohmann::json::parse(chrome_trace(tracks, {"fetch", "hit"}));
  const auto& events = trace.at("traceEvents");
  REQUIRE(events.size() == 5);
  CHECK(events[0].at("args").at("name") == "node 0");
  CHECK(events[2].at("args").at("name") == "node 3");
  CHECK(events[1].at("ph") == "b");
  CHECK(events[1].at("ts") == 5.0);
  CHECK(events[1].at("args").at("arg") == 7);
  CHECK(events[3].at("name") == "hit");
  CHECK(events[3].at("ts") == 1.5);
  CHECK(events[3].at("pid") == 3);
  CHECK(events[4].at("ph") == "e");
  CHECK(events[4].at("id2") == events[1].at("id2"));
  CHECK(events[4].at("cat") == events[1].at("cat"));
  CHECK(events[4].at("name") == events[1].at("name"));
}
