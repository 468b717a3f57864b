// Rules for signs: luminance, evenness, contrast, height, letters, distance.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "scenes/emergency/rule_limits.hpp"
#include "scenes/emergency/rule_table.hpp"
#include "scenes/emergency/rules.hpp"
#include "scenes/light/signs/sign_colours.hpp"

namespace luxodus {

using namespace rule_limit;

namespace {

constexpr double low_level_m = 1;  // below this height a sign is low-level way guidance
constexpr double standing_eye_m = 1.65;

struct Extremes {
  double least = std::numeric_limits<double>::infinity(), most = 0;
};

/// Extremes of the brightness pattern over one colour; the pattern's mean is 1.
Extremes pattern_of(const SignFace& face, ColourIndex colour) {
  Extremes e;
  for (size_t i = 0; i < face.relative_luminance.size(); ++i) {
    if (face.colour[i] != colour) continue;
    const auto v = static_cast<double>(face.relative_luminance[i]);
    e.least = std::min(e.least, v);
    e.most = std::max(e.most, v);
  }
  return e;
}

/// Whether a walker still comes nearer to a sign. A sign behind him does not count.
bool lies_ahead(const Walker& walker, const SignView& view) {
  return glm::dot(glm::dvec2(view.centre - walker.foot), glm::dvec2(walker.ahead)) > 0;
}

Remark smoke_condition(const SceneDescription& scene) {
  return remark(scene.assessment.smoke_expected ? RemarkId::smoke_may_occur
                                                : RemarkId::no_smoke_expected);
}

/// The colours that ISO 7010 gives signs of escape.
struct EscapeColours {
  const FaceColour& white;
  const FaceColour& green;
  ColourIndex green_index;
};
/// None where one of them is missing.
std::optional<EscapeColours> escape_colours(const Sign& sign) {
  const auto white = safety_colour_of(sign, "white"), green = safety_colour_of(sign, "green");
  if (!white || !green) return std::nullopt;
  return EscapeColours{sign.colours[*white], sign.colours[*green], *green};
}

Remark other_colours(const Sign& sign) {
  return remark(RemarkId::other_colours, colour_names(sign.colours));
}

/// Judged by name: the sign has other colours than signs of escape have.
Check wrong_colours(const Sign& sign, const Subject& subject, const CodeChoice& codes) {
  Check check = not_assessed(rule_of(RuleId::S8c, codes), subject, other_colours(sign));
  check.verdict = CheckVerdict::fail;
  check.worst = sign.frame.origin;
  return check;
}

/// If the mean is below the limit, so is the smallest value. A mean above the limit does not show
/// that the smallest value is.
Check smallest_green(const SceneDescription& scene, const Sign& sign, const EscapeColours& colours,
                     const Subject& subject, const CodeChoice& codes) {
  const double limit = scene.assessment.smoke_expected ? min_green_in_smoke : min_green;
  const double mean = colours.green.emergency_cd_m2;
  const bool mapped = !sign.face.relative_luminance.empty();
  Check check = judged(rule_of(RuleId::S1, codes), subject,
                       mapped ? mean * pattern_of(sign.face, colours.green_index).least : mean,
                       Limit{limit}, sign.frame.origin);
  check.conditions = {smoke_condition(scene)};
  if (!mapped && check.verdict == CheckVerdict::pass) {
    check.verdict = CheckVerdict::not_assessed;
    check.reasons = {remark(RemarkId::one_luminance)};
  }
  return check;
}

Check evenness(const Sign& sign, const Subject& subject, const CodeChoice& codes) {
  if (sign.face.relative_luminance.empty())
    return not_assessed(rule_of(RuleId::S2, codes), subject, remark(RemarkId::one_luminance));
  double worst = 0;
  for (size_t c = 0; c < sign.colours.size(); ++c) {
    const Extremes e = pattern_of(sign.face, static_cast<ColourIndex>(c));
    if (e.most > 0)
      worst =
          std::max(worst, e.least > 0 ? e.most / e.least : std::numeric_limits<double>::infinity());
  }
  return judged(rule_of(RuleId::S2, codes), subject, worst, sign.frame.origin);
}

/// Mean of a spectrum weighted by V(lambda), in equal-energy light.
double luminous_mean(const Spectrum& s) {
  return s.integral_with(cie_y()) / cie_y().integral();
}

/// Contrast of the mean luminances of the colours.
Check contrast(const Sign& sign, const EscapeColours& colours, const Subject& subject,
               const CodeChoice& codes) {
  const double green = colours.green.emergency_cd_m2;
  if (!(green > 0))
    return not_assessed(rule_of(RuleId::S3, codes), subject, remark(RemarkId::green_dark));
  const double ratio = colours.white.emergency_cd_m2 / green;
  const bool low = ratio < min_contrast;
  Check check = judged(rule_of(RuleId::S3, codes), subject, ratio,
                       Limit{low ? min_contrast : max_contrast, low}, sign.frame.origin);
  check.conditions = {remark(RemarkId::contrast_of_means)};
  return check;
}

std::vector<Check> mounting(const SceneDescription& scene, const Sign& sign, const Subject& subject,
                            const FloorUnder& floor_under, const CodeChoice& codes) {
  const auto floor = floor_of(scene, floor_under, sign.frame.origin);
  if (!floor)
    return {not_assessed(rule_of(RuleId::S6, codes), subject, remark(RemarkId::height_unknown))};
  const double height = sign.frame.origin.z - sign.height_m / 2 - *floor;
  if (height < low_level_m)
    return {not_assessed(rule_of(RuleId::S6, codes), subject, remark(RemarkId::low_sign))};
  SignView from_ahead;
  const double farthest = viewing_distance(sign, from_ahead).allowed_m;
  const double above = sign.frame.origin.z - *floor - standing_eye_m;
  const double elevation =
      std::asin(std::clamp(above / std::max(farthest, 1e-9), -1.0, 1.0)) * 180 / std::numbers::pi;
  return {judged(rule_of(RuleId::S6, codes), subject, height, sign.frame.origin),
          judged(rule_of(RuleId::S6a, codes), subject, elevation, sign.frame.origin)};
}

/// Luminance of green on an externally lit face.
Check lit_green(const SceneDescription& scene, const Sign& sign, const EscapeColours& colours,
                const Subject& subject, double lux, const CodeChoice& codes) {
  const double limit = scene.assessment.smoke_expected ? min_green_in_smoke : min_green;
  const double mean = lux * luminous_mean(colours.green.reflectance) / std::numbers::pi;
  Check check = judged(rule_of(RuleId::S1, codes), subject, mean, Limit{limit}, sign.frame.origin);
  check.conditions = {smoke_condition(scene)};
  if (check.verdict == CheckVerdict::pass) {
    check.verdict = CheckVerdict::not_assessed;
    check.reasons = {remark(RemarkId::one_luminance)};
  }
  return check;
}

Check reflected_contrast(const Sign& sign, const EscapeColours& colours, const Subject& subject,
                         const CodeChoice& codes) {
  const double green = luminous_mean(colours.green.reflectance);
  if (!(green > 0))
    return not_assessed(rule_of(RuleId::S3, codes), subject, remark(RemarkId::green_dark));
  // Rounded: reflectances are written with few digits, and their means are long sums.
  const double ratio = std::round(luminous_mean(colours.white.reflectance) / green * 1e9) / 1e9;
  const bool low = ratio < min_contrast;
  Check check = judged(rule_of(RuleId::S3, codes), subject, ratio,
                       Limit{low ? min_contrast : max_contrast, low}, sign.frame.origin);
  check.conditions = {remark(RemarkId::contrast_of_means)};
  return check;
}

/// Rules for the light of the safety colour and of its contrast colour.
std::vector<Check> colour_checks(const SceneDescription& scene, const Sign& sign,
                                 const Subject& subject, double lux, const CodeChoice& codes) {
  const auto colours = escape_colours(sign);
  std::vector<Check> out;
  const auto unknown = [&](RuleId id, Remark reason) {
    out.push_back(not_assessed(rule_of(id, codes), subject, std::move(reason)));
  };
  if (!colours) out.push_back(wrong_colours(sign, subject, codes));
  if (sign.lighting == SignLighting::photoluminescent) {
    for (RuleId id : {RuleId::S1, RuleId::S3}) unknown(id, remark(RemarkId::glow_class_unknown));
    return out;
  }
  const bool internal = sign.lighting == SignLighting::internal;
  if (!colours)
    unknown(RuleId::S1, other_colours(sign));
  else
    out.push_back(internal ? smallest_green(scene, sign, *colours, subject, codes)
                           : lit_green(scene, sign, *colours, subject, lux, codes));
  if (internal) out.push_back(evenness(sign, subject, codes));
  if (!colours)
    unknown(RuleId::S3, other_colours(sign));
  else
    out.push_back(internal ? contrast(sign, *colours, subject, codes)
                           : reflected_contrast(sign, *colours, subject, codes));
  if (!internal || !codes.has(Deviation::de_din_4844)) return out;
  if (!colours)
    unknown(RuleId::S5, other_colours(sign));
  else
    out.push_back(
        judged(rule_of(RuleId::S5, codes), subject, colours->white.mains_cd_m2, sign.frame.origin));
  return out;
}

std::vector<Check> en_checks(const SceneDescription& scene, const Sign& sign,
                             const Subject& subject, double lux, const LinesOfSight& seen,
                             const FloorUnder& floor_under, const FedLuminaires& fed,
                             const StoreyFloors& floors, const CodeChoice& codes) {
  std::vector<Check> out = colour_checks(scene, sign, subject, lux, codes);
  if (sign.lighting == SignLighting::external)
    out.push_back(luminaire_near(rule_of(RuleId::S6l, codes), scene, subject, sign.frame.origin,
                                 false, seen, fed, floors));
  for (Check& check : mounting(scene, sign, subject, floor_under, codes))
    out.push_back(std::move(check));
  return out;
}

}  // namespace

std::vector<Check> checks_of_sign(const SceneDescription& scene, const Sign& sign, double lux,
                                  const LinesOfSight& seen, const CodeChoice& codes,
                                  const FloorUnder& floor_under, const FedLuminaires& fed,
                                  const StoreyFloors& floors) {
  const Subject subject = subject_of(sign);
  std::vector<Check> out;
  if (codes.european())
    return en_checks(scene, sign, subject, lux, seen, floor_under, fed, floors, codes);
  if (sign.lighting == SignLighting::external)
    out.push_back(judged(rule_of(RuleId::N6, codes), subject, lux, sign.frame.origin));
  if (sign.letters) {
    out.push_back(
        judged(rule_of(RuleId::N7, codes), subject, sign.letters->height_m, sign.frame.origin));
    out.push_back(
        judged(rule_of(RuleId::N7s, codes), subject, sign.letters->stroke_m, sign.frame.origin));
  } else {
    out.push_back(not_assessed(rule_of(RuleId::N7, codes), subject, remark(RemarkId::no_letters)));
  }
  return out;
}

std::vector<Check> checks_of_distance(const SceneDescription& scene, const EscapeRoute& route,
                                      const std::vector<Walker>& walkers,
                                      const std::vector<std::vector<ClearSign>>& clear,
                                      const CodeChoice& codes) {
  const Subject subject = subject_of(route);
  // Over walkers: the worst share of the allowed distance (by the best sign of each), and the
  // largest distance to the nearest sign [m].
  double worst_share = 0, worst_distance = 0;
  glm::dvec3 where_share(0), where_distance(0);
  size_t through_glass = 0;
  for (size_t i = 0; i < walkers.size(); ++i) {
    double share = std::numeric_limits<double>::infinity(), distance = share;
    bool any = false, bare = false;
    for (const ClearSign& seen : clear[i]) {
      if (!lies_ahead(walkers[i], seen.view)) continue;
      any = true;
      bare = bare || !seen.through_glass;
      const double allowed = viewing_distance(scene.signs[seen.sign], seen.view).allowed_oblique_m;
      if (allowed > 0) share = std::min(share, seen.view.distance_m / allowed);
      distance = std::min(distance, seen.view.distance_m);
    }
    through_glass += any && !bare ? 1 : 0;
    if (share > worst_share) {
      worst_share = share;
      where_share = walkers[i].foot;
    }
    if (distance > worst_distance) {
      worst_distance = distance;
      where_distance = walkers[i].foot;
    }
  }
  std::vector<Check> out;
  if (codes.european()) {
    out.push_back(judged(rule_of(RuleId::S4, codes), subject, worst_share, where_share));
    if (std::isinf(worst_share)) out.back().reasons = {remark(RemarkId::no_sign_ahead)};
  }
  if (!codes.european()) {
    out.push_back(judged(rule_of(RuleId::N8, codes), subject, worst_distance, where_distance));
    if (std::isinf(worst_distance)) out.back().reasons = {remark(RemarkId::no_sign_ahead)};
  }
  if (through_glass > 0 && out.back().reasons.empty())
    out.back().reasons = {remark(RemarkId::through_glass, through_glass, walkers.size())};
  return out;
}

}  // namespace luxodus
