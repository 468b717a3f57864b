// The checks of the codes in a live view: they follow moves and dimming, and the worst come first.
#include "actors/apps/view/code_checks.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/actors/apps/view/live_room.hpp"

using namespace luxodus;

namespace {

Json checks_of(const SceneDescription& scene, const SceneEdits& edits,
               const std::map<std::string, double>& factors = {},
               std::optional<double> seconds = {}) {
  LiveOptions options;
  options.threads = 2;
  LiveDimming dimming;
  dimming.factors = factors;
  dimming.seconds = seconds;
  const auto checks = code_checks(scene, edits, dimming, options);
  INFO((checks ? std::string() : checks.problem().text()));
  REQUIRE(checks.ok());
  return checks.value();
}

/// The check of the illuminance on the centre line.
Json centre_line(const Json& checks) {
  const Json& rows = checks["rows"];
  const auto at = std::find_if(rows.begin(), rows.end(), [](const Json& row) {
    return row["rule"] == "E1" && row["value"].is_number();
  });
  REQUIRE(at != rows.end());
  return *at;
}

}  // namespace

TEST_CASE("the checks of a live view follow moves and dimming", "[view][codes]") {
  const test::TemporaryFolder folder;
  const auto scene = test::emergency_room(folder);
  SceneEdits edits;
  edits.scenario = "failed";
  const Json now = checks_of(*scene, edits);
  CHECK(now["type"] == "checks");
  CHECK(now["counts"]["fail"].get<int>() > 0);
  const Json dark = centre_line(now);
  CHECK(dark["verdict"] == "fail");
  CHECK(dark["subject"] == "route \"way\"");
  CHECK(dark["limit"] == 1.0);
  CHECK(dark["at_least"] == true);
  CHECK(dark["place"][0].get<double>() == Approx(13).margin(0.5));  // the far end
  CHECK(dark["margin"].get<double>() == Approx(dark["value"].get<double>() - 1));
  SECTION("dimmed") {
    const Json dimmed = centre_line(checks_of(*scene, edits, {{"lamp", 0.5}}));
    CHECK(dimmed["value"].get<double>() ==
          Approx(0.5 * dark["value"].get<double>()).epsilon(1e-6));
  }
  SECTION("after the battery has ended") {
    SceneDescription supplied = *scene;
    supplied.emitters[0].duration_s = 3600;
    CHECK(centre_line(checks_of(supplied, edits, {}, 60))["value"] == dark["value"]);
    CHECK(centre_line(checks_of(supplied, edits, {}, 7200))["value"] == 0);
  }
  SECTION("moved to the middle") {
    edits.luminaires["lamp"] = {{7, 1.5, 2.97}, std::nullopt};
    CHECK(centre_line(checks_of(*scene, edits))["value"].get<double>() >
          2 * dark["value"].get<double>());
  }
}

TEST_CASE("checks that fail come first, the smallest margin first", "[view][codes]") {
  const test::TemporaryFolder folder;
  SceneEdits edits;
  edits.scenario = "failed";
  const Json checks = checks_of(*test::emergency_room(folder), edits);
  const Json& rows = checks["rows"];
  size_t counted = 0;
  for (const auto& count : checks["counts"]) counted += count.get<size_t>();
  CHECK(rows.size() == counted);
  REQUIRE(rows.front()["verdict"] == "fail");
  const auto fails = [](const Json& row) { return row["verdict"] == "fail"; };
  CHECK(std::is_partitioned(rows.begin(), rows.end(), fails));
  double last = -1e9;
  for (const Json& row : rows) {
    if (!fails(row) || !row["margin"].is_number()) continue;
    CHECK(row["margin"].get<double>() >= last);
    last = row["margin"].get<double>();
  }
}
