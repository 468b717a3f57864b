// Mutated files of trajectories. The seed is LUXODUS_SEED, or 1; LUXODUS_MUTATIONS sets how many
// files are mutated. Files of HDF5, which a process each reads, are a tenth of them.
#include <catch2/catch.hpp>
#include <cmath>
#include <iterator>

#include "runtime/core/isolated_job.hpp"
#include "scenes/formats/trajectories/trajectories.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/kit/environment_number.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/scenes/formats/trajectories/trajectory_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

Bytes bytes_of(const std::string& text) {
  const auto* from = reinterpret_cast<const std::byte*>(text.data());
  return Bytes(from, from + text.size());
}

std::string text_of(const Bytes& bytes) {
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

bool is_sound(const Trajectories& read) {
  for (const Trajectory& person : read.people) {
    if (person.times_s.empty() || person.places.size() != person.times_s.size()) return false;
    for (size_t i = 1; i < person.times_s.size(); ++i)
      if (!(person.times_s[i - 1] < person.times_s[i])) return false;
    for (const glm::dvec3& place : person.places)
      if (!std::isfinite(place.x + place.y + place.z)) return false;
  }
  return !read.people.empty();
}

}  // namespace

TEST_CASE("mutated files of trajectories are read or rejected with one sentence",
          "[trajectories]") {
  const uint64_t seed = environment_number("LUXODUS_SEED", 1);
  const uint64_t tries = environment_number("LUXODUS_MUTATIONS", 2000);
  INFO("seed " << seed);
  Random random(seed, RandomStream::test);
  random.start(0);
  const TemporaryFolder folder;
  make_database(folder / "a.sqlite", JupedsimDatabase{}.sql());
  const std::vector<std::string> forms{petrack_text, pathfinder_csv, pathfinder_json,
                                       content_of(folder / "a.sqlite")};
  std::vector<uint64_t> read(forms.size());
  for (uint64_t i = 0; i < tries; ++i) {
    const size_t form = i % forms.size();
    const std::string harmed = text_of(
        mutated(bytes_of(forms[form]), bytes_of(forms[random.bits() % forms.size()]), random));
    const auto people = trajectories_of(harmed, "harmed");
    if (people) {
      ++read[form];
      REQUIRE(is_sound(people.value()));
    } else {
      REQUIRE_FALSE(people.problem().what.empty());
      REQUIRE(people.problem().kind != ProblemKind::bug);
    }
  }
  for (const uint64_t of_form : read) {
    CHECK(of_form > tries / 400);  // mutations that reach deep
    CHECK(of_form < tries / forms.size());
  }
}

TEST_CASE("mutated tables of HDF5 are read or rejected with one sentence", "[trajectories][hdf5]") {
  const uint64_t seed = environment_number("LUXODUS_SEED", 1);
  const uint64_t tries = environment_number("LUXODUS_MUTATIONS", 2000) / 10;
  INFO("seed " << seed);
  Random random(seed, RandomStream::test);
  random.start(1);
  const TemporaryFolder folder;
  TrajectoryTable{}.write(folder / "plain.h5");
  TrajectoryTable{.fps = false, .schema = true, .filter = 32015}.write(folder / "packed.h5");
  const Bytes plain = bytes_of(content_of(folder / "plain.h5")),
              packed = bytes_of(content_of(folder / "packed.h5"));
  const ForkedJobs forked;
  uint64_t read = 0;
  for (uint64_t i = 0; i < tries; ++i) {
    const std::string harmed =
        text_of(i % 2 == 0 ? mutated(plain, packed, random) : mutated(packed, plain, random));
    const auto people = trajectories_of(harmed, folder.write("harmed.h5", harmed));
    if (people) {
      ++read;
      REQUIRE(is_sound(people.value()));
    } else {
      REQUIRE_FALSE(people.problem().what.empty());
      REQUIRE(people.problem().kind != ProblemKind::bug);
    }
  }
  CHECK(read > tries / 50);
  CHECK(read < tries);
}
