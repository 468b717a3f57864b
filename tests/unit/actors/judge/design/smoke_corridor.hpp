// A corridor in smoke with layouts of luminaires, for tests of the judgement in smoke.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "actors/judge/design/smoke_stage.hpp"
#include "tests/kit/described.hpp"
#include "tests/kit/room_texts.hpp"

namespace luxodus::test {

inline const std::string corridor_room = R"(
[[object]]
name = "corridor"
shape = "room"
low = [0, -2, 0]
high = [16, 2, 3]
material = "grey50"

[assessment]
irritant_smoke = false
spacing_m = 2
eye_heights_m = [1.65]
rules = ["en1838-2013"]

[[route]]
name = "way"
path = [[1, 0, 0], [15, 0, 0]]
width = 1.6

[[scenario]]
name = "fire"
operation = "emergency"

)";
/// A sign at the end of the corridor.
inline const std::string corridor_sign =
    exit_sign_at("[15.95, 0, 2.2]") + "lighting = \"internal\"\n";

/// The corridor with a sign that leads along the route; `smoke`: tables of media and of time.
inline std::string corridor_with(const std::string& smoke) {
  return corridor_room + corridor_sign + "[[sign.leads_to]]\nroute = \"way\"\narrow = \"ahead\"\n" +
         smoke;
}

inline const std::string even_smoke =
    "[[medium]]\nname = \"smoke\"\nkind = \"homogeneous\"\nextinction = 0.4\nalbedo = 0.6\n";

/// An ageing luminaire of 200 lm under the ceiling, as in a layout.
inline Emitter corridor_luminaire(const std::string& name, double x) {
  static const auto scene = described_text(corridor_with(even_smoke) + R"(
[[emitter]]
name = "a"
shape = "disc"
diameter = 0.1
position = [1, 0, 2.97]
flux_lm = 200
emergency = "non-maintained"
emergency_flux = 200
maintenance_factor = 0.8
end_of_duration_factor = 0.7
)");
  Emitter out = scene->emitters.front();
  out.name = name;
  out.frame.origin.x = x;
  return out;
}

/// A layout of the corridor with luminaires at these positions along it.
inline JudgedLayout corridor_layout(const std::shared_ptr<const SceneDescription>& scene,
                                    const std::string& name, const std::vector<double>& places) {
  JudgedLayout out;
  out.name = name;
  out.placed = places.size();
  out.objective = static_cast<double>(places.size());
  auto variant = std::make_shared<SceneDescription>(*scene);
  for (const double x : places) {
    PlacedLuminaire one;
    one.name = "L" + std::to_string(out.layout.luminaires.size() + 1);
    one.candidate.type = 0;
    one.candidate.position = {x, 0, 2.97};
    variant->emitters.push_back(corridor_luminaire(one.name, x));
    out.layout.luminaires.push_back(one);
  }
  out.layout.variant = variant;
  return out;
}

}  // namespace luxodus::test
