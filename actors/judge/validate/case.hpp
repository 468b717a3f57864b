// A case: a scene whose light is known from elsewhere, and the quantities that are compared. Cases
// of one kind are made by one file, cases_*.cpp; all_cases() is the table of them all. Plain
// values; any thread.
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

/// Of the first sign's white part, at the first eye.
inline Estimate first_view(const Traced& run, EyeQuantity quantity) {
  return run.value(run.blocks().views, 0, static_cast<uint32_t>(quantity));
}

/// What tracing estimates, and what it ought to be.
struct Quantity {
  std::string name;
  double reference = 0;
  std::function<Estimate(const Traced&)> read;
  /// Declared beforehand, in the reference's unit: of a mesh that stands for a round thing, of a
  /// source that stands off its wall, of the digits of a table.
  double bias = 0;
  /// About the most that all particles can bring, should each do so; 0: the power of the scene.
  double unit = 0;
  /// Equal to the reference within the bias, whatever chance does.
  bool certain = false;
};

/// What is computed without chance.
struct Computed {
  std::string name;
  double reference = 0;
  std::function<double(const DirectLightAt&)> value;
  double tolerance = 0;  // relative
};

/// A case made ready.
struct PreparedCase {
  SceneDescription scene;
  std::vector<BinSum> sums;
  std::vector<WeightedSum> weighted;
  std::vector<Quantity> quantities;  // none: nothing is traced
  std::vector<Computed> computed;
  int64_t quick_particles = 1 << 18;
  int64_t batch_particles = 4096;

  /// `bias` is relative to the reference.
  Quantity& add(std::string name, double reference, std::function<Estimate(const Traced&)> read,
                double bias = 0);
  void compute(std::string name, double reference, double value, double tolerance);
  /// Direct light in a scene that is compiled already [lx].
  void compute_direct(std::string name, double lux, const std::shared_ptr<const Traced>& lamp,
                      const glm::dvec3& point, const glm::dvec3& normal, double tolerance);
  /// No light leaves the scene.
  void add_closed();
  /// Few particles, on which nothing here depends, and so many paths from the eye for each of them
  /// to each part of the only sign.
  void look_rather(double paths_per_particle);
};

struct Case {
  std::string group;   // "stack"
  std::string name;    // unique: "stack 5 L1 lambert from top"
  std::string source;  // of the reference: a table, or the law
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
/// Those whose name holds the text, small and capital letters alike; all for "".
Cases cases_named(const std::string& text);

}  // namespace luxodus::light
