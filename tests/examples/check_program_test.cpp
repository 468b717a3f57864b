// The output of `luxodus check`, and that other commands refuse scenes with errors.
#include <nlohmann/json.hpp>

#include "tests/examples/program_kit.hpp"

using namespace luxodus::program;

namespace {

const std::string good = R"([[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [4, 3, 2.8]
material = "grey50"
[[emitter]]
name = "lamp"
shape = "point"
distribution = "isotropic"
position = [2, 1.5, 2.5]
flux_lm = 100
[[camera]]
name = "view"
eye = [1, 1, 1.5]
target = [3, 2, 1]
width = 16
height = 9
)";

std::string with_lamp_far_away() {
  return good +
         "[[emitter]]\nname = \"lost\"\nshape = \"point\"\ndistribution = \"isotropic\"\n"
         "position = [2000, 1500, 2500]\nflux_lm = 100\n";
}

std::string written(const TemporaryFolder& folder, const std::string& text) {
  const fs::path file = folder / "scene.toml";
  std::ofstream(file) << text;
  return file.string();
}

}  // namespace

TEST_CASE(
    "check lists each finding with its severity, file and line, counts them, and fails on errors "
    "only",
    "[program]") {
  const TemporaryFolder folder;
  const auto fine = run_luxodus(folder, "check " + written(folder, good));
  CHECK(fine.code == 0);
  CHECK(fine.out.find("no errors, no warnings, no notes") != std::string::npos);
  const auto bad = run_luxodus(folder, "check " + written(folder, with_lamp_far_away()));
  CHECK(bad.code == 2);
  CHECK(bad.err.find((folder / "scene.toml").string() + ":19: error: emitter \"lost\" is ") !=
        std::string::npos);
  CHECK(bad.out.find("1 error, no warnings, no notes") != std::string::npos);
  const auto open =
      run_luxodus(folder, "check " + written(folder, "open_sides = [\"top\"]\n" + good));
  CHECK(open.code == 0);
}

TEST_CASE("check gives its findings as JSON, too", "[program]") {
  const TemporaryFolder folder;
  const auto bad = run_luxodus(folder, "check --json " + written(folder, with_lamp_far_away()));
  CHECK(bad.code == 2);
  const auto json = nlohmann::json::parse(bad.out);
  REQUIRE(json["findings"].size() == 1);
  const auto& finding = json["findings"][0];
  CHECK(finding["severity"] == "error");
  CHECK(finding["kind"] == "far");
  CHECK(finding["line"] == 19);
  CHECK(finding["what"].get<std::string>().find("millimetres") != std::string::npos);
}

TEST_CASE("check looks at the last state of a scene that changes in time, too", "[program]") {
  const TemporaryFolder folder;
  const auto checked = [&](const std::string& row) {
    return run_luxodus(folder,
                       "check " + written(folder, good +
                                                      "[time]\nto = 600\nstep = 300\n[[medium]]\n"
                                                      "name = \"smoke\"\nkind = \"homogeneous\"\n"
                                                      "albedo = 0.3\nextinction = [[0, 0.1], " +
                                                      row + "]\n"));
  };
  const auto ends = checked("[100, 1]");
  INFO(ends.err);
  CHECK(ends.code == 2);
  CHECK(ends.err.find("'extinction' is known from 0 to 100 s, and the time is 600 s") !=
        std::string::npos);
  CHECK(ends.err.find("the last state of [time]") != std::string::npos);
  CHECK(checked("[600, 1]").code == 0);
}

TEST_CASE("run and pack refuse a scene with an error before they write anything", "[program]") {
  const TemporaryFolder folder;
  const std::string scene = written(folder, with_lamp_far_away());
  const std::string out = (folder / "out").string();
  for (const std::string& command :
       {"run " + scene + " --particles 10k --out " + out, "pack " + scene + " --out " + out}) {
    const auto refused = run_luxodus(folder, command);
    INFO(command << "\n" << refused.err);
    CHECK(refused.code == 2);
    CHECK(refused.err.find("error: ") != std::string::npos);
    CHECK(refused.err.find("emitter \"lost\" is ") != std::string::npos);
    CHECK_FALSE(fs::exists(out));
  }
}
