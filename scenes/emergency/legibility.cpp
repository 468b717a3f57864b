#include "scenes/emergency/legibility.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/emergency/smoke_laws.hpp"

namespace luxodus {

namespace {

/// A sign of which less than the first share is visible is hidden. Up to the second share, light of
/// the obstacle is mixed with that of the sign, and no verdict is given.
constexpr double hidden_share = 0.02, whole_share = 0.95;
/// Reaches end here [m].
constexpr double farthest_reach_m = 1000;

/// Visibility level, with its standard error, of a difference from a background, both seen through
/// a veil. An error that may turn a brighter target into a darker one counts as that of a darker
/// one, whose threshold is lower.
Uncertain level(const Uncertain& difference, const Uncertain& background, double veil,
                double size_arcmin, const SightRules& rules) {
  if (!(size_arcmin > 0)) return {};
  const auto at = [&](double by, double under) {
    return visibility_level(under + by, under, size_arcmin, rules.eye);
  };
  const double under = background.value + veil;
  const double value = at(difference.value, under);
  const bool brighter = difference.value > rules.sure_errors * difference.error;
  const double by_chance = at(brighter ? difference.error : -difference.error, under);
  // The eye adapts to the background, so its error changes the threshold as well. It counts by what
  // as many errors as a verdict needs would change, to whichever side that is more.
  const double off = rules.sure_errors * background.error;
  const double brighter_ground = at(difference.value, under + off);
  const double darker_ground = under > 0 ? at(difference.value, under / (1 + off / under)) : value;
  const double by_ground =
      off > 0 ? std::max(std::abs(brighter_ground - value), std::abs(darker_ground - value)) /
                    rules.sure_errors
              : 0;
  return {value, std::hypot(by_chance, by_ground)};
}

bool surely_above(const Uncertain& level, double limit, double sure_errors) {
  return level.value - sure_errors * level.error >= limit;
}
bool surely_below(const Uncertain& level, double limit, double sure_errors) {
  return level.value + sure_errors * level.error < limit;
}
bool surely_seen(const Sight& sight) {
  return surely_above(sight.seeing_level, sight.seen_from, sight.sure_errors);
}

bool has_legend(const SignFace& face) {
  return face.ground != other_colour &&
         std::count(face.colour.begin(), face.colour.end(), face.legend) > 0 &&
         std::count(face.colour.begin(), face.colour.end(), face.ground) > 0;
}

/// The levels of a view, and what is certain of them.
struct Levels {
  Uncertain reading, pattern, silhouette;
  double sure_errors, seen_from;

  bool read() const { return surely_above(reading, level_read, sure_errors); }
  bool unread() const { return surely_below(reading, level_read, sure_errors); }
  bool seen() const {
    return surely_above(pattern, seen_from, sure_errors) ||
           surely_above(silhouette, seen_from, sure_errors);
  }
  bool unseen() const {
    return surely_below(pattern, seen_from, sure_errors) &&
           surely_below(silhouette, seen_from, sure_errors);
  }
};

/// The verdicts that remain possible, the better one first.
RemarkId open_between(const Levels& levels) {
  if (levels.unread()) return RemarkId::visible_or_invisible;
  return levels.seen() ? RemarkId::legible_or_not : RemarkId::legible_or_invisible;
}

/// Limits the verdict on a sign that would be legible, or may be, by its light alone.
void judge_in_irritant_smoke(Sight& sight) {
  const bool undecided = sight.verdict == SightVerdict::undecided;
  if (undecided && !surely_seen(sight)) {
    sight.reason = remark(RemarkId::visible_or_invisible);
  } else if (undecided || sight.verdict == SightVerdict::legible) {
    sight.verdict = SightVerdict::visible;
    sight.reason = remark(RemarkId::irritant_smoke);
  }
}

double extinction_of(const SignView& view, const SignLook& look) {
  const double passed = std::clamp(look.transmission, 1e-300, 1.0);
  return view.distance_m > 0 ? -std::log(passed) / view.distance_m : 0;
}

/// The distance from which irritant smoke makes reading impossible, whatever the light [m].
double stinging_distance_m(const Sign& sign, double extinction, const SightRules& rules) {
  if (!rules.irritant_smoke || extinction < irritant_from)
    return std::numeric_limits<double>::infinity();
  return irritant_distance_m(jin_constant(sign.lighting), extinction);
}

/// The verdict by the light that reaches the eye.
void judge_by_light(Sight& sight, const SignView& view, const SignLook& look,
                    const SightRules& rules) {
  const double whole = std::sqrt(view.width_arcmin * view.height_arcmin);
  const double veil = look.veil_cd_m2;
  const Levels levels{level(look.difference, look.ground, veil, view.detail_arcmin, rules),
                      level(look.difference, look.ground, veil, whole, rules),
                      level(look.silhouette, look.surround, veil, whole, rules), rules.sure_errors,
                      rules.seen_from()};
  sight.reading_level = levels.reading;
  sight.seeing_level =
      levels.pattern.value >= levels.silhouette.value ? levels.pattern : levels.silhouette;
  if (levels.read()) {
    sight.verdict = SightVerdict::legible;
  } else if (levels.unseen()) {
    sight.verdict = SightVerdict::invisible;
  } else if (levels.unread() && levels.seen()) {
    sight.verdict = SightVerdict::visible;
  } else {
    sight.verdict = SightVerdict::undecided;
    sight.reason = remark(open_between(levels));
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
  const double face = share_of(colours.face);
  // Of the surround no more is known than the light of the room, as of the veil.
  look.silhouette = {(look.silhouette.value + look.beyond_cd_m2) * face - look.beyond_cd_m2 * room,
                     look.silhouette.error * std::max(face, room)};
  look.beyond_cd_m2 *= room;
  scale(look.face, face);
  scale(look.surround, room);
  look.veil_cd_m2 *= room;
  return look;
}

Sight judge_sight(const Sign& sign, const SignView& view, const SignLook& look,
                  const SightRules& rules) {
  Sight sight;
  sight.sure_errors = rules.sure_errors;
  sight.seen_from = rules.seen_from();
  sight.viewing = viewing_distance(sign, view);
  sight.extinction = extinction_of(view, look);
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
  judge_by_light(sight, view, look, rules);
  sight.stings = view.distance_m > stinging_distance_m(sign, sight.extinction, rules);
  if (sight.stings) judge_in_irritant_smoke(sight);
  return sight;
}

Reach reach_of(const Sign& sign, const SignView& view, const SignLook& look,
               const SightRules& rules) {
  const double extinction = extinction_of(view, look);
  const double whole = std::sqrt(view.width_arcmin * view.height_arcmin);
  /// At this distance, instead of that of the view.
  const auto level_at = [&](double distance, const Uncertain& difference,
                            const Uncertain& background, double size_arcmin) {
    const double arrives = std::exp(-extinction * (distance - view.distance_m));
    return level({difference.value * arrives, 0}, {background.value, 0}, look.veil_cd_m2,
                 size_arcmin * view.distance_m / distance, rules)
        .value;
  };
  const auto farthest = [&](const auto& level, double limit) {
    double near = 0, far = farthest_reach_m;
    if (level(far) >= limit) return far;
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = (near + far) / 2;
      (level(middle) >= limit ? near : far) = middle;
    }
    return near;
  };
  const auto pattern_at = [&](double size_arcmin) {
    return [&, size_arcmin](double distance) {
      return level_at(distance, look.difference, look.ground, size_arcmin);
    };
  };
  const auto silhouette = [&](double distance) {
    return level_at(distance, look.silhouette, look.surround, whole);
  };
  if (!(view.distance_m > 0)) return {};
  return {std::min(farthest(pattern_at(view.detail_arcmin), level_read),
                   stinging_distance_m(sign, extinction, rules)),
          std::max(farthest(pattern_at(whole), rules.seen_from()),
                   farthest(silhouette, rules.seen_from()))};
}

double stinging_extinction(const Sign& sign, const SignView& view, const SightRules& rules) {
  if (!rules.irritant_smoke) return std::numeric_limits<double>::infinity();
  const auto stings = [&](double extinction) {
    return view.distance_m > stinging_distance_m(sign, extinction, rules);
  };
  if (stings(irritant_from)) return irritant_from;
  double clear = irritant_from, dense = 2;  // there the law's distance is 0
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = (clear + dense) / 2;
    (stings(middle) ? dense : clear) = middle;
  }
  return dense;
}

bool may_be_read(const Sight& sight) {
  if (sight.verdict == SightVerdict::legible) return true;
  return sight.verdict == SightVerdict::undecided && !sight.stings &&
         !surely_below(sight.reading_level, level_read, sight.sure_errors);
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
        return surely_seen(sight) ? 1 : 3;
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
