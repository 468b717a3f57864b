// Inspects media: those that overlap, whose extinctions add, which is intended for a haze
// everywhere, and a mistake if one smoke is written twice; those that reach no part of the
// building, or lie outside with most of their smoke; flames in bodies and outside.
#include <algorithm>
#include <array>

#include "actors/judge/inspect/site.hpp"
#include "scenes/light/transport/media_bounds.hpp"

namespace luxodus {

namespace {

/// Sample places along each edge of the box that two media share.
constexpr int overlap_steps = 12;
/// A flame with more than this share outside was meant to be in a room.
constexpr double overlap_share = 0.1;
constexpr double one_flame_m = 0.02;
const Bounds everywhere{glm::dvec3(-1e9), glm::dvec3(1e9)};
/// If the thinner one adds less than this share of the thicker one, it is a haze within it.
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
  for (int i = 0; i < overlap_steps * overlap_steps * overlap_steps; ++i) {
    const glm::dvec3 share = (glm::dvec3(i % overlap_steps, i / overlap_steps % overlap_steps,
                                         i / overlap_steps / overlap_steps) +
                              0.5) /
                             static_cast<double>(overlap_steps);
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

Bounds built(const SceneDescription& scene) {
  Bounds out;
  for (const Object& object : scene.objects)
    for (const glm::dvec3& p : object.mesh.positions) out.extend(p);
  return out;
}

bool apart(const Bounds& a, const Bounds& b) {
  return glm::any(glm::greaterThanEqual(a.low, b.high)) ||
         glm::any(glm::greaterThanEqual(b.low, a.high));
}

/// Smoke with this share outside hardly attenuates what it was written for.
constexpr double mostly_outside = 0.5;
/// Another order of its numbers was meant if that leaves at most this share outside.
constexpr double fits_inside = 0.1;
/// A nearly square box changes little when its axes are swapped: the other order must bring this
/// share of the smoke inside to be suggested.
constexpr double brings_in = 0.3;

/// The share of smoke outside the building, also after moving its points.
class SmokePlaces {
 public:
  SmokePlaces(const Building& smoky, size_t medium) : smoky_(smoky) {
    constexpr int across = 10, up = 4;
    const CompiledScene& scene = smoky.scene();
    const Medium* one = &scene.description->media[medium];
    Bounds box = media_bounds({&one, 1}, everywhere);
    if (box.empty() || box.high.x - box.low.x > unbounded_m) return;
    // Heights are reported separately, by tell_layers.
    const Bounds building = built(*scene.description);
    box.low.z = std::max(box.low.z, building.low.z);
    box.high.z = std::min(box.high.z, building.high.z);
    if (glm::any(glm::greaterThanEqual(box.low, box.high))) return;
    box_ = box;
    ResidentBricks bricks(scene.media);
    const int band = scene.bands.count() / 2;
    for (int i = 0; i < across * across * up; ++i) {
      const glm::dvec3 share =
          (glm::dvec3(i % across, i / across % across, i / across / across) + 0.5) /
          glm::dvec3(across, across, up);
      const glm::dvec3 place = box.low + (box.high - box.low) * share;
      double sigma = 0;
      for_each_medium_at(scene.media, band, smoky.local(place), bricks,
                         [&](int m, int, double extinction, double) {
                           if (m == static_cast<int>(medium)) sigma += extinction;
                         });
      if (sigma > 0) smoke_.push_back({place, share});
    }
  }

  bool any() const { return !smoke_.empty(); }
  const Bounds& box() const { return box_; }
  /// With these corners of the box in plan instead of its own.
  double outside(const glm::dvec2& low, const glm::dvec2& high) const {
    std::vector<char> out(smoke_.size(), 0);
    smoky_.each(smoke_.size(), [&](const GeometryAccess& access, size_t i) {
      const glm::dvec2 plan = low + (high - low) * glm::dvec2(smoke_[i].share);
      out[i] = is_outside(smoky_.scene(), access, smoky_.local({plan, smoke_[i].place.z})) ? 1 : 0;
    });
    return static_cast<double>(std::count(out.begin(), out.end(), 1)) /
           static_cast<double>(out.size());
  }

 private:
  /// No box is this large; an unbounded medium is everywhere [m].
  static constexpr double unbounded_m = 1e7;
  struct Point {
    glm::dvec3 place, share;
  };
  const Building& smoky_;
  Bounds box_;
  std::vector<Point> smoke_;
};

std::string corners_text(const glm::dvec2& low, const glm::dvec2& high) {
  return fmt::format("[[{:.4g}, {:.4g}], [{:.4g}, {:.4g}]]", low.x, low.y, high.x, high.y);
}

/// Points across a flame's box that burn, and where they are.
struct BurningPoints {
  int all = 0, in_bodies = 0, outside = 0;
  bool around = false;  // the centre of the building lies in its box
};

BurningPoints burning_of(const Building& smoky, size_t index) {
  constexpr int across = 6;
  const CompiledScene& scene = smoky.scene();
  const Medium* medium = &scene.description->media[index];
  const Bounds box = media_bounds({&medium, 1}, everywhere);
  const int band = scene.bands.count() / 2;
  std::vector<std::array<char, 3>> points(across * across * across);
  smoky.each(points.size(), [&](const GeometryAccess& access, size_t k) {
    const int i = static_cast<int>(k);
    const glm::dvec3 share =
        (glm::dvec3(i % across, i / across % across, i / across / across) + 0.5) /
        static_cast<double>(across);
    const glm::dvec3 place = box.low + (box.high - box.low) * share;
    ResidentBricks bricks(scene.media);
    bool burns = false;
    for_each_medium_at(scene.media, band, Vec3(place - scene.local_origin), bricks,
                       [&](int m, int, double, double) { burns |= m == static_cast<int>(index); });
    if (!burns) return;
    points[k] = {1, smoky.in_solid(access, place) ? char{1} : char{0},
                 is_outside(scene, access, smoky.local(place)) ? char{1} : char{0}};
  });
  BurningPoints out;
  const Bounds building = built(*scene.description);
  const glm::dvec3 middle = (building.low + building.high) * 0.5;
  out.around =
      glm::all(glm::greaterThan(middle, box.low)) && glm::all(glm::lessThan(middle, box.high));
  for (const auto& [burns, in_body, outside] : points) {
    out.all += burns;
    out.in_bodies += in_body;
    out.outside += outside;
  }
  return out;
}

std::string medium_text(const Medium& m) {
  return (m.emission ? "the flame \"" : "the medium \"") + m.name + "\"";
}

/// Reports layers above or below the whole building.
void tell_layers(const Medium& m, const Bounds& building, Findings& out) {
  for (size_t i = 0; i < m.layers.size(); ++i) {
    const Layer& layer = m.layers[i];
    if (layer.z_low < building.high.z && layer.z_high > building.low.z) continue;
    out.push_back(
        {Severity::warning,
         "media",
         {m.place, fmt::format("layer {} of {}, from z = {:.6g} to {:.6g} m, lies outside "
                               "the building, which reaches from {:.6g} to {:.6g} m: it "
                               "dims nothing; are its heights in metres?",
                               i + 1, medium_text(m), layer.z_low, layer.z_high, building.low.z,
                               building.high.z)}});
  }
}

/// A grid that is this many times as large as the building along every axis is in another unit.
constexpr double larger_than_built = 2.5, absurdly_larger = 80, smaller_than_built = 0.1;

/// The unit of which a factor of sizes is a sign.
std::string unit_words(double factor) {
  struct Unit {
    double factor;
    const char* words;
  };
  for (const Unit& unit : {Unit{1000, "millimetres"}, Unit{100, "centimetres"},
                           Unit{39.37, "inches"}, Unit{3.281, "feet"}, Unit{0.001, "kilometres"}})
    if (factor > unit.factor / 1.3 && factor < unit.factor * 1.3)
      return fmt::format(": are its cells in {}?", unit.words);
  return ": are its cells in metres?";
}

/// Reports data sets far larger or smaller than the building along all axes. Simulations state
/// metres.
void tell_size(const SceneDescription& scene, const Medium& m, const Bounds& building,
               Findings& out) {
  if (m.kind != MediumKind::data_set || m.data.nx == 0 || is_of_simulation(scene, m)) return;
  const glm::dvec3 size = building.high - building.low;
  // Along its own axes the building is at most this large.
  const glm::dmat3 axes = glm::transpose(m.frame.axes);
  glm::dvec3 along(0);
  for (int axis = 0; axis < 3; ++axis) along += glm::abs(axes[axis] * size[axis]);
  if (glm::any(glm::lessThanEqual(along, glm::dvec3(0)))) return;
  const glm::dvec3 ratio = m.data.extent / along;
  const double least = std::min({ratio.x, ratio.y, ratio.z});
  const double most = std::max({ratio.x, ratio.y, ratio.z});
  if (least > larger_than_built)
    out.push_back(
        {least > absurdly_larger ? Severity::error : Severity::warning,
         "media",
         {m.place,
          fmt::format("{} is {:.4g} times as large as the building of {:.3g} x "
                      "{:.3g} x {:.3g} m, so that most of its smoke lies outside "
                      "of it{}",
                      medium_text(m), least, along.x, along.y, along.z, unit_words(least))}});
  else if (most < smaller_than_built)
    out.push_back({Severity::warning,
                   "media",
                   {m.place, fmt::format("{} has {:.2g} of the size of the building, so that the "
                                         "air around it is clear{}",
                                         medium_text(m), most, unit_words(most))}});
}

}  // namespace

void inspect_reach(const SceneDescription& scene, Findings& out) {
  const Bounds building = built(scene);
  if (building.empty()) return;
  const Remoteness remote(scene);
  for (const Medium& m : scene.media) {
    tell_size(scene, m, building, out);
    const Medium* one = &m;
    const Bounds box = media_bounds({&one, 1}, everywhere);
    if (box.empty()) continue;
    if (!apart(box, building)) {
      tell_layers(m, building, out);
      continue;
    }
    const glm::dvec3 nearest = glm::clamp((building.low + building.high) * 0.5, box.low, box.high);
    if (auto far = remote.told(medium_text(m), nearest))
      out.push_back({Severity::error, "far", {m.place, *far}});
    else if (!m.emission)
      out.push_back(
          {Severity::warning,
           "media",
           {m.place, medium_text(m) + " lies outside the building, with all of it: it dims "
                                      "nothing; are its place and its heights in metres?"}});
  }
}

void inspect_smoke_places(const Building& smoky, Findings& out) {
  const auto& media = smoky.scene().description->media;
  for (size_t i = 0; i < media.size(); ++i) {
    const Medium& m = media[i];
    if (m.emission && m.kind != MediumKind::data_set) continue;    // a flame
    if (m.simulation || m.kind == MediumKind::data_set) continue;  // its meshes extend outside
    const SmokePlaces smoke(smoky, i);
    if (!smoke.any()) continue;
    const glm::dvec2 low(smoke.box().low), high(smoke.box().high);
    const double outside = smoke.outside(low, high);
    if (outside <= fits_inside) continue;
    std::string meant;
    // y before x; and [[x, x], [y, y]] for [[x, y], [x, y]], whose corners are kept sorted.
    const std::pair<glm::dvec2, glm::dvec2> orders[] = {{{low.y, low.x}, {high.y, high.x}},
                                                        {{low.x, high.x}, {low.y, high.y}},
                                                        {{high.x, low.x}, {high.y, low.y}}};
    for (const auto& [from, to] : orders) {
      if (glm::any(glm::greaterThanEqual(from, to))) continue;
      const double left = smoke.outside(from, to);
      if (left > fits_inside || outside - left < brings_in) continue;
      meant = fmt::format(
          "; with its numbers in another order, box = {}, {} would: 'box' is two "
          "opposite corners, [[x, y], [x, y]]",
          corners_text(from, to), left > 0 ? percent_text(left) : "nothing");
      break;
    }
    // A box around the whole building loses no smoke.
    const Bounds building = built(*smoky.scene().description);
    const bool around = glm::all(glm::lessThanEqual(low, glm::dvec2(building.low))) &&
                        glm::all(glm::greaterThanEqual(high, glm::dvec2(building.high)));
    const bool turned = !meant.empty();
    // inspect_reach reports smoke that is entirely outside.
    if (!turned && (around || outside <= mostly_outside || apart(smoke.box(), building))) continue;
    if (!turned) meant = ", where it dims nothing that is judged: is its place right?";
    const bool matters = turned && judges_people(*smoky.scene().description);
    out.push_back({matters ? Severity::warning : Severity::note,
                   "media",
                   {m.place, percent_text(outside) + " of the smoke of " + medium_text(m) +
                                 " lies outside the building" + meant}});
  }
}

void inspect_flames(const Building& smoky, Findings& out, std::vector<char>& misplaced) {
  const auto& media = smoky.scene().description->media;
  misplaced.resize(media.size(), 0);
  for (size_t i = 0; i < media.size(); ++i) {
    const Medium& m = media[i];
    if (!m.emission || m.kind != MediumKind::bounded) continue;
    const BurningPoints burning = burning_of(smoky, i);
    if (burning.all == 0) continue;
    const auto percent = [&](int part) {
      return percent_text(static_cast<double>(part) / burning.all);
    };
    if (2 * burning.in_bodies > burning.all)
      out.push_back({Severity::error,
                     "inside",
                     {m.place, medium_text(m) + " lies inside a wall or body, with " +
                                   percent(burning.in_bodies) + " of it: move it out"}});
    else if (burning.outside == burning.all && !burning.around)
      out.push_back(
          {Severity::note, "outside", {m.place, medium_text(m) + " burns outside the building"}});
    else if (burning.outside > overlap_share * burning.all)
      out.push_back({Severity::warning,
                     "outside",
                     {m.place, medium_text(m) + " burns outside the building with " +
                                   percent(burning.outside) +
                                   " of it: move it into the room, or "
                                   "make it smaller"}});
    else
      continue;
    misplaced[i] = 1;
  }
  for (size_t b = 0; b < media.size(); ++b)
    for (size_t a = 0; a < b; ++a) {
      if (!media[a].emission || !media[b].emission) continue;
      const Medium *first = &media[a], *second = &media[b];
      const Bounds x = media_bounds({&first, 1}, everywhere);
      const Bounds y = media_bounds({&second, 1}, everywhere);
      if (glm::length(x.low - y.low) + glm::length(x.high - y.high) >= one_flame_m) continue;
      out.push_back({Severity::warning,
                     "same place",
                     {second->place,
                      fmt::format("{} burns where {} (line {}) does: its light "
                                  "counts twice; remove one of them",
                                  medium_text(*second), medium_text(*first), first->place.line)}});
    }
}

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
