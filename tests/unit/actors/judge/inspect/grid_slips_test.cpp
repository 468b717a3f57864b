// Mistakes in smoke of data sets and fire simulations: their unit, height and optics, and flames
// without light.
#include <fmt/format.h>

#include "tests/kit/replaced.hpp"
#include "tests/kit/small_fire.hpp"
#include "tests/unit/actors/judge/inspect/inspect_kit.hpp"

using namespace luxodus;
using namespace luxodus::inspection;

namespace {

using Files = std::vector<std::pair<std::string, std::string>>;

/// 12 x 4 x 6 cells of 0.3 /m with these edges, from a corner [m].
Files grid(const glm::dvec3& cell, const glm::dvec3& low = {0, -2, 0}) {
  const auto vector = [](double x, double y, double z) {
    return fmt::format("({},{},{})", x, y, z);
  };
  const glm::dvec3 first = low + cell / 2.0;
  return {{"s.nrrd", fmt::format("NRRD0004\ntype: float\ndimension: 3\nsizes: 12 4 6\nspace: "
                                 "3D-right-handed\nspace directions: {} {} {}\nspace origin: {}\n"
                                 "encoding: raw\nendian: little\n\n",
                                 vector(cell.x, 0, 0), vector(0, cell.y, 0), vector(0, 0, cell.z),
                                 vector(first.x, first.y, first.z)) +
                         test::bytes_of_values(std::vector<float>(12 * 4 * 6, 0.3F))}};
}

std::string gridded(const std::string& optics = "albedo = 0.3\nphase = \"hg\"\ng = 0.6\n") {
  return furnished_room + long_way +
         "[[medium]]\nname = \"s\"\nkind = \"data_set\"\nfile = \"s.nrrd\"\nquantity = "
         "\"extinction\"\n" +
         optics;
}

const glm::dvec3 metres{1, 1, 0.5};

}  // namespace

TEST_CASE("a data set in another unit is named by its size beside the building",
          "[inspect][smoke]") {
  check_no_alarm(found_in(gridded(), grid(metres)));
  check_found(found_in(gridded(), grid(1000.0 * metres, {0, -2000, 0})), Severity::error,
              "1000 times as large as the building of 12 x 4 x 3 m, so that most of its smoke lies "
              "outside of it: are its cells in millimetres?");
  check_found(found_in(gridded(), grid(3.281 * metres, {0, -6.56, 0})), Severity::warning,
              "are its cells in feet?");
  check_found(found_in(gridded(), grid(0.001 * metres, {6, 0, 1})), Severity::warning,
              "are its cells in kilometres?");
  // One that is larger along two axes is a site.
  CHECK(that_say(found_in(gridded(), grid({5, 5, 0.5}, {-10, -10, 0})), "times as large").empty());
}

TEST_CASE("a grid that begins above the floor of a route is named", "[inspect][smoke]") {
  check_found(found_in(gridded(), grid(metres, {0, -2, 0.6})), Severity::warning,
              "the cells of \"s\" begin more than 0.26 m above the floor");
  CHECK(that_say(found_in(gridded(), grid(metres, {0, -2, 0.2})), "above the floor").empty());
  CHECK(that_say(found_in(gridded(), grid(metres, {0, -2, -0.5})), "above the floor").empty());
}

TEST_CASE("data sets get the warnings of layers on their optics", "[inspect][smoke]") {
  const auto found = [](const std::string& optics) {
    return found_in(gridded(optics), grid(metres));
  };
  check_found(found("albedo = 1\nphase = \"hg\"\ng = 0.6\n"), Severity::warning,
              "it absorbs nothing, as fog does");
  check_found(found("albedo = 0\nphase = \"hg\"\ng = 0.6\n"), Severity::warning,
              "it scatters nothing");
  check_found(found("albedo = 0.3\nphase = \"hg\"\ng = 0.99\n"), Severity::warning, "has g = 0.99");
  check_found(found("albedo = 0.3\nphase = \"hg\"\ng = 0.6\nangstrom = 5\n"), Severity::warning,
              "Angstrom exponent of 5");
  const std::string soot = test::replaced(gridded(), "\"extinction\"", "\"soot_density\"");
  check_found(found_in(soot + "mass_extinction = 8.7\n", grid(metres)), Severity::warning,
              "8.7 m2/g is 8700 m2/kg");
}

TEST_CASE("fire simulations get the warnings of layers on their optics, once", "[inspect][fds]") {
  using namespace test;
  const SmallMesh a = even_mesh({0, -2, 0}, {0.5, 0.5, 0.5}, {12, 8, 6});
  const SmallMesh b = even_mesh({6, -2, 0}, {0.25, 0.25, 0.25}, {24, 16, 12});
  Files files;
  std::string index = index_of_meshes({a, b});
  for (const auto& [m, mesh] : {std::pair<size_t, const SmallMesh&>{1, a}, {2, b}}) {
    const std::string name = std::to_string(m) + ".sf";
    const auto even = cell_values(mesh, [](int, int, int) { return 0.3F; });
    files.emplace_back(name, slice_file(mesh, "SOOT EXTINCTION COEFFICIENT", {{60, even}}));
    index += slice_entry(m, true, mesh, name, "SOOT EXTINCTION COEFFICIENT");
  }
  files.emplace_back("fire.smv", index);
  const auto found = [&](const std::string& keys) {
    return found_in(furnished_room + long_way +
                        "[[medium]]\nname = \"fire\"\nkind = \"fds\"\nfile = \"fire.smv\"\nat_s = "
                        "60\n" +
                        keys,
                    files);
  };
  check_found(found("albedo = 0\ng = 0.6\nangstrom = 1\n"), Severity::warning,
              "it scatters nothing");
  check_found(found("albedo = 0.2\ng = 0.6\nangstrom = 1\nmass_extinction = 8.7\n"),
              Severity::warning, "8.7 m2/g is 8700 m2/kg");
  check_found(found("albedo = 0.2\ng = 0.6\nangstrom = 1\nposition = [0, 0, 0.6]\n"),
              Severity::warning, "above the floor");
}

TEST_CASE("a state that takes the light of flames and leaves the smoke is named",
          "[inspect][smoke]") {
  const std::string burning =
      furnished_room + long_way +
      "[[medium]]\nname = \"smoke\"\nkind = \"homogeneous\"\nextinction = 0.5\nalbedo = 0.3\n"
      "[[medium]]\nname = \"fl\"\nkind = \"bounded\"\nbody = \"cone\"\nposition = [6, 1, 0]\n"
      "radius = 0.2\nheight = 1\nextinction = 1\nalbedo = 0.2\nsmoke = \"flaming\"\n"
      "[medium.emission]\npower_w = 300000\ntemperature_k = 1400\ncircuit = \"gas\"\n"
      "[[scenario]]\nname = \"fire\"\noperation = \"emergency\"\nseconds_after_failure = 60\n";
  const auto told = [&](const std::string& keys) {
    return that_say(found_in(burning + keys), "their glare is missing").size();
  };
  CHECK(told("") == 0);
  CHECK(told("emission_factor = 0\n") == 1);
  CHECK(told("emission_factor = 0.001\n") == 1);
  CHECK(told("circuits = { gas = 0 }\n") == 1);
  CHECK(told("emission_factor = 0\nmedia = { smoke = 0 }\n") == 0);
}
