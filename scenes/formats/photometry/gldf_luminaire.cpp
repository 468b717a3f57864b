// A scene's choice of a container: one light of one variant, with its photometric file, its fluxes
// and its turn within the luminaire. The files are read here, like those beside a scene.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <numbers>

#include "runtime/core/printable.hpp"
#include "scenes/formats/photometry/gldf.hpp"
#include "scenes/light/geometry/transform.hpp"

namespace luxodus {
namespace {

std::string choices(const std::vector<std::string>& names) {
  constexpr size_t most = 12;
  std::string out;
  for (size_t i = 0; i < names.size() && i < most; ++i)
    out += (i == 0 ? "\"" : ", \"") + excerpt(names[i]) + "\"";
  return names.size() > most ? out + ", ..." : out;
}

Result<const GldfVariant*> chosen_variant(const GldfProduct& product, const std::string& id) {
  if (id.empty() && product.variants.size() == 1) return &product.variants.front();
  std::vector<std::string> ids;
  for (const GldfVariant& variant : product.variants) {
    if (variant.id == id) return &variant;
    ids.push_back(variant.id);
  }
  return problem_in(product.file,
                    (id.empty() ? std::string("several variants; say 'variant'")
                                : "no variant \"" + excerpt(id) + "\" in it; there are") +
                        (id.empty() ? ": " : " ") + choices(ids));
}

Result<const GldfReference*> chosen_light(const GldfProduct& product, const GldfVariant& variant,
                                          const std::string& emitter) {
  std::vector<std::string> names;
  for (const GldfReference& light : variant.lights) {
    if (light.name == emitter || (emitter.empty() && variant.lights.size() == 1)) return &light;
    names.push_back(light.name);
  }
  const std::string of = "variant \"" + excerpt(variant.id) + "\" ";
  if (names.empty()) return problem_in(product.file, of + "has no light emitter");
  return problem_in(
      product.file,
      of +
          (emitter.empty() ? std::string("has several emitters; say 'emitter': ")
                           : "has no emitter \"" + excerpt(emitter) + "\"; there are ") +
          choices(names));
}

/// Scales a web to another flux.
Result<std::shared_ptr<const PhotometricWeb>> with_flux(const PhotometricWeb& web, double flux_lm,
                                                        const std::string& file) {
  std::vector<double> candela = web.candela();
  for (double& c : candela) c *= flux_lm / web.flux_lm();
  auto scaled = PhotometricWeb::make(web.azimuth_deg(), web.polar_deg(), std::move(candela),
                                     web.to_luminaire());
  if (!scaled) return problem_in(file, scaled.problem());
  return std::make_shared<const PhotometricWeb>(std::move(scaled).value());
}

std::string words_for(const GldfLight& light) {
  return "emitter \"" + excerpt(light.emitter) + "\": ";
}

/// A light's photometric file, scaled to its rated flux.
struct Rated {
  PhotometricFile photometry;
  double flux_lm = 0;
  double of_lamps = 1;  // share of the lamps' light that the luminaire emits
};

Result<Rated> rated_of(const GldfProduct& product, const GldfLight& light,
                       std::optional<int> lamp_set) {
  const std::string who = words_for(light);
  if (!light.fault.empty()) return problem_in(product.file, who + light.fault);
  const auto file = std::find_if(product.photometry.begin(), product.photometry.end(),
                                 [&](const GldfFile& f) { return f.name == light.photometry; });
  if (file == product.photometry.end())
    return problem_in(product.file, who + "its photometric file is not in the container");
  // Lamp sets differ in flux alone: where the container states that, any gives the same light.
  if (!lamp_set && (light.rated_lm || light.lamp_lm)) lamp_set = 1;
  // The folder is a file, so that no file named by TILT= is found.
  auto photometry = photometric_file_of(
      file->bytes, product.file + ":ldc/" + excerpt(file->name, 200), product.file, lamp_set);
  if (!photometry) return photometry.problem();
  Rated out;
  out.photometry = std::move(photometry).value();
  out.of_lamps = out.photometry.light_output_ratio;
  const double of_lamps = light.lamp_lm.value_or(0) * out.of_lamps;
  const double own = out.photometry.web->flux_lm();
  out.flux_lm = light.rated_lm ? *light.rated_lm : of_lamps > 0 ? of_lamps : own;
  if (light.rated_lm && light.lamp_lm.value_or(0) > 0)
    out.of_lamps = *light.rated_lm / *light.lamp_lm;
  if (!(out.flux_lm > 0)) return out;
  auto web = with_flux(*out.photometry.web, out.flux_lm, product.file);
  if (!web) return web.problem();
  out.photometry.web = std::move(web).value();
  out.photometry.flux_lm = out.flux_lm;
  return out;
}

bool says_emergency_flux(const GldfLight& light) {
  return light.emergency_lm || light.emergency_lamp_lm || light.ballast_factor;
}

/// Whether the container says that a light is lit in an emergency. Without 'emergencyBehaviour' it
/// is for normal lighting, unless it has a flux for emergencies.
bool lit_in_emergencies(const GldfLight& light) {
  if (light.behaviour.empty()) return says_emergency_flux(light);
  return light.behaviour != "None";
}

/// The share that a light has of the product's emergency flux: its rated flux over that of all
/// lights that are lit then. Of alternatives that the other references leave open the brightest
/// counts, which makes the share small.
Result<double> share_of(const GldfProduct& product, const GldfVariant& variant,
                        const GldfReference& chosen, double rated_lm) {
  const GldfLight& own = product.lights[chosen.light];
  std::map<std::pair<uint64_t, int>, double> sums;  // of the channels of an alternative
  for (const GldfReference& reference : variant.lights) {
    const GldfLight& light = product.lights[reference.light];
    if (!lit_in_emergencies(light)) continue;
    const bool with_chosen = reference.number == chosen.number;
    if (with_chosen && light.alternative != own.alternative) continue;
    double lumens = light.rated_lm.value_or(0);
    if (&reference == &chosen) {
      lumens = rated_lm;
    } else if (!light.rated_lm) {  // only then is its photometric file needed
      const auto rated = rated_of(product, light, {});
      if (!rated)
        return problem_in(product.file,
                          "the emergency flux by duration is that of the whole "
                          "product, and the share of the emitter is not known: " +
                              rated.problem().what);
      lumens = rated->flux_lm;
    }
    sums[{reference.number, light.alternative}] += lumens;
  }
  std::map<uint64_t, double> brightest;  // of a reference
  for (const auto& [key, sum] : sums) brightest[key.first] = std::max(brightest[key.first], sum);
  double all = 0;
  for (const auto& [number, sum] : brightest) all += sum;
  return all > 0 ? rated_lm / all : 1;
}

Result<double> emergency_flux(const GldfProduct& product, const GldfVariant& variant,
                              const GldfReference& chosen, const Rated& rated,
                              std::optional<double> duration_h) {
  const GldfLight& light = product.lights[chosen.light];
  const std::string say = "say 'emergency_flux' or 'emergency_factor'";
  if (!lit_in_emergencies(light))
    return problem_in(product.file,
                      words_for(light) +
                          (light.behaviour.empty()
                               ? "it states no emergency flux and no ballast's factor, and no "
                                 "emergencyBehaviour, so that it is for normal lighting: "
                               : "it is for normal lighting only (emergencyBehaviour \"None\"): "
                                 "leave 'emergency' out, or ") +
                          say);
  if (duration_h && !variant.durations.empty()) {
    std::vector<std::string> hours;
    for (const GldfDuration& row : variant.durations) {
      if (row.hours == *duration_h) {
        const auto share = share_of(product, variant, chosen, rated.flux_lm);
        if (!share) return share.problem();
        return row.flux_lm * share.value();
      }
      hours.push_back(fmt::format("{:g}", row.hours));
    }
    return problem_in(product.file, "variant \"" + excerpt(variant.id) +
                                        "\" has no emergency flux for " +
                                        fmt::format("{:g} h; it has those for ", *duration_h) +
                                        choices(hours) + " h");
  }
  if (light.emergency_lm) return *light.emergency_lm;
  if (light.emergency_lamp_lm) return *light.emergency_lamp_lm * rated.of_lamps;
  if (light.ballast_factor) return rated.flux_lm * *light.ballast_factor;
  if (light.behaviour == "EmergencyOnly") return rated.flux_lm;
  return problem_in(product.file,
                    "emitter \"" + excerpt(light.emitter) +
                        "\" states no emergency flux and no ballast's factor: " + say);
}

/// First about its own gamma 0; then about the luminaire's axes as parts of models turn, in the
/// order z, x, y.
glm::dmat3 turn_of(const GldfLight& light) {
  const auto about = [](const glm::dvec3& axis, double degrees) {
    return rotation(axis, degrees).value().linear;  // an axis of length 1, a finite angle
  };
  const glm::dvec3& turn = light.rotation_deg;
  return about({0, 0, 1}, turn.z) * about({1, 0, 0}, turn.x) * about({0, 1, 0}, turn.y) *
         about({0, 0, 1}, light.g0_deg);
}

/// Told where the format leaves open how turns about several axes follow each other.
std::optional<std::string> turn_words(const GldfLight& light) {
  const glm::dvec3& turn = light.rotation_deg;
  const int axes = (turn.x != 0) + (turn.y != 0) + (turn.z != 0);
  if (axes < 2) return std::nullopt;
  return words_for(light) +
         fmt::format(
             "the container turns it by [{:g}, {:g}, {:g}] degrees about x, y, z, and GLDF "
             "does not say in which order: z, then x, then y is taken, as for parts of "
             "models; look where it shines",
             turn.x, turn.y, turn.z);
}

}  // namespace

Result<GldfLuminaire> luminaire_of(const GldfProduct& product, const GldfChoice& choice) {
  const auto variant = chosen_variant(product, choice.variant);
  if (!variant) return variant.problem();
  const auto reference = chosen_light(product, *variant.value(), choice.emitter);
  if (!reference) return reference.problem();
  const GldfLight& light = product.lights[reference.value()->light];
  auto rated = rated_of(product, light, choice.lamp_set);
  if (!rated) return rated.problem();
  GldfLuminaire out;
  out.emergency_lm = emergency_flux(product, *variant.value(), *reference.value(), rated.value(),
                                    choice.duration_h);
  out.rated_lm = rated->flux_lm;
  out.photometry = std::move(rated->photometry);
  out.photometry.manufacturer = product.manufacturer;
  out.photometry.article = product.number;
  if (const auto& housing = variant.value()->housing) {
    out.photometry.housing_m = housing->size_m;
    out.photometry.housing_round = housing->round;
  }
  std::string& name = out.photometry.luminaire;
  name = product.name.empty() ? name : product.name;
  if (!product.number.empty() && name.find(product.number) == std::string::npos)
    name += (name.empty() ? "" : ", ") + product.number;
  if (auto words = turn_words(light))
    out.photometry.warnings.push_back(problem_in(product.file, std::move(*words)));
  out.emergency_only = light.behaviour == "EmergencyOnly";
  out.normal_only = light.behaviour == "None";
  out.turn = turn_of(light);
  return out;
}

}  // namespace luxodus
