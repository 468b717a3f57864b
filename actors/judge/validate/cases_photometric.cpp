// Photometric files written here, in both formats, for a luminaire of known intensity: what the
// readers return, and where the tracer sends the light.
#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "actors/judge/validate/case.hpp"
#include "actors/judge/validate/scene_kit.hpp"
#include "actors/judge/validate/veil.hpp"
#include "runtime/core/check.hpp"
#include "scenes/formats/photometry/ies.hpp"
#include "scenes/formats/photometry/ldt.hpp"

namespace luxodus::light {

namespace {

/// Asymmetric towards C0: I = I0 cos(gamma) (1 + cos(C) / 2) below the horizon, none above.
constexpr double peak_cd = 500;
double intensity(double c_deg, double gamma_deg) {
  if (gamma_deg >= 90) return 0;
  return peak_cd * std::cos(gamma_deg * pi / 180) * (1 + 0.5 * std::cos(c_deg * pi / 180));
}

constexpr double c_step = 5, gamma_step = 2.5;  // [deg]

/// The table, one C plane after another, from 0 to `gamma_last`.
std::vector<double> candela(double c_last, double gamma_last) {
  std::vector<double> out;
  for (double c = 0; c <= c_last; c += c_step) {
    for (double gamma = 0; gamma <= gamma_last; gamma += gamma_step)
      out.push_back(intensity(c, gamma));
  }
  return out;
}

/// A lamp of 2000 lm, so that the table is in cd/klm and the readers must apply a factor.
PhotometricFile ldt_file() {
  constexpr double lamp_lm = 2000;
  std::string text;
  const auto line = [&](const auto& field) { text += fmt::format("{}\r\n", field); };
  const int planes = static_cast<int>(360 / c_step);
  const int gammas = static_cast<int>(180 / gamma_step) + 1;
  for (const char* field : {"Luxodus", "1", "0"}) line(field);
  line(planes);
  line(c_step);
  line(gammas);
  line(gamma_step);
  for (const char* field : {"report", "leaning", "number", "file", "date"}) line(field);
  for (const int size_mm : {0, 0, 0, 0, 0, 0, 0, 0, 0}) line(size_mm);
  for (const char* field : {"100", "100", "1", "0", "1"})
    line(field);  // shares, factor, tilt, sets
  line(1);
  line("LED");
  line(lamp_lm);
  for (const char* field : {"4000 K", "80", "10"}) line(field);
  for (int ratio = 0; ratio < 10; ++ratio) line("0.5");
  for (double c = 0; c < 360; c += c_step) line(c);
  for (double gamma = 0; gamma <= 180; gamma += gamma_step) line(gamma);
  for (const double cd : candela(359, 180)) line(cd / lamp_lm * 1000);
  auto file = read_ldt(text, "leaning.ldt");
  LUX_CHECK(file.ok(), file.problem().text().c_str());
  return std::move(file).value();
}

PhotometricFile ies_file() {
  std::string text = "IESNA:LM-63-2002\r\n[TEST] 1\r\n[MANUFAC] Luxodus\r\nTILT=NONE\r\n";
  const int gammas = static_cast<int>(90 / gamma_step) + 1,
            planes = static_cast<int>(360 / c_step) + 1;
  // One lamp, absolute photometry, type C, metres, a point.
  text += fmt::format("1 -1 1 {} {} 1 2 0 0 0\r\n1 1 10\r\n", gammas, planes);
  for (double gamma = 0; gamma <= 90; gamma += gamma_step) text += fmt::format("{}\r\n", gamma);
  for (double c = 0; c <= 360; c += c_step) text += fmt::format("{}\r\n", c);
  for (const double cd : candela(360, 90)) text += fmt::format("{}\r\n", cd);
  auto file = read_ies(text, "leaning.ies", ".");
  LUX_CHECK(file.ok(), file.problem().text().c_str());
  return std::move(file).value();
}

constexpr double flux_digits = 1e-5;  // digits of single precision, and of the files' numbers

/// The lamp above a floor: its computed light there, in directions of the table.
void add_places(PreparedCase& plan, const PhotometricFile& file) {
  constexpr double height = 2;
  SceneDescription scene;
  Emitter& e = add_point(scene, {0, 0, height}, 0);
  e.radiometric = false;
  e.mains_flux = file.flux_lm;
  e.distribution = Distribution::web;
  e.web = file.web;
  add_speck(scene, {-5, -5, 0});
  add_speck(scene, {5, 5, 0});
  scene.objects.back().name = "other speck";
  const auto lamp = lit(std::move(scene));
  for (const double c : {0, 60, 90, 180, 270}) {
    for (const double gamma : {10, 40, 65}) {
      const double away = height * std::tan(gamma * pi / 180), turn = c * pi / 180;
      plan.compute_direct(
          fmt::format("E at C {}, gamma {} [lx]", c, gamma),
          intensity(c, gamma) * std::pow(std::cos(gamma * pi / 180), 3) / (height * height), lamp,
          {away * std::cos(turn), away * std::sin(turn), 0}, {0, 0, 1}, flux_digits);
    }
  }
}

/// Its light scattered into a line of sight.
PreparedCase luminaire_veil(const PhotometricFile& file) {
  constexpr double g = 0.5;
  VeilCase veil;
  veil.phase.kind = PhaseKind::henyey_greenstein;
  veil.phase.g = g;
  veil.density = [](double cosine) {
    return (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
  };
  veil.flux_lm = file.flux_lm;
  veil.web = file.web;
  veil.candela = [](const glm::dvec3& way) {
    return intensity(std::atan2(way.y, way.x) * 180 / pi, std::acos(-way.z) * 180 / pi);
  };
  veil.bias = 1e-3;  // interpolation between the angles of the table: (5 deg)^2 / 8 and (2.5 deg)^2
                     // / 8
  return veil_plan(veil);
}

/// The table is interpolated linearly in C and gamma; the integrals over both angles have closed
/// forms. Mean of cos(C) over a half turn divided into steps, as a share of the exact one, and
/// integral of the polar part, as a share of I0 / 2.
double share_of_trapezoids(double step_deg) {
  const double d = step_deg * pi / 180;
  return 0.5 * d / std::tan(0.5 * d);
}
double polar_integral(double from_deg, double to_deg) {
  double sum = 0;
  for (double g = from_deg; g < to_deg; g += gamma_step) {
    const double a = g * pi / 180, b = (g + gamma_step) * pi / 180;
    const double slope = (std::cos(b) - std::cos(a)) / (b - a);
    // The integral of (cos a + slope (x - a)) sin x.
    sum +=
        std::cos(a) * std::cos(a) - std::cos(b) * std::cos(b) + slope * (std::sin(b) - std::sin(a));
  }
  return sum;
}

PreparedCase luminaire_plan(const PhotometricFile& file) {
  PreparedCase plan;
  SceneDescription& scene = plan.scene;
  const double flux_lm = 2 * pi * peak_cd * polar_integral(0, 90);
  plan.compute("flux of the file [lm]", flux_lm, file.flux_lm, 1e-6);
  plan.compute("share downwards", 1, file.down_share, 1e-6);
  plan.compute("I at C 30, gamma 40 [cd]", intensity(30, 40),
               file.web->intensity({std::sin(40 * pi / 180) * std::cos(pi / 6),
                                    std::sin(40 * pi / 180) * 0.5, -std::cos(40 * pi / 180)}),
               1e-6);
  add_places(plan, file);
  Emitter& e = add_point(scene, {0, 0, 0}, 1);
  e.distribution = Distribution::web;
  e.web = file.web;
  // A floor directly below the lamp, in two halves, receives everything except what leaves within
  // 1e-3 of the horizon, 1e-6 of it. Rays resolve the seam of its halves to a millionth of their
  // size.
  constexpr double below = 1e-2, wide = 10, edge = 1e-4;
  add_quad(scene, "towards C0", {0, -wide, -below}, {wide, 0, 0}, {0, 2 * wide, 0},
           add_grey(scene, 0));
  add_quad(scene, "away from C0", {-wide, -wide, -below}, {wide, 0, 0}, {0, 2 * wide, 0},
           add_grey(scene, 0));
  const double leaning = share_of_trapezoids(c_step) / (2 * pi);
  for (const auto& [half, share] :
       {std::pair("towards C0", 0.5 + leaning), {"away from C0", 0.5 - leaning}})
    plan.add(
        half, share, [half = half](const Traced& run) { return run.into(half); }, edge);
  return plan;
}

}  // namespace

void add_photometric_cases(Cases& cases) {
  cases.push_back({"photometry", "luminaire of an LDT file", "integral of its table",
                   [] { return luminaire_plan(ldt_file()); }});
  cases.push_back({"photometry", "luminaire of an IES file", "integral of its table",
                   [] { return luminaire_plan(ies_file()); }});
  cases.push_back({"photometry", "veil of a luminaire, LDT file",
                   "integral along the line of sight", [] { return luminaire_veil(ldt_file()); }});
  cases.push_back({"photometry", "veil of a luminaire, IES file",
                   "integral along the line of sight", [] { return luminaire_veil(ies_file()); }});
}

}  // namespace luxodus::light
