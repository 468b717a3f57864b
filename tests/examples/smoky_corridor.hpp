// Pieces of corridors in smoke in which people walk, for tests that run the program.
#pragma once

#include <fmt/format.h>

#include <string>

#include "tests/examples/program_kit.hpp"

namespace luxodus::program {

/// A downlight of 200 lm in an emergency. `position` in the scene file's syntax.
inline std::string lamp_text(const std::string& position) {
  return R"(
[[luminaire_type]]
name = "lamp"
file = "lamp.ldt"
emergency = "non-maintained"
emergency_flux = 200
emergency_flux_is = "initial"
maintenance_factor = 0.8
end_of_duration_factor = 0.7

[[luminaire]]
name = "lamp"
type = "lamp"
position = )" +
         position + "\n";
}

inline std::string smoke_text(double extinction_per_m) {
  return fmt::format(
      "\n[[medium]]\nname = \"smoke\"\nkind = \"homogeneous\"\nextinction = {}\nalbedo = 0.3\n"
      "phase = \"hg\"\ng = 0.6\nangstrom = 0\n",
      extinction_per_m);
}

/// Luminances of a sign in cd/m2; its white has 500 on mains.
struct SignLight {
  double mains_green = 100, emergency_white = 500, emergency_green = 100;
};

/// A sign on a west wall. `position` in the scene file's syntax.
inline std::string sign_text(const std::string& name, const std::string& position,
                             const SignLight& light = {}) {
  return fmt::format(
      "\n[[sign]]\nname = \"{}\"\nfile = \"exit.svg\"\nsmallest_detail = 0.016\nwidth = 0.4\n"
      "height = 0.2\nposition = {}\nfacing = [1, 0, 0]\nmains_white = 500\nmains_green = {}\n"
      "emergency_white = {}\nemergency_green = {}\n",
      name, position, light.mains_green, light.emergency_white, light.emergency_green);
}

/// Copies the files that these texts name.
inline void copy_lamp_and_sign(const TemporaryFolder& folder) {
  const fs::path library = fs::path(LUX_SOURCE_DIR) / "scenes/library";
  fs::copy_file(library / "luminaires/emergency_downlight.ldt", folder / "lamp.ldt");
  fs::copy_file(library / "signs/exit_straight.svg", folder / "exit.svg");
}

}  // namespace luxodus::program
