// Forged packs: all hashes are correct, but a value is not. Each is rejected with a sentence, or
// checked, compiled and traced like any other; none crashes the program. The seed is LUXODUS_SEED,
// or 1; LUXODUS_FORGERIES packs are forged, or 1500.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "actors/results/run/local_run.hpp"
#include "runtime/core/atomic_file.hpp"
#include "runtime/core/hash.hpp"
#include "runtime/core/random.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/formats/pack/scene_pack.hpp"
#include "scenes/formats/pack/skeleton.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/scenes/formats/pack/burning_gallery.hpp"

using namespace luxodus;
namespace fs = std::filesystem;

namespace {

using Bytes = std::vector<std::byte>;

/// Lamps of all shapes, a sign with two faces, smoke of all kinds, measurements of all kinds.
constexpr const char* crowded_text = R"(
[run]
batch_particles = 512
voxel_edge_m = 1
max_bands = 3
groups = "emitter"
[[material]]
name = "shiny"
kind = "glossy"
reflectance = 0.3
specular = 0.4
roughness = 0.2
[[material]]
name = "pane"
kind = "glass"
transmittance = 0.9
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [6, 4, 3]
material = "grey50"
patch_edge_m = 1
[[object]]
name = "leaf"
shape = "quad"
corner = [1, 1, 0.01]
edge_u = [1, 0, 0]
edge_v = [0, 0, 2]
material = "pane"
[object.door]
hinge = [1, 1, 0]
[[object]]
name = "plinth"
shape = "box"
low = [2.5, 1.5, 0.01]
high = [3.5, 2.5, 1]
material = "shiny"
one_patch = true
tags = ["stone"]
[[emitter]]
name = "spot"
shape = "point"
position = [3, 2, 2.9]
flux_lm = 400
distribution = "spot"
spot_inner_deg = 10
spot_outer_deg = 30
[[emitter]]
name = "panel"
shape = "rectangle"
position = [1, 2, 2.9]
size = [0.6, 0.3]
flux_lm = 1000
body_material = "grey20"
[[emitter]]
name = "globe"
shape = "sphere"
position = [5, 3, 2]
diameter = 0.3
flux_lm = 500
[[sign]]
name = "exit"
position = [3, 2, 2.3]
facing = [1, 0, 0]
width = 0.6
height = 0.2
text = "EXIT"
letter_height = 0.1
double_sided = true
mains_white = 300
mains_green = 40
emergency_white = 100
emergency_green = 20
[[medium]]
name = "layers"
kind = "layered"
[[medium.layer]]
z_low = 0
z_high = 1.5
extinction = 0.1
albedo = 0.2
[[medium.layer]]
z_low = 1.5
z_high = 3
extinction = 0.6
albedo = 0.7
[[medium]]
name = "ball"
kind = "bounded"
body = "ellipsoid"
position = [4, 1, 1]
radii = [0.5, 0.4, 0.3]
extinction = 2
albedo = 0.5
phase = "hg"
g = 0.6
[[plane]]
name = "floor"
corner = [0.5, 0.5, 0.02]
edge_u = [5, 0, 0]
edge_v = [0, 3, 0]
cell_m = 0.5
[[volume_group]]
name = "shell"
shape = "shell"
centre = [3, 2, 1.5]
radius = 1
inner_radius = 0.5
[[surface_group]]
name = "stones"
objects = ["stone"]
[[counting_plane]]
name = "gate"
corner = [3, 0, 0]
edge_u = [0, 4, 0]
edge_v = [0, 0, 3]
[[probe]]
name = "visitor"
position = [1, 1.5, 1.6]
[[observer]]
name = "guard"
eye = [5.5, 2, 1.6]
target = [3, 2, 2.3]
[[camera]]
name = "door"
eye = [3, 0.3, 1.6]
target = [3, 4, 1.5]
width = 24
height = 16
)";

uint64_t setting(const char* name, uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 0) : otherwise;
}

template <class T>
T value_at(const Bytes& bytes, size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}
template <class T>
void put_at(Bytes& bytes, size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

// Offsets in the head, as in scene_pack.cpp.
constexpr size_t head_bytes = 128, file_bytes_at = 16, skeleton_at = 24, skeleton_bytes_at = 32,
                 skeleton_hash_at = 40, head_hash_at = 120;

/// Recomputes the hashes of head and skeleton.
void sign_anew(Bytes& bytes) {
  const auto skeleton = value_at<uint64_t>(bytes, skeleton_at);
  const std::span<const std::byte> all(bytes);
  put_at<uint64_t>(bytes, file_bytes_at, bytes.size());
  put_at<uint64_t>(bytes, skeleton_bytes_at, bytes.size() - skeleton);
  put_at<uint64_t>(bytes, skeleton_hash_at, object_id_of(all.subspan(skeleton)).value);
  put_at<uint64_t>(bytes, head_hash_at, object_id_of(all.first(head_hash_at)).value);
}

/// Writes a value that an attacker would try, or random bits.
void harm(Bytes& bytes, size_t at, Random& random) {
  constexpr uint32_t words[] = {0,          1,          2,          0x7fffffff,
                                0x80000000, 0xffffffff, 0xfffffffe, 0x00010000};
  constexpr double numbers[] = {0.0,  -0.0, -1.0, 1e-300, 1e300, 1e30,
                                -1e9, 2.0,  0.5,  1e6,    NAN,   INFINITY};
  const size_t left = bytes.size() - at;
  switch (random.bits() % 5) {
    case 0:
      bytes[at] ^= static_cast<std::byte>(1u << (random.bits() % 8));
      break;
    case 1:
      bytes[at] = static_cast<std::byte>(random.bits());
      break;
    case 2:
      if (left >= 4) put_at(bytes, at, words[random.bits() % std::size(words)]);
      break;
    case 3:
      if (left >= 8) put_at(bytes, at, numbers[random.bits() % std::size(numbers)]);
      break;
    default:
      if (left >= 4)
        put_at(bytes, at, static_cast<float>(numbers[random.bits() % std::size(numbers)]));
      break;
  }
}

struct Sample {
  Bytes bytes;
  std::vector<std::pair<size_t, size_t>> objects;  // offset and length
};

Sample sample_of(const std::shared_ptr<const SceneDescription>& description, const fs::path& file) {
  auto scene = compile_scene(description, find_scenario(*description, "").value(), {3});
  INFO((scene.ok() ? "" : scene.problem().text()));
  REQUIRE(scene.ok());
  REQUIRE(write_pack(file, *scene.value(), 3).ok());
  Sample out{read_whole_file(file, uint64_t{1} << 30).value(), {}};
  auto packed = read_pack(file);
  REQUIRE(packed.ok());
  size_t at = head_bytes;
  for (const auto& object : packed.value()->packed->objects) {
    out.objects.emplace_back(at, object.wire_bytes);
    at = (at + object.wire_bytes + 63) / 64 * 64;
  }
  return out;
}

/// Changes one or a few values of the skeleton, or of an object, whose name is then recomputed,
/// too.
Bytes forged(const Sample& sample, Random& random) {
  Bytes bytes = sample.bytes;
  const auto skeleton = value_at<uint64_t>(bytes, skeleton_at);
  if (random.uniform() < 0.25f) {
    const auto [at, length] = sample.objects[random.bits() % sample.objects.size()];
    const auto object = [&, at = at, length = length] {
      return std::span<const std::byte>(bytes).subspan(at, length);
    };
    const uint64_t before = object_id_of(object()).value;
    harm(bytes, at + random.bits() % length, random);
    const uint64_t after = object_id_of(object()).value;
    const auto name = std::as_bytes(std::span(&before, 1));
    const auto found = std::search(bytes.begin() + static_cast<ptrdiff_t>(skeleton), bytes.end(),
                                   name.begin(), name.end());
    if (found != bytes.end()) put_at(bytes, static_cast<size_t>(found - bytes.begin()), after);
  } else {
    do harm(bytes, skeleton + random.bits() % (bytes.size() - skeleton), random);
    while (random.uniform() < 0.2f);
  }
  sign_anew(bytes);
  return bytes;
}

/// Does what `check` and a short `run` do. True: it completed.
bool used(const fs::path& file) {
  const auto told = [](const Problem& problem) {
    CHECK_FALSE(problem.what.empty());
    return false;
  };
  auto read = read_pack(file);
  if (!read.ok()) return told(read.problem());
  const SceneDescription& d = *read.value();
  if (d.run.batch_particles > 4096 || d.run.batch_particles == 0) return false;  // only slow
  auto scenario = find_scenario(d, d.scenarios.empty() ? "" : d.scenarios.front().name);
  if (!scenario.ok()) return told(scenario.problem());
  auto scene = compile_scene(read.value(), scenario.value(), {1});
  if (!scene.ok()) return told(scene.problem());
  // If forged to be larger, it takes minutes and gigabytes, like a scene file of that size.
  if (scene.value()->layout.scores() > 2'000'000) return false;
  if (scene.value()->groups.empty()) return false;
  for (const auto loaded : {load_bricks(*scene.value()).ok(), load_images(*scene.value()).ok()})
    if (!loaded) return false;
  if (auto cells = for_each_cell(*scene.value(), [](const GeometryCell&) {}); !cells.ok())
    return told(cells.problem());
  LocalRun run(scene.value(), 3, 1);
  StopRule stop;
  stop.particles = 512;
  const std::atomic<bool> nobody{false};
  run.run(stop, nobody, [](const Progress&) {});
  return true;
}

}  // namespace

TEST_CASE("a forged pack is rejected or traced, and never crashes the program", "[pack][hostile]") {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "x.luxpack";
  std::vector<Sample> samples;
  samples.push_back(sample_of(gallery_in(folder.path()), file));
  REQUIRE(write_file_atomically(folder.path() / "crowded.toml", std::string(crowded_text)).ok());
  auto crowded = read_scene(folder.path() / "crowded.toml");
  for (const Problem& p : crowded.problems.list()) UNSCOPED_INFO(p.text());
  REQUIRE(crowded.scene);
  samples.push_back(
      sample_of(std::make_shared<const SceneDescription>(std::move(*crowded.scene)), file));
  const uint64_t seed = setting("LUXODUS_SEED", 1), wanted = setting("LUXODUS_FORGERIES", 1500);
  INFO("seed " << seed);
  Random random(seed, RandomStream::test);
  uint64_t traced = 0;
  for (uint64_t i = 0; i < wanted; ++i) {
    random.start(i);
    REQUIRE(write_file_atomically(file, forged(samples[i % samples.size()], random)).ok());
    if (std::getenv("LUXODUS_TELL") != nullptr) std::fprintf(stderr, "forgery %d\n", int(i));
    traced += used(file) ? 1 : 0;
  }
  CHECK(traced > wanted / 10);
  CHECK(traced < wanted);
}

TEST_CASE("a forged value is reported by its meaning", "[pack][hostile]") {
  const test::TemporaryFolder folder;
  const auto description = gallery_in(folder.path());
  auto scene = compile_scene(description, find_scenario(*description, "smoky").value(), {2});
  REQUIRE(scene.ok());
  const PackedScene whole = summary_of(*scene.value(), SceneParts(*scene.value()), 2);
  const auto says = [](const SceneDescription& d, const PackedScene& p) {
    const auto read = decode_skeleton(encode_skeleton(d, p));
    return read.ok() ? std::string() : read.problem().what;
  };
  const auto with = [&](const std::function<void(SceneDescription&, PackedScene&)>& change) {
    SceneDescription d = *description;
    PackedScene p = whole;
    change(d, p);
    return says(d, p);
  };
  using D = SceneDescription;
  using P = PackedScene;
  CHECK(with([](D&, P&) {}).empty());
  const auto contains = [](const char* words) { return Catch::Contains(words); };
  CHECK_THAT(with([](D& d, P&) { d.emitters[0].mains_flux = NAN; }), contains("not finite"));
  CHECK_THAT(with([](D& d, P&) { d.emitters[0].mains_flux = -1; }), contains("flux"));
  CHECK_THAT(with([](D& d, P&) { d.emitters[0].spectrum = {}; }), contains("no light"));
  CHECK_THAT(with([](D& d, P&) { d.materials[0].reflectance = Spectrum::constant(1.5); }),
             contains("reflects"));
  CHECK_THAT(with([](D& d, P&) {
               FireSimulation fire;
               fire.meshes = {{glm::dvec3(1), glm::dvec3(0)}};
               for (Medium& m : d.media)
                 if (m.kind == MediumKind::data_set) m.simulation = fire;
             }),
             contains("simulated fire"));
  CHECK_THAT(
      with([](D& d, P&) { d.media[0].simulation = FireSimulation{"", NAN, "", false, {}, {}}; }),
      contains("not finite"));
  CHECK_THAT(with([](D& d, P&) { d.objects[0].material = 1000; }), contains("no material"));
  CHECK_THAT(with([](D& d, P&) { d.planes[0].cells_u = 1 << 30; }), contains("plane"));
  CHECK_THAT(with([](D& d, P&) { d.planes[0].edge_v = d.planes[0].edge_u; }), contains("no area"));
  CHECK_THAT(with([](D& d, P&) { d.media[0].optics.albedo = Spectrum::constant(2); }),
             contains("scatters"));
  CHECK_THAT(with([](D& d, P&) { d.cameras[0].width = -1; }), contains("camera"));
  CHECK_THAT(with([](D& d, P&) { d.run.band_edges_nm = {380, 400}; }), contains("bands"));
  CHECK_THAT(with([](D&, P& p) { p.surfaces[0].material[1] = 77; }), contains("surface"));
  CHECK_THAT(with([](D&, P& p) { p.surfaces[1].first_patch = 0; }), contains("patches"));
  CHECK_THAT(with([](D&, P& p) { p.surfaces[0].sign = 0; }), contains("surface"));
  CHECK_THAT(with([](D&, P& p) { p.cells[0].high.x = 1e30f; }), contains("cell"));
  CHECK_THAT(with([](D&, P& p) { p.triangles += 1; }), contains("triangles"));
  CHECK_THAT(with([](D&, P& p) { p.flame_points[1][0].x = 1e20f; }), contains("too far"));
}
