// A scene read from a pack is the same scene, bit for bit; a damaged pack is rejected.
#include "scenes/formats/pack/scene_pack.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "actors/results/run/local_run.hpp"
#include "runtime/core/atomic_file.hpp"
#include "runtime/core/random.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/formats/pack/skeleton.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/scenes/formats/pack/burning_gallery.hpp"

using namespace luxodus;
namespace fs = std::filesystem;

namespace {

std::shared_ptr<const SceneDescription> described(const std::string& file) {
  auto read = read_scene(std::string(LUX_SOURCE_DIR) + "/scenes/library/" + file);
  REQUIRE(read.scene);
  return std::make_shared<const SceneDescription>(std::move(*read.scene));
}

std::shared_ptr<const CompiledScene> compiled(
    const std::shared_ptr<const SceneDescription>& description, const std::string& scenario,
    int cells) {
  auto scene = compile_scene(description, find_scenario(*description, scenario).value(), {cells});
  REQUIRE(scene.ok());
  return scene.value();
}

std::shared_ptr<const SceneDescription> opened(const fs::path& pack) {
  auto read = read_pack(pack);
  INFO((read.ok() ? "" : read.problem().text()));
  REQUIRE(read.ok());
  return read.value();
}

std::unique_ptr<LocalRun> traced(const std::shared_ptr<const CompiledScene>& scene) {
  auto run = std::make_unique<LocalRun>(scene, 3, 2);
  StopRule stop;
  stop.particles = 60'000;
  const std::atomic<bool> nobody{false};
  run->run(stop, nobody, [](const Progress&) {});
  return run;
}

void check_same_bits(const Totals& a, const Totals& b) {
  REQUIRE(a.groups() == b.groups());
  for (int g = 0; g < a.groups(); ++g) {
    REQUIRE(a.state(g).totals.size() == b.state(g).totals.size());
    int64_t differences = 0;
    for (size_t i = 0; i < a.state(g).totals.size(); ++i) {
      const Total &x = a.state(g).totals[i], &y = b.state(g).totals[i];
      differences += x.sum != y.sum || x.squares != y.squares;
    }
    CHECK(differences == 0);
  }
}

/// The message for a file with these bytes.
std::string refusal(const fs::path& file, const std::vector<std::byte>& bytes) {
  REQUIRE(write_file_atomically(file, bytes).ok());
  const auto read = read_pack(file);
  return read.ok() ? "" : read.problem().text();
}

std::vector<std::byte> bytes_of(const fs::path& file) {
  return read_whole_file(file, uint64_t{1} << 30).value();
}

}  // namespace

TEST_CASE("a packed scene equals its source, and is traced to the same bits", "[pack]") {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "x.luxpack";
  struct Case {
    const char* scene;
    const char* scenario;
    int cells;
  };
  for (const Case& c : {Case{"office_floor.toml", "smoke_emergency", 37},
                        Case{"fire_in_a_box.toml", "", 1}, Case{"auditorium.toml", "show", 12}}) {
    INFO(c.scene);
    const auto description = described(c.scene);
    const auto scene = compiled(description, c.scenario, c.cells);
    const auto report = write_pack(file, *scene, c.cells);
    REQUIRE(report.ok());
    CHECK(report->objects == scene->cells.size());
    CHECK(report->file_bytes == fs::file_size(file));
    CHECK(is_pack(file));
    const auto again = compiled(opened(file), c.scenario, 1);
    CHECK(again->scene_hash == scene->scene_hash);
    CHECK(again->cells.empty());
    CHECK(again->cell_boxes.size() == scene->cells.size());
    CHECK(again->patch_count == scene->patch_count);
    CHECK(again->emitters.size() == scene->emitters.size());
    check_same_bits(traced(scene)->totals(), traced(again)->totals());
  }
}

TEST_CASE("a pack keeps the open sides of a scene", "[pack]") {
  const test::TemporaryFolder folder;
  auto scene = std::make_shared<SceneDescription>(*described("empty_room.toml"));
  scene->open_sides = {Side::top, Side::west};
  REQUIRE(write_pack(folder / "open.luxpack", *compiled(scene, "", 1), 1).ok());
  CHECK(opened(folder / "open.luxpack")->open_sides == scene->open_sides);
}

TEST_CASE("a pack keeps the time, the meshes and the missing flames of a fire simulation",
          "[pack][fds]") {
  const test::TemporaryFolder folder;
  auto scene = std::make_shared<SceneDescription>(*gallery_in(folder.path()));
  const auto smoke = std::find_if(scene->media.begin(), scene->media.end(),
                                  [](const Medium& m) { return m.kind == MediumKind::data_set; });
  REQUIRE(smoke != scene->media.end());
  const size_t index = static_cast<size_t>(smoke - scene->media.begin());
  smoke->simulation = FireSimulation{"fire.smv", 60.0264, "Smoke3D",
                                     false,      Frame{}, {{glm::dvec3(0), glm::dvec3(1, 2, 3)}}};
  const fs::path file = folder / "fire.luxpack";
  REQUIRE(write_pack(file, *compiled(scene, "smoky", 1), 1).ok());
  const auto packed = opened(file);
  const auto& read = packed->media.at(index).simulation;
  REQUIRE(read);
  CHECK(read->file == "fire.smv");
  CHECK(read->time_s == 60.0264);
  CHECK(read->source == "Smoke3D");
  CHECK_FALSE(read->glows);
  REQUIRE(read->meshes.size() == 1);
  CHECK(read->meshes[0].high == glm::dvec3(1, 2, 3));
}

TEST_CASE("smoke data and pictures are in a pack as objects, and not in its skeleton", "[pack]") {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "x.luxpack";
  const auto description = gallery_in(folder.path());
  for (const auto& [packed_in, cells] : {std::pair("smoky", 5), std::pair("aired", 1)}) {
    INFO("packed in scenario " << packed_in);
    const auto report = write_pack(file, *compiled(description, packed_in, cells), cells);
    REQUIRE(report.ok());
    CHECK(report->bricks == 9 + 4);  // three of the smoke's are clear
    CHECK(report->tiles == 6);
    CHECK(report->objects == static_cast<size_t>(cells) + 9 + 4 + 6);
    CHECK(report->skeleton_bytes < 40'000);
    const auto packed = opened(file);
    for (const Medium& medium : packed->media) CHECK(medium.data.extinction.empty());
    for (const auto& image : distinct_images(*packed)) CHECK(image->texels.empty());
    for (const char* traced_in : {"smoky", "aired"}) {
      INFO("traced in scenario " << traced_in);
      const auto scene = compiled(description, traced_in, cells);
      const auto again = compiled(packed, traced_in, 1);
      CHECK(again->scene_hash == scene->scene_hash);
      CHECK(again->volume_points == scene->volume_points);
      check_same_bits(traced(scene)->totals(), traced(again)->totals());
    }
  }
}

TEST_CASE("a skeleton alone compiles a scene of smoke data, with the numbers of the pack",
          "[pack]") {
  const test::TemporaryFolder folder;
  const fs::path whole = folder.path() / "x.luxpack", skeleton = folder.path() / "s.luxpack";
  const auto scene = compiled(gallery_in(folder.path()), "smoky", 5);
  REQUIRE(write_pack(whole, *scene, 5).ok());
  REQUIRE(write_skeleton_pack(skeleton, whole).ok());
  const auto bare = compiled(opened(skeleton), "smoky", 1);
  CHECK(bare->scene_hash == scene->scene_hash);
  CHECK(bare->volume_points == scene->volume_points);
  const SceneParts here(*bare), there(*scene);
  REQUIRE(here.count() == there.count());
  for (size_t i = 0; i < here.count(); ++i) {
    CHECK(here[i].kind == there[i].kind);
    CHECK(here[i].owner == there[i].owner);
    CHECK(here[i].index == there[i].index);
  }
  CHECK(here.tables() == there.tables());
  CHECK_FALSE(load_bricks(*bare).ok());
  CHECK_FALSE(load_images(*bare).ok());
}

TEST_CASE("a pack with a damaged brick or tile is rejected where it is read", "[pack]") {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "x.luxpack";
  REQUIRE(write_pack(file, *compiled(gallery_in(folder.path()), "smoky", 1), 1).ok());
  const auto whole = compiled(opened(file), "smoky", 1);
  REQUIRE(load_bricks(*whole).ok());
  REQUIRE(load_images(*whole).ok());
  CHECK(check_objects(*whole).ok());
  auto bytes = bytes_of(file);
  const size_t cell = whole->description->packed->objects[0].wire_bytes;
  bytes[128 + cell + 64 + 1000] ^= std::byte{4};  // in the first brick
  const fs::path broken = folder.path() / "broken.luxpack";
  REQUIRE(write_file_atomically(broken, bytes).ok());
  const auto harmed = compiled(opened(broken), "smoky", 1);
  const auto bricks = load_bricks(*harmed);
  REQUIRE_FALSE(bricks.ok());
  CHECK(bricks.problem().text().find("damaged") != std::string::npos);
  CHECK(load_images(*harmed).ok());
  const auto all = check_objects(*harmed);
  REQUIRE_FALSE(all.ok());
  CHECK(all.problem().text().find(broken.string() + ": scene part 1 of this pack is damaged") == 0);
}

TEST_CASE("a pack serves every scenario that leaves its doors unchanged, and rejects the others",
          "[pack]") {
  const test::TemporaryFolder folder;
  const std::string text = R"(
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [4, 3, 3]
material = "grey50"
[[object]]
name = "leaf"
shape = "quad"
corner = [1, 1, 0]
edge_u = [1, 0, 0]
edge_v = [0, 0, 2]
material = "grey50"
[object.door]
hinge = [1, 1, 0]
[[emitter]]
name = "lamp"
shape = "point"
position = [2, 2, 2]
flux_lm = 100
[[scenario]]
name = "shut"
[[scenario]]
name = "dimmed"
smoke_factor = 0.5
[[scenario]]
name = "ajar"
doors_open = ["leaf"]
)";
  REQUIRE(write_file_atomically(folder.path() / "s.toml", text).ok());
  auto read = read_scene(folder.path() / "s.toml");
  for (const Problem& p : read.problems.list()) UNSCOPED_INFO(p.text());
  REQUIRE(read.scene);
  const auto description = std::make_shared<const SceneDescription>(std::move(*read.scene));
  const fs::path file = folder.path() / "x.luxpack";
  REQUIRE(write_pack(file, *compiled(description, "shut", 2), 2).ok());
  const auto packed = opened(file);
  CHECK(compile_scene(packed, find_scenario(*packed, "shut").value(), {}).ok());
  CHECK(compile_scene(packed, find_scenario(*packed, "dimmed").value(), {}).ok());
  const auto refused = compile_scene(packed, find_scenario(*packed, "ajar").value(), {});
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.problem().what.find("doors") != std::string::npos);
}

TEST_CASE("a skeleton alone compiles, and says that it holds no triangles", "[pack]") {
  const test::TemporaryFolder folder;
  const fs::path whole = folder.path() / "x.luxpack", skeleton = folder.path() / "s.luxpack";
  const auto description = described("office_floor.toml");
  const auto scene = compiled(description, "clear_mains", 9);
  REQUIRE(write_pack(whole, *scene, 9).ok());
  const auto report = write_skeleton_pack(skeleton, whole);
  REQUIRE(report.ok());
  CHECK(fs::file_size(skeleton) < fs::file_size(whole));
  const auto bare = compiled(opened(skeleton), "clear_mains", 1);
  CHECK(bare->scene_hash == scene->scene_hash);
  const auto cell = load_cell(*bare, 3);
  REQUIRE_FALSE(cell.ok());
  CHECK(cell.problem().what.find("holds no objects") != std::string::npos);
}

TEST_CASE("a damaged pack is rejected, wherever the damage is", "[pack]") {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "x.luxpack", broken = folder.path() / "broken.luxpack";
  const auto description = described("empty_room.toml");
  REQUIRE(write_pack(file, *compiled(description, "", 3), 3).ok());
  const std::vector<std::byte> bytes = bytes_of(file);
  CHECK(refusal(broken, {}).find("too short") != std::string::npos);
  CHECK(refusal(broken, std::vector<std::byte>(500)).find("no pack") != std::string::npos);
  auto cut = bytes;
  cut.resize(cut.size() - 1);
  CHECK(refusal(broken, cut).find("should have") != std::string::npos);
  // Any bit of the head or the skeleton; objects lie between them, and are checked when used.
  const size_t objects_end = bytes.size() - (bytes.size() / 8);
  for (size_t at = 0; at < bytes.size(); at += at < 128 || at >= objects_end ? 1 : 997) {
    auto flipped = bytes;
    flipped[at] ^= std::byte{0x10};
    INFO(at);
    REQUIRE(write_file_atomically(broken, flipped).ok());
    const auto read = read_pack(broken);
    if (!read.ok()) {
      CHECK(read.problem().text().find(broken.string()) == 0);
      continue;
    }
    REQUIRE(at >= 128);
    const auto scene = compiled(read.value(), "", 1);
    const auto whole = for_each_cell(*scene, [](const GeometryCell&) {});
    // Padding between objects holds nothing.
    if (!whole.ok()) CHECK(whole.problem().what.find("damaged") != std::string::npos);
  }
  auto other_version = bytes;
  other_version[8] = std::byte{99};
  CHECK(refusal(broken, other_version).find("pack the scene again") != std::string::npos);
}

TEST_CASE("no bytes of a skeleton crash its reader", "[pack]") {
  const test::TemporaryFolder folder;
  const auto description = gallery_in(folder.path());
  const auto scene = compiled(description, "", 2);
  const std::vector<std::byte> bytes =
      encode_skeleton(*description, summary_of(*scene, SceneParts(*scene), 2));
  REQUIRE(decode_skeleton(bytes).ok());
  Random random(11, RandomStream::test);
  int refused = 0;
  for (uint64_t i = 0; i < 3000; ++i) {
    random.start(i);
    auto mutated = bytes;
    const auto anywhere = [&] {
      return static_cast<size_t>(random.uniform_double() * static_cast<double>(mutated.size()));
    };
    const int changes = 1 + static_cast<int>(i % 4);
    for (int k = 0; k < changes; ++k)
      mutated[anywhere()] = static_cast<std::byte>(random.uniform_double() * 256);
    if (i % 3 == 0) mutated.resize(anywhere());
    const auto read = decode_skeleton(mutated);
    if (read.ok()) continue;
    ++refused;
    CHECK_FALSE(read.problem().what.empty());
  }
  CHECK(refused > 500);
}
