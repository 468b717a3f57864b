// Rows for points at which a layout is below a minimum with luminaires off their places. Each
// candidate counts with the least light that it gives there from any place where it may be mounted.
// Every layout whose minima hold off its places satisfies these rows.
#include <algorithm>
#include <limits>

#include "actors/judge/design/demands_lit.hpp"
#include "actors/judge/design/place_tolerance.hpp"

namespace luxodus {

namespace {

/// A candidate that gives less than this share of the requirement at every point is not displaced:
/// it counts with the light from its place.
constexpr double gives_little = 0.01;

/// Indices of candidates that give more at any of the points, or are chosen.
std::vector<uint32_t> worth_moving(const std::vector<PointOffPlace>& points,
                                   const std::vector<std::vector<double>>& planned,
                                   const Layout& layout) {
  std::vector<uint32_t> out;
  for (uint32_t i = 0; i < layout.size(); ++i) {
    bool much = layout[i] != 0;
    for (size_t p = 0; p < points.size() && !much; ++p)
      much = planned[p][i] >= gives_little * points[p].least;
    if (much) out.push_back(i);
  }
  return out;
}

}  // namespace

/// Some of the candidates with their displaced copies, in one building.
class Demands::Displaced {
 public:
  static Result<std::unique_ptr<Displaced>> make(const OffPlaceScene& of,
                                                 const std::vector<LuminaireCandidate>& some) {
    std::unique_ptr<Displaced> out(new Displaced);
    auto copies = displaced_copies(of, some);
    if (!copies) return copies.problem();
    for (const LuminaireCandidate& copy : copies.value()) out->whose_.push_back(copy.place);
    out->count_ = some.size();
    out->scene_ = scene_of(of.scene, of.design, copies.value());
    const bool has_furniture =
        std::any_of(out->scene_.objects.begin(), out->scene_.objects.end(), is_furniture);
    for (const bool furnished : {false, true}) {
      if (furnished && !has_furniture) break;
      auto building = Building::make(code_scene(out->scene_, furnished),
                                     code_scenario(out->scene_, of.doors), of.threads);
      if (!building) return building.problem();
      (furnished ? out->furnished_ : out->bare_) =
          std::make_unique<Lit>(out->scene_, std::move(building).value(), std::vector<uint32_t>{});
    }
    return out;
  }

  /// For each point, the least light of each candidate [lx]. `furnished`: for each point. Requires:
  /// there is furniture if any point is `furnished`.
  std::vector<std::vector<double>> min_at(const std::vector<PointOffPlace>& points,
                                          const std::vector<char>& furnished) const {
    const std::vector<double> none(count_, std::numeric_limits<double>::infinity());
    std::vector<std::vector<double>> out(points.size(), none);
    for (const bool with : {false, true}) {
      std::vector<size_t> those;
      std::vector<glm::dvec3> places;
      for (size_t p = 0; p < points.size(); ++p) {
        if ((furnished[p] != 0) != with) continue;
        those.push_back(p);
        places.push_back(points[p].place);
      }
      if (places.empty()) continue;
      const CodeLight& light = (with ? *furnished_ : *bare_).light;
      const auto lit = light.lit(places, floor_normal, lifted_already);
      for (size_t i = 0; i < lit.size(); ++i)
        for (size_t k = 0; k < whose_.size(); ++k) {
          double& least = out[those[i]][whose_[k]];
          least = std::min(least, lit[i].lux[k]);
        }
    }
    return out;
  }

 private:
  Displaced() = default;

  SceneDescription scene_;
  std::vector<uint32_t> whose_;  // candidate of each copy
  size_t count_ = 0;             // number of candidates
  std::unique_ptr<Lit> bare_, furnished_;
};

Result<size_t> Demands::ask_off_place(const OffPlaceScene& of,
                                      const std::vector<LuminaireCandidate>& candidates,
                                      const std::vector<PointOffPlace>& points,
                                      const Layout& layout) {
  std::vector<PointOffPlace> asked;
  std::vector<std::vector<double>> light;
  std::vector<char> furnished;
  for (const PointOffPlace& point : points) {
    const auto group =
        std::find_if(problem_.groups.begin(), problem_.groups.end(),
                     [&](const ConstraintGroup& one) { return same_demand(one, point); });
    if (group == problem_.groups.end() || !is_at_points(point.kind)) continue;
    // As at points of the grid: a point that furniture hides from all candidates is taken without
    // furniture.
    const auto planned = [&](const Lit& lit) {
      return lit.light.lit({point.place}, floor_normal, lifted_already).front().lux;
    };
    bool past = furnished_ && !hidden_.contains({name_of(point.rule), point.subject});
    std::vector<double> lux = planned(past ? *furnished_ : *bare_);
    if (past && max_from(*terms_of(lux, 0), problem_.options) < point.least) {
      past = false;
      lux = planned(*bare_);
    }
    asked.push_back(point);
    light.push_back(std::move(lux));
    furnished.push_back(past ? 1 : 0);
  }
  if (asked.empty()) return size_t{0};
  const std::vector<uint32_t> moved = worth_moving(asked, light, layout);
  if (moved.size() > limits::displaced_candidates) return size_t{0};
  std::vector<LuminaireCandidate> some;
  for (const uint32_t i : moved) some.push_back(candidates[i]);
  const auto displaced = Displaced::make(of, some);
  if (!displaced) return displaced.problem();
  size_t broken = 0;
  const auto least = displaced.value()->min_at(asked, furnished);
  for (size_t p = 0; p < asked.size(); ++p) {
    for (size_t k = 0; k < moved.size(); ++k)
      light[p][moved[k]] = std::min(light[p][moved[k]], least[p][k]);
    broken += add_off_place(asked[p], terms_of(light[p], no_light_lx), layout) ? 1 : 0;
  }
  return broken;
}

/// Adds the row; returns whether the layout violates it.
bool Demands::add_off_place(const PointOffPlace& point, Terms light, const Layout& layout) {
  const auto at = std::find_if(problem_.groups.begin(), problem_.groups.end(),
                               [&](const ConstraintGroup& one) { return same_demand(one, point); });
  const auto group = static_cast<uint32_t>(at - problem_.groups.begin());
  if (const auto factors = factors_.find(group); factors != factors_.end())
    light = times(light, factors->second);
  double sum = 0, largest = 0;
  for (const Term& term : *light) {
    if (layout[term.option] == 0) continue;
    sum += static_cast<double>(term.value);
    largest = std::max(largest, static_cast<double>(term.value));
  }
  if (point.kind == DemandKind::failed) {
    problem_.points.push_back({std::move(light), point.place});
    problem_.failures.push_back(
        {group, point.least, {static_cast<uint32_t>(problem_.points.size() - 1)}});
    return sum - largest < point.least * (1 - sum_tolerance);
  }
  problem_.covers.push_back({group, std::move(light), point.least, point.place});
  return sum < point.least * (1 - sum_tolerance);
}

}  // namespace luxodus
