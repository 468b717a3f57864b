// The program as a user runs it: exit codes, files, and promises that only whole runs can show.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/examples/program_kit.hpp"
#include "tests/unit/scenes/formats/pack/burning_gallery.hpp"

using namespace luxodus::program;

namespace {

std::string first_guide() {
  return slurp(fs::path(LUX_SOURCE_DIR) / "docs/guide/first-scene.md");
}

/// The first scene of the guide, which a newcomer copies.
std::string readme_scene() {
  const std::string guide = first_guide();
  const std::string fence = "```toml\n";
  const size_t first = guide.find(fence) + fence.size();
  return guide.substr(first, guide.find("```", first) - first);
}

/// The first scene with its haze and without.
std::string two_scenarios() {
  return readme_scene() +
         "[[scenario]]\nname = \"clear\"\nmedia = { haze = 0 }\n[[scenario]]\nname = \"hazy\"\n";
}

std::string write_scene(const TemporaryFolder& folder, const std::string& text) {
  const fs::path file = folder / "room.toml";
  std::ofstream(file) << text;
  return file.string();
}

std::string out(const TemporaryFolder& folder, const char* name) {
  return (folder / name).string();
}

std::string flux(const TemporaryFolder& folder, const char* name) {
  const std::string bytes = slurp(folder / name / "flux.lux");
  REQUIRE(!bytes.empty());
  return bytes;
}

}  // namespace

TEST_CASE("the guide's first scene runs and writes the files that the guide lists", "[program]") {
  const TemporaryFolder folder;
  const std::string guide = first_guide();
  const std::string scene = write_scene(folder, readme_scene());
  const Outcome run = run_luxodus(folder, "run " + scene + " --out " + out(folder, "room") +
                                              " --particles 50k --picture-paths 1");
  INFO(run.err);
  REQUIRE(run.code == 0);
  for (const char* file : {"result.json", "flux.lux", "planes/floor.csv", "planes/floor.png",
                           "views/door.exr", "views/door.png", "patches.vtp", "volume.vti"}) {
    INFO(file);
    CHECK(fs::file_size(folder / "room" / file) > 0);
    CHECK(guide.find("`" + std::string(file) + "`") != std::string::npos);
  }
  const auto result = nlohmann::json::parse(slurp(folder / "room" / "result.json"));
  CHECK(result["ledger"]["closes"] == true);
  CHECK(result["planes"][0]["mean_illuminance"]["standard_error"].get<double>() > 0);
  CHECK(result["particles"].get<int64_t>() >= 50'000);
}

TEST_CASE("the flux file has the same bits for one, two and three threads", "[program]") {
  const TemporaryFolder folder;
  const std::string scene = write_scene(folder, readme_scene());
  for (const char* threads : {"1", "2", "3"}) {
    REQUIRE(run_luxodus(folder, "run " + scene + " --no-views --particles 100k --out " +
                                    out(folder, threads) + " --threads " + threads)
                .code == 0);
  }
  CHECK(flux(folder, "1") == flux(folder, "2"));
  CHECK(flux(folder, "1") == flux(folder, "3"));
}

TEST_CASE("a resumed run equals an uninterrupted one bit for bit", "[program]") {
  const TemporaryFolder folder;
  const std::string scene = write_scene(folder, readme_scene());
  const std::string common = "run " + scene + " --no-views --cells 4 --out ";
  REQUIRE(run_luxodus(folder, common + out(folder, "whole") + " --particles 120k").code == 0);
  REQUIRE(run_luxodus(folder, common + out(folder, "parts") + " --particles 40k").code == 0);
  CHECK(flux(folder, "whole") != flux(folder, "parts"));
  REQUIRE(run_luxodus(folder, common + out(folder, "parts") + " --particles 120k --resume").code ==
          0);
  CHECK(flux(folder, "whole") == flux(folder, "parts"));
}

TEST_CASE("an adaptive run has the same bits on nodes and resumed, and can be rendered",
          "[program]") {
  const TemporaryFolder folder;
  const std::string scene = write_scene(
      folder, readme_scene() +
                  "[[emitter]]\nname = \"other\"\nshape = \"rectangle\"\nposition = [1, 1, 2.4]\n"
                  "size = [0.2, 0.2]\nflux_lm = 50\n[run]\ngroups = \"emitter\"\n");
  const std::string common = "run " + scene + " --no-views --adaptive --out ";
  REQUIRE(run_luxodus(folder, common + out(folder, "whole") + " --particles 200k").code == 0);
  REQUIRE(run_luxodus(folder, common + out(folder, "parts") + " --particles 80k").code == 0);
  REQUIRE(run_luxodus(folder, common + out(folder, "parts") + " --particles 200k --resume").code ==
          0);
  CHECK(flux(folder, "whole") == flux(folder, "parts"));
  REQUIRE(run_luxodus(folder, common + out(folder, "nodes") + " --particles 200k --nodes 2").code ==
          0);
  CHECK(flux(folder, "whole") == flux(folder, "nodes"));
  const auto result = nlohmann::json::parse(slurp(folder / "whole" / "result.json"));
  CHECK(result["source_groups"].size() == 2);
  CHECK(result["source_groups"][0]["batch_share"].get<double>() > 0);
  CHECK(run_luxodus(folder, "render " + out(folder, "whole") + " --paths 1").code == 0);
  CHECK(run_luxodus(folder, "run " + write_scene(folder, readme_scene()) + " --adaptive --out " +
                                out(folder, "one"))
            .err.find("groups = \"emitter\"") != std::string::npos);
}

TEST_CASE("another seed gives another flux, and resuming with it is refused by name", "[program]") {
  const TemporaryFolder folder;
  const std::string scene = write_scene(folder, readme_scene());
  const std::string common = "run " + scene + " --no-views --particles 20k --out ";
  REQUIRE(run_luxodus(folder, common + out(folder, "a") + " --seed 1").code == 0);
  REQUIRE(run_luxodus(folder, common + out(folder, "b") + " --seed 2").code == 0);
  CHECK(flux(folder, "a") != flux(folder, "b"));
  const Outcome refused = run_luxodus(folder, common + out(folder, "a") + " --seed 2 --resume");
  CHECK(refused.code == 2);
  CHECK(refused.err.find("seed") != std::string::npos);
}

TEST_CASE("resuming all scenarios keeps the finished ones and starts those not begun",
          "[program]") {
  const TemporaryFolder folder;
  const std::string scene = write_scene(folder, two_scenarios());
  const std::string common = "run " + scene + " --no-views --particles 20k --out ";
  REQUIRE(run_luxodus(folder, common + out(folder, "all/clear") + " --scenario clear").code == 0);
  const std::string finished = flux(folder, "all/clear");
  REQUIRE(run_luxodus(folder, common + out(folder, "all") + " --scenario all --resume").code == 0);
  CHECK(flux(folder, "all/clear") == finished);
  REQUIRE(run_luxodus(folder, common + out(folder, "hazy") + " --scenario hazy").code == 0);
  CHECK(flux(folder, "all/hazy") == flux(folder, "hazy"));
  // A single scenario that was never begun is probably a wrong folder.
  CHECK(run_luxodus(folder, common + out(folder, "never") + " --scenario hazy --resume").code == 2);
}

TEST_CASE("the results of all scenarios are printed as one JSON array", "[program]") {
  const TemporaryFolder folder;
  const std::string scene = write_scene(folder, two_scenarios());
  const Outcome run = run_luxodus(
      folder, "run " + scene + " --no-views --json --scenario all --particles 20k --out " +
                  out(folder, "all"));
  REQUIRE(run.code == 0);
  const auto results = nlohmann::json::parse(run.out);
  REQUIRE(results.size() == 2);
  CHECK(results[0]["scenario"] == "clear");
  CHECK(results[1]["scenario"] == "hazy");
}

TEST_CASE("a run removes the maps and pictures of the previous one, and only these", "[program]") {
  const TemporaryFolder folder;
  const std::string scene = write_scene(folder, readme_scene());
  const fs::path room = folder / "room";
  const std::string common =
      "run " + scene + " --particles 20k --picture-paths 1 --out " + room.string();
  REQUIRE(run_luxodus(folder, common).code == 0);
  const fs::path mine[] = {room / "views" / "mine.png", room / "planes" / "mine.csv",
                           room / "notes.txt"};
  for (const fs::path& file : mine) std::ofstream(file) << "mine";
  const std::string before = flux(folder, "room");
  CHECK(run_luxodus(folder, common + " --resume --seed 77").code == 2);
  CHECK(flux(folder, "room") == before);
  CHECK(fs::exists(room / "views" / "door.png"));

  std::string renamed = readme_scene();
  renamed.replace(renamed.find("name = \"floor\""), 14, "name = \"below\"");
  write_scene(folder, renamed);
  REQUIRE(run_luxodus(folder, common + " --no-views").code == 0);
  std::vector<std::string> left;
  for (const auto& entry : fs::recursive_directory_iterator(room))
    if (entry.is_regular_file()) left.push_back(fs::relative(entry.path(), room).string());
  std::sort(left.begin(), left.end());
  CHECK(left == std::vector<std::string>{"flux.lux", "notes.txt", "patches.vtp", "planes/below.csv",
                                         "planes/below.png", "planes/below_direct_clear_air.png",
                                         "planes/mine.csv", "result.json", "views/mine.png",
                                         "volume.vti"});
}

TEST_CASE("a finished run is rendered again without tracing", "[program]") {
  const TemporaryFolder folder;
  const std::string scene = write_scene(folder, readme_scene());
  REQUIRE(run_luxodus(folder,
                      "run " + scene + " --particles 20k --no-views --out " + out(folder, "room"))
              .code == 0);
  const std::string before = flux(folder, "room");
  CHECK_FALSE(fs::exists(folder / "room" / "views"));
  REQUIRE(run_luxodus(folder, "render " + out(folder, "room") + " --view door --paths 1").code ==
          0);
  const std::string gathered = slurp(folder / "room" / "views" / "door.exr");
  CHECK(fs::exists(folder / "room" / "views" / "door.png"));
  REQUIRE(run_luxodus(folder, "render " + out(folder, "room") + " --paths 1 --full-paths").code ==
          0);
  CHECK(slurp(folder / "room" / "views" / "door.exr") != gathered);
  CHECK(flux(folder, "room") == before);
  CHECK(run_luxodus(folder, "render " + out(folder, "room") + " --view nowhere").code == 2);
}

TEST_CASE("bad input gives one line with file and line, exit code 2, and no files", "[program]") {
  const TemporaryFolder folder;
  const std::string good = readme_scene();
  struct Mistake {
    std::string from, to, said;
  };
  for (const Mistake& m : {
           Mistake{"reflectance = \"white80\"", "reflectence = 0.8", "reflectance"},
           Mistake{"extinction = 0.2", "extinction = -0.2", "extinction"},
           Mistake{"albedo = 0.9", "albedo = 1.9", "albedo"},
           Mistake{"size = [0.6, 0.6]", "size = [0.6, 0.0]", "size"},
           Mistake{"flux_lm = 3000", "flux_lm = nan", "flux_lm"},
           Mistake{"material = \"white\"", "material = \"whote\"", "whote"},
       }) {
    std::string text = good;
    text.replace(text.find(m.from), m.from.size(), m.to);
    const std::string scene = write_scene(folder, text);
    const Outcome run = run_luxodus(folder, "run " + scene + " --out " + out(folder, "never"));
    INFO(m.to << "\n" << run.err);
    CHECK(run.code == 2);
    CHECK(run.err.find("room.toml:") != std::string::npos);
    CHECK(run.err.find(m.said) != std::string::npos);
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
    CHECK_FALSE(fs::exists(folder / "never"));
  }
}

TEST_CASE("invalid words on the command line give exit code 2 and an explanation", "[program]") {
  const TemporaryFolder folder;
  CHECK(run_luxodus(folder, "").code == 2);
  CHECK(run_luxodus(folder, "simulate").code == 2);
  CHECK(run_luxodus(folder, "run").code == 2);
  const std::string scene = write_scene(folder, readme_scene());
  const Outcome wrong = run_luxodus(folder, "run " + scene + " --particles many");
  CHECK(wrong.code == 2);
  CHECK(wrong.err.find("many") != std::string::npos);
  CHECK(run_luxodus(folder, "run " + scene + " --scenario nowhere").code == 2);
  CHECK(run_luxodus(folder, "run " + out(folder, "absent.toml")).code == 2);
  CHECK(run_luxodus(folder, "run --help").out.find("--particles") != std::string::npos);
}

TEST_CASE("check and info print JSON on request", "[program]") {
  const TemporaryFolder folder;
  const std::string scene = write_scene(folder, readme_scene());
  const auto check = nlohmann::json::parse(run_luxodus(folder, "check --json " + scene).out);
  CHECK(check["scenarios"][0]["luminous_flux"]["value"].get<double>() == Approx(3000));
  CHECK(check["scenarios"][0]["bands_nm"].size() == 1);
  const auto info = nlohmann::json::parse(run_luxodus(folder, "info --json").out);
  CHECK(info["packages"]["Embree"].get<std::string>().rfind("3.", 0) == 0);
}

TEST_CASE("converge writes its table and plots, and the error falls with the inverse root",
          "[program]") {
  const TemporaryFolder folder;
  const std::string scene = write_scene(folder, readme_scene());
  const Outcome run = run_luxodus(
      folder, "converge " + scene + " --particles 2M --json --out " + out(folder, "converge"));
  INFO(run.err);
  REQUIRE(run.code == 0);
  for (const char* file : {"converge.csv", "error_particles.svg", "error_seconds.svg"})
    CHECK(fs::file_size(folder / "converge" / file) > 0);
  const auto json = nlohmann::json::parse(run.out);
  // Seven doublings; each standard error is itself known to about 1 / sqrt(2 n) of n >= 8 batches.
  CHECK(json["slope_particles"].get<double>() == Approx(-0.5).margin(0.12));
}

TEST_CASE("a seed beyond 64 bits is rejected in one sentence", "[program]") {
  const TemporaryFolder folder;
  const std::string scene = write_scene(folder, readme_scene());
  for (const char* command : {"run", "converge"}) {
    for (const char* seed : {"-1", "99999999999999999999", "1.5", "0x10", "one"}) {
      const Outcome run = run_luxodus(
          folder, command + (" " + scene) + " --out " + out(folder, "never") + " --seed " + seed);
      INFO(command << " " << seed << "\n" << run.err);
      CHECK(run.code == 2);
      CHECK(run.err.find("--seed") != std::string::npos);
      CHECK(run.err.find("\"" + std::string(seed) + "\" is no whole number") != std::string::npos);
      CHECK_FALSE(fs::exists(folder / "never"));
    }
  }
  const std::string common = "run " + scene + " --no-views --particles 20k --out ";
  CHECK(run_luxodus(folder, common + out(folder, "most") + " --seed 18446744073709551615").code ==
        0);
  REQUIRE(run_luxodus(folder, common + out(folder, "ten") + " --seed 10").code == 0);
  REQUIRE(run_luxodus(folder, common + out(folder, "padded") + " --seed 010").code == 0);
  CHECK(flux(folder, "ten") == flux(folder, "padded"));
}

TEST_CASE("converge says that a scene without statistical error has no error", "[program]") {
  const TemporaryFolder folder;
  const std::string scene = write_scene(
      folder,
      "[[object]]\nname = \"floor\"\nshape = \"quad\"\ncorner = [0, 0, 0]\n"
      "edge_u = [1, 0, 0]\nedge_v = [0, 1, 0]\nmaterial = \"black0\"\n"
      "[[emitter]]\nname = \"lamp\"\nshape = \"point\"\nposition = [0.5, 0.5, 1]\n"
      "distribution = \"isotropic\"\nflux_lm = 100\n"
      "[[plane]]\nname = \"floor\"\ncorner = [0, 0, 0]\nedge_u = [1, 0, 0]\nedge_v = [0, 1, 0]\n"
      "cells = [2, 2]\n");
  const Outcome run = run_luxodus(folder, "converge " + scene + " --out " + out(folder, "never"));
  INFO(run.err);
  CHECK(run.code == 2);
  CHECK(run.err.find("exactly 0") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "never"));
}

TEST_CASE("an interrupted converge says so and ends with 130", "[program]") {
  const TemporaryFolder folder;
  const std::string scene = write_scene(folder, readme_scene());
  // `timeout` sends the signal of Ctrl-C; the requested particles would take days.
  const Outcome run = run_luxodus(
      folder, "converge " + scene + " --particles 1000G --out " + out(folder, "converge"),
      "timeout --preserve-status --signal=INT 1 ");
  INFO(run.err);
  CHECK(run.code == 130);
  CHECK(run.err.find("interrupted") != std::string::npos);
}

TEST_CASE("a scene with too many patches is rejected before memory is allocated", "[program]") {
  const TemporaryFolder folder;
  std::string text = readme_scene();
  // With this edge each triangle has 2^31 patches: twice that is zero in 32 bits.
  const size_t edge = text.find("patch_edge_m");
  REQUIRE(edge != std::string::npos);
  text.replace(edge, text.find('\n', edge) - edge, "patch_edge_m = 1e-4");
  const Outcome check = run_luxodus(folder, "check " + write_scene(folder, text));
  INFO(check.err);
  CHECK(check.code == 2);
  CHECK(check.err.find("patch_edge_m larger") != std::string::npos);
}

TEST_CASE("check counts the triangles without area that it drops", "[program]") {
  const TemporaryFolder folder;
  std::ofstream(folder / "scrap.obj")
      << "v 0 0 1\nv 1 0 1\nv 0 1 1\nv 2 0 1\nf 1 2 3\nf 1 2 4\nf 1 1 3\n";
  const std::string scene =
      write_scene(folder, readme_scene() +
                              "[[import]]\nname = \"scrap\"\nfile = \"scrap.obj\"\n"
                              "units = \"m\"\nup = \"z\"\nmaterial = \"white\"\n");
  const Outcome check = run_luxodus(folder, "check " + scene);
  REQUIRE(check.code == 0);
  CHECK(check.out.find("13 triangles") != std::string::npos);
  CHECK(check.out.find("2 degenerate triangles dropped") != std::string::npos);
}

TEST_CASE("a packed scene runs like its scene file, resident and on nodes with a budget",
          "[program]") {
  const TemporaryFolder folder;
  const std::string scene = write_scene(
      folder, readme_scene() +
                  "[[object]]\nname = \"blocks\"\nshape = \"box\"\nlow = [1, 1, 0]\n"
                  "high = [1.1, 1.1, 0.1]\nmaterial = \"white\"\nrepeat = [{ count = 10, step = "
                  "[0.2, 0, 0] }, { count = 5, step = [0, 0.2, 0] }]\n");
  const std::string pack = out(folder, "room.luxpack");
  REQUIRE(run_luxodus(folder, "pack " + scene + " --cell-kib 1 --out " + pack).code == 0);
  const Outcome told = run_luxodus(folder, "check --json " + pack);
  REQUIRE(told.code == 0);
  const auto checked = nlohmann::json::parse(told.out);
  const int cells = checked["scenarios"][0]["cells"].get<int>();
  REQUIRE(cells > 1);
  const std::string common = " --no-views --particles 40k --out ";
  REQUIRE(run_luxodus(folder, "run " + scene + " --cells " + std::to_string(cells) + common +
                                  out(folder, "plain"))
              .code == 0);
  REQUIRE(run_luxodus(folder, "run " + pack + common + out(folder, "packed")).code == 0);
  REQUIRE(run_luxodus(folder, "run " + pack + " --nodes 2 --fibers 32 --part-cache-mib 0.05" +
                                  common + out(folder, "nodes"))
              .code == 0);
  CHECK(flux(folder, "packed") == flux(folder, "plain"));
  CHECK(flux(folder, "nodes") == flux(folder, "plain"));
  CHECK(run_luxodus(folder, "render " + out(folder, "nodes") + " --paths 1").code == 0);

  const std::string skeleton = out(folder, "skeleton.luxpack");
  REQUIRE(run_luxodus(folder, "pack " + pack + " --skeleton-only --out " + skeleton).code == 0);
  const Outcome bare = run_luxodus(folder, "run " + skeleton + common + out(folder, "bare"));
  CHECK(bare.code != 0);
  CHECK(bare.err.find("holds no objects") != std::string::npos);
  CHECK(run_luxodus(folder, "pack " + pack + " --out " + skeleton).code == 2);
}

TEST_CASE("a packed scene of smoke data and pictures runs on nodes that hold a part of it",
          "[program]") {
  const TemporaryFolder folder;
  const std::string scene = luxodus::write_gallery(folder.path()).string();
  const std::string pack = out(folder, "gallery.luxpack");
  const Outcome packed = run_luxodus(folder, "pack " + scene + " --json --out " + pack);
  REQUIRE(packed.code == 0);
  const auto told = nlohmann::json::parse(packed.out);
  CHECK(told["bricks"].get<int>() == 13);
  CHECK(told["tiles"].get<int>() == 6);
  const std::string common = " --no-views --particles 8k --out ";
  REQUIRE(run_luxodus(folder, "run " + scene + common + out(folder, "plain")).code == 0);
  const std::string nodes = "run " + pack + " --nodes 2 --fibers 64 --part-cache-mib 1";
  const Outcome shared = run_luxodus(folder, nodes + common + out(folder, "shared"));
  INFO(shared.err);
  REQUIRE(shared.code == 0);
  CHECK(shared.out.find("shared") != std::string::npos);
  REQUIRE(run_luxodus(folder, nodes + " --no-sharing" + common + out(folder, "apart")).code == 0);
  CHECK(flux(folder, "shared") == flux(folder, "plain"));
  CHECK(flux(folder, "apart") == flux(folder, "plain"));
}

TEST_CASE("a run writes previews in progress, and its result does not change", "[program]") {
  const TemporaryFolder folder;
  const std::string scene = write_scene(folder, readme_scene());
  const std::string common = "run " + scene + " --no-views --particles 300k --out ";
  REQUIRE(run_luxodus(folder, common + out(folder, "plain")).code == 0);
  REQUIRE(run_luxodus(folder, common + out(folder, "shown") + " --preview 0.1s").code == 0);
  CHECK(fs::exists(folder / "shown" / "preview" / "views" / "door.exr"));
  CHECK(fs::exists(folder / "shown" / "preview" / "views" / "door.png"));
  CHECK(flux(folder, "shown") == flux(folder, "plain"));
  CHECK(run_luxodus(folder, common + out(folder, "never") + " --preview soon").code == 2);
}

TEST_CASE("nodes give validation the estimates of threads, weighted sums included",
          "[program][nodes]") {
  const TemporaryFolder folder;
  const auto estimates = [&](const std::string& options) {
    const Outcome outcome =
        run_luxodus(folder, "validate --only \"area lamp L1_600x600_h2.5, traced\" --out " +
                                (folder / "v").string() + " " + options);
    INFO(outcome.err << outcome.out);
    CHECK(outcome.code == 0);
    std::vector<std::string> found;
    auto page = nlohmann::json::parse(slurp(folder / "v" / "validate.json"));
    for (auto& quantity : page["cases"][0]["quantities"]) {
      quantity.erase("figure_of_merit");  // of the time that it took
      found.push_back(quantity.dump());
    }
    return found;
  };
  const std::vector<std::string> by_threads = estimates("--threads 1");
  CHECK_FALSE(by_threads.empty());
  CHECK(estimates("--nodes 2") == by_threads);
}
