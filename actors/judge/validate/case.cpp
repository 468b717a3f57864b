#include "actors/judge/validate/case.hpp"

#include <algorithm>
#include <cctype>

namespace luxodus::light {

Quantity& PreparedCase::add(std::string name, double reference,
                            std::function<Estimate(const Traced&)> read, double bias) {
  quantities.push_back(
      {std::move(name), reference, std::move(read), bias * std::abs(reference), 0, false});
  return quantities.back();
}

void PreparedCase::compute(std::string name, double reference, double value, double tolerance) {
  computed.push_back(
      {std::move(name), reference, [value](const DirectLightAt&) { return value; }, tolerance});
}

void PreparedCase::compute_direct(std::string name, double lux,
                                  const std::shared_ptr<const Traced>& lamp,
                                  const glm::dvec3& point, const glm::dvec3& normal,
                                  double tolerance) {
  computed.push_back({std::move(name), lux,
                      [=](const DirectLightAt& direct_light) {
                        return lamp->direct_lx(point, normal, direct_light);
                      },
                      tolerance});
}

void PreparedCase::add_closed() {
  add("escaped", 0, [](const Traced& run) {
    double sum = 0;
    for (uint32_t side = 0; side < 6; ++side) sum += run.escaped(side).value;
    return Estimate{sum, 0};
  }).certain = true;
}

void PreparedCase::look_rather(double paths_per_particle) {
  quick_particles = 1 << 13;
  // A share of 1 is a tenth of a path for each particle, divided among the three parts of a sign.
  scene.run.eye_path_factor = 30 * paths_per_particle;
}

Cases all_cases() {
  Cases cases;
  add_stack_cases(cases);
  add_half_space_cases(cases);
  add_cube_cases(cases);
  add_enclosure_cases(cases);
  add_gas_cases(cases);
  add_furnace_cases(cases);
  add_smoke_cases(cases);
  add_fog_cases(cases);
  add_lamp_cases(cases);
  add_room_lighting_cases(cases);
  add_photometric_cases(cases);
  add_sight_cases(cases);
  add_veil_cases(cases);
  add_glossy_cases(cases);
  return cases;
}

Cases cases_named(const std::string& text) {
  const auto lower = [](std::string word) {
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return word;
  };
  Cases cases = all_cases();
  std::erase_if(
      cases, [&](const Case& c) { return lower(c.name).find(lower(text)) == std::string::npos; });
  return cases;
}

}  // namespace luxodus::light
