#include "actors/judge/walkers/walkers_in_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "actors/judge/assess/plan_cut.hpp"
#include "actors/judge/walk/wall_check.hpp"
#include "actors/judge/walkers/scene_eyes.hpp"
#include "scenes/emergency/way.hpp"
#include "scenes/light/transport/surroundings.hpp"

namespace luxodus {

namespace {

/// Spacing of the eyes among which places to trace from are chosen [m]; more on floors so large
/// that estimates would have more pairs of eyes and signs than they can.
constexpr double eyes_apart_m = 0.25;
/// Height at which it is asked whether a place is outdoors [m].
constexpr double breast_m = 1.2;
/// Edge of the squares of which that is asked [m]: less than a body's width and a wall.
constexpr double indoors_edge_m = 0.5;
/// Shares of the work: floor, estimates of signs; the rest is walking.
constexpr double floor_share = 0.02, signs_share = 0.9;

const AssessedArea* area_named(const SceneDescription& scene, const std::string& name) {
  for (const auto* areas : {&scene.rooms, &scene.open_areas})
    for (const AssessedArea& area : *areas)
      if (area.name == name) return &area;
  return nullptr;
}

Result<double> floor_of(const WalkersRequest& request, const AssessedArea* within) {
  if (request.floor_m) return *request.floor_m;
  if (within != nullptr) return within->z_m;
  const SceneDescription& scene = *request.states.last;
  const std::vector<double> floors = floors_of(scene);
  if (floors.size() == 1) return floors.front();
  if (floors.empty())
    return problem_in(scene.file,
                      "no [[route]] says how people leave: they need one, whose path "
                      "ends where they are out");
  return problem_in(
      scene.file,
      fmt::format("routes and open areas lie on {} storeys, from {:g} to {:g} m, and people walk "
                  "on one: give its height by --floor-m",
                  floors.size(), floors.front(), floors.back()));
}

/// Signs that lead along a route of this floor, by number of the scene.
std::vector<uint32_t> leading_signs(const SceneDescription& scene, const WaysOut& ways) {
  std::vector<uint32_t> out;
  for (uint32_t s = 0; s < scene.signs.size(); ++s) {
    const auto& leads = scene.signs[s].leads_to;
    if (std::any_of(leads.begin(), leads.end(), [&](const LeadsTo& one) {
          return std::any_of(ways.ways().begin(), ways.ways().end(),
                             [&](const WayOut& way) { return way.route->name == one.route; });
        }))
      out.push_back(s);
  }
  return out;
}

/// Whether people reach the end of the named way from a cell, or of any if none is named.
bool leads_out(WaysOut& ways, CellNumber from, std::optional<size_t> named = {}) {
  for (size_t way = 0; way < ways.ways().size(); ++way)
    if ((!named || named == way) && std::isfinite(ways.distance_to_end_m(way, from))) return true;
  return false;
}

/// Column and row of a square of the floor.
using Square = std::pair<int64_t, int64_t>;
Square square_at(const FreeSpace& space, const glm::dvec2& place, double edge_m) {
  const glm::dvec2 at = glm::floor((place - space.low()) / edge_m);
  return {static_cast<int64_t>(at.x), static_cast<int64_t>(at.y)};
}

class WalkersInScene {
 public:
  WalkersInScene(const WalkersRequest& request, const std::atomic<bool>& interrupt,
                 const AssessProgress& progress)
      : request_(request),
        scene_(*request.states.last),
        interrupt_(interrupt),
        progress_(progress),
        within_(area_named(scene_, request.within)) {}

  Result<WalkersWalked> run() {
    if (auto ok = check(); !ok) return ok.problem();
    const auto floor = floor_of(request_, within_);
    if (!floor) return floor.problem();
    out_.floor_m = floor.value();
    const auto walls = walls_alone(scene_, scenario_, request_.options.threads);
    if (!walls) return walls.problem();
    const auto space = FreeSpace::make(
        *walls.value(),
        {.floor_m = out_.floor_m, .radius_m = body_radius_m, .cell_m = request_.cell_m});
    if (!space) return space.problem();
    out_.low = space->low();
    out_.high = space->high();
    size_t followed = 0;
    for (const Sign& sign : scene_.signs) followed += sign.leads_to.size();
    auto ways = WaysOut::make(scene_, space.value(), out_.floor_m, followed);
    if (!ways) return ways.problem();
    const auto starts = starts_on(*walls.value(), space.value(), ways.value());
    if (!starts) return starts.problem();
    progress_("floor", floor_share);
    return walk(space.value(), ways.value(), starts.value());
  }

 private:
  Result<void> check() {
    if (auto ok = check_walkable(scene_); !ok) return ok;
    if (auto ok = check_people(request_.people); !ok) return ok;
    if (!request_.within.empty() && within_ == nullptr)
      return problem_in(scene_.file,
                        fmt::format("there is no [[room]] and no open area \"{}\": give another "
                                    "name by --within",
                                    request_.within));
    auto scenario = judged_scenario(scene_, request_.options.scenario);
    if (!scenario) return scenario.problem();
    scenario_ = std::move(scenario).value();
    out_.scenario = scenario_.name;
    return {};
  }

  /// Cells of the stated room from which a way out can be reached, indoors.
  Result<std::vector<CellNumber>> starts_on(const Building& walls, const FreeSpace& space,
                                            WaysOut& ways) const {
    std::optional<size_t> named;
    if (!request_.people.came_by.empty()) {
      const auto way = ways.way_named(request_.people.came_by);
      if (!way) return way.problem();
      named = way.value();
    }
    std::vector<CellNumber> reached;
    for (CellNumber cell = 0; cell < space.cells(); ++cell) {
      if (!space.is_free(cell)) continue;
      if (within_ != nullptr && !is_within(*within_, space.centre(cell), 0)) continue;
      if (leads_out(ways, cell, named)) reached.push_back(cell);
    }
    std::vector<CellNumber> out = indoors(walls, space, reached);
    if (auto ok = check_room(space, out.size()); !ok) return ok.problem();
    return out;
  }

  /// Those of the cells that are not outdoors. One cell is asked for all of a square of half a
  /// metre: free cells on both sides of a wall are farther apart.
  std::vector<CellNumber> indoors(const Building& walls, const FreeSpace& space,
                                  const std::vector<CellNumber>& cells) const {
    std::map<Square, size_t> squares;
    std::vector<glm::dvec3> asked;
    std::vector<size_t> square_of;
    for (const CellNumber cell : cells) {
      const glm::dvec2 place = space.centre(cell);
      const auto [at, is_new] =
          squares.try_emplace(square_at(space, place, indoors_edge_m), asked.size());
      if (is_new) asked.emplace_back(place, out_.floor_m + breast_m);
      square_of.push_back(at->second);
    }
    std::vector<char> outside(asked.size());
    walls.each(asked.size(), [&](const GeometryAccess& access, size_t i) {
      outside[i] = is_outside(walls.scene(), access, walls.local(asked[i])) ? 1 : 0;
    });
    std::vector<CellNumber> out;
    for (size_t i = 0; i < cells.size(); ++i)
      if (outside[square_of[i]] == 0) out.push_back(cells[i]);
    return out;
  }

  Result<void> check_room(const FreeSpace& space, size_t cells) const {
    const std::string where =
        request_.within.empty() ? "the floor" : fmt::format("\"{}\"", request_.within);
    if (cells == 0)
      return problem_in(
          scene_.file,
          fmt::format("from nowhere on {} at {:g} m can people walk to the end of a route: is the "
                      "height of the floor right, are doors [[object]] tables with 'door', and are "
                      "ways wider than {:.2g} m?",
                      where, out_.floor_m, least_width_m(space)));
    const double area_m2 = static_cast<double>(cells) * space.cell_m() * space.cell_m();
    const double most = std::max(1.0, area_m2 * limits::walkers_per_m2);
    if (request_.people.count > most)
      return problem_in(scene_.file,
                        fmt::format("{} people do not fit on the {:.3g} m2 of {} where people can "
                                    "stand: give a --count of at most {:.0f}",
                                    request_.people.count, area_m2, where, std::floor(most)));
    return {};
  }

  /// Ways of this width always have a free cell across them.
  static double least_width_m(const FreeSpace& space) {
    return 2 * body_radius_m + (1 + std::sqrt(2)) * space.cell_m();
  }

  /// Eyes about as far apart as estimates need them, over the cells from which people can leave.
  std::vector<glm::dvec3> eyes_over(const FreeSpace& space, WaysOut& ways) const {
    const double floor_m2 = static_cast<double>(space.cells()) * space.cell_m() * space.cell_m();
    const auto signs = static_cast<double>(std::max<size_t>(1, scene_.signs.size()));
    const double most = std::min(static_cast<double>(limits::estimated_eyes),
                                 static_cast<double>(limits::estimated_pairs) / signs);
    const double apart_m = std::max(eyes_apart_m, std::sqrt(2 * floor_m2 / most));
    std::set<Square> taken;
    std::vector<glm::dvec3> out;
    for (CellNumber cell = 0; cell < space.cells(); ++cell) {
      if (!space.is_free(cell)) continue;
      const glm::dvec2 place = space.centre(cell);
      if (leads_out(ways, cell) && taken.insert(square_at(space, place, apart_m)).second)
        out.emplace_back(place, out_.floor_m + scene_.assessment.eye_heights_m.front());
    }
    return out;
  }

  Result<WalkersWalked> walk(const FreeSpace& space, WaysOut& ways,
                             const std::vector<CellNumber>& starts) {
    out_.start_m2 = static_cast<double>(starts.size()) * space.cell_m() * space.cell_m();
    const PeopleFloor floor{scene_,
                            space,
                            out_.floor_m,
                            scene_.assessment.eye_heights_m.front(),
                            leading_signs(scene_, ways),
                            starts};
    out_.signs = floor.signs.size();
    EyesRequest asked{request_.states, request_.options, {}, eyes_over(space, ways)};
    asked.options.scenario = out_.scenario;
    for (const uint32_t sign : floor.signs) asked.signs.push_back(scene_.signs[sign].name);
    const auto eyes =
        SceneEyes::make(asked, interrupt_, [&](const std::string& what, double share) {
          progress_(what, floor_share + (signs_share - floor_share) * share);
        });
    if (!eyes) return eyes.problem();
    auto walked = walk_people(
        floor, request_.people, ways,
        [&](double time_s, const std::vector<glm::dvec3>& at) -> Result<FoundByEyes> {
          if (interrupt_) return problem("interrupted");
          return eyes.value()->find(time_s, at);
        },
        [&](double share) { progress_("walking", signs_share + (1 - signs_share) * share); });
    if (!walked) return walked.problem();
    out_.walked = std::move(walked).value();
    for (const WayOut& way : ways.ways()) out_.routes.push_back({way.route->name, 0, 0});
    for (const WalkerOutcome& one : out_.walked.people)
      ++(one.left_s ? out_.routes[one.way].left : out_.routes[one.way].inside);
    progress_("all people", 1);
    return std::move(out_);
  }

  const WalkersRequest& request_;
  const SceneDescription& scene_;
  const std::atomic<bool>& interrupt_;
  const AssessProgress& progress_;
  const AssessedArea* within_;
  Scenario scenario_;
  WalkersWalked out_;
};

}  // namespace

Result<WalkersWalked> walk_in_scene(const WalkersRequest& request,
                                    const std::atomic<bool>& interrupt,
                                    const AssessProgress& progress) {
  return WalkersInScene(request, interrupt, progress).run();
}

}  // namespace luxodus
