// Mutated files of a fire simulation: whatever their content, they are read or rejected with one
// sentence, in bounded memory. The seed is LUXODUS_SEED, or 1; LUXODUS_MUTATIONS sets how many
// files are mutated (a sanitizer build has run 500 000).
#include <catch2/catch.hpp>
#include <map>

#include "scenes/formats/fields/fds.hpp"
#include "scenes/formats/fields/fds_building.hpp"
#include "scenes/formats/fields/fds_visibility.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/kit/environment_number.hpp"
#include "tests/kit/small_fire.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// Two meshes, one of them stretched, an obstruction that vanishes, an opening, and every kind of
/// file.
std::map<std::string, std::string> whole_case() {
  SmallMesh a = even_mesh({0, 0, 0}, {0.5, 0.5, 0.5}, {3, 2, 2});
  SmallMesh b = even_mesh({1.5, 0, 0}, {0.5, 0.5, 0.5}, {2, 2, 2});
  b.nodes[2] = {0, 0.3, 1};
  a.obstructions = {{0, 1, 0, 1, 0, 1}, {1, 1, 0, 2, 0, 2}};
  a.openings = {{0, 0, 0, 1, 0, 1}};
  std::map<std::string, std::string> out;
  std::string index = index_of_meshes({a, b});
  for (const auto& [m, mesh] : {std::pair<size_t, const SmallMesh&>{1, a}, {2, b}}) {
    const std::string of_mesh = std::to_string(m);
    const auto at = [](int i, int j, int k) { return static_cast<float>(i + j + 2 * k); };
    const auto bytes = [](int i, int j, int) { return static_cast<float>(i > 1 ? 200 : 3 * j); };
    const auto clear = [](int, int, int) { return 0.0F; };
    const std::vector<SmallFrame> cells = {{0, cell_values(mesh, clear)},
                                           {5, cell_values(mesh, at)}};
    const std::vector<SmallFrame> nodes = {{0, node_values(mesh, clear)},
                                           {5, node_values(mesh, at)}};
    const std::vector<SmallFrame> smoke = {{0, node_values(mesh, clear)},
                                           {2.5F, node_values(mesh, bytes)},
                                           {5, node_values(mesh, bytes)}};
    out["c" + of_mesh + ".sf"] = slice_file(mesh, "SOOT DENSITY", cells);
    out["n" + of_mesh + ".sf"] = slice_file(mesh, "SOOT EXTINCTION COEFFICIENT", nodes);
    out["s" + of_mesh + ".s3d"] = smoke3d_file(mesh, smoke);
    out["h" + of_mesh + ".s3d"] = smoke3d_file(mesh, smoke);
    const DensityFiles fog = density_files(mesh, smoke);
    out["d" + of_mesh + ".s3d"] = fog.smoke;
    out["d" + of_mesh + ".s3d.sz"] = fog.sizes;
    const auto one = node_values(mesh, at);
    out["p_" + of_mesh + "_5p00.q"] = plot3d_file(mesh, {one, one, one, one, one});
    const std::array<int32_t, 6> level{0, mesh.cells(0), 0, mesh.cells(1), 1, 1};
    const std::vector<float> metres(static_cast<size_t>((mesh.cells(0) + 1) * (mesh.cells(1) + 1)),
                                    7);
    out["v" + of_mesh + ".sf"] = part_slice_file(level, "VISIBILITY", {{0, metres}, {5, metres}});
    index += part_slice_entry(m, m == 2, level, "v" + of_mesh + ".sf", "VISIBILITY") +
             slice_entry(m, true, mesh, "c" + of_mesh + ".sf", "SOOT DENSITY") +
             slice_entry(m, false, mesh, "n" + of_mesh + ".sf", "SOOT EXTINCTION COEFFICIENT") +
             smoke_entry(m, "s" + of_mesh + ".s3d", "SOOT DENSITY") +
             smoke_entry(m, "d" + of_mesh + ".s3d", "FOG DENSITY", "0.001") +
             smoke_entry(m, "h" + of_mesh + ".s3d", "HRRPUV", "0.000") + "PL3D 5.0 " + of_mesh +
             "\n p_" + of_mesh + "_5p00.q\n";
    for (const char* label : {"TEMPERATURE", "U", "V", "SOOT DENSITY", "HRRPUV"})
      index += label_lines(label);
  }
  index += "HIDE_OBST 1\n 1 2.5\nDEVICE_ACT d\n 1 4.00 1\nHIDE_OBST 1\n 1 2.6\n";
  out["case.smv"] = index;
  out["small_hrr.csv"] = "s,kW\nTime,HRR\n 0.0,0.0\n 5.0,1.0E+002\n 10.0,50\n";
  return out;
}

/// Replaces a word, or repeats or removes a line.
std::string harmed_text(std::string text, Random& random) {
  static const char* const words[] = {"-1",  "0",    "1",    "2",     "99999999999", "1e308",
                                      "nan", "8192", "4096", "65535", "GRID",        "../x",
                                      "a b", "",     "\n",   "OBST"};
  const size_t at = random.bits() % (text.size() + 1);
  const size_t line = text.rfind('\n', at) == std::string::npos ? 0 : text.rfind('\n', at) + 1;
  const size_t end = std::min(text.find('\n', at), text.size());
  switch (random.bits() % 3) {
    case 0: {
      const size_t from = std::min(text.find_first_not_of(" \n", at), text.size());
      const size_t to = std::min(text.find_first_of(" \n", from), text.size());
      return text.replace(from, to - from, words[random.bits() % std::size(words)]);
    }
    case 1:
      return text.insert(line, text.substr(line, end - line) + "\n");
    default:
      return text.erase(line, std::min(end + 1, text.size()) - line);
  }
}

std::string harmed(const std::string& name, const std::string& whole, const std::string& other,
                   Random& random) {
  if (name.ends_with(".smv") || name.ends_with(".csv") || name.ends_with(".sz"))
    if (random.uniform() < 0.8F) return harmed_text(whole, random);
  const auto bytes = [](const std::string& text) {
    Bytes out(text.size());
    std::memcpy(out.data(), text.data(), text.size());
    return out;
  };
  const Bytes out = mutated(bytes(whole), bytes(other), random);
  return {reinterpret_cast<const char*>(out.data()), out.size()};
}

}  // namespace

TEST_CASE("mutated results of FDS are read or rejected with one sentence", "[format][fds][fuzz]") {
  const auto whole = whole_case();
  std::vector<std::string> names;
  const TemporaryFolder folder;
  for (const auto& [name, bytes] : whole) {
    names.push_back(name);
    folder.write(name, bytes);
  }
  Random random(environment_number("LUXODUS_SEED", 1), RandomStream::test);
  random.start(0);
  INFO("seed " << environment_number("LUXODUS_SEED", 1));
  // Each with Smoke3D, which alone has one of the two species.
  const auto with_smoke3d = [](FireSource source) {
    return std::vector<FireSource>{source, FireSource::smoke3d};
  };
  const std::vector<FireSource> sources[] = {{},
                                             with_smoke3d(FireSource::cell_soot),
                                             with_smoke3d(FireSource::node_extinction),
                                             with_smoke3d(FireSource::node_soot),
                                             with_smoke3d(FireSource::plot3d),
                                             {FireSource::smoke3d},
                                             with_smoke3d(FireSource::cell_extinction),
                                             {FireSource::smoke3d}};
  uint64_t read = 0;
  const uint64_t tries = environment_number("LUXODUS_MUTATIONS", 3000);
  for (uint64_t i = 0; i < tries; ++i) {
    // Half of the mutations change the index, on which all else depends.
    const std::string name =
        random.bits() % 2 == 0 ? "case.smv" : names[random.bits() % names.size()];
    const std::string& other = whole.at(names[random.bits() % names.size()]);
    folder.write(name, harmed(name, whole.at(name), other, random));
    FireOptions options;
    options.at_s = random.bits() % 4 == 0 ? 2.5 : 5;
    options.between_frames = random.bits() % 2 == 0;
    options.sources = sources[random.bits() % std::size(sources)];
    options.flames = random.bits() % 2 == 0;
    const auto building = read_fire_building(folder / "case.smv", options.at_s);
    if (!building.ok()) REQUIRE_FALSE(building.problem().what.empty());
    const auto visibility = read_visibility(folder / "case.smv", options.at_s);
    if (!visibility.ok())
      REQUIRE_FALSE(visibility.problem().what.empty());
    else if (visibility.value())
      if (const auto metres = visibility.value()->at({0.7, 0.3, 0.6}))
        REQUIRE((*metres >= 0 && *metres <= 1e9));
    const auto fire = read_fire(folder / "case.smv", options);
    if (fire.ok()) {
      ++read;
      for (const FireGrid& grid : fire->grids)
        for (const float v : grid.data.extinction) REQUIRE((v >= 0 && v <= 1e9F));
    } else {
      REQUIRE_FALSE(fire.problem().what.empty());
      REQUIRE(fire.problem().text().find('\n') == std::string::npos);
    }
    folder.write(name, whole.at(name));
  }
  CHECK(read > tries / 20);
  CHECK(read < tries);
}
