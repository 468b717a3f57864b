// Places are found in this order: over routes along their centre line, then over open areas, then
// over task areas. Of two places close to each other the first is kept.
#include "actors/judge/design/candidates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "actors/judge/assess/code_light.hpp"
#include "actors/judge/assess/storey_floor.hpp"
#include "actors/judge/design/wall_places.hpp"
#include "actors/judge/design/wall_probe.hpp"
#include "scenes/emergency/rule_limits.hpp"
#include "scenes/emergency/way.hpp"
#include "scenes/light/geometry/transform.hpp"

namespace luxodus {

namespace {

/// Height above the floor from which a ceiling is searched, and largest distance [m].
constexpr double above_floor_m = 0.05, highest_m = 200;
/// Two places nearer than this share of the spacing are merged.
constexpr double one_place = 0.5;
/// Wider routes get several rows of places [m].
constexpr double one_row_width_m = 2.5;
/// Number of directions in which walls beside a place are searched.
constexpr int wall_directions = 16;
/// Places are rounded to a millimetre [m].
constexpr double told_m = 1e-3;
/// A luminaire faces down if its aim is within half a degree of it [cosine].
constexpr double looks_down = 0.99996;
/// Luminaires on walls whose aims differ by less are of one kind [deg].
constexpr double same_aim_deg = 1;
/// An intensity that varies less over the azimuth, as a share of its largest value, has no
/// direction.
constexpr double even_share = 0.02;

/// A point on the floor over which a candidate may hang.
struct Spot {
  glm::dvec3 floor;
  double heading_deg = 0;   // of the route below it; 0 over areas
  std::optional<double> z;  // height, if the scene states it
};

double heading_of(const glm::dvec3& way) {
  return std::atan2(way.y, way.x) * 180 / std::numbers::pi;
}

void add_over_route(const EscapeRoute& route, double spacing_m, std::vector<Spot>& out) {
  const int more = route.width_m <= one_row_width_m
                       ? 0
                       : static_cast<int>(std::ceil(route.width_m / spacing_m)) - 1;
  for (size_t i = 1; i < route.path.size(); ++i) {
    EscapeRoute leg = route;
    leg.path = {route.path[i - 1], route.path[i]};
    const double heading = heading_of(leg.path[1] - leg.path[0]);
    for (int row = 0; row <= more; ++row) {
      const double aside = more == 0 ? 0 : route.width_m * ((row + 0.5) / (more + 1) - 0.5);
      for (const glm::dvec3& p : along(leg, aside, spacing_m))
        out.push_back({p, heading, std::nullopt});
    }
  }
}

std::vector<Spot> spots_of(const SceneDescription& scene, const DesignSettings& design,
                           const Building& building) {
  std::vector<Spot> out;
  if (!design.places.empty()) {
    const auto floors = storey_floors(scene, building, design.places);
    for (size_t i = 0; i < floors.size(); ++i) {
      const glm::dvec3& p = design.places[i];
      out.push_back({{p.x, p.y, floors[i].value_or(p.z)}, 0, p.z});
    }
    return out;
  }
  for (const EscapeRoute& route : scene.routes)
    if (is_wanted(design, route.name)) add_over_route(route, design.spacing_m, out);
  for (const auto* areas : {&scene.open_areas, &scene.task_areas})
    for (const AssessedArea& area : *areas)
      if (is_wanted(design, area.name))
        for (const glm::dvec3& p : within(area, design.wall_clearance_m, design.spacing_m))
          out.push_back({p, 0, std::nullopt});
  return out;
}

/// Whether the intensity of a type depends on the azimuth around its aim.
bool has_direction(const Emitter& e) {
  if (e.distribution != Distribution::web) return e.shape == EmitterShape::tube;
  constexpr int azimuths = 24, polars = 9;
  for (int p = 1; p <= polars; ++p) {
    const double polar = p * std::numbers::pi / 2 / polars;
    double low = e.web->peak_cd(), high = 0;
    for (int a = 0; a < azimuths; ++a) {
      const double azimuth = 2 * std::numbers::pi * a / azimuths;
      const double candela =
          e.web->intensity({std::sin(polar) * std::cos(azimuth),
                            std::sin(polar) * std::sin(azimuth), -std::cos(polar)});
      low = std::min(low, candela);
      high = std::max(high, candela);
    }
    if (high - low > even_share * e.web->peak_cd()) return true;
  }
  return false;
}

glm::dvec3 rounded(const glm::dvec3& place) {
  return glm::round(place / told_m) * told_m;
}

/// Rotations of a type over a route with this heading.
std::vector<double> rotations_of(const DesignType& type, double heading_deg) {
  std::vector<double> turns = type.turns_deg;
  // A type without a direction gets no rotation, which nobody could see on site.
  if (turns.empty() && !has_direction(type.emitter)) return {0};
  if (turns.empty()) turns = {0, 90};
  for (double& turn : turns) turn = std::remainder(heading_deg + turn, 360.0);
  return turns;
}

class PlaceFinder {
 public:
  PlaceFinder(const SceneDescription& scene, const DesignSettings& design, const Building& bare,
              const Building& furnished)
      : scene_(scene), design_(design), bare_(bare), furnished_(furnished) {}

  /// Spots over which luminaires can hang, each at its mounting height.
  std::vector<Spot> find(LeftOut& left_out) const {
    const std::vector<Spot> spots = spots_of(scene_, design_, bare_);
    enum class Fate : char { good, no_ceiling, in_body, near_wall };
    std::vector<Fate> fates(spots.size(), Fate::good);
    std::vector<double> heights(spots.size(), 0);
    bare_.each(spots.size(), [&](const GeometryAccess& access, size_t i) {
      const auto z = spots[i].z ? spots[i].z : mounting_z(access, spots[i].floor);
      if (z)
        heights[i] = *z;
      else
        fates[i] = Fate::no_ceiling;
    });
    furnished_.each(spots.size(), [&](const GeometryAccess& access, size_t i) {
      if (fates[i] != Fate::good) return;
      const glm::dvec3 p(spots[i].floor.x, spots[i].floor.y, heights[i]);
      if (furnished_.in_solid(access, p))
        fates[i] = Fate::in_body;
      else if (near_wall(access, p))
        fates[i] = Fate::near_wall;
    });
    std::vector<Spot> out;
    for (size_t i = 0; i < spots.size(); ++i) {
      const glm::dvec3 p(spots[i].floor.x, spots[i].floor.y, heights[i]);
      const bool again = std::any_of(out.begin(), out.end(), [&](const Spot& other) {
        return glm::length(glm::dvec2(other.floor - p)) < one_place * apart() &&
               std::abs(*other.z - p.z) < storey_m;
      });
      if (again) continue;
      if (fates[i] == Fate::no_ceiling)
        ++left_out.no_ceiling;
      else if (fates[i] == Fate::in_body)
        ++left_out.in_bodies;
      else if (fates[i] == Fate::near_wall)
        ++left_out.near_walls;
      else if (near_sign(scene_, p, design_.sign_clearance_m))
        ++left_out.near_signs;
      else if (kept_out(scene_, design_, p))
        ++left_out.keep_out;
      else
        out.push_back({spots[i].floor, spots[i].heading_deg, p.z});
    }
    return out;
  }

  /// Mounting height over a point on the floor; none if it is not allowed.
  std::optional<double> height_over(const glm::dvec3& floor) const {
    std::optional<double> z;
    bare_.each(1, [&](const GeometryAccess& access, size_t) { z = mounting_z(access, floor); });
    if (!z) return std::nullopt;
    const glm::dvec3 p(floor.x, floor.y, *z);
    bool good = true;
    furnished_.each(1, [&](const GeometryAccess& access, size_t) {
      good = !furnished_.in_solid(access, p) && !near_wall(access, p);
    });
    if (!good || near_sign(scene_, p, design_.sign_clearance_m) || kept_out(scene_, design_, p))
      return std::nullopt;
    return z;
  }

 private:
  /// Smallest distance of two places; listed places are only merged if they coincide.
  double apart() const { return design_.places.empty() ? design_.spacing_m : 0.02; }

  std::optional<double> mounting_z(const GeometryAccess& access, const glm::dvec3& floor) const {
    const auto stop =
        wall_distance(bare_, access, floor + glm::dvec3(0, 0, above_floor_m), {0, 0, 1}, highest_m);
    const double ceiling = stop ? floor.z + above_floor_m + *stop : 0;
    if (!design_.mounting_height_m) {
      if (!stop) return std::nullopt;
      return ceiling - design_.drop_m;
    }
    const double z = floor.z + *design_.mounting_height_m;
    if (stop && z > ceiling) return std::nullopt;
    return z;
  }

  bool near_wall(const GeometryAccess& access, const glm::dvec3& p) const {
    if (!(design_.wall_clearance_m > 0)) return false;
    for (int i = 0; i < wall_directions; ++i) {
      const double azimuth = 2 * std::numbers::pi * (i + 0.5) / wall_directions;
      const glm::dvec3 aside(std::cos(azimuth), std::sin(azimuth), 0);
      if (wall_distance(furnished_, access, p, aside, design_.wall_clearance_m)) return true;
    }
    return false;
  }

  const SceneDescription& scene_;
  const DesignSettings& design_;
  const Building& bare_;
  const Building& furnished_;
};

/// Whether an existing luminaire is fixed, movable or removed.
ExistingTreatment fate_of(const DesignSettings& design, const std::string& name) {
  const auto in = [&](const std::vector<std::string>& list) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  if (in(design.fixed)) return ExistingTreatment::fixed;
  if (in(design.movable)) return ExistingTreatment::movable;
  if (in(design.removable)) return ExistingTreatment::removable;
  if (in(design.removed)) return ExistingTreatment::removed;
  return design.existing;
}

void add_existing(const SceneDescription& scene, const DesignSettings& design, Candidates& out) {
  for (const uint32_t number : emergency_luminaires(scene)) {
    const Emitter& e = scene.emitters[number];
    const ExistingTreatment fate = fate_of(design, e.name);
    if (fate == ExistingTreatment::removed) {
      out.removed.push_back(e.name);
      continue;
    }
    LuminaireCandidate one;
    one.place = static_cast<uint32_t>(out.all.size());
    one.position = one.floor = e.frame.origin;
    one.name = e.name;
    // A mesh cannot be moved: its corners are where its file says.
    const bool movable = fate == ExistingTreatment::movable && e.shape != EmitterShape::mesh;
    one.fixed =
        fate == ExistingTreatment::fixed || (fate == ExistingTreatment::movable && !movable);
    if (movable) one.pool = MovablePool{};
    out.all.push_back(std::move(one));
  }
}

/// A type whose circuit the judged state switches off gives no light.
bool gives_light(const DesignType& type) {
  return type.emitter.emergency_flux > 0;
}

/// Why a type's battery does not last as long as all rules require; none if it does, or if no
/// duration is stated.
std::optional<UnusedType> too_short(const DesignType& type, const std::vector<CodeChoice>& codes) {
  constexpr double hour_s = 3600, share = 1 - 1e-9;
  if (!type.emitter.duration_s) return std::nullopt;
  const double hours = *type.emitter.duration_s / hour_s;
  for (const CodeChoice& one : codes)
    if (const double asked = rated_duration_h(one); hours < asked * share)
      return UnusedType{type.name, named(one.set).edition, hours, asked};
  return std::nullopt;
}

std::vector<UnusedType> unused_types(const DesignSettings& design,
                                     const std::vector<CodeChoice>& codes) {
  std::vector<UnusedType> out;
  for (const DesignType& type : design.types)
    if (auto one = too_short(type, codes)) out.push_back(*std::move(one));
  return out;
}

bool is_unused(const Candidates& candidates, const DesignType& type) {
  return std::any_of(candidates.unused.begin(), candidates.unused.end(),
                     [&](const UnusedType& one) { return one.name == type.name; });
}

/// Movable luminaires of one kind on one storey.
struct MovableKind {
  const Emitter* emitter;           // of the first of them
  std::optional<double> floor_z{};  // of their storey
  MovablePool pool;
  std::vector<size_t> at{};  // indices of the candidates

  /// A luminaire that does not face down hangs on a wall.
  bool on_wall() const { return emitter->frame.axes[2].z < looks_down; }
  double aim_deg() const {
    return std::acos(std::clamp(emitter->frame.axes[2].z, -1.0, 1.0)) * 180 / std::numbers::pi;
  }
  /// Without a floor below, the heights of luminaires decide on the storey.
  bool is_on_storey(double floor, double height) const {
    return std::abs(floor_z ? floor - *floor_z : height - emitter->frame.origin.z) < storey_m;
  }
};

/// Numbers the pools of movable luminaires.
std::vector<MovableKind> find_pools(const SceneDescription& scene, const Building& building,
                                    std::vector<LuminaireCandidate>& existing) {
  std::vector<MovableKind> out;
  std::vector<glm::dvec3> places;
  for (const LuminaireCandidate& one : existing) places.push_back(one.position);
  const auto floors = storey_floors(scene, building, places);
  for (size_t i = 0; i < existing.size(); ++i) {
    if (!existing[i].pool) continue;
    const Emitter& e = *std::find_if(scene.emitters.begin(), scene.emitters.end(),
                                     [&](const Emitter& o) { return o.name == existing[i].name; });
    const auto& floor = floors[i];
    MovableKind kind{&e, floor, {static_cast<uint32_t>(out.size()), 0}};
    auto at = std::find_if(out.begin(), out.end(), [&](const MovableKind& other) {
      return same_light(e, *other.emitter) && e.circuit == other.emitter->circuit &&
             kind.on_wall() == other.on_wall() &&
             std::abs(kind.aim_deg() - other.aim_deg()) < same_aim_deg &&
             floor.has_value() == other.floor_z.has_value() &&
             other.is_on_storey(floor.value_or(0), e.frame.origin.z);
    });
    if (at == out.end()) at = out.insert(out.end(), kind);
    ++at->pool.size;
    at->at.push_back(i);
  }
  for (const MovableKind& kind : out)
    for (const size_t i : kind.at) existing[i].pool = kind.pool;
  return out;
}

/// Adds candidates for places to which existing luminaires may be moved. `first`: index of the
/// first place.
void add_moves(const std::vector<MovableKind>& kinds, const std::vector<Spot>& spots,
               const std::vector<WallSpot>& walls, uint32_t first, Candidates& out) {
  for (const MovableKind& kind : kinds) {
    LuminaireCandidate one;
    one.name = kind.emitter->name;
    one.pool = kind.pool;
    one.moved = true;
    DesignType type;
    type.emitter = *kind.emitter;
    for (uint32_t s = 0; s < spots.size() && !kind.on_wall(); ++s) {
      if (!kind.is_on_storey(spots[s].floor.z, *spots[s].z)) continue;
      one.place = first + s;
      one.position = rounded({spots[s].floor.x, spots[s].floor.y, *spots[s].z});
      one.floor = spots[s].floor;
      for (const double rotation_deg : rotations_of(type, spots[s].heading_deg)) {
        one.rotation_deg = rotation_deg;
        out.all.push_back(one);
      }
    }
    one.rotation_deg = 0;
    for (uint32_t s = 0; s < walls.size() && kind.on_wall(); ++s) {
      if (!kind.is_on_storey(walls[s].floor.z, walls[s].position.z)) continue;
      one.place = static_cast<uint32_t>(first + spots.size()) + s;
      one.position = walls[s].position;
      one.floor = walls[s].floor;
      one.outward = walls[s].outward;
      one.aim = aim_from_wall(walls[s].outward, kind.aim_deg());
      out.all.push_back(one);
    }
  }
}

void add_new(const DesignSettings& design, const std::vector<Spot>& spots,
             const std::vector<WallSpot>& walls, Candidates& out) {
  const auto placed = [&](const DesignType& type) {
    return gives_light(type) && !is_unused(out, type);
  };
  const auto first = static_cast<uint32_t>(out.all.size());
  for (uint32_t s = 0; s < spots.size(); ++s)
    for (size_t t = 0; t < design.types.size(); ++t) {
      if (design.types[t].mount == LuminaireMount::wall || !placed(design.types[t])) continue;
      for (const double rotation_deg : rotations_of(design.types[t], spots[s].heading_deg)) {
        LuminaireCandidate one;
        one.type = t;
        one.place = first + s;
        one.position = rounded({spots[s].floor.x, spots[s].floor.y, *spots[s].z});
        one.floor = spots[s].floor;
        one.rotation_deg = rotation_deg;
        out.all.push_back(std::move(one));
      }
    }
  const auto first_wall = static_cast<uint32_t>(first + spots.size());
  for (uint32_t s = 0; s < walls.size(); ++s)
    for (size_t t = 0; t < design.types.size(); ++t) {
      if (design.types[t].mount == LuminaireMount::ceiling || !placed(design.types[t])) continue;
      auto turns = design.types[t].turns_deg;
      if (turns.empty()) turns = {0};
      for (const double turn : turns) {
        LuminaireCandidate one;
        one.type = t;
        one.place = first_wall + s;
        one.position = walls[s].position;
        one.floor = walls[s].floor;
        one.outward = walls[s].outward;
        one.aim = aim_from_wall(walls[s].outward, design.types[t].aim_deg);
        one.rotation_deg = turn;
        out.all.push_back(std::move(one));
      }
    }
  out.places = spots.size() + walls.size();
}

/// Whether any type is mounted in this way.
bool any_mounted(const DesignSettings& design, LuminaireMount mount) {
  return std::any_of(design.types.begin(), design.types.end(), [&](const DesignType& type) {
    return type.mount == mount || type.mount == LuminaireMount::both;
  });
}

/// Removes candidates that glare or hang too low, since no other luminaire changes that.
void leave_out_forbidden(const SceneDescription& scene, const DesignSettings& design,
                         const std::vector<CodeChoice>& codes, const Building& bare,
                         Candidates& out) {
  const SceneDescription all = scene_of(scene, design, out.all);
  const CodeLight light(all, bare);
  std::vector<std::optional<double>> floors;
  const FloorUnder floor = [&](const glm::dvec3& p) { return light.floor_under(p); };
  std::set<size_t> low, glaring;
  const auto take = [&](const std::vector<Check>& checks, std::set<size_t>& to) {
    for (size_t i = 0; i < checks.size(); ++i)
      if (checks[i].verdict == CheckVerdict::fail) to.insert(i);
  };
  // Checks of luminaires are in the order of the luminaires.
  for (const CodeChoice& choice : codes) {
    take(checks_of_height(all, choice, floor), low);
    take(checks_of_glare(all, choice, floor), glaring);
  }
  std::vector<LuminaireCandidate> good;
  for (size_t i = 0; i < out.all.size(); ++i) {
    const LuminaireCandidate& one = out.all[i];
    const bool forbidden = low.contains(i) || glaring.contains(i);
    if (forbidden && one.pool && !one.moved) {
      good.push_back(one);
      good.back().barred = true;
      continue;
    }
    if (forbidden && !one.fixed) {
      ++(low.contains(i) ? out.left_out.too_low : out.left_out.glaring);
      if (one.type == LuminaireCandidate::existing && !one.moved) out.removed.push_back(one.name);
      continue;
    }
    good.push_back(one);
  }
  out.all = std::move(good);
}

/// Sets the position, facing down or as its wall requires.
void put_in_frame(Emitter& e, const LuminaireCandidate& candidate) {
  const glm::dvec3 aim = candidate.aim.value_or(glm::dvec3(0, 0, -1));
  e.frame = frame_aiming(candidate.position, aim, {0, 0, 1}).value();
  // Like `rotation_deg` of a luminaire: around local z.
  e.frame.axes = e.frame.axes * rotation({0, 0, 1}, candidate.rotation_deg).value().linear;
}

/// Errors: a luminaire that must not stay has no place to go to.
Result<void> all_may_hang_somewhere(const DesignSettings& design, const Candidates& candidates) {
  std::map<uint32_t, std::set<uint32_t>> places;  // by pool
  for (const LuminaireCandidate& one : candidates.all)
    if (one.pool && !one.barred) places[one.pool->number].insert(one.place);
  for (const LuminaireCandidate& one : candidates.all)
    if (one.barred && places[one.pool->number].size() < one.pool->size)
      return problem_in(design.place,
                        "the movable luminaire \"" + one.name +
                            "\" glares (E8) or hangs too low (E14) where it is, and there is no "
                            "place to move it to: name it in 'removable', or offer more places");
  return {};
}

/// Bodies of existing luminaires must not count as walls, so the building is taken without them.
SceneDescription without_bodies(const SceneDescription& scene, const DesignSettings& design) {
  SceneDescription out = scene;
  for (Emitter& e : out.emitters) e.body_material.clear();
  if (out.emitters.empty()) out.emitters.push_back(some_light(design));
  return out;
}

std::string words_of(const LeftOut& left) {
  std::string out;
  const auto add = [&](size_t count, const char* why) {
    if (count > 0) out += fmt::format("{}{} {}", out.empty() ? "" : ", ", count, why);
  };
  add(left.no_ceiling, "without a ceiling above (give 'mounting_height_m')");
  add(left.in_bodies, "in bodies");
  add(left.near_walls, "nearer to a wall than 'wall_clearance_m'");
  add(left.near_signs, "nearer to a sign than 'sign_clearance_m'");
  add(left.keep_out, "in keep-out zones");
  add(left.no_wall, "where no wall is flat");
  add(left.too_low, "less than 2 m above the floor (E14)");
  add(left.glaring, "that glare (E8)");
  return out;
}

}  // namespace

std::string unused_words(const UnusedType& type) {
  return fmt::format("type \"{}\" is not placed: it lasts {:g} h, and {} asks for {:g} h",
                     type.name, type.lasts_h, type.rules, type.asked_h);
}

const Emitter& some_light(const DesignSettings& design) {
  const auto lit = std::find_if(design.types.begin(), design.types.end(), gives_light);
  return (lit == design.types.end() ? design.types.front() : *lit).emitter;
}

bool is_wanted(const DesignSettings& design, const std::string& name) {
  return design.over.empty() ||
         std::find(design.over.begin(), design.over.end(), name) != design.over.end();
}

Result<void> gives_any_light(const DesignSettings& design) {
  if (std::any_of(design.types.begin(), design.types.end(), gives_light)) return {};
  return problem_in(design.place,
                    "no type of luminaire gives light in the judged scenario, whose 'circuits' "
                    "switch them all off: take another scenario, or types on other circuits");
}

bool near_sign(const SceneDescription& scene, const glm::dvec3& p, double clearance_m) {
  return std::any_of(scene.signs.begin(), scene.signs.end(), [&](const Sign& sign) {
    return glm::length(glm::dvec2(sign.frame.origin - p)) < clearance_m &&
           std::abs(sign.frame.origin.z - p.z) < 2 * storey_m;
  });
}

bool kept_out(const SceneDescription& scene, const DesignSettings& design, const glm::dvec3& p) {
  const auto floor = floor_below(scene, p);
  return std::any_of(design.keep_outs.begin(), design.keep_outs.end(), [&](const KeepOut& zone) {
    const auto its_floor = floor_below(scene, zone.position);
    const bool here = floor && its_floor ? std::abs(*floor - *its_floor) < storey_m
                                         : std::abs(zone.position.z - p.z) < 2 * storey_m;
    return here && glm::length(glm::dvec2(zone.position - p)) < zone.radius_m;
  });
}

Emitter emitter_of(const SceneDescription& scene, const DesignSettings& design,
                   const LuminaireCandidate& candidate) {
  if (candidate.type == LuminaireCandidate::existing) {
    const auto at = std::find_if(scene.emitters.begin(), scene.emitters.end(),
                                 [&](const Emitter& e) { return e.name == candidate.name; });
    if (!candidate.moved) return *at;
    Emitter e = *at;
    put_in_frame(e, candidate);
    return e;
  }
  Emitter e = design.types[candidate.type].emitter;
  put_in_frame(e, candidate);
  return e;
}

SceneDescription scene_of(const SceneDescription& scene, const DesignSettings& design,
                          const std::vector<LuminaireCandidate>& candidates) {
  SceneDescription out = scene;
  out.emitters.clear();
  for (size_t i = 0; i < candidates.size(); ++i) {
    Emitter e = emitter_of(scene, design, candidates[i]);
    e.name = std::to_string(i);
    if (!candidates[i].fixed) e.body_material.clear();
    out.emitters.push_back(std::move(e));
  }
  return out;
}

struct PlaceCheck::Parts {
  SceneDescription scene;
  const DesignSettings& design;
  std::unique_ptr<Building> bare, furnished;
};

PlaceCheck::PlaceCheck(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
PlaceCheck::~PlaceCheck() = default;

Result<std::unique_ptr<PlaceCheck>> PlaceCheck::make(const SceneDescription& scene,
                                                     const DesignSettings& design,
                                                     const Scenario& doors, int threads) {
  auto parts = std::make_unique<Parts>(Parts{without_bodies(scene, design), design, {}, {}});
  for (const bool with_furniture : {false, true}) {
    auto made = Building::make(code_scene(parts->scene, with_furniture),
                               code_scenario(parts->scene, doors), threads);
    if (!made) return made.problem();
    (with_furniture ? parts->furnished : parts->bare) = std::move(made).value();
  }
  return std::unique_ptr<PlaceCheck>(new PlaceCheck(std::move(parts)));
}

std::optional<PlaceCheck::Place> PlaceCheck::place_over(const glm::dvec2& plan,
                                                        const glm::dvec3& near) const {
  const auto floor = floor_below(parts_->scene, {plan, near.z});
  if (!floor) return std::nullopt;
  const auto z = PlaceFinder(parts_->scene, parts_->design, *parts_->bare, *parts_->furnished)
                     .height_over({plan, *floor});
  if (!z || std::abs(*z - near.z) > storey_m) return std::nullopt;
  return Place{rounded({plan, *z}), {plan, *floor}};
}

Result<Candidates> find_candidates(const SceneDescription& scene, const DesignSettings& design,
                                   const std::vector<CodeChoice>& codes, const Scenario& doors,
                                   int threads) {
  const SceneDescription dark = without_bodies(scene, design);
  const auto bare = Building::make(code_scene(dark, false), code_scenario(dark, doors), threads);
  if (!bare) return bare.problem();
  const auto furnished =
      Building::make(code_scene(dark, true), code_scenario(dark, doors), threads);
  if (!furnished) return furnished.problem();
  Candidates out;
  out.unused = unused_types(design, codes);
  add_existing(scene, design, out);
  const auto existing = static_cast<uint32_t>(out.all.size());
  const std::vector<MovableKind> kinds = find_pools(scene, *bare.value(), out.all);
  const auto any_moves = [&](bool on_wall) {
    return std::any_of(kinds.begin(), kinds.end(),
                       [&](const MovableKind& kind) { return kind.on_wall() == on_wall; });
  };
  std::vector<Spot> spots;
  if (any_mounted(design, LuminaireMount::ceiling) || any_moves(false))
    spots = PlaceFinder(scene, design, *bare.value(), *furnished.value()).find(out.left_out);
  std::vector<WallSpot> walls;
  if (any_mounted(design, LuminaireMount::wall) || any_moves(true))
    walls = wall_spots(scene, design, *bare.value(), *furnished.value(), out.left_out);
  if (const size_t places = spots.size() + walls.size(); places > limits::design_places)
    return problem_in(design.place, fmt::format("there are {} candidate places, and at most {} are "
                                                "taken: make 'spacing_m' larger, or say 'over'",
                                                places, limits::design_places));
  add_new(design, spots, walls, out);
  add_moves(kinds, spots, walls, existing, out);
  // Candidates of one place are consecutive: what hides the first hides all of them.
  std::stable_sort(out.all.begin(), out.all.end(),
                   [](const auto& a, const auto& b) { return a.place < b.place; });
  if (out.all.size() > limits::design_candidates)
    return problem_in(
        design.place,
        fmt::format("there are {} candidates ({} places, types and turns), and at most "
                    "{} are taken: make 'spacing_m' larger",
                    out.all.size(), out.places, limits::design_candidates));
  if (!out.all.empty()) leave_out_forbidden(scene, design, codes, *bare.value(), out);
  if (auto ok = all_may_hang_somewhere(design, out); !ok) return ok.problem();
  if (out.all.size() == existing &&
      std::all_of(out.all.begin(), out.all.end(),
                  [](const LuminaireCandidate& c) { return c.fixed; })) {
    if (auto ok = gives_any_light(design); !ok) return ok.problem();
    if (out.unused.size() == design.types.size())
      return problem_in(design.place, "no type of luminaire lasts as long as the rules ask for: " +
                                          unused_words(out.unused.front()));
    const std::string why = words_of(out.left_out);
    return problem_in(design.place, "there is no place for a luminaire" +
                                        (why.empty() ? std::string(": no route or area is there to "
                                                                   "place any over")
                                                     : "; left out were " + why));
  }
  return out;
}

}  // namespace luxodus
