// Media that lie in one another: their extinctions add, which is meant of a haze that lies
// everywhere, and a mistake where one smoke is written twice.
#include <algorithm>

#include "actors/inspect/site.hpp"
#include "scenes/transport/media_bounds.hpp"

namespace luxodus {

namespace {

/// Places along each edge of the box that two media share.
constexpr int steps = 12;
/// Where the thinner one adds less than this share of the thicker one it is a haze in it.
constexpr double haze_share = 0.25;

struct Overlap {
  bool any = false;
  bool matters = false;
  glm::dvec3 place{0};
  double first = 0, second = 0;  // extinctions there [1/m]
};

Bounds shared_box(const CompiledScene& scene, const Medium& a, const Medium& b) {
  const Medium* first[] = {&a};
  const Medium* second[] = {&b};
  const Bounds x = media_bounds(first, scene.bounds), y = media_bounds(second, scene.bounds);
  return {glm::max(x.low, y.low), glm::min(x.high, y.high)};
}

Overlap overlap_of(const CompiledScene& scene, int a, int b) {
  const auto& media = scene.description->media;
  const Bounds box =
      shared_box(scene, media[static_cast<size_t>(a)], media[static_cast<size_t>(b)]);
  Overlap out;
  if (glm::any(glm::greaterThanEqual(box.low, box.high))) return out;
  ResidentBricks bricks(scene.media);
  const int band = scene.bands.count() / 2;
  for (int i = 0; i < steps * steps * steps; ++i) {
    const glm::dvec3 share = (glm::dvec3(i % steps, i / steps % steps, i / steps / steps) + 0.5) /
                             static_cast<double>(steps);
    const glm::dvec3 place = box.low + (box.high - box.low) * share;
    double first = 0, second = 0;
    for_each_medium_at(scene.media, band, Vec3(place - scene.local_origin), bricks,
                       [&](int medium, int, double sigma, double) {
                         if (medium == a) first += sigma;
                         if (medium == b) second += sigma;
                       });
    if (!(first > 0 && second > 0)) continue;
    const bool matters = std::min(first, second) >= haze_share * std::max(first, second);
    if (out.matters || (out.any && !matters)) continue;
    out = {true, matters, place, first, second};
  }
  return out;
}

}  // namespace

void inspect_media(const CompiledScene& scene, Findings& out) {
  const auto& media = scene.description->media;
  for (size_t b = 0; b < media.size(); ++b)
    for (size_t a = 0; a < b; ++a) {
      if (media[a].emission || media[b].emission) continue;
      const Overlap o = overlap_of(scene, static_cast<int>(a), static_cast<int>(b));
      if (!o.any) continue;
      out.push_back({o.matters ? Severity::warning : Severity::note,
                     "media",
                     {media[b].place,
                      fmt::format("the medium \"{}\" overlaps \"{}\" (line {}), at {}: extinctions "
                                  "add there, {:.3g} and {:.3g} /m; {}",
                                  media[b].name, media[a].name, media[a].place.line,
                                  place_text(o.place), o.second, o.first,
                                  o.matters ? "is double extinction meant? Else cut one of them"
                                            : "the thinner one is a haze in the other")}});
    }
}

}  // namespace luxodus
