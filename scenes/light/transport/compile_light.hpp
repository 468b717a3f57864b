// Part of compile: which emitters and signs emit in a scenario, with which spectrum, and in which
// source group. Pure but for compile_groups; one thread.
#pragma once

#include <string>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

/// One active light source of the scenario: its origin, power and spectrum.
struct ActiveSource {
  const Emitter* emitter = nullptr;
  const Medium* medium = nullptr;
  const Sign* sign = nullptr;
  uint32_t description_index = 0;
  bool sign_back = false;
  ColourIndex colour = 0;
  double lumens = 0;
  double watts = 0;  // within 380..780 nm
  Spectrum shape;    // integral 1
  std::string name, group;
  SourcePlace place;
};

double factor_of(const std::vector<Scenario::Factor>& factors, const std::string& name,
                 double other);

/// Factor of the scenario on the extinction of the medium of this name; 0: the medium is absent.
double extinction_factor(const Scenario& scenario, const std::string& medium);

/// Factor of the scenario on a whole medium: as above, except that the factor for all smoke does
/// not apply to flames; it does apply to data sets that glow, since they are smoke, too.
double factor_of_medium(const Scenario& scenario, const Medium& medium);

/// The share of the light of a medium's flame that the scenario leaves; 0 without a flame, or where
/// the medium is absent.
double flame_share(const Scenario& scenario, const Medium& medium);

/// Luminance [cd/m2] of a sign's colour along the normal in this scenario.
double scenario_luminance(const Sign& sign, ColourIndex colour, const Scenario& scenario);

/// Area [m2] of one colour on one face.
double sign_colour_area_m2(const Sign& sign, ColourIndex colour);

/// Everything that emits in this scenario; sources of zero flux are left out.
std::vector<ActiveSource> active_sources(const SceneDescription& scene, const Scenario& scenario);

/// Emitter with its shape, distribution and per-band power; corners and positions in local
/// coordinates. A mesh whose triangles are too small to have a normal has no area.
CompiledEmitter compile_emitter(const ActiveSource& source, const CompiledScene& scene);

/// Source groups, their band shares and cumulative tables, from scene.emitters.
/// `group_names[i]` is the group of emitter i.
void compile_groups(CompiledScene& scene, const std::vector<std::string>& group_names);

}  // namespace luxodus
