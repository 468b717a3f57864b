// A case: a scene whose light is known from elsewhere, and the quantities to compare. Cases of one
// kind are in one file, cases_*.cpp; all_cases() lists all. Plain values; any thread.
#pragma once

#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "actors/judge/validate/traced.hpp"

namespace luxodus::light {

inline constexpr double pi = std::numbers::pi;
/// The reference table of closed forms, each with its id.
inline constexpr const char* exact_table = "misc_exact.csv";

/// For the first sign's white part, at the first eye.
inline Estimate first_view(const Traced& run, EyeQuantity quantity) {
  return run.value(run.blocks().views, 0, static_cast<uint32_t>(quantity));
}

/// An estimate of tracing, and its reference.
struct Quantity {
  std::string name;
  double reference = 0;
  std::function<Estimate(const Traced&)> read;
  /// Declared in advance, in the reference's unit: of a mesh that replaces a round body, of a
  /// source in front of its wall, of the digits of a table.
  double bias = 0;
  /// About the largest possible total of all particles; 0: the power of the scene.
  double unit = 0;
  /// Equal to the reference within the bias, without statistical error.
  bool certain = false;
};

/// A quantity that is computed deterministically.
struct Computed {
  std::string name;
  double reference = 0;
  std::function<double(const DirectLightAt&)> value;
  double tolerance = 0;  // relative
};

/// A case ready to be traced.
struct PreparedCase {
  SceneDescription scene;
  std::vector<BinSum> sums;
  std::vector<WeightedSum> weighted;
  std::vector<Quantity> quantities;  // empty: nothing is traced
  std::vector<Computed> computed;
  int64_t quick_particles = 1 << 18;
  int64_t batch_particles = 4096;

  /// `bias` is relative to the reference.
  Quantity& add(std::string name, double reference, std::function<Estimate(const Traced&)> read,
                double bias = 0);
  void compute(std::string name, double reference, double value, double tolerance);
  /// Direct light in a compiled scene [lx].
  void compute_direct(std::string name, double lux, const std::shared_ptr<const Traced>& lamp,
                      const glm::dvec3& point, const glm::dvec3& normal, double tolerance);
  /// No light leaves the scene.
  void add_closed();
  /// Few particles, on which no quantity depends, and this many paths from the eye for each of them
  /// to each part of the only sign.
  void look_rather(double paths_per_particle);
};

struct Case {
  std::string group;   // "stack"
  std::string name;    // unique: "stack 5 L1 lambert from top"
  std::string source;  // source of the reference: a table, or the law
  std::function<PreparedCase()> plan;
};

using Cases = std::vector<Case>;

void add_stack_cases(Cases& cases);
void add_half_space_cases(Cases& cases);
void add_cube_cases(Cases& cases);
void add_enclosure_cases(Cases& cases);
void add_gas_cases(Cases& cases);
void add_furnace_cases(Cases& cases);
void add_smoke_cases(Cases& cases);
void add_fog_cases(Cases& cases);
void add_lamp_cases(Cases& cases);
void add_room_lighting_cases(Cases& cases);
void add_photometric_cases(Cases& cases);
void add_sight_cases(Cases& cases);
void add_veil_cases(Cases& cases);
void add_glossy_cases(Cases& cases);

/// Every case that has a reference.
Cases all_cases();
/// Cases whose name contains the text, ignoring case; all for "".
Cases cases_named(const std::string& text);

}  // namespace luxodus::light
