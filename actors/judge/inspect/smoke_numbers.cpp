// Inspects the numbers of smoke, as stated and as scaled by scenarios: extinctions and optics that
// no smoke in a building has, and settings that contradict it.
#include <algorithm>
#include <cmath>

#include "actors/judge/inspect/site.hpp"
#include "scenes/light/transport/compile_light.hpp"

namespace luxodus {

namespace {

/// Smoke that people still walk through has 0.05 to 3 /m, that in a fire's own room about 10 /m.
constexpr double thickest = 20, thinnest = 5e-4;
/// People do not walk through denser smoke.
constexpr double impassable = 5;
/// Limit in a cell of a fire simulation, near the fire.
constexpr double thickest_cell = 200;
/// Soot of flaming fires absorbs: its albedo is 0.15 to 0.3, that of white smoke up to 0.99.
constexpr double flaming_albedo = 0.6, min_albedo = 0.05, max_albedo = 0.995;
/// Mean cosine of smoke: 0.5 to 0.8.
constexpr double max_g = 0.95;
/// Extinction follows wavelength^-1 for soot, up to ^-3.5 for brown smoke.
constexpr double max_angstrom = 3.5, min_nm = 350, max_nm = 1100;

double albedo_of(const SmokeOptics& optics) {
  return optics.albedo.integral_with(cie_y()) / cie_y().integral();
}

/// Flaming fires' soot: extinction follows 1/wavelength.
bool is_flaming(const SmokeOptics& optics) {
  return !optics.extinction.table && optics.extinction.angstrom == 1;
}

/// Inspects a layer of a medium, or all of it.
class SmokePart {
 public:
  SmokePart(const SceneDescription& scene, const Medium& medium, const SmokeOptics& optics,
            std::string name, Findings& out)
      : scene_(scene), medium_(medium), optics_(optics), name_(std::move(name)), out_(out) {}

  void inspect() {
    if (!(optics_.extinction.sigma_t > 0)) return;
    tell_extinction();
    if (!medium_.emission) inspect_scattering();
  }

  /// What a data set states beside the extinctions of its cells.
  void inspect_scattering() {
    if (medium_.data.albedo.empty()) tell_albedo();
    tell_phase();
    tell_spectrum();
  }

 private:
  void tell(std::string what) {
    out_.push_back({judges_people(scene_) ? Severity::warning : Severity::note,
                    "smoke optics",
                    {medium_.place, name_ + " " + std::move(what)}});
  }

  void tell_extinction() {
    const double sigma = optics_.extinction.sigma_t;
    double factor = 0;
    for (const Scenario& s : scene_.scenarios)
      factor = std::max(factor, factor_of_medium(s, medium_));
    if (scene_.scenarios.empty()) factor = 1;
    const std::string times =
        factor != 1 && factor > 0
            ? fmt::format(" with the largest factor of a scenario, {:g},", factor)
            : "";
    if (sigma * factor > thickest)
      tell(
          fmt::format("has{} an extinction of {:.4g} /m, which leaves {:.1g} of the light after a "
                      "metre: smoke in buildings has 0.05 to 10 /m. Is it in 1/km, or its soot in "
                      "g/m3 or mg/m3 instead of kg/m3?",
                      times, sigma * factor, std::exp(-std::min(700.0, sigma * factor))));
    else if (sigma * factor > impassable && !medium_.emission)
      out_.push_back({Severity::note,
                      "smoke optics",
                      {medium_.place,
                       name_ + fmt::format(" has{} an extinction of {:.4g} /m, in which a lit sign "
                                           "is seen for {:.2g} m (Jin, 8/K): is it a visibility "
                                           "in metres?",
                                           times, sigma * factor, 8 / (sigma * factor))}});
    else if (factor > 0 && sigma * factor < thinnest)
      tell(
          fmt::format("has{} an extinction of {:.2g} /m, which takes {:.2g} % of the light in a "
                      "metre: smoke in buildings has 0.05 to 10 /m. Is it in 1/mm, or a share "
                      "taken for a percentage?",
                      times, sigma * factor, 100 * sigma * factor));
  }

  void tell_albedo() {
    const double albedo = albedo_of(optics_);
    if (albedo >= max_albedo)
      tell(
          fmt::format("has an albedo of {:.3g}: it absorbs nothing, as fog does; soot of flaming "
                      "fires has 0.15 to 0.3, white smoke at most 0.99",
                      albedo));
    else if (albedo < min_albedo)
      tell(
          fmt::format("has an albedo of {:.3g}: it scatters nothing, so that no light veils what "
                      "is behind it and signs seem more legible than they are; soot has 0.15 to "
                      "0.3",
                      albedo));
    else if (is_flaming(optics_) && albedo > flaming_albedo)
      tell(
          fmt::format("is said to be of a flaming fire and has an albedo of {:.3g}: its soot has "
                      "0.15 to 0.3, smouldering fires have more",
                      albedo));
  }

  void tell_spectrum() {
    const Extinction& e = optics_.extinction;
    if (e.table) return;
    if (e.angstrom > max_angstrom || e.angstrom < 0)
      tell(
          fmt::format("has an Angstrom exponent of {:.3g}: soot has 1, droplets of smouldering "
                      "fires 0 to 3",
                      e.angstrom));
    if (e.angstrom != 0 && (e.wavelength_nm > max_nm || e.wavelength_nm < min_nm))
      tell(
          fmt::format("states its extinction at {:.4g} nm, from where it is carried to visible "
                      "light by a power of the wavelength: meters of smoke use 450 to 1000 nm",
                      e.wavelength_nm));
  }

  void tell_phase() {
    if (optics_.phase.kind == PhaseKind::rayleigh)
      tell(
          "scatters as Rayleigh has it, as particles far smaller than a wavelength do: those of "
          "smoke are not (phase = \"hg\", g = 0.6)");
    if (optics_.phase.kind != PhaseKind::henyey_greenstein) return;
    const double g = optics_.phase.g;
    if (g < 0)
      tell(
          fmt::format("has g = {:.3g}: it would scatter back more than on, as no smoke does; "
                      "smoke has 0.5 to 0.8",
                      g));
    else if (g > max_g)
      tell(
          fmt::format("has g = {:.3g}: nearly all that it scatters goes straight on, as if it "
                      "were not scattered; smoke has 0.5 to 0.8",
                      g));
  }

  const SceneDescription& scene_;
  const Medium& medium_;
  const SmokeOptics& optics_;
  std::string name_;
  Findings& out_;
};

bool is_smoke(const Medium& m) {
  return !m.emission || m.kind == MediumKind::data_set;
}

bool smokes(const SceneDescription& scene, const Scenario& scenario) {
  return std::any_of(scene.media.begin(), scene.media.end(), [&](const Medium& m) {
    return is_smoke(m) && factor_of_medium(scenario, m) > 0;
  });
}

/// Cells of a file are read as 1/m, although their numbers may be in another unit.
void inspect_cells(const SceneDescription& scene, const Medium& m, Findings& out) {
  const std::vector<float>& cells = m.data.extinction;
  if (cells.empty()) return;
  const auto most = static_cast<double>(*std::max_element(cells.begin(), cells.end()));
  const auto tell = [&](std::string what) {
    out.push_back({judges_people(scene) ? Severity::warning : Severity::note,
                   "smoke optics",
                   {m.place, "the data set \"" + m.name + "\" " + std::move(what)}});
  };
  // Grids of one fire simulation share a name, and some have no smoke yet.
  const bool others_smoke =
      std::any_of(scene.media.begin(), scene.media.end(), [&](const Medium& other) {
        return other.name == m.name &&
               std::any_of(other.data.extinction.begin(), other.data.extinction.end(),
                           [](float v) { return v > 0; });
      });
  if (most == 0 && others_smoke) return;
  if (most == 0)
    tell(
        "has no smoke in any of its cells: is it of a time before the fire, or of another "
        "quantity?");
  else if (most > thickest_cell)
    tell(
        fmt::format("has up to {:.4g} /m in a cell: fires give at most some 50 /m. Is its "
                    "quantity soot density, or its unit another?",
                    most));
  else if (most < thinnest)
    tell(
        fmt::format("has at most {:.2g} /m in any cell, which dims nothing: is its quantity soot "
                    "density, or its unit another?",
                    most));
}

/// A medium that comes from a flaming fire.
const Medium* from_flames(const SceneDescription& scene) {
  for (const Medium& m : scene.media) {
    if (m.emission) return &m;
    if (is_flaming(m.optics) && m.kind != MediumKind::layered) return &m;
    for (const Layer& layer : m.layers)
      if (is_flaming(layer.optics)) return &m;
  }
  return nullptr;
}

}  // namespace

void inspect_smoke_numbers(const SceneDescription& scene, Findings& out) {
  for (const Medium& m : scene.media) {
    const std::string name = (m.emission ? "the flame \"" : "the medium \"") + m.name + "\"";
    if (m.kind == MediumKind::data_set) {
      inspect_cells(scene, m, out);
      // All grids of a fire simulation have its optics; the first one stands for them.
      const auto first =
          std::find_if(scene.media.begin(), scene.media.end(), [&](const Medium& other) {
            return other.name == m.name && other.place.line == m.place.line;
          });
      if (&*first == &m) SmokePart(scene, m, m.optics, name, out).inspect_scattering();
      continue;
    }
    const bool dense = std::any_of(m.layers.begin(), m.layers.end(), [](const Layer& layer) {
      return layer.optics.extinction.sigma_t > 0;
    });
    if (!dense && !(m.kind != MediumKind::layered && m.optics.extinction.sigma_t > 0) &&
        !m.emission) {
      out.push_back({judges_people(scene) ? Severity::warning : Severity::note,
                     "smoke optics",
                     {m.place, name + " has an extinction of 0: it is clear air"}});
      continue;
    }
    if (m.kind != MediumKind::layered) {
      SmokePart(scene, m, m.optics, name, out).inspect();
      continue;
    }
    for (size_t i = 0; i < m.layers.size(); ++i)
      SmokePart(scene, m, m.layers[i].optics, fmt::format("layer {} of {}", i + 1, name), out)
          .inspect();
  }
}

void inspect_smoke_settings(const SceneDescription& scene, const std::vector<Scenario>& scenarios,
                            Findings& out) {
  const AssessmentSettings& said = scene.assessment;
  const auto smoky = std::find_if(scenarios.begin(), scenarios.end(),
                                  [&](const Scenario& s) { return smokes(scene, s); });
  if (smoky == scenarios.end() || !judges_people(scene)) return;
  const auto tell = [&](std::string what) {
    out.push_back({Severity::warning,
                   "smoke settings",
                   {said.place.line > 0 ? said.place : smoky->place, std::move(what)}});
  };
  if (!said.smoke_expected)
    tell("smoke_expected = false says that no smoke may occur where signs are, and scenario \"" +
         smoky->name +
         "\" has smoke: signs would be judged by 2 cd/m2 instead of 10; say smoke_expected = true");
  const Medium* flames = from_flames(scene);
  if (said.irritant_smoke && !*said.irritant_smoke && flames != nullptr)
    tell("irritant_smoke = false says that the smoke does not sting, and \"" + flames->name +
         "\" (" + flames->place.file + ":" + std::to_string(flames->place.line) +
         ") is of a flaming fire, whose smoke does: say irritant_smoke = true");
}

}  // namespace luxodus
