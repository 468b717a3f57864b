#include "actors/results/formats/flux_file.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;

namespace {

using Bytes = std::vector<std::byte>;
const SourcePlace flux_place{"test.lux", 0};

Bytes noise(size_t size, uint64_t seed) {
  std::mt19937_64 random(seed);
  Bytes out(size);
  for (std::byte& b : out) b = static_cast<std::byte>(random());
  return out;
}

FluxFile example_flux() {
  FluxFile file;
  file.header_json = R"({"seed": 7, "scene": "box"})";
  file.blocks.push_back({"patch.flux", noise(300, 1)});
  file.blocks.push_back({"zeros", Bytes(5000)});
  file.blocks.push_back({"empty", {}});
  file.blocks.push_back({std::string("odd \0 \xff \n 'name'", 16), noise(17, 2)});
  return file;
}

Bytes encoded(const FluxFile& file) {
  Result<Bytes> bytes = encode_flux_file(file, flux_place);
  REQUIRE(bytes.ok());
  return bytes.value();
}

uint64_t number_at(const Bytes& bytes, size_t at, size_t size) {
  uint64_t value = 0;
  for (size_t i = 0; i < size; ++i) value |= std::to_integer<uint64_t>(bytes[at + i]) << (8 * i);
  return value;
}

void set_number(Bytes& bytes, size_t at, size_t size, uint64_t value) {
  for (size_t i = 0; i < size; ++i) bytes[at + i] = static_cast<std::byte>(value >> (8 * i));
}

/// The offsets of all records, and of the end, from the layout in the header file.
std::vector<size_t> record_starts(const Bytes& bytes) {
  std::vector<size_t> starts = {16};
  for (uint64_t i = 0; i <= number_at(bytes, 12, 4); ++i) {
    const size_t at = starts.back();
    starts.push_back(at + 40 + static_cast<size_t>(number_at(bytes, at, 4)) +
                     static_cast<size_t>(number_at(bytes, at + 16, 8)));
  }
  return starts;
}

std::string flux_refusal(const Bytes& bytes) {
  const Result<FluxFile> file = decode_flux_file(bytes, flux_place);
  REQUIRE_FALSE(file.ok());
  CHECK(file.problem().where.file == flux_place.file);
  return file.problem().what;
}

using Catch::Matchers::Contains;

}  // namespace

TEST_CASE("a flux file is read back as it was written, in its order", "[format][flux]") {
  const FluxFile file = example_flux();
  const test::TemporaryFolder folder;
  REQUIRE(write_flux_file(folder / "a.lux", file).ok());
  const Result<FluxFile> back = read_flux_file(folder / "a.lux");
  REQUIRE(back.ok());
  CHECK(back->header_json == file.header_json);
  REQUIRE(back->blocks.size() == file.blocks.size());
  for (size_t i = 0; i < file.blocks.size(); ++i) {
    CHECK(back->blocks[i].name == file.blocks[i].name);
    CHECK(back->blocks[i].bytes == file.blocks[i].bytes);
  }
  REQUIRE(back->find("zeros") != nullptr);
  CHECK(back->find("zeros")->bytes.size() == 5000);
  CHECK(back->find("none") == nullptr);
}

TEST_CASE("a flux file may be empty or large", "[format][flux]") {
  CHECK(decode_flux_file(encoded({}), flux_place).ok());
  FluxFile file;
  file.blocks.push_back({"zeros", Bytes(size_t{40} << 20)});
  file.blocks.push_back({"noise", noise(size_t{3} << 20, 3)});
  const Bytes bytes = encoded(file);
  CHECK(bytes.size() < (size_t{4} << 20));
  const Result<FluxFile> back = decode_flux_file(bytes, flux_place);
  REQUIRE(back.ok());
  CHECK(back->blocks[0].bytes == file.blocks[0].bytes);
  CHECK(back->blocks[1].bytes == file.blocks[1].bytes);
}

TEST_CASE("equal content gives equal bytes", "[format][flux]") {
  CHECK(encoded(example_flux()) == encoded(example_flux()));
}

TEST_CASE("every flipped bit of a flux file is detected", "[format][flux]") {
  const Bytes good = encoded(example_flux());
  Bytes bytes = good;
  size_t found = 0;
  for (size_t bit = 0; bit < 8 * good.size(); ++bit) {
    bytes[bit / 8] ^= static_cast<std::byte>(1u << (bit % 8));
    if (!decode_flux_file(bytes, flux_place).ok()) ++found;
    bytes[bit / 8] = good[bit / 8];
  }
  CHECK(found == 8 * good.size());
}

TEST_CASE("a damaged block is named", "[format][flux]") {
  const Bytes good = encoded(example_flux());
  const std::vector<size_t> starts = record_starts(good);
  const std::vector<std::string> names = {"the header", "'patch.flux'", "'zeros'", "'empty'"};
  for (size_t i = 0; i < names.size(); ++i) {
    Bytes bytes = good;
    bytes[starts[i + 1] - 1] ^= std::byte{0x10};  // the last byte of its compressed data
    CHECK_THAT(flux_refusal(bytes), Contains(names[i]));
    bytes = good;
    bytes[starts[i] + 24] ^= std::byte{1};  // its checksum
    CHECK_THAT(flux_refusal(bytes), Contains(names[i]) && Contains("checksum"));
  }
}

TEST_CASE("a truncated flux file is rejected, and between records the missing one is named",
          "[format][flux]") {
  const Bytes good = encoded(example_flux());
  for (size_t size = 0; size < good.size(); ++size) {
    REQUIRE_FALSE(decode_flux_file(std::span(good).first(size), flux_place).ok());
  }
  const std::vector<size_t> starts = record_starts(good);
  for (size_t i = 1; i < starts.size(); ++i) {
    const Bytes cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(starts[i]));
    CHECK_THAT(flux_refusal(cut), Contains("cut short"));
  }
  CHECK_THAT(flux_refusal({}), Contains("not a flux file"));
  Bytes longer = good;
  longer.push_back({});
  CHECK_THAT(flux_refusal(longer), Contains("goes on after its last block"));
}

TEST_CASE("other files and newer versions are rejected by name", "[format][flux]") {
  Bytes bytes = encoded(example_flux());
  set_number(bytes, 8, 4, 2);
  CHECK_THAT(flux_refusal(bytes), Contains("version 2") && Contains("up to 1"));
  set_number(bytes, 8, 4, 0);
  CHECK_THAT(flux_refusal(bytes), Contains("version 0"));
  CHECK_THAT(flux_refusal(noise(1000, 9)), Contains("not a flux file"));
  bytes = encoded(example_flux());
  bytes[7] = std::byte{1};
  CHECK_THAT(flux_refusal(bytes), Contains("not a flux file"));
}

TEST_CASE("absurd sizes are rejected before memory is allocated", "[format][flux]") {
  const Bytes good = encoded(example_flux());
  const size_t patch = record_starts(good)[1];
  const auto with = [&](size_t at, size_t size, uint64_t value) {
    Bytes bytes = good;
    set_number(bytes, at, size, value);
    return flux_refusal(bytes);
  };
  for (const uint64_t huge : {uint64_t{1} << 30, uint64_t{1} << 45, ~uint64_t{0}}) {
    CHECK_THAT(with(patch + 8, 8, huge), Contains("'patch.flux'") && Contains("more than it can"));
    CHECK_THAT(with(patch + 16, 8, huge), Contains("'patch.flux'") && Contains("cut short"));
  }
  CHECK_THAT(with(patch, 4, 0xffffffff), Contains("absurdly long name"));
  CHECK_THAT(with(patch + 4, 4, 1), Contains("must be zero"));
  CHECK_THAT(with(12, 4, 0xffffffff), Contains("claims 4294967295 blocks"));
  CHECK_THAT(with(12, 4, 6), Contains("cut short"));
  CHECK_THAT(with(12, 4, 3), Contains("goes on after"));
  // A size that the data could hold, but that contradicts the frame.
  CHECK_THAT(with(patch + 8, 8, 301), Contains("not compressed as its record says"));
}

TEST_CASE("random bytes after a valid start are never accepted and never crash", "[format][flux]") {
  std::mt19937_64 random(11);
  const Bytes good = encoded(example_flux());
  for (int round = 0; round < 3000; ++round) {
    Bytes bytes = good;
    const size_t from = 16 + random() % (bytes.size() - 16);
    const size_t count = 1 + random() % 40;
    for (size_t i = from; i < std::min(bytes.size(), from + count); ++i) {
      bytes[i] = static_cast<std::byte>(random());
    }
    if (bytes != good) REQUIRE_FALSE(decode_flux_file(bytes, flux_place).ok());
  }
}

TEST_CASE("ambiguous or unreadable names are not written", "[format][flux]") {
  const auto refused = [](std::vector<Block> blocks) {
    const Result<Bytes> bytes = encode_flux_file({"{}", std::move(blocks)}, flux_place);
    return bytes.ok() ? std::string() : bytes.problem().what;
  };
  CHECK_THAT(refused({{"a", {}}, {"a", {}}}), Contains("'a' is there twice"));
  CHECK_THAT(refused({{"", {}}}), Contains("needs a name"));
  CHECK_THAT(refused({{std::string(1025, 'n'), {}}}), Contains("too long a name"));
  CHECK(refused({{std::string(1024, 'n'), {}}}).empty());
}

TEST_CASE("a flux file that cannot be written or read is reported with place and reason",
          "[format][flux]") {
  const test::TemporaryFolder folder;
  const auto written = write_flux_file(folder / "none" / "a.lux", example_flux());
  REQUIRE_FALSE(written.ok());
  CHECK_THAT(written.problem().text(), Contains("none/a.lux") && Contains("No such file"));
  CHECK_THAT(read_flux_file(folder / "a.lux").problem().text(),
             Contains("a.lux") && Contains("No such file"));
  CHECK_FALSE(read_flux_file(folder.path()).ok());
}
