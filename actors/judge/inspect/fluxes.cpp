// Inspects the numbers of luminaires in the scene and in photometric files: fluxes of the wrong
// operation, factors that state a loss or ignore ageing, openings and fluxes in another unit. A
// finding shared by several luminaires is reported for the first, with the number of the others.
#include <algorithm>

#include "actors/judge/inspect/site.hpp"

namespace luxodus {

namespace {

/// Ratio of the emergency flux to the flux of the file: more is a percentage taken for a share,
/// less may be a luminaire of the same make with more lamps.
constexpr double max_of_file = 4;
/// Tolerance for rounding in files and designs.
constexpr double rounding_share = 0.02;
/// On its own battery a luminaire has 5 to 30 % of its mains flux.
constexpr double mains_like_share = 0.9;
/// Emergency luminaires of corridors and rooms have 30 to 1000 lm; those of high halls more.
constexpr double strong_emergency_lm = 2000, strongest_emergency_lm = 3000;
constexpr double mains_like_lm = 1500;
/// A smaller flux is a share written as a flux.
constexpr double min_emergency_lm = 1;
/// Factors for the remaining light: lower values usually state the loss instead.
constexpr double low_maintenance = 0.4, low_end_of_duration = 0.3;
/// Limits on luminous openings: outside, an LDT file is in metres instead of millimetres, or an IES
/// file in feet.
constexpr double min_opening_m = 0.003, max_opening_m = 3.5;
/// Limits on the flux of a luminaire's file.
constexpr double min_file_lm = 5, max_file_lm = 2e5;

double largest_of(const glm::dvec3& v) {
  return std::max({v.x, v.y, v.z});
}

std::string lit_thing(const Emitter& e) {
  return (e.web ? "luminaire \"" : "emitter \"") + e.name + "\"";
}

/// Findings that luminaires share, reported for the first.
class SharedSlips {
 public:
  void add(Severity severity, const char* kind, const Emitter& e, std::string what) {
    for (Slip& slip : slips_)
      if (slip.severity == severity && slip.what == what) {
        ++slip.others;
        return;
      }
    slips_.push_back({severity, kind, &e, std::move(what), 0});
  }

  void tell(Findings& out) const {
    for (const Slip& slip : slips_) {
      std::string text = lit_thing(*slip.first) + " " + slip.what;
      if (slip.others > 0)
        text += fmt::format(" (and {} other{})", slip.others, slip.others == 1 ? "" : "s");
      out.push_back({slip.severity, slip.kind, {slip.first->place, std::move(text)}});
    }
  }

 private:
  struct Slip {
    Severity severity;
    const char* kind;
    const Emitter* first;
    std::string what;
    size_t others;
  };
  std::vector<Slip> slips_;
};

/// Flux of a new luminaire on emergency supply [lm, or W if radiometric].
double new_emergency_flux(const Emitter& e) {
  return e.emergency_ageing > 0 ? e.emergency_flux / e.emergency_ageing : e.emergency_flux;
}

void tell_dark(const Emitter& e, SharedSlips& slips) {
  if (e.emergency_flux > 0) return;
  if (e.maintained)
    slips.add(
        Severity::warning, "flux", e,
        "is an emergency luminaire whose emergency flux is 0: it is dark when the mains fail");
  else if (!(e.mains_flux > 0))
    slips.add(Severity::warning, "flux", e,
              "gives no light in any operation: its flux, or a factor of it, is 0");
}

void tell_emergency_flux(const Emitter& e, SharedSlips& slips) {
  if (e.radiometric || !(e.emergency_flux > 0)) return;
  const double lumens = new_emergency_flux(e), rated = e.web ? e.web->flux_lm() : 0;
  const double share = rated > 0 ? lumens / rated : 0;
  if (lumens < min_emergency_lm)
    slips.add(Severity::warning, "flux", e,
              fmt::format("gives {:.3g} lm in emergency operation: emergency_flux is in lm, and "
                          "emergency_factor is the share of the file's flux",
                          lumens));
  if (share > max_of_file)
    slips.add(Severity::warning, "flux", e,
              fmt::format("gives {:.3g} times the {:.4g} lm of its file in emergency operation: "
                          "emergency_factor is a share, 0.15 for 15 %, and emergency_flux is in lm",
                          share, rated));
  else if (share > 1 + rounding_share)
    slips.add(Severity::note, "flux", e,
              fmt::format("gives {:.4g} lm in emergency operation, and its file {:.4g} lm: is the "
                          "file that of this luminaire?",
                          lumens, rated));
  if (e.maintained && share >= mains_like_share && share <= 1 + rounding_share)
    slips.add(lumens >= mains_like_lm ? Severity::warning : Severity::note, "flux", e,
              fmt::format("gives all of its mains flux, {:.4g} lm, in emergency operation, too: "
                          "right on a central battery; on a battery of its own a luminaire keeps "
                          "5 to 30 % (emergency_factor = 0.15)",
                          lumens));
  else if ((share >= mains_like_share && lumens >= strong_emergency_lm) ||
           (rated == 0 && lumens >= strongest_emergency_lm))
    slips.add(Severity::warning, "flux", e,
              fmt::format("gives {:.4g} lm in emergency operation: is that the flux of its mains "
                          "operation? Emergency luminaires mostly give 30 to 1000 lm",
                          lumens));
}

/// What the emergency flux states: the rated flux of EN 60598-2-22 is the least over the duration
/// already, so that a factor for its end counts that twice.
void tell_flux_state(const Emitter& e, SharedSlips& slips) {
  if (e.emergency_flux_is == EmergencyFluxIs::unstated)
    slips.add(Severity::warning, "flux", e,
              "does not say what its emergency flux is: with emergency_flux_is = \"rated\" (EN "
              "60598-2-22: the least until the end of the duration) no end_of_duration_factor "
              "belongs to it, which would count that twice; with \"initial\" the factor holds");
  else if (e.emergency_flux_is == EmergencyFluxIs::initial && e.end_of_duration_factor == 1)
    slips.add(Severity::note, "flux", e,
              "has an end_of_duration_factor of 1: its light does not fall until the battery is "
              "empty, as on a central supply");
  else if (!e.initial_flux_known)
    slips.add(Severity::note, "flux", e,
              "has a rated emergency flux and no initial_flux: how far it glares (E8), and veils "
              "signs, when it is new, is not assessed");
}

void tell_factors(const Emitter& e, SharedSlips& slips) {
  const bool emergency = e.emergency_flux > 0;
  if (e.maintenance_factor < low_maintenance)
    slips.add(Severity::warning, "flux", e,
              fmt::format("has a maintenance_factor of {:.3g}: it is the share that is left of the "
                          "light, not the one that is lost (0.8 where 20 % are lost)",
                          e.maintenance_factor));
  if (emergency && e.end_of_duration_factor < low_end_of_duration)
    slips.add(Severity::warning, "flux", e,
              fmt::format("has an end_of_duration_factor of {:.3g}: it is the share that is left "
                          "at the end of the rated duration, not the one that is lost",
                          e.end_of_duration_factor));
  if (emergency && e.maintenance_factor == 1)
    slips.add(Severity::warning, "flux", e,
              "has a maintenance_factor of 1, as if it never aged nor got dirty: the codes' "
              "limits hold at the end of its life, 0.8 is usual");
  if (emergency) tell_flux_state(e, slips);
  const double rated = e.web && !e.radiometric ? e.web->flux_lm() : 0;
  if (rated > 0 && e.mains_flux / e.maintenance_factor > rated * (1 + rounding_share))
    slips.add(Severity::warning, "flux", e,
              fmt::format("gives {:.3g} times the {:.4g} lm of its file in mains operation: "
                          "mains_factor is a share, 0.5 for 50 %",
                          e.mains_flux / e.maintenance_factor / rated, rated));
}

void tell_file(const Emitter& e, SharedSlips& slips) {
  if (!e.web) return;
  const double opening_m = largest_of(e.opening_m), rated = e.web->flux_lm();
  if (opening_m == 0)
    slips.add(Severity::note, "file", e,
              "has a file that states no luminous opening: it shines from a point, and no place is "
              "told to be too near for the file");
  else if (opening_m < min_opening_m)
    slips.add(Severity::warning, "file", e,
              fmt::format("has a luminous opening of {:.3g} mm by its file \"{}\": EULUMDAT states "
                          "millimetres, IES metres or feet; is the file's unit wrong?",
                          1000 * opening_m, e.file));
  else if (opening_m > max_opening_m)
    slips.add(Severity::warning, "file", e,
              fmt::format("has a luminous opening of {:.3g} m by its file \"{}\": EULUMDAT states "
                          "millimetres, IES metres or feet; is the file's unit wrong?",
                          opening_m, e.file));
  if (rated < min_file_lm || rated > max_file_lm)
    slips.add(Severity::warning, "file", e,
              fmt::format("has a file, \"{}\", whose intensities add up to {:.3g} lm: is a "
                          "conversion factor or multiplier of it wrong?",
                          e.file, rated));
}

}  // namespace

void inspect_fluxes(const SceneDescription& scene, Findings& out) {
  SharedSlips slips;
  for (const Emitter& e : scene.emitters) {
    tell_dark(e, slips);
    tell_emergency_flux(e, slips);
    tell_factors(e, slips);
    tell_file(e, slips);
  }
  slips.tell(out);
}

}  // namespace luxodus
