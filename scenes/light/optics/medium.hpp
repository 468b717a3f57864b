// Participating media as a scene describes them: kind, optical properties and place. Plain values
// in SI units; any thread. Media overlap and their extinctions add. media_set.hpp compiles them for
// tracing.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/core/result.hpp"
#include "scenes/light/geometry/frame.hpp"
#include "scenes/light/geometry/mesh.hpp"
#include "scenes/light/optics/spectrum.hpp"

namespace luxodus {

enum class PhaseKind { isotropic, henyey_greenstein, rayleigh, tabulated };

struct Phase {
  PhaseKind kind = PhaseKind::isotropic;
  double g = 0;
  std::vector<double> table_cos;    // ascending, first -1, last 1
  std::vector<double> table_value;  // relative density per solid angle, >= 0
};

/// sigma_t at `wavelength_nm`; at other wavelengths w, times (wavelength_nm / w)^angstrom, or by a
/// table.
struct Extinction {
  double sigma_t = 0;  // [1/m]
  double wavelength_nm = 633;
  double angstrom = 0;
  std::optional<Spectrum> table;  // [1/m]; replaces the law above

  Spectrum spectrum() const;
};

struct SmokeOptics {
  Extinction extinction;
  Spectrum albedo = Spectrum::constant(0);  // [0, 1]
  Phase phase;
};

/// Region of a medium: a z range and a horizontal polygon, both optional.
struct Footprint {
  std::vector<glm::dvec2> polygon;  // empty: everywhere; simple, either orientation
  double z_low = -1e30;
  double z_high = 1e30;
};

enum class MediumKind { homogeneous, layered, bounded, data_set };

struct Layer {
  double z_low = 0;  // [m]; layers do not overlap, ascending
  double z_high = 0;
  SmokeOptics optics;
};

/// x^T A x + b.x + c <= 0 in local coordinates, clipped by half spaces n.x <= d.
struct Quadric {
  glm::dmat3 a{0};
  glm::dvec3 b{0};
  double c = 0;
  struct Clip {
    glm::dvec3 normal;
    double offset;
  };
  std::vector<Clip> clips;
};

/// 3-D arrays in a box, x fastest. Each array is empty (the medium's constant holds) or has
/// nx*ny*nz values.
struct DataSet {
  int nx = 0, ny = 0, nz = 0;
  glm::dvec3 extent{0};           // box [0, extent] in local coordinates [m]
  std::vector<float> extinction;  // [1/m] at extinction wavelength
  std::vector<float> albedo;
  std::vector<float> emission;  // relative strength per volume
  bool interpolate_emission = false;
};

/// Emission of a medium: total radiant power, with the spectrum and the visible share of it.
struct MediumEmission {
  double power_w = 0;           // radiant, over all wavelengths
  double visible_fraction = 1;  // share within 380..780 nm
  Spectrum spectrum = equal_energy_shape();
  std::string group;
  std::string circuit;
};

/// Facts about smoke from a fire simulation, at one time.
struct FireSimulation {
  std::string file;            // its index, as the scene writes it
  double time_s = 0;           // time of the frame used
  std::string source;          // quantity that the extinction was computed from, for people
  bool glows = false;          // the emission of its flames is in the scene
  Frame frame;                 // frame of the simulation's coordinates
  std::vector<Bounds> meshes;  // in those coordinates [m]; outside of them nothing is known
  double depth_error = 0;      // largest relative error of optical depths from this source
  std::string index = {};      // path of the index file; "" in a pack
};

struct Medium {
  std::string name;
  SourcePlace place;
  MediumKind kind = MediumKind::homogeneous;
  SmokeOptics optics;         // homogeneous, bounded; phase and wavelength law of a data set
  std::vector<Layer> layers;  // layered
  Footprint footprint;        // homogeneous, layered
  Frame frame;                // bounded, data_set
  Quadric quadric;            // bounded
  Bounds local_bounds;        // bounded: a box that holds the body, in local coordinates
  DataSet data;               // data_set
  std::optional<MediumEmission> emission;  // bounded, data_set
  /// Set for the first of the data sets made from a simulation; the others have its name.
  std::optional<FireSimulation> simulation = std::nullopt;
};

}  // namespace luxodus
