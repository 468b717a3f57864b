// Smoke of any shape: what a uniform field of light does in it, point sources in fog, glowing
// bodies.
#include <cmath>

#include "scenes/geometry/mesh_tools.hpp"
#include "scenes/geometry/primitives.hpp"
#include "tests/optics/light_kit.hpp"

namespace luxodus::light {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Walls over a box, all of one reflectance, all emitting `exitance`.
void add_glowing_box(SceneDescription& scene, const glm::dvec3& size, double reflectance,
                     double exitance) {
  const int wall = add_grey(scene, reflectance);
  for (const Face& f : faces_of_box({0, 0, 0}, size)) {
    add_quad(scene, f.name, f.corner, f.u, f.v, wall);
    if (exitance > 0) add_face_emitter(scene, f, exitance * glm::length(f.u) * glm::length(f.v));
  }
}

/// Smoke of every kind that absorbs nothing, over one another, in a box of `size`.
void add_white_smoke(SceneDescription& scene, const glm::dvec3& size, int kind) {
  if (kind == 0 || kind == 4) add_homogeneous(scene, smoke(1.5, 1, 0.6));
  if (kind == 1 || kind == 4)
    add_layers(scene, 0.3 * size.z, {0.3 * size.z, 0.2 * size.z},
               {smoke(0.5, 1, 0.9), smoke(4, 1, -0.5)});
  if (kind == 2 || kind == 4)
    add_ball(scene, size * glm::dvec3(0.4, 0.5, 0.6), 0.3 * std::min({size.x, size.y, size.z}),
             smoke(8, 1));
  if (kind == 3 || kind == 4)
    add_cells(
        scene, 0.1 * size, 0.7 * size, 20,
        [&](const glm::dvec3& p) {
          return 3 * (1 + std::sin(9 * p.x) * std::cos(7 * p.y + 5 * p.z));
        },
        1, 0.7);
}

}  // namespace

TEST_CASE("in a closed room of equal walls white smoke of any density changes nothing anywhere") {
  for (int kind = 0; kind < 5; ++kind) {
    INFO("kind " << kind);
    SceneDescription scene;
    scene.run.voxel_edge_m = 0.5;
    add_glowing_box(scene, {1, 1, 1}, 0.5, 0.5);  // irradiance 0.5 / (1 - 0.5) = 1
    add_white_smoke(scene, {1, 1, 1}, kind);
    add_layer_group(scene, 0, 1);
    add_box_group(scene, {0.5, 0.1, 0.2}, {0.8, 0.9, 0.5});
    add_shell_group(scene, {0.4, 0.5, 0.6}, 0, 0.3);
    add_shell_group(scene, {0.5, 0.5, 0.5}, 0.3, 0.45);
    RunOptions options;
    options.particles = 1 << 19;
    options.batch_particles = 2048;
    const Run run(std::move(scene), options, {{&TallyBlocks::surfaces, {0, 1, 2, 3, 4, 5}}});
    const double fluence = exact("equilibrium_fluence", "E=1");
    const auto ball = [](double r) { return 4 * pi / 3 * r * r * r; };
    check_within(run.track_length(0), fluence, half_percent / 2, 2e-5);
    check_within(run.track_length(1), fluence * 0.3 * 0.8 * 0.3, half_percent, 2e-5);
    check_within(run.track_length(2), fluence * ball(0.3), half_percent, 2e-5);
    check_within(run.track_length(3), fluence * (ball(0.45) - ball(0.3)), half_percent, 2e-5);
    check_within(run.sum(0), 6, half_percent / 2, 2e-5);
    for (const std::string wall : {"x0", "x1", "y0", "y1", "z0", "z1"})
      check_within(run.into(wall), 1, half_percent, 2e-5);
    REQUIRE(run.scene().voxels.count() == 8);
    for (uint32_t v = 0; v < 8; ++v)
      check_within(run.watts(run.blocks().voxels, v), fluence / 8, half_percent, 5e-5);
    for (uint32_t m = 0; m < run.scene().media_names.size(); ++m)
      CHECK(run.absorbed_by_medium(m).value == 0);
  }
}

TEST_CASE("smoke as hot as the walls around it absorbs in every part what it emits") {
  SceneDescription scene;
  scene.run.voxels = false;
  add_glowing_box(scene, {1, 1, 1}, 0.3, 0.7);  // irradiance 1, fluence 4
  const auto sigma_t = [](const glm::dvec3& p) { return 0.2 + 5 * p.x * p.z; };
  Medium& m = add_cells(scene, {0, 0, 0}, {1, 1, 1}, 10, sigma_t, 0.4, 0.5);
  double power = 0;
  for (const float s : m.data.extinction) {
    m.data.emission.push_back(s);
    power += 4 * 0.6 * static_cast<double>(s) / 1000;
  }
  m.emission = MediumEmission{};
  m.emission->power_w = power;
  add_box_group(scene, {0.2, 0.2, 0.2}, {0.5, 0.9, 0.6});
  add_box_group(scene, {0, 0, 0}, {0.5, 1, 0.5});
  add_box_group(scene, {0.5, 0, 0.5}, {1, 1, 1});
  RunOptions options;
  options.particles = 1 << 20;
  const Run run(std::move(scene), options);
  check_within(run.track_length(0), 4 * 0.3 * 0.7 * 0.4, half_percent, 2e-5);
  check_within(run.track_length(1), 4 * 0.25, half_percent, 2e-5);
  check_within(run.track_length(2), 4 * 0.25, half_percent, 2e-5);
  // Emitted: 4 x 0.6 x the mean extinction, 0.2 + 5 x (mean x) (mean z), x volume.
  check_within(run.absorbed_in(0), 4 * 0.6 * (0.2 + 5 * 0.35 * 0.4) * 0.3 * 0.7 * 0.4, half_percent,
               1e-4);
  check_within(run.absorbed_in(1), 4 * 0.6 * (0.2 + 5 * 0.25 * 0.25) * 0.25, half_percent, 1e-4);
  check_within(run.absorbed_in(2), 4 * 0.6 * (0.2 + 5 * 0.75 * 0.75) * 0.25, half_percent, 1e-4);
  for (const std::string wall : {"x0", "x1", "y0", "y1", "z0", "z1"})
    check_within(run.into(wall), 1, half_percent, 2e-5);
}

TEST_CASE("the mean path through white smoke is four volumes over surface, whatever its density") {
  RunOptions options;
  options.particles = 1 << 18;
  options.batch_particles = 2048;
  for (int kind = 0; kind < 5; ++kind) {
    INFO("kind " << kind);
    SceneDescription scene;
    scene.run.voxels = false;
    add_glowing_box(scene, {6, 4, 3}, 0, 1 / 108.0);
    add_white_smoke(scene, {6, 4, 3}, kind);
    add_layer_group(scene, 0, 3);
    add_layer_group(scene, 1, 2);
    const Run run(std::move(scene), options);
    check_within(run.track_length(0), exact("mean_track_box", "6x4x3"), half_percent, 2e-5);
    check_within(run.track_length(1), exact("mean_track_box", "6x4x3") / 3, half_percent, 2e-5);
  }
  const auto drum = shapes::cylinder(1, 2, 200), ball = shapes::sphere(1, 1e-3);
  for (const auto& [name, shape] :
       {std::pair("mean_track_cylinder", drum), std::pair("mean_track_sphere", ball)}) {
    INFO(name);
    REQUIRE(shape.ok());
    SceneDescription scene;
    scene.run.voxels = false;
    Mesh inside = shape->mesh;
    for (glm::uvec3& t : inside.triangles) std::swap(t.y, t.z);
    const int black = add_grey(scene, 0);
    Emitter& e = add_emitter(scene, EmitterShape::mesh, {0, 0, 0.5}, {0, 0, -1}, 1);
    e.mesh = inside;
    e.body_material = scene.materials[static_cast<size_t>(black)].name;
    add_homogeneous(scene, smoke(2, 1, 0.5));
    add_ball(scene, {0.2, 0, 0.3}, 0.5, smoke(5, 1));
    add_layer_group(scene, -5, 5);
    const Run run(std::move(scene), options);
    const double mean = 4 * std::abs(signed_volume_of(shape->mesh)) / area_of(shape->mesh);
    check_within(run.track_length(0), mean, half_percent, 2e-5);  // of this mesh, exactly
    CHECK(mean == Approx(exact(name, name == std::string("mean_track_sphere") ? "R=1" : "R=1;H=2"))
                      .epsilon(3e-3));
  }
}

TEST_CASE("around a point source in endless fog light spreads as Case's solution says") {
  for (const double albedo : {0.3, 0.9}) {
    SceneDescription scene;
    scene.run.voxels = false;
    add_speck(scene, {30, 30, 30});
    add_speck(scene, {-30, -30, -30});
    scene.objects.back().name = "other speck";
    add_point(scene, {0, 0, 0}, 1);
    add_homogeneous(scene, smoke(1, albedo));
    std::vector<Row> rows;
    for (const Row& row : reference_table("infinite_point_source.csv")) {
      if (row.number("albedo") == albedo) rows.push_back(row);
    }
    // Half the relative thickness of shells. Fluence bends most over a free path: 0.1 of it.
    const auto thin = [](double r) { return std::min(0.02, 0.1 / r); };
    for (const Row& row : rows) {
      const double r = row.number("r_in_mfp");
      add_shell_group(scene, {0, 0, 0}, 0, r);
      add_shell_group(scene, {0, 0, 0}, r * (1 - thin(r)), r * (1 + thin(r)));
    }
    RunOptions options;
    options.particles = 1 << 21;
    const Run run(std::move(scene), options);
    for (uint32_t i = 0; i < rows.size(); ++i) {
      const double r = rows[i].number("r_in_mfp"), t = thin(r),
                   share = rows[i].number("absorbed_fraction_within_r");
      INFO("albedo " << albedo << ", radius " << r);
      check_within(run.absorbed_in(2 * i), share, half_percent, 1e-6);
      check_within(run.track_length(2 * i) * (1 - albedo), share, half_percent, 1e-6);
      // Far away, where few particles come, one of them stays in the shell for twice its thickness.
      const double area = 4 * pi * r * r, thickness = 2 * r * t;
      const double fluence = rows[i].number("fluence_sigma_t=1");
      check_share(run.track_length(2 * i + 1) * (1 / (1 + t * t / 3)), area * thickness * fluence,
                  options.particles, 2 * thickness, 3e-3 * area * thickness * fluence);
    }
  }
}

TEST_CASE("a ball of smoke lets out, passes and absorbs what collision probabilities say") {
  for (const Row& row : reference_table("sphere_cases.csv")) {
    const double radius = 1.25, albedo = row.number("albedo");
    const std::string& quantity = row.text("quantity");
    INFO(row.text("optical_radius") << " " << albedo << " " << quantity);
    SceneDescription scene;
    scene.run.voxels = false;
    add_speck(scene, {-3, -3, -3});
    add_speck(scene, {3, 3, 3});
    scene.objects.back().name = "other speck";
    Medium& ball = add_ball(scene, {0.2, -0.1, 0.3}, radius,
                            smoke(row.number("optical_radius") / radius, albedo));
    double entering = 1;
    if (quantity.starts_with("escape fraction of uniform")) {
      ball.emission = MediumEmission{};
      ball.emission->power_w = 1;
    } else if (quantity.starts_with("escape fraction of central")) {
      add_point(scene, {0.2, -0.1, 0.3}, 1);
    } else {
      // Within walls of one exitance M the field is the same everywhere: M x 4 pi r^2 enters a
      // ball.
      for (const Face& f : faces_of_box({-1.2, -1.5, -1.1}, {1.6, 1.3, 1.7}))
        add_face_emitter(scene, f, 1 / 6.0);
      entering = 4 * pi * radius * radius / (6 * 2.8 * 2.8);
    }
    const bool absorbed = quantity.starts_with("absorbed");
    const double share = absorbed ? row.number("value") : 1 - row.number("value");
    RunOptions options;
    options.particles = 1 << 20;
    const Run run(std::move(scene), options, {every_side()});
    check_within(run.absorbed_by_medium(0) * (1 / entering), share, half_percent, 2e-5);
    check_share(run.sum(0), 1 - entering * share, options.particles, 1, 2e-5);
  }
}

TEST_CASE("the glowing cube of Burns and Christon loses and keeps what quadrature says") {
  SceneDescription scene;
  scene.run.voxels = false;
  const auto kappa = [](const glm::dvec3& p) {
    const auto f = [](double x) { return 1 - 2 * std::abs(x - 0.5); };
    return 0.9 * f(p.x) * f(p.y) * f(p.z) + 0.1;
  };
  const int black = add_grey(scene, 0);
  for (const Face& f : faces_of_box({0, 0, 0}, {1, 1, 1}))
    add_quad(scene, f.name, f.corner, f.u, f.v, black);
  // An even number of cells: their centres' values are the averages, as kappa is linear within
  // each.
  Medium& m = add_cells(scene, {0, 0, 0}, {1, 1, 1}, 80, kappa, 0);
  m.data.emission = m.data.extinction;
  m.emission = MediumEmission{};
  m.emission->power_w = 0.85;
  std::vector<Row> line;
  double escaping = 0, per_wall = 0;
  for (const Row& row : reference_table("burns_christon.csv")) {
    if (row.text("x").starts_with("total escaping"))
      escaping = row.number("divQ");
    else if (row.text("x") == "per wall")
      per_wall = row.number("divQ");
    else if (row.text("x").starts_with("total"))
      CHECK(row.number("divQ") == 0.85);
    else if (row.number("x") < 0.97)
      line.push_back(row);
  }
  // The centre line is six half lines of one and the same field.
  constexpr double half = 0.015;
  std::vector<BinSum> sums = {{&TallyBlocks::surfaces, {0, 1, 2, 3, 4, 5}}};
  std::vector<double> expected;
  for (size_t i = 0; i < line.size(); i += 3) {
    sums.push_back({&TallyBlocks::volume_length, {}});
    expected.push_back(line[i].number("G_incident_radiation"));
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        glm::dvec3 c(0.5);
        c[axis] += sign * (line[i].number("x") - 0.5);
        sums.back().bins.push_back(static_cast<uint32_t>(scene.volume_groups.size()));
        add_box_group(scene, c - half, c + half);
      }
    }
  }
  RunOptions options;
  options.particles = 1 << 24;
  const Run run(std::move(scene), options, sums);
  check_within(run.absorbed_by_medium(0), 0.85 - escaping, half_percent, 1e-3);
  check_within(run.sum(0), escaping, half_percent / 2, 1e-3);
  for (const std::string wall : {"x0", "x1", "y0", "y1", "z0", "z1"})
    check_within(run.into(wall), per_wall, half_percent, 1e-3);
  for (uint32_t i = 0; i < expected.size(); ++i) {
    INFO("x = " << line[3 * i].text("x"));
    // By quadrature along rays, cells of 1/80 and the average over a box of 3 cm take 0.37 % off
    // the centre's value, where kappa has its peak, and up to 0.26 % off the others. The centre's
    // six boxes are one and the same.
    check_within(run.sum(1 + i) * (1 / (6 * std::pow(2 * half, 3))), expected[i],
                 i == 0 ? 1.5 * half_percent : half_percent, 4e-3);
  }
}

}  // namespace luxodus::light
