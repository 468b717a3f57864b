// `luxodus spacing` as a designer calls it: text, CSV and JSON give one table, and bad input gets a
// clear word.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/examples/program_kit.hpp"

using namespace luxodus::program;

namespace {

const std::string corridor =
    (fs::path(LUX_SOURCE_DIR) / "scenes/library/luminaires/emergency_corridor.ldt").string();
const std::string factors = " --maintenance-factor 0.8 --end-of-duration-factor 0.7";

}  // namespace

TEST_CASE("a spacing table is the same as text, CSV and JSON", "[program][spacing]") {
  const TemporaryFolder folder;
  const std::string call = "spacing " + corridor + factors + " --height 2.5,2.8 --level 1";
  const Outcome text = run_luxodus(folder, call);
  INFO(text.err);
  REQUIRE(text.code == 0);
  CHECK(text.out.find("factor 0.56 = maintenance 0.8 x end of duration 0.7") != std::string::npos);
  CHECK(text.out.find("6.15     12.97") != std::string::npos);
  CHECK(text.out.find("1.73      3.94") != std::string::npos);

  const auto json = nlohmann::json::parse(run_luxodus(folder, call + " --json").out);
  CHECK(json["flux_lm"].get<double>() == Approx(180).epsilon(0.01));
  REQUIRE(json["rows"].size() == 4);  // two heights, initial and end of life
  const auto& end = json["rows"][1];
  CHECK(end["life"] == "end");
  CHECK(end["factor"].get<double>() == Approx(0.56));
  CHECK(end["c0_along"]["to_wall_m"].get<double>() == Approx(6.15).margin(0.005));

  const Outcome csv = run_luxodus(folder, call + " --csv");
  CHECK(csv.out.starts_with("height [m],life,factor,level [lx],C0 along: wall to first [m],"));
  CHECK(std::count(csv.out.begin(), csv.out.end(), '\n') == 5);
}

TEST_CASE("without factors a spacing table is of new luminaires, and says so",
          "[program][spacing]") {
  const TemporaryFolder folder;
  const Outcome run = run_luxodus(folder, "spacing " + corridor + " --height 3 --level 1");
  REQUIRE(run.code == 0);
  CHECK(run.out.find("new luminaires only") != std::string::npos);
  CHECK(run.out.find("    end  ") == std::string::npos);  // no row of the end of life
}

TEST_CASE("twice the flux on emergency supply at twice the level is the same spacing",
          "[program][spacing]") {
  const TemporaryFolder folder;
  const auto rows_of = [&](const std::string& options) {
    const Outcome run = run_luxodus(folder, "spacing " + corridor + " --height 3 --json" + options);
    REQUIRE(run.code == 0);
    return nlohmann::json::parse(run.out)["rows"][0]["c0_along"]["between_m"].get<double>();
  };
  CHECK(rows_of(" --emergency-flux 90 --level 0.5") ==
        Approx(rows_of(" --emergency-flux 180 --level 1")));
}

TEST_CASE("bad input of a spacing table is refused in one sentence", "[program][spacing]") {
  const TemporaryFolder folder;
  const std::pair<std::string, std::string> bad[] = {
      {corridor + " --height 0.02", "--height 0.02: the luminaire hangs above the lit plane"},
      {corridor + " --level 0", "--level 0: a level is above 0 lx"},
      {corridor + " --variant x", "--variant, --emitter and --duration-h belong to a GLDF"},
      {"missing.ldt", "missing.ldt: there is no such file"},
  };
  for (const auto& [arguments, words] : bad) {
    const Outcome run = run_luxodus(folder, "spacing " + arguments);
    INFO(arguments << ": " << run.err);
    CHECK(run.code == 2);
    CHECK(run.err.find(words) != std::string::npos);
    CHECK(run.out.empty());
  }
}
