// Mutated input files of FDS: whatever their content, they are read or rejected with one sentence,
// in bounded time and memory. The seed is LUXODUS_SEED, or 1; LUXODUS_MUTATIONS sets how many files
// are mutated.
#include <catch2/catch.hpp>
#include <cstring>

#include "scenes/formats/fds_input/input_building.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/kit/environment_number.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// Every group that is read.
const std::string whole_input =
    "&HEAD CHID='small' /\n"
    "&MULT ID='grid', DX=1, DY=1, I_UPPER=2, J_LOWER=-1, J_UPPER=1, I_LOWER_SKIP=1 /\n"
    "&MULT ID='row', DXB=0,1,0,0,1,1, N_UPPER=3 /\n"
    "&MESH ID='a', IJK=6,5,4, XB=0,3,0,2.5,0,2 /\n"
    "&MESH ID='b', IJK=3,5,4, XB=3,6,0,2.5,0,2 /\n"
    "&MISC THICKEN_OBSTRUCTIONS=T /\n"
    "&SURF ID='WALL', RGB=200,190,180, DEFAULT=T /\n&SURF ID='WOOD', COLOR='SIENNA 2' /\n"
    "&DEVC ID='t', QUANTITY='TIME', SETPOINT=40, INITIAL_STATE=T, XYZ=0,0,0 /\n"
    "&DEVC ID='u', QUANTITY='TIME', SETPOINT=20, LATCH=F, TRIP_DIRECTION=-1, XYZ=0,0,0 /\n"
    "&CTRL ID='c', FUNCTION_TYPE='ANY', INPUT_ID='t','d' /\n"
    "&CTRL ID='d', FUNCTION_TYPE='TIME_DELAY', DELAY=5, INPUT_ID='e' /\n"
    "&CTRL ID='e', FUNCTION_TYPE='CUSTOM', INPUT_ID='u', RAMP_ID='r' /\n"
    "&RAMP ID='r', T=0, F=-1 /\n&RAMP ID='r', T=9, F=1 /\n"
    "&TIME T_END=90 /\n&MOVE ID='m', AXIS=0,0,1, ROTATION_ANGLE=90, DX=2 /\n"
    "&OBST ID='wall', XB=1,1.5,0,2.5,0,2, SURF_IDS='WALL','WOOD','WALL' /\n"
    "&HOLE ID='door', XB=0.9,1.6,1,2,0,1.5, DEVC_ID='t' /\n"
    "&OBST ID='post', XB=2,2.1,0,0.1,0,2, MULT_ID='grid', PERMIT_HOLE=F, CTRL_ID='c' /\n"
    "&OBST XB=4,4,0,2.5,0,2, COLOR='GRAY 60', TRANSPARENCY=0.5, MULT_ID='row' /\n"
    "&VENT XB=6,6,1,2,0,1.5, SURF_ID='OPEN' /\n&VENT MB='ZMAX', SURF_ID='OPEN' /\n"
    "&VENT PBX=0, SURF_ID='OPEN' /\n&VENT MB='YMIN', SURF_ID='MIRROR' /\n"
    "&OBST XB=1,2,0,1,0,1, , MOVE_ID='m', CTRL_ID='d' /\n"
    "&GEOM ID='tent', SURF_ID='WOOD','WALL', VERTS=4,0,0, 5,0,0, 4,1,0, 4,0,1,\n"
    "  FACES=1,3,2,1, 1,2,4,2, 2,3,4,1, 1,4,3,1 /\n"
    "&GEOM SPHERE_ORIGIN=5,2,1, SPHERE_RADIUS=0.3, MOVE_ID='m' /\n"
    "&GEOM CYLINDER_ORIGIN=5,1,1, CYLINDER_LENGTH=0.5, CYLINDER_RADIUS=0.2 /\n"
    "&CATF OTHER_FILES='more.fds' /\n&TAIL /\n";

/// Replaces a word, or repeats or removes a line.
std::string harmed_words(std::string text, Random& random) {
  static const char* const words[] = {"-1",       "0",    "1e308", "99999999*1", "nan",    "1e6",
                                      "-999999",  "4096", "'a'",   "'",          "/",      "&OBST",
                                      "&MULT ID", "=",    ",,,",   "XB(-5)=",    "T",      "3*",
                                      "'../x'",   "\n",   "(",     "200000",     "0.5,0.5"};
  const size_t at = random.bits() % (text.size() + 1);
  const size_t line = text.rfind('\n', at) == std::string::npos ? 0 : text.rfind('\n', at) + 1;
  const size_t end = std::min(text.find('\n', at), text.size());
  switch (random.bits() % 4) {
    case 0:
    case 1: {
      const size_t from = std::min(text.find_first_not_of(" ,=\n", at), text.size());
      const size_t to = std::min(text.find_first_of(" ,=\n", from), text.size());
      return text.replace(from, to - from, words[random.bits() % std::size(words)]);
    }
    case 2:
      return text.insert(line, text.substr(line, end - line) + "\n");
    default:
      return text.erase(line, std::min(end + 1, text.size()) - line);
  }
}

std::string harmed_input(const std::string& whole, const std::string& other, Random& random) {
  std::string out = whole;
  if (random.uniform() < 0.8F) {
    do out = harmed_words(out, random);
    while (random.uniform() < 0.3F);
    return out;
  }
  const auto bytes = [](const std::string& text) {
    Bytes made(text.size());
    std::memcpy(made.data(), text.data(), text.size());
    return made;
  };
  const Bytes mutant = mutated(bytes(whole), bytes(other), random);
  return {reinterpret_cast<const char*>(mutant.data()), mutant.size()};
}

}  // namespace

TEST_CASE("mutated input files of FDS are read or rejected with one sentence",
          "[fds][input][fuzz]") {
  const TemporaryFolder folder;
  const std::string more = "&OBST ID='table', XB=2,3,1,2,0.5,0.6 /\n&HOLE XB=2,3,0,1,0,1 /\n";
  folder.write("more.fds", more);
  folder.write("case.fds", whole_input);
  {
    const auto input = read_fds_input(folder / "case.fds");
    if (!input) FAIL(input.problem().text());
  }
  Random random(environment_number("LUXODUS_SEED", 1), RandomStream::test);
  random.start(0);
  INFO("seed " << environment_number("LUXODUS_SEED", 1));
  const uint64_t tries = environment_number("LUXODUS_MUTATIONS", 3000);
  uint64_t read = 0;
  for (uint64_t i = 0; i < tries; ++i) {
    const std::string text = harmed_input(whole_input, more, random);
    folder.write("case.fds", text);
    const auto input = read_fds_input(folder / "case.fds");
    if (!input) {
      REQUIRE_FALSE(input.problem().what.empty());
      REQUIRE(input.problem().text().find('\n') == std::string::npos);
      continue;
    }
    ++read;
    FdsInputOptions options;
    options.at_s = random.bits() % 2 == 0 ? 0 : 60;
    for (const auto& building :
         {exact_building(input.value(), options), snapped_building(input.value(), options)})
      if (!building) REQUIRE_FALSE(building.problem().what.empty());
  }
  CHECK(read > tries / 20);
  CHECK(read < tries);
}
