// An experiment with people, as data: who saw what, and the scene in which the program is asked the
// same. Experiments of one kind are in one file, experiments_*.cpp; all_experiments() lists all.
// How to add one: README.md of this folder. Plain values; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "actors/judge/validate/agreement.hpp"

namespace luxodus::light {

// ---- the scene ---------------------------------------------------------------------------------

/// A room around the line of sight, which runs along its axis from the eye to the target at its far
/// wall. Without a width there is no room.
struct ExperimentRoom {
  double width_m = 0, height_m = 0;
  double length_m = 0;  // from the near wall to the target; 0: the eye is at the near wall
  double walls = 0;     // reflectance
  double far_wall = 0;  // reflectance of the wall behind the target
};

/// Light of lamps at the ceiling that neither the eye nor the target faces.
struct ExperimentLamps {
  double lux = 0;         // horizontal illuminance; 0: dark
  bool on_floor = false;  // on the floor, half-way along the room; else in the middle of the room
  bool in_smoke = false;  // with the smoke; else in clear air
};

struct ExperimentSmoke {
  double extinction = 0;  // [1/m]
  double albedo = 1;
  double g = 0.6;  // of Henyey and Greenstein's phase function
  /// Extinction falls with this power of the wavelength; it is stated at 633 nm.
  double angstrom = 0;
};

enum class TargetShape { disc, rectangle, landolt_ring, text };

struct ExperimentTarget {
  TargetShape shape = TargetShape::disc;
  double width_m = 0;   // diameter; of text the height of its letters
  double height_m = 0;  // of a rectangle; 0: as wide
  double stroke_m = 0;  // of text
  std::string text = {};
  double detail_m = 0;  // what must be seen; 0: the disc, the rectangle, the ring's gap, the stroke
  double luminance_cd_m2 = 0;  // emitted by the target, and by the ground around it
  double ground_cd_m2 = 0;
  double light_nm = 0;  // wavelength of the emitted light, of one colour; 0: white
  double reflectance = 0;
  double ground_reflectance = 0;
};

/// Light that the eyes came from. Without a time they are adapted to what they look at.
struct LightBefore {
  double luminance_cd_m2 = 0;         // mean of the view
  std::optional<double> seconds_ago;  // since it went out
};

struct ExperimentScene {
  double distance_m = 0;
  ExperimentTarget target;
  ExperimentRoom room = {};
  ExperimentLamps lamps = {};
  ExperimentSmoke smoke = {};
  double age_years = 23;
  LightBefore before = {};
};

// ---- what is found in it -----------------------------------------------------------------------

/// What is varied until the target is just seen, or just read. `nothing`: the level of the scene as
/// it is.
enum class Varied { extinction, distance, contrast, nothing };

/// One threshold. It is an optical depth (extinction times distance) in smoke, and else what is
/// varied: a distance [m], a contrast.
struct Trial {
  std::string name;
  ExperimentScene scene;
  Varied varied = Varied::extinction;
  Interval searched = {0.5, 16};
  std::optional<Interval> observed = {};
  std::string scatter = {};  // of the observed value, as the source states it
  bool of_reading = false;   // people read the detail; else they saw the target
};

enum class Rule {
  seen,         // rule S of each trial
  read,         // rule R of each trial
  acuity,       // rule A of each trial
  value,        // each trial's threshold lies in the interval
  slope,        // of the thresholds over the logarithm of the target's luminance
  quotient,     // first trial's over the second's
  difference,   // first trial's minus the second's
  beyond,       // rule O: the first trial's threshold lies beyond the second's
  much_beyond,  // rule O: and they are not about equal
  about_equal,  // rule O
};

/// What is tested of the trials.
struct Claim {
  Rule rule;
  std::vector<size_t> trials;
  std::string says;
  Interval allowed = {};  // of value, slope, quotient, difference
  double level = 1;       // of the thresholds that are compared: 1 or 7
};

struct Experiment {
  std::string id;  // "T8"
  std::string title;
  std::string source;                // people, year, place of publication
  std::string read;                  // how the source was read
  std::vector<std::string> assumed;  // what the source leaves open, and what is taken here
  std::string beer = {};             // what of it is Beer's law alone; "": nothing
  std::vector<Trial> trials;
  std::vector<Claim> claims;
};

using Experiments = std::vector<Experiment>;

/// Jin's chamber.
void add_jin_experiments(Experiments& all);
/// Signs in smoke, by others.
void add_sign_experiments(Experiments& all);
/// Acuity and signs in clear air.
void add_clear_air_experiments(Experiments& all);

Experiments all_experiments();
/// The experiment with this id; if there is none, those whose id or title contains the text,
/// ignoring case; all for "".
Experiments experiments_named(const std::string& text);

}  // namespace luxodus::light
