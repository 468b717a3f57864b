// Mutated OpenVDB files: whatever the library does, they are read or rejected with one sentence, in
// bounded time and memory. Each is read in a process of its own, a copy of this one, so that
// hundreds are read in a second. The seed is LUXODUS_SEED, or 1; LUXODUS_MUTATIONS sets how many
// files are mutated, and prints a count of the outcomes on standard error.
#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "runtime/core/isolated_job.hpp"
#include "scenes/formats/vdb/vdb.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/unit/scenes/formats/vdb/vdb_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

uint64_t said_number(const char* name, uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 0) : otherwise;
}

Bytes bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(in), {});
  const auto* from = reinterpret_cast<const std::byte*>(text.data());
  return {from, from + text.size()};
}

/// Files with every storage of cells: packed by each library or not, as halves, blocks of one
/// value, several grids, and one file of another program if available.
std::vector<Bytes> whole_files(const TemporaryFolder& folder) {
  namespace io = openvdb::io;
  std::vector<Bytes> out;
  const auto add = [&](const openvdb::GridPtrVec& grids, uint32_t compression) {
    out.push_back(bytes_of(written_grids(folder, grids, compression)));
  };
  for (const uint32_t packing : {uint32_t{io::COMPRESS_NONE}, uint32_t{io::COMPRESS_ZIP},
                                 uint32_t{io::COMPRESS_BLOSC}, uint32_t{io::COMPRESS_ACTIVE_MASK}})
    add({fog()}, packing);
  const auto halves = fog();
  halves->setSaveFloatAsHalf(true);
  halves->fill(openvdb::CoordBBox(openvdb::Coord(-4), openvdb::Coord(11)), 0.5F);
  halves->getAccessor().setValue(openvdb::Coord(1), 0.25F);
  add({halves}, io::COMPRESS_BLOSC | io::COMPRESS_ACTIVE_MASK);
  auto surface = fog("surface", 3);
  surface->setGridClass(openvdb::GRID_LEVEL_SET);
  const auto wind = openvdb::Vec3SGrid::create();
  wind->setName("wind");
  add({surface, fog(), wind}, io::COMPRESS_ZIP | io::COMPRESS_ACTIVE_MASK);
  const std::filesystem::path others =
      std::filesystem::path(LUX_SHARED_DATA) / "vdb/smoke_layer_own.vdb";
  if (std::filesystem::is_regular_file(others)) out.push_back(bytes_of(others));
  return out;
}

/// The first words of a message, which identify the kind of outcome.
std::string kind_of_end(const std::string& sentence) {
  size_t end = 0;
  for (int words = 0; words < 7 && end != std::string::npos; ++words)
    end = sentence.find_first_of(" \"", end + 1);
  return sentence.substr(0, std::min<size_t>(end, 60));
}

}  // namespace

TEST_CASE("mutated OpenVDB files are read or rejected with one sentence", "[vdb][fuzz]") {
  const uint64_t seed = said_number("LUXODUS_SEED", 1);
  const uint64_t tries = said_number("LUXODUS_MUTATIONS", 300);
  INFO("seed " << seed);
  Random random(seed, RandomStream::test);
  random.start(2);
  // Also while files are written: a copy of this process has only its own thread.
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const TemporaryFolder folder;
  const std::vector<Bytes> whole = whole_files(folder);
  // A small limit, so that files that declare gigabytes fill it quickly.
  const VdbProgram program{LUX_VDB_PROGRAM, {}, 1, uint64_t{128} << 20};
  const ForkedJobs here;
  std::map<std::string, uint64_t> ends;
  for (uint64_t i = 0; i < tries; ++i) {
    const Bytes harmed =
        mutated(whole[i % whole.size()], whole[random.bits() % whole.size()], random);
    const auto path = folder.write(
        "harmed.vdb", std::string(reinterpret_cast<const char*>(harmed.data()), harmed.size()));
    const auto count = [&](const auto& answer, const char* good) {
      if (!answer) {
        INFO("file " << i << ": " << answer.problem().text());
        REQUIRE(answer.problem().where.file == path);
        REQUIRE_FALSE(answer.problem().what.empty());
      }
      ++ends[answer ? good : kind_of_end(answer.problem().what)];
    };
    if (i % 4 == 3)
      count(list_vdb(path, program), "listed");
    else
      count(read_vdb(path, "density", UpAxis::z, program), "read");
  }
  if (std::getenv("LUXODUS_MUTATIONS") != nullptr)
    for (const auto& [end, times] : ends)
      std::fprintf(stderr, "%8llu  %s\n", static_cast<unsigned long long>(times), end.c_str());
  CHECK(ends["read"] > 0);
  CHECK(ends["read"] < tries);
}
