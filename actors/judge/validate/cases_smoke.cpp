// A point source in infinite fog (Case), balls of smoke (collision probabilities), and the glowing
// cube of Burns and Christon (quadrature).
#include <algorithm>
#include <cmath>

#include "actors/judge/validate/case.hpp"
#include "actors/judge/validate/reference.hpp"
#include "actors/judge/validate/scene_kit.hpp"

namespace luxodus::light {

namespace {

void add_specks(SceneDescription& scene, double away) {
  add_speck(scene, {away, away, away});
  add_speck(scene, {-away, -away, -away});
  scene.objects.back().name = "other speck";
}

PreparedCase fog_plan(double albedo, const std::vector<Row>& rows) {
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  scene.run.voxels = false;
  add_specks(scene, 30);
  add_point(scene, {0, 0, 0}, 1);
  add_homogeneous(scene, smoke(1, albedo));
  for (uint32_t i = 0; i < rows.size(); ++i) {
    const double r = rows[i].number("r_in_mfp");
    // Half the relative thickness of a shell. Fluence curves most over a free path: 0.1 of it.
    const double t = std::min(0.02, 0.1 / r);
    add_shell_group(scene, {0, 0, 0}, 0, r);
    add_shell_group(scene, {0, 0, 0}, r * (1 - t), r * (1 + t));
    const std::string where = " " + rows[i].text("r_in_mfp");
    const double share = rows[i].number("absorbed_fraction_within_r");
    plan.add("absorbed within" + where, share,
             [i](const Traced& run) { return run.absorbed_in(2 * i); });
    // Far away, where few particles come, each stays in the shell for twice its thickness.
    const double area = 4 * pi * r * r, thickness = 2 * r * t;
    constexpr double of_shells = 3e-3;  // curvature of the fluence within them
    plan.add(
            "path about" + where, area * thickness * rows[i].number("fluence_sigma_t=1"),
            [i, t](const Traced& run) {
              return run.track_length(2 * i + 1) * (1 / (1 + t * t / 3));
            },
            of_shells)
        .unit = 2 * thickness;
  }
  return plan;
}

PreparedCase ball_plan(const Row& row) {
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  const double radius = 1.25, albedo = row.number("albedo");
  const std::string& quantity = row.text("quantity");
  scene.run.voxels = false;
  add_specks(scene, 3);
  Medium& ball = add_ball(scene, {0.2, -0.1, 0.3}, radius,
                          smoke(row.number("optical_radius") / radius, albedo));
  double entering = 1;
  if (quantity.starts_with("escape fraction of uniform")) {
    ball.emission = MediumEmission{};
    ball.emission->power_w = 1;
  } else if (quantity.starts_with("escape fraction of central")) {
    add_point(scene, {0.2, -0.1, 0.3}, 1);
  } else {
    // Within walls of uniform exitance M the field is uniform: M x 4 pi r^2 enters a ball.
    for (const BoxFace& f : faces_of_box({-1.2, -1.5, -1.1}, {1.6, 1.3, 1.7}))
      add_face_emitter(scene, f, 1 / 6.0);
    entering = 4 * pi * radius * radius / (6 * 2.8 * 2.8);
  }
  const bool absorbed = quantity.starts_with("absorbed");
  const double share = absorbed ? row.number("value") : 1 - row.number("value");
  plan.sums.push_back(every_side());
  plan.quick_particles = 1 << 17;
  constexpr double digits = 2e-6;
  plan.add("absorbed", entering * share,
           [](const Traced& run) { return run.absorbed_by_medium(0); })
      .bias = digits;
  plan.add("escaped", 1 - entering * share, [](const Traced& run) { return run.sum(0); }).bias =
      digits;
  return plan;
}

double kappa_of_burns_christon(const glm::dvec3& p) {
  const auto f = [](double x) { return 1 - 2 * std::abs(x - 0.5); };
  return 0.9 * f(p.x) * f(p.y) * f(p.z) + 0.1;
}

/// A box around a point of the cube's centre line, and its five images: the field is the same along
/// six half lines. `from` and `to` are distances from the centre, `half` is half the width.
std::vector<uint32_t> add_images(SceneDescription& scene, double from, double to, double half) {
  std::vector<uint32_t> numbers;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      glm::dvec3 low(0.5 - half), high(0.5 + half);
      low[axis] = 0.5 + std::min(sign * from, sign * to);
      high[axis] = 0.5 + std::max(sign * from, sign * to);
      numbers.push_back(static_cast<uint32_t>(scene.volume_groups.size()));
      add_box_group(scene, low, high);
    }
  }
  return numbers;
}

std::string fluence_at(const Row& row) {
  return "fluence at x = " + row.text("x");
}

/// Cells of 1/80 and averaging over a box reduce the fluence by this much: at the peak of kappa
/// 0.37 % in a box of 3 cm, elsewhere up to 0.26 %, by quadrature along rays.
constexpr double of_cells = 4e-3;

/// [W]; all particles carry the same power.
double emitted_in_all() {
  return rows_where("burns_christon.csv", "x", "total emitted (4*int kappa)")
      .front()
      .number("divQ");
}

/// Fluence, and emission minus absorption, at a point of the centre line.
void add_centre(PreparedCase& plan, const Row& row) {
  constexpr double half = 0.015;
  const double x = row.number("x"), kappa = row.number("kappa");
  const auto number = static_cast<uint32_t>(plan.sums.size());
  const auto images = add_images(plan.scene, x - 0.5 - half, x - 0.5 + half, half);
  plan.sums.push_back({&TallyBlocks::volume_length, images});
  plan.sums.push_back({&TallyBlocks::volume_power, images});
  const double volume = 6 * std::pow(2 * half, 3), diagonal = 2 * half * std::sqrt(3.0);
  plan.add(
          fluence_at(row), row.number("G_incident_radiation"),
          [=](const Traced& run) { return run.sum(number) * (1 / volume); }, of_cells)
      .unit = emitted_in_all() * diagonal / volume;
  // Averages over the box: kappa is 0.1 + 0.9 times the product of three hat functions, each
  // averaged.
  const double side = 1 - half, along = x == 0.5 ? side : 2 * (1 - x);
  const double mean_kappa = 0.1 + 0.9 * along * side * side;
  plan.add("emission less absorption at x = " + row.text("x"), row.number("divQ"),
           [=](const Traced& run) {
             const Estimate absorbed = run.sum(number + 1) * (kappa / (mean_kappa * volume));
             return Estimate{4 * kappa - absorbed.value, absorbed.standard_error};
           })
      .bias = 2 * of_cells * kappa * row.number("G_incident_radiation");
  // Its count is that of the absorbed light.
  const double absorbed = kappa * row.number("G_incident_radiation");
  plan.quantities.back().unit = emitted_in_all() / volume * row.number("divQ") / absorbed;
}

/// At the wall, extrapolated from three thin boxes in front of it, by the quadratic with their
/// averages.
void add_wall_point(PreparedCase& plan, const Row& row) {
  constexpr double thin = 0.01, half = 0.015;
  constexpr double shares[] = {11.0 / 6, -7.0 / 6, 2.0 / 6};
  WeightedSum sum{&TallyBlocks::volume_length, {}};
  for (int i = 0; i < 3; ++i) {
    for (const uint32_t box : add_images(plan.scene, 0.5 - (i + 1) * thin, 0.5 - i * thin, half))
      sum.terms.push_back({box, 0, shares[i] / (6 * thin * 4 * half * half)});
  }
  plan.weighted.push_back(std::move(sum));
  plan.add(
          fluence_at(row), row.number("G_incident_radiation"),
          [](const Traced& run) { return run.weighted_sum(0); }, of_cells)
      .unit = emitted_in_all() * shares[0] / (6 * thin * 2 * half);
}

PreparedCase burns_christon_plan() {
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  scene.run.voxels = false;
  const int black = add_grey(scene, 0);
  for (const BoxFace& f : faces_of_box({0, 0, 0}, {1, 1, 1}))
    add_quad(scene, f.name, f.corner, f.u, f.v, black);
  // With an even number of cells their centres' values are the averages, as kappa is linear within
  // each.
  Medium& m = add_cells(scene, {0, 0, 0}, {1, 1, 1}, 80, kappa_of_burns_christon, 0);
  m.data.emission = m.data.extinction;
  m.emission = MediumEmission{};
  constexpr const char* table = "burns_christon.csv";
  const auto total = [](const char* what) {
    return rows_where(table, "x", what).front().number("divQ");
  };
  const double emitted = emitted_in_all(), escaping = total("total escaping to the 6 black walls");
  m.emission->power_w = emitted;
  plan.quick_particles = 1 << 20;  // boxes about the points are small
  constexpr double of_totals = 1e-3;
  plan.sums.push_back({&TallyBlocks::surfaces, {0, 1, 2, 3, 4, 5}});
  plan.add(
      "to all walls", escaping, [](const Traced& run) { return run.sum(0); }, of_totals);
  plan.add(
      "absorbed", emitted - escaping, [](const Traced& run) { return run.absorbed_by_medium(0); },
      of_totals);
  for (const std::string wall : {"x0", "x1", "y0", "y1", "z0", "z1"})
    plan.add(
        "to wall " + wall, total("per wall"), [wall](const Traced& run) { return run.into(wall); },
        of_totals);
  for (const Row& row : reference_table(table)) {
    if (row.text("x").starts_with("total") || row.text("x") == "per wall") continue;
    if (row.number("x") < 1)
      add_centre(plan, row);
    else
      add_wall_point(plan, row);
  }
  return plan;
}

}  // namespace

void add_smoke_cases(Cases& cases) {
  for (const std::string albedo : {"0.3", "0.9"}) {
    cases.push_back(
        {"fog", "point source in fog, albedo " + albedo, "infinite_point_source.csv", [albedo] {
           return fog_plan(std::stod(albedo),
                           rows_where("infinite_point_source.csv", "albedo", albedo));
         }});
  }
  for (const Row& row : reference_table("sphere_cases.csv")) {
    cases.push_back({"ball",
                     "ball of smoke " + row.text("optical_radius") + ", albedo " +
                         row.text("albedo") + ", " + row.text("quantity"),
                     "sphere_cases.csv", [row] { return ball_plan(row); }});
  }
  cases.push_back(
      {"cells", "Burns and Christon's cube", "burns_christon.csv", burns_christon_plan});
}

}  // namespace luxodus::light
