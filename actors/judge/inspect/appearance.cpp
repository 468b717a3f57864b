// Inspects stated reflectances and luminances: reflectances that no paint has, rooms that are black
// all over, signs that are dark, reversed, or brighter than their kind can be.
#include <algorithm>
#include <cmath>

#include "actors/judge/inspect/site.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"
#include "scenes/light/signs/legend_size.hpp"
#include "scenes/light/signs/sign_colours.hpp"
#include "scenes/light/signs/sign_light.hpp"

namespace luxodus {

namespace {

/// Fresh white paint reflects 0.85; only the coating of integrating spheres reflects more.
constexpr double max_paint = 0.9;
/// Below this a surface counts as black.
constexpr double black_below = 0.01;
/// Photoluminescent faces have some cd/m2 in the first minute and less than 1 after ten (ISO
/// 17398); more is the luminance of an internally lit sign.
constexpr double max_glow_cd_m2 = 10;
constexpr double max_lit_cd_m2 = 5000;
/// Limits on white over green (EN 1838: 5 to 15), and the lower one on any legend and its ground.
constexpr double min_mains_contrast = 2, max_mains_contrast = 50;
/// Share of a sign's shorter side; the details of pictograms are a tenth of it.
constexpr double large_detail = 0.34;
/// Share of a drawing's parts that may be finer than its smallest detail: their ends and corners.
constexpr double max_finer_share = 0.25;
/// Luminance ~ cos^n: with a larger exponent little is visible from the side.
constexpr double max_exponent = 2;
/// Texels across the longer side of a drawn face, whose details are a tenth of the shorter one.
constexpr int min_texels = 40;
/// A glow that lasts this long is probably given in minutes, or belongs to another sign [s].
constexpr double glow_s = 600, max_glow_share = 0.5;

void tell_of(const Sign& sign, Severity severity, const std::string& what, Findings& out) {
  out.push_back({severity, "sign light", {sign.place, "sign \"" + sign.name + "\" " + what}});
}

/// White and green, where these are all colours of a sign: rules and habits are known of them.
struct WhiteGreen {
  const FaceColour& white;
  const FaceColour& green;
};
std::optional<WhiteGreen> white_green_of(const Sign& sign) {
  const auto white = safety_colour_of(sign, "white"), green = safety_colour_of(sign, "green");
  if (!white || !green || sign.colours.size() != 2) return std::nullopt;
  return WhiteGreen{sign.colours[*white], sign.colours[*green]};
}

using Luminance = double FaceColour::*;

/// Whether white and green of a self-luminous sign are as bright as each other should be.
void inspect_contrast(const Sign& sign, double white, double green, const char* operation,
                      Findings& out) {
  if (green > white)
    return tell_of(sign, Severity::warning,
                   fmt::format("has green of {:.4g} cd/m2 and white of {:.4g} cd/m2 in {} "
                               "operation: white is the brighter one; are they swapped?",
                               green, white, operation),
                   out);
  if (green > 0 && white < min_mains_contrast * green)
    tell_of(sign, Severity::warning,
            fmt::format("has white only {:.3g} times as bright as green in {} operation: its "
                        "legend hardly stands out; EN 1838 asks for 5 to 15 times",
                        white / green, operation),
            out);
  if (sign.lighting == SignLighting::internal && green > 0 && white > max_mains_contrast * green)
    tell_of(sign, Severity::warning,
            fmt::format("has white {:.3g} times as bright as green in {} operation: EN 1838 asks "
                        "for 5 to 15 times; is one of them in another unit?",
                        white / green, operation),
            out);
}

/// Whether legend and ground of a sign of other colours differ enough to be read.
void inspect_legend(const Sign& sign, Luminance luminance, const char* operation, Findings& out) {
  if (sign.face.ground == other_colour) return;
  const FaceColour &legend = sign.colours[sign.face.legend],
                   &ground = sign.colours[sign.face.ground];
  const double a = legend.*luminance, b = ground.*luminance;
  if (std::max(a, b) >= min_mains_contrast * std::min(a, b)) return;
  tell_of(sign, Severity::warning,
          fmt::format("has {} of {:.4g} cd/m2 on {} of {:.4g} cd/m2 in {} operation: its legend "
                      "hardly stands out",
                      legend.name, a, ground.name, b, operation),
          out);
}

/// Inspects the luminances of a self-luminous sign in one operation.
void inspect_state(const Sign& sign, Luminance luminance, const char* operation, Findings& out) {
  const auto darker = [&](const FaceColour& a, const FaceColour& b) {
    return a.*luminance < b.*luminance;
  };
  const FaceColour& brightest = *std::max_element(sign.colours.begin(), sign.colours.end(), darker);
  const double most = brightest.*luminance;
  if (most == 0) return;
  if (const auto pair = white_green_of(sign))
    inspect_contrast(sign, pair->white.*luminance, pair->green.*luminance, operation, out);
  else
    inspect_legend(sign, luminance, operation, out);
  if (most > max_lit_cd_m2)
    tell_of(sign, Severity::warning,
            fmt::format("has {} of {:.4g} cd/m2 in {} operation, as bright as a lamp: is it in "
                        "mcd/m2?",
                        brightest.name, most, operation),
            out);
}

void inspect_internal(const Sign& sign, Findings& out) {
  if (max_emergency_cd_m2(sign) == 0)
    return tell_of(sign, Severity::warning,
                   "has luminances of 0 in emergency operation: it is dark when the mains fail",
                   out);
  for (const FaceColour& colour : sign.colours) {
    if (!(colour.mains_cd_m2 > 0 && colour.emergency_cd_m2 > colour.mains_cd_m2)) continue;
    return tell_of(sign, Severity::warning,
                   fmt::format("is brighter in emergency operation ({:.4g} cd/m2 of {}) than with "
                               "the mains ({:.4g} cd/m2): are they swapped?",
                               colour.emergency_cd_m2, colour.name, colour.mains_cd_m2),
                   out);
  }
}

void inspect_glow(const Sign& sign, Findings& out) {
  for (const FaceColour& colour : sign.colours)
    if (colour.emergency_cd_m2 > max_glow_cd_m2)
      tell_of(sign, Severity::warning,
              fmt::format("is photoluminescent and has {:.4g} cd/m2 of {} at the failure, as much "
                          "as a sign that is lit from within: such faces give a few cd/m2 (is it "
                          "in mcd/m2?)",
                          colour.emergency_cd_m2, colour.name),
              out);
  if (sign.decay.empty()) return;
  if (sign.decay.front().y != 1)
    tell_of(sign, Severity::warning,
            fmt::format("has a 'decay' that begins with a share of {:.3g}: emergency_white is the "
                        "luminance at the failure, where the share is 1",
                        sign.decay.front().y),
            out);
  for (size_t i = 1; i < sign.decay.size(); ++i)
    if (sign.decay[i].y > sign.decay[i - 1].y)
      return tell_of(
          sign, Severity::warning,
          fmt::format("has a 'decay' that rises at {:.4g} s: a glow fades", sign.decay[i].x), out);
  const double later = decay_share(sign.decay, glow_s);
  if (later > max_glow_share)
    tell_of(sign, Severity::warning,
            fmt::format("keeps {} of its glow for ten minutes: most faces keep less than a "
                        "tenth; are the times of 'decay' in minutes?",
                        percent_text(later)),
            out);
}

/// Holds the stated detail against the face and its drawing. A stroke that makes the legend is
/// measured already.
void inspect_detail(const Sign& sign, Findings& out) {
  const double shorter = std::min(sign.width_m, sign.height_m);
  if (sign.smallest_detail_m > large_detail * shorter)
    return tell_of(
        sign, Severity::warning,
        fmt::format("has a smallest_detail of {:.3g} m, more than a third of its shorter side "
                    "of {:.3g} m: details of pictograms are about a tenth of it, and verdicts "
                    "follow from the detail",
                    sign.smallest_detail_m, shorter),
        out);
  if (sign.face.colour.empty() ||
      (sign.letters && sign.smallest_detail_m <= sign.letters->stroke_m))
    return;
  const auto drawn = legend_size(sign, sign.smallest_detail_m);
  if (!drawn) return;
  if (drawn->widest_m < sign.smallest_detail_m)
    return tell_of(sign, Severity::warning,
                   fmt::format("has a smallest_detail of {:.3g} m, and nothing in its drawing is "
                               "so large: its widest part is {:.2g} m wide; verdicts follow from "
                               "the detail",
                               sign.smallest_detail_m, drawn->widest_m),
                   out);
  if (drawn->finer_share > max_finer_share)
    tell_of(sign, Severity::warning,
            fmt::format("has a smallest_detail of {:.3g} m, and {} of its drawing is finer: state "
                        "the width of the finest part that must be seen; verdicts follow from it",
                        sign.smallest_detail_m, percent_text(drawn->finer_share)),
            out);
}

void inspect_face(const Sign& sign, Findings& out) {
  const auto pair = white_green_of(sign);
  const double white = pair ? luminous_mean(pair->white.reflectance) : 1;
  const double green = pair ? luminous_mean(pair->green.reflectance) : 0;
  if (white <= green)
    tell_of(sign, Severity::warning,
            fmt::format(
                "has colours that reflect light, and its white reflects {:.3g}, its green {:.3g}: "
                "white is the brighter one; are they swapped?",
                white, green),
            out);
  if (sign.lighting != SignLighting::external && sign.angular_exponent > max_exponent)
    tell_of(sign, Severity::note,
            fmt::format("shines ahead alone: at 60 degrees from its normal it has {:.2g} % of its "
                        "luminance (angular_exponent), and checks take the luminance along the "
                        "normal",
                        100 * std::pow(0.5, sign.angular_exponent)),
            out);
  if (!sign.file.empty() && std::max(sign.face.width, sign.face.height) < min_texels)
    tell_of(sign, Severity::warning,
            fmt::format("is drawn with {} x {} texels, too few for the details of \"{}\": say "
                        "texels = 96 or more",
                        sign.face.width, sign.face.height, sign.file),
            out);
  inspect_detail(sign, out);
}

}  // namespace

bool judges_people(const SceneDescription& scene) {
  return !scene.routes.empty() || !scene.open_areas.empty() ||
         (!scene.observers.empty() && !scene.signs.empty());
}

void inspect_materials(const SceneDescription& scene, Findings& out) {
  std::vector<double> area(scene.materials.size(), 0);
  for (const Object& object : scene.objects)
    area[static_cast<size_t>(object.material)] += area_of(object.mesh);
  double all = 0, reflected = 0;
  for (size_t i = 0; i < area.size(); ++i) {
    const Material& m = scene.materials[i];
    if (!(area[i] > 0) || m.kind == MaterialKind::open) continue;
    const bool paint = m.kind == MaterialKind::lambertian || m.kind == MaterialKind::glossy;
    const double share = paint ? luminous_mean(m.reflectance) + luminous_mean(m.specular)
                         : m.kind == MaterialKind::mirror ? luminous_mean(m.specular)
                                                          : 1;
    all += area[i];
    reflected += area[i] * share;
    if (paint && share > max_paint + 1e-9)
      out.push_back({judges_people(scene) ? Severity::warning : Severity::note,
                     "material",
                     {m.place, fmt::format("material \"{}\" reflects {:.3g} of the light: fresh "
                                           "white paint reflects 0.85, floors 0.1 to 0.4",
                                           m.name, share)}});
  }
  if (all > 0 && reflected < black_below * all)
    out.push_back({judges_people(scene) ? Severity::warning : Severity::note,
                   "material",
                   {{scene.file, 0},
                    "all surfaces are black: there is direct light alone, and none of the veil "
                    "that reflected light lays over smoke and signs; state the reflectances"}});
}

void inspect_sign_light(const SceneDescription& scene, Findings& out) {
  for (const Sign& sign : scene.signs) {
    inspect_face(sign, out);
    if (sign.lighting == SignLighting::external) continue;
    inspect_state(sign, &FaceColour::emergency_cd_m2, "emergency", out);
    if (sign.lighting == SignLighting::photoluminescent) {
      inspect_glow(sign, out);
      continue;
    }
    inspect_state(sign, &FaceColour::mains_cd_m2, "mains", out);
    inspect_internal(sign, out);
  }
}

}  // namespace luxodus
