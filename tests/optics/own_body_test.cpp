// A luminaire's own body: the intensities were measured with it, so that its own light passes it on
// its way from the luminaire; all other light, and its own once scattered, meets it.
#include <cmath>

#include "scenes/light/transport/trace.hpp"
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

/// A lamp in the middle of a closed box, which hides all of it, in a room.
std::string room_with(const std::string& reflectance, const std::string& body,
                      const std::string& lamp) {
  return "[run]\nvoxels = false\n[[material]]\nname = \"m\"\nreflectance = " + reflectance +
         "\n[[object]]\nname = \"room\"\nshape = \"room\"\nlow = [-3, -3, 0]\nhigh = [3, 3, 3]\n"
         "material = \"m\"\n" +
         body + lamp +
         "[[plane]]\nname = \"floor\"\ncorner = [-2, -2, 0.2]\nedge_u = [4, 0, 0]\n"
         "edge_v = [0, 4, 0]\ncells = [1, 1]\n"
         "[[plane]]\nname = \"ceiling\"\ncorner = [-2, -2, 2.8]\nedge_u = [0, 4, 0]\n"
         "edge_v = [4, 0, 0]\ncells = [1, 1]\n";
}

std::string body_of(const std::string& names) {
  return "[[object]]\nname = \"housing\"\nshape = \"box\"\nlow = [-0.3, -0.3, 1.9]\n"
         "high = [0.3, 0.3, 2.1]\nmaterial = \"m\"\n" +
         (names.empty() ? "" : "body_of = [" + names + "]\n");
}

std::string point(const std::string& name, const std::string& position) {
  return "[[emitter]]\nname = \"" + name +
         "\"\nshape = \"point\"\ndistribution = \"isotropic\"\nflux_w = 1\nspectrum = \"E\"\n"
         "position = " +
         position + "\n";
}

/// A face that shines up, within the box.
const std::string upward =
    "[[emitter]]\nname = \"lamp\"\nshape = \"rectangle\"\nsize = [0.4, 0.4]\nflux_w = 1\n"
    "spectrum = \"E\"\nposition = [0, 0, 2]\ndirection = [0, 0, 1]\n";

const std::string inside = point("lamp", "[0, 0, 2]"), other = point("other", "[1, 0, 2.9]");

double direct_lx(const Run& run, const glm::dvec3& at, const glm::dvec3& normal) {
  return direct_light_at(run.scene(), GeometryAccess::resident(run.local().index()),
                         glm::vec3(at - run.scene().local_origin), glm::vec3(normal), {})
      .total_lx();
}

Run run_of(const std::string& text, int64_t particles = 1 << 16) {
  RunOptions options;
  options.particles = particles;
  return Run(scene_from_toml(text), options);
}

/// Compares the light that arrives at the planes after at least one event: by particles, and by
/// paths from the eye to probes on each plane.
void check_paths_agree_with_particles(const std::string& text, double max_relative_error) {
  SceneDescription scene = scene_from_toml(text);
  constexpr uint32_t per_side = 5, n = per_side * per_side;
  const std::vector<BinSum> probes_of_plane = add_probes_on_planes(scene, per_side);
  std::vector<double> area_m2;
  for (const PlaneMeasure& plane : scene.planes)
    area_m2.push_back(glm::length(plane.edge_u) * glm::length(plane.edge_v));
  scene.run.eye_path_factor = 8;
  const double lm_per_w = efficacy_lm_per_w(scene.emitters[0].spectrum);
  RunOptions options;
  options.particles = 1 << 21;
  const Run run(std::move(scene), options, probes_of_plane);
  for (uint32_t plane = 0; plane < area_m2.size(); ++plane) {
    INFO("plane " << plane);
    check_agree(run.sum(plane) * (1 / (lm_per_w * n)),
                run.watts(run.blocks().planes, plane, 1) * (1 / area_m2[plane]),
                max_relative_error);
  }
}

/// A body of one material about the lamp, and a mirror under the ceiling.
std::string body_and_mirror(const std::string& material) {
  return "[[material]]\nname = \"own\"\n" + material +
         "[[material]]\nname = \"mirror\"\nkind = \"mirror\"\nspecular = 0.9\n"
         "[[object]]\nname = \"mirror\"\nshape = \"box\"\nlow = [-1, -1, 2.92]\n"
         "high = [1, 1, 2.95]\nmaterial = \"mirror\"\n"
         "[[object]]\nname = \"housing\"\nshape = \"box\"\nlow = [-0.3, -0.3, 1.9]\n"
         "high = [0.3, 0.3, 2.1]\nmaterial = \"own\"\nbody_of = [\"lamp\"]\n";
}

}  // namespace

TEST_CASE("in a black room a lamp's own body changes nothing, and another's body hides it") {
  for (const std::string& lamp : {inside, upward}) {
    const Run bare = run_of(room_with("0", "", lamp), 1 << 18);
    const Run own = run_of(room_with("0", body_of("\"lamp\""), lamp), 1 << 18);
    const Run foreign = run_of(room_with("0", body_of(""), lamp));
    for (const double z : {0.2, 2.8}) {
      const glm::dvec3 at(0.7, -0.4, z), normal(0, 0, z < 2 ? 1 : -1);
      const double free = direct_lx(bare, at, normal);
      CHECK((free > 0 || (z < 2 && lamp == upward)));
      CHECK(direct_lx(own, at, normal) == Approx(free).epsilon(1e-9).margin(1e-12));
      CHECK(direct_lx(foreign, at, normal) == 0);
    }
    for (const char* side : {"room.floor", "room.ceiling", "room.x0"}) {
      INFO(side);
      if (bare.into(side).value > 0) check_agree(own.into(side), bare.into(side), half_percent);
      CHECK(foreign.into(side).value == 0);
    }
    CHECK(own.into("housing").value == 0);
    CHECK(foreign.into("housing").value == Approx(1));
  }
}

TEST_CASE("a body hides the light of other lamps, and light that comes back to it") {
  const std::string both = inside + other;
  const Run own = run_of(room_with("0", body_of("\"lamp\""), both));
  const Run none = run_of(room_with("0", "", both));
  const Run alone = run_of(room_with("0", "", inside));
  // In the shadow of the box as the other lamp casts it.
  const glm::dvec3 shadow(-1.9, 0, 0.2), up(0, 0, 1);
  CHECK(direct_lx(own, shadow, up) == Approx(direct_lx(alone, shadow, up)).epsilon(1e-6));
  CHECK(direct_lx(none, shadow, up) > 1.05 * direct_lx(alone, shadow, up));
  // Reflected light of its own lamp is absorbed by a body, too.
  const Run grey = run_of(room_with("0.6", body_of("\"lamp\""), inside));
  CHECK(grey.into("housing").value > 0.01);
}

TEST_CASE("paths from the eye find the light that passes a lamp's own body") {
  check_paths_agree_with_particles(room_with("0.6", body_of("\"lamp\""), upward), 4 * half_percent);
}

TEST_CASE("paths from the eye find a lamp behind its own glass or opening once") {
  for (const char* material : {"kind = \"glass\"\ntransmittance = 0.6\n", "kind = \"open\"\n"}) {
    INFO(material);
    check_paths_agree_with_particles(room_with("0.6", body_and_mirror(material), upward),
                                     8 * half_percent);
  }
}

TEST_CASE("an eye sees a lamp behind its own glass as bright as without it") {
  const auto seen_w = [](const std::string& body) {
    const Run run = run_of(room_with("0", body, upward), 1 << 12);
    const auto tracer =
        make_picture_tracer(run.scene(), GeometryAccess::resident(run.local().index()), 1, nullptr);
    tracer->start(0, 1, 0);
    FirstHit first;
    const glm::dvec3 eye(0.1, 0.05, 2.8);
    tracer->radiance({Vec3(eye - run.scene().local_origin), Vec3(0, 0, -1)}, 0, nullptr, &first);
    return first.emitted.at(0);
  };
  const double bare = seen_w("");
  CHECK(bare > 0);
  CHECK(seen_w(body_and_mirror("kind = \"glass\"\ntransmittance = 0.6\n")) == Approx(bare));
  CHECK(seen_w(body_of("\"lamp\"")) == 0);  // it is opaque
}

TEST_CASE("a lamp does not light its own body, neither by particles nor by paths from the eye") {
  // Face and planes are between the body and the ceiling, so that the body fills much of the view.
  const std::string face_on_it =
      "[[emitter]]\nname = \"lamp\"\nshape = \"rectangle\"\nsize = [0.4, 0.4]\nflux_w = 1\n"
      "spectrum = \"E\"\nposition = [0, 0, 2.5]\ndirection = [0, 0, -1]\n"
      "[[plane]]\nname = \"near\"\ncorner = [-0.25, -0.25, 2.2]\nedge_u = [0, 0.5, 0]\n"
      "edge_v = [0.5, 0, 0]\ncells = [1, 1]\n";
  const std::string glossy =
      "[[material]]\nname = \"own\"\nkind = \"glossy\"\nreflectance = 0.4\nspecular = 0.3\n"
      "roughness = 0.3\n";
  for (const std::string& material : {std::string(), glossy}) {
    INFO(material);
    std::string body = body_of("\"lamp\"");
    if (!material.empty()) body.replace(body.find("\"m\""), 3, "\"own\"");
    check_paths_agree_with_particles(room_with("0.6", material + body, face_on_it),
                                     8 * half_percent);
  }
}

}  // namespace luxodus::light
