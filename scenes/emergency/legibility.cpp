#include "scenes/emergency/legibility.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/emergency/smoke_laws.hpp"

namespace luxodus {

namespace {

/// Distance of a value from its limit at which a verdict is given, in standard errors.
constexpr double sure = 2;
/// A sign of which less than the first share is visible is hidden. Up to the second share, light of
/// the obstacle is mixed with that of the sign, and no verdict is given.
constexpr double hidden_share = 0.02, whole_share = 0.95;

/// Visibility level, with its standard error, of a difference from a background, both seen through
/// a veil.
Uncertain level(const Uncertain& difference, const Uncertain& background, double veil,
                double size_arcmin, const Eye& eye) {
  if (!(size_arcmin > 0)) return {};
  const auto at = [&](double by, double under) {
    return visibility_level(under + by, under, size_arcmin, eye);
  };
  const double under = background.value + veil;
  const double value = at(difference.value, under);
  const double by_chance = at(difference.error, under);
  // The eye adapts to the background, so its error changes the threshold as well.
  return {value, std::hypot(by_chance, at(difference.value, under + background.error) - value)};
}

Uncertain minus(const Uncertain& a, const Uncertain& b) {
  return {a.value - b.value, std::hypot(a.error, b.error)};
}

bool surely_above(const Uncertain& level, double limit) {
  return level.value - sure * level.error >= limit;
}
bool surely_below(const Uncertain& level, double limit) {
  return level.value + sure * level.error < limit;
}

bool has_legend(const SignFace& face) {
  return face.ground != other_colour &&
         std::count(face.colour.begin(), face.colour.end(), face.legend) > 0 &&
         std::count(face.colour.begin(), face.colour.end(), face.ground) > 0;
}

/// Whether the face is certainly not seen: its pattern is below the threshold, and so is its
/// silhouette, or the silhouette is not significant although its error is below the threshold.
bool unseen(const Uncertain& pattern, const Uncertain& silhouette) {
  const bool no_silhouette =
      surely_below(silhouette, level_seen) ||
      (silhouette.value < sure * silhouette.error && silhouette.error <= level_seen);
  return surely_below(pattern, level_seen) && no_silhouette;
}

/// The verdicts that remain possible, the better one first.
RemarkId open_between(const Uncertain& reading, const Uncertain& pattern,
                      const Uncertain& silhouette) {
  const bool may_be_read = !surely_below(reading, level_read);
  const bool seen = surely_above(pattern, level_seen) || surely_above(silhouette, level_seen);
  if (!may_be_read) return RemarkId::visible_or_invisible;
  return seen ? RemarkId::legible_or_not : RemarkId::legible_or_invisible;
}

/// Limits the verdict on a sign that would be legible, or may be, by its light alone.
void judge_in_irritant_smoke(Sight& sight) {
  const bool undecided = sight.verdict == SightVerdict::undecided;
  if (undecided && !surely_above(sight.seeing_level, level_seen)) {
    sight.reason = remark(RemarkId::visible_or_invisible);
  } else if (undecided || sight.verdict == SightVerdict::legible) {
    sight.verdict = SightVerdict::visible;
    sight.reason = remark(RemarkId::irritant_smoke);
  }
}

/// The verdict by the light that reaches the eye.
void judge_by_light(Sight& sight, const SignView& view, const SignLook& look, const Eye& eye) {
  const double whole = std::sqrt(view.width_arcmin * view.height_arcmin);
  const double veil = look.veil_cd_m2;
  const Uncertain pattern = level(look.difference, look.ground, veil, whole, eye);
  const Uncertain silhouette =
      level(minus(look.face, look.surround), look.surround, veil, whole, eye);
  sight.reading_level = level(look.difference, look.ground, veil, view.detail_arcmin, eye);
  sight.seeing_level = pattern.value >= silhouette.value ? pattern : silhouette;
  const bool seen = surely_above(pattern, level_seen) || surely_above(silhouette, level_seen);
  if (surely_above(sight.reading_level, level_read)) {
    sight.verdict = SightVerdict::legible;
  } else if (unseen(pattern, silhouette)) {
    sight.verdict = SightVerdict::invisible;
  } else if (surely_below(sight.reading_level, level_read) && seen) {
    sight.verdict = SightVerdict::visible;
  } else {
    sight.verdict = SightVerdict::undecided;
    sight.reason = remark(open_between(sight.reading_level, pattern, silhouette));
  }
}

}  // namespace

const char* name_of(SightVerdict verdict) {
  switch (verdict) {
    case SightVerdict::legible:
      return "legible";
    case SightVerdict::visible:
      return "visible but not legible";
    case SightVerdict::invisible:
      return "invisible";
    case SightVerdict::hidden:
      return "hidden by the building";
    case SightVerdict::undecided:
      return "undecided";
    case SightVerdict::not_assessed:
      return "not assessed";
  }
  return "";
}

SignLook as_protan_eyes_see(SignLook look) {
  const auto share_of = [](const Tristimulus& light) {
    return light[1] > 0 ? std::max(0.0, protan_luminance(light) / light[1]) : 1.0;
  };
  const auto scale = [](Uncertain& luminance, double share) {
    luminance.value *= share;
    luminance.error *= share;
  };
  const ColoursAtEye& colours = look.colours;
  const double legend = share_of(colours.legend), ground = share_of(colours.ground);
  const double room = share_of(colours.room);
  if (colours.difference != Tristimulus{}) {
    look.difference.value = protan_luminance(colours.difference);
    look.difference.error *= std::max(legend, ground);
  }
  scale(look.legend, legend);
  scale(look.ground, ground);
  scale(look.face, share_of(colours.face));
  scale(look.surround, room);
  look.veil_cd_m2 *= room;
  return look;
}

Sight judge_sight(const Sign& sign, const SignView& view, const SignLook& look,
                  const SightRules& rules) {
  Sight sight;
  sight.viewing = viewing_distance(sign, view);
  const double passed = std::clamp(look.transmission, 1e-300, 1.0);
  sight.extinction = view.distance_m > 0 ? -std::log(passed) / view.distance_m : 0;
  const double constant = jin_constant(sign.lighting);
  sight.jin_m = jin_distance_m(constant, sight.extinction);
  sight.jin_legible = view.distance_m <= sight.jin_m;
  if (look.visible_share < hidden_share) {
    sight.verdict = SightVerdict::hidden;
    return sight;
  }
  if (look.visible_share < whole_share) {
    sight.reason = remark(RemarkId::partly_hidden);
    return sight;
  }
  if (!has_legend(sign.face)) {
    sight.reason = remark(RemarkId::one_colour);
    return sight;
  }
  judge_by_light(sight, view, look, rules.eye);
  sight.stings = rules.irritant_smoke && sight.extinction >= irritant_from &&
                 view.distance_m > irritant_distance_m(constant, sight.extinction);
  if (sight.stings) judge_in_irritant_smoke(sight);
  return sight;
}

bool may_be_read(const Sight& sight) {
  if (sight.verdict == SightVerdict::legible) return true;
  return sight.verdict == SightVerdict::undecided && !sight.stings &&
         !surely_below(sight.reading_level, level_read);
}

double error_of_level_beyond(const SignLook& first, const SignLook& other, const SignLook& beyond,
                             const SignView& view, const Eye& eye) {
  if (!(view.detail_arcmin > 0)) return 0;
  const auto at = [&](double by, double under) {
    return visibility_level(under + by, under, view.detail_arcmin, eye);
  };
  const auto under = [](const SignLook& look) { return look.ground.value + look.veil_cd_m2; };
  const auto brighter_ground = [&](const SignLook& look, double by) {
    return at(look.difference.value, under(look) + by) - at(look.difference.value, under(look));
  };
  // An error that both lights share counts by the difference of its effects in them. The same paths
  // estimate the first light and the rest of the other one, so the two errors are correlated: their
  // sum is the worst case. Errors of difference and ground are taken as independent, as in level().
  const double by_difference =
      at(beyond.difference.error, under(other)) +
      std::abs(at(first.difference.error, under(other)) - at(first.difference.error, under(first)));
  const double by_ground = std::abs(brighter_ground(other, beyond.ground.error)) +
                           std::abs(brighter_ground(other, first.ground.error) -
                                    brighter_ground(first, first.ground.error));
  return std::hypot(by_difference, by_ground);
}

bool is_worse(const Sight& a, const Sight& b) {
  const auto badness = [](const Sight& sight) {
    switch (sight.verdict) {
      case SightVerdict::legible:
        return 0;
      case SightVerdict::undecided:
        return surely_above(sight.seeing_level, level_seen) ? 1 : 3;
      case SightVerdict::visible:
        return 2;
      case SightVerdict::invisible:
        return 4;
      case SightVerdict::hidden:
        return 5;
      case SightVerdict::not_assessed:
        return 6;
    }
    return 6;
  };
  const int x = badness(a), y = badness(b);
  return x != y ? x > y : a.reading_level.value < b.reading_level.value;
}

}  // namespace luxodus
