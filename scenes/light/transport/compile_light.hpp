// Part of compile: which emitters and signs shine in a scenario, in what spectrum, in which source
// group.
#pragma once

#include <string>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

/// One source of light as the scenario has it: what it is, its power, its spectrum.
struct ActiveSource {
  const Emitter* emitter = nullptr;
  const Medium* medium = nullptr;
  const Sign* sign = nullptr;
  uint32_t description_index = 0;
  bool sign_back = false;
  SignColour colour = SignColour::white;
  double lumens = 0;
  double watts = 0;  // within 380..780 nm
  Spectrum shape;    // integral 1
  std::string name, group;
  SourcePlace place;
};

double factor_of(const std::vector<Scenario::Factor>& factors, const std::string& name,
                 double other);

/// What multiplies the extinction of the medium of this name; 0: it is not there.
double extinction_factor(const Scenario& scenario, const std::string& medium);

/// How much of a medium a scenario leaves: as above, but the factor of all smoke leaves flames
/// alone, and no data sets that glow, which are smoke, too.
double factor_of_medium(const Scenario& scenario, const Medium& medium);

/// Luminance [cd/m2] along the normal of a colour of a sign in this scenario.
double scenario_luminance(const Sign& sign, SignColour colour, const Scenario& scenario);

/// Area [m2] of one colour on one face.
double sign_colour_area_m2(const Sign& sign, SignColour colour);

/// Everything that emits in this scenario; sources of zero flux are left out.
std::vector<ActiveSource> active_sources(const SceneDescription& scene, const Scenario& scenario);

/// Emitter with its shape, distribution and per-band power; corners and positions in local
/// coordinates. A mesh whose triangles are too small to have a normal has no area.
CompiledEmitter compile_emitter(const ActiveSource& source, const CompiledScene& scene);

/// Source groups, their band shares and cumulative tables, from scene.emitters.
/// `group_names[i]` is the group of emitter i.
void compile_groups(CompiledScene& scene, const std::vector<std::string>& group_names);

}  // namespace luxodus
