// The escape routes of one floor as ways to walk: over its free cells to a route, and along it to
// where it ends or leaves the floor by stairs. Fields of distances are made when they are first
// asked for, and kept. Thread rule: one thread.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "actors/judge/walkers/walking_field.hpp"
#include "scenes/light/world/description.hpp"

namespace luxodus {

namespace limits {
/// Cells of all fields of distances together, 8 bytes each.
inline constexpr size_t field_cells = 100'000'000;
}  // namespace limits

/// The part of a route on the floor.
struct WayOut {
  const EscapeRoute* route = nullptr;
  double from_m = 0, to_m = 0;  // along the whole route
  /// Where its line bends, and its end: by distance along the route.
  std::vector<std::pair<double, CellNumber>> bends;
  CellNumber end() const { return bends.back().second; }
};

/// Places at which a way turns, from its begin to its end [m].
using WalkingLine = std::vector<glm::dvec2>;

class WaysOut {
 public:
  /// `followed`: pairs of a sign and a route along which it leads. Requires: scene and space
  /// outlive it. Errors: no route ends on this floor; no free cell at the end of a route; more
  /// cells than the limit.
  static Result<WaysOut> make(const SceneDescription& scene, const FreeSpace& space, double floor_m,
                              size_t followed);

  /// In the order of the scene's routes; at least one.
  const std::vector<WayOut>& ways() const { return ways_; }
  /// The way of a route; none if it does not end on this floor.
  std::optional<size_t> way_of(const EscapeRoute& route) const;
  /// The way of the route with this name. Errors: there is none.
  Result<size_t> way_named(const std::string& name) const;

  /// Shortest distance to the end of a way; infinite where it cannot be reached [m].
  double distance_to_end_m(size_t way, CellNumber from);
  /// The way to the nearest place of a route, as people walk, and then along it; none where it
  /// cannot be reached.
  std::optional<WalkingLine> along(size_t way, CellNumber from);
  /// The way to a place of a route, by its distance along it, and on from there.
  std::optional<WalkingLine> past(size_t way, double along_m, CellNumber from);

 private:
  WaysOut(const SceneDescription& scene, const FreeSpace& space) : scene_(scene), space_(space) {}
  const WalkingField& field_to(const std::vector<CellNumber>& goals);
  /// Adds what follows `line` on the way after a distance along it; false where it is closed off.
  bool go_on(size_t way, double along_m, std::vector<CellNumber>& line);
  WalkingLine places_of(const std::vector<CellNumber>& cells) const;

  const SceneDescription& scene_;
  const FreeSpace& space_;
  std::vector<WayOut> ways_;
  std::vector<std::map<CellNumber, double>> lines_;  // of each way: its cells, by distance along it
  std::map<std::vector<CellNumber>, std::unique_ptr<WalkingField>> fields_;  // by their goals
  std::vector<const WalkingField*> to_end_;  // of each way; null: not asked for yet
  std::map<std::pair<CellNumber, CellNumber>, std::vector<CellNumber>> legs_;
};

}  // namespace luxodus
