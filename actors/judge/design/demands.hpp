// The demands on a layout as numbers: the light of every candidate at every point of the rules,
// from the light of the code mode (actors/judge/assess/code_light.hpp), and the constraint rows
// that follow from the rules, the failure of luminaires and the planning margin. It solves nothing.
// Thread rule: one thread, which has rows computed by others.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "actors/judge/assess/code_light.hpp"
#include "actors/judge/design/candidates.hpp"
#include "actors/judge/design/layout_problem.hpp"

namespace luxodus {

/// Our reading of "not in total darkness" after a failure [lx].
inline constexpr double never_dark_lx = 0.1;

/// What was found between the points of the grid.
struct BetweenPoints {
  size_t added = 0;  // points added since a minimum did not hold there
  double least = std::numeric_limits<double>::infinity();  // least share of the planned value
  static constexpr void fields(auto&& field, auto& m) {
    field("added", m.added)("least", m.least, {.or_null = true});
  }
};

/// A point at which a minimum does not hold with luminaires off their places.
struct PointOffPlace {
  DemandKind kind = DemandKind::minimum;
  RuleId rule = RuleId::none;
  Subject subject;
  glm::dvec3 place{0};
  double least = 0;  // required value at the point [lx]
};

/// The scene in which luminaires are mounted off their places. Keeps references.
struct OffPlaceScene {
  const SceneDescription& scene;  // as for Demands::make
  const DesignSettings& design;
  const Scenario& doors;
  int threads = 1;
};

namespace limits {
/// Candidates per call whose light off their places is computed; each has nine places.
inline constexpr size_t displaced_candidates = 4'000;
}  // namespace limits

class Demands {
 public:
  /// `scene`: after the circuits of the judged state (as_switched).
  /// Errors: as compile_scene.
  static Result<std::unique_ptr<Demands>> make(const SceneDescription& scene,
                                               const DesignSettings& design,
                                               const std::vector<LuminaireCandidate>& candidates,
                                               const std::vector<CodeChoice>& codes,
                                               const Scenario& doors, int threads);
  ~Demands();

  const LayoutProblem& problem() const { return problem_; }

  /// Whether a check cannot pass with any layout, since furniture hides points from all candidates,
  /// or since no candidate lights a flight of stairs.
  bool is_hidden(const Check& check) const;

  /// Rules and subjects that are required without furniture only, with the number of points that
  /// furniture hides from all candidates.
  using Hidden = std::map<std::pair<std::string_view, Subject>, size_t>;
  const Hidden& hidden() const { return hidden_; }

  /// Flights of stairs with a tread that no candidate lights; no light is required there.
  const std::vector<std::string>& unlit_stair_flights() const { return unlit_stair_flights_; }

  /// Tightens the rows of a check that an assessment found to fail although they hold: at the worst
  /// place, by the missing amount. False if there is no such row.
  bool ask_for_more(const Check& check, const Layout& layout);
  /// Tests the points between the darkest points of each minimum and their neighbours, and adds a
  /// point if a layout gives over a hundredth less than planned there. A point that no candidate
  /// reaches lies in or behind a body, and is skipped. `all`: the demands of all candidates, if
  /// these are made of the luminaires of one layout.
  BetweenPoints look_between(const Layout& layout, const Demands* all = nullptr);
  /// Adds rows at points, in which each candidate counts with the least light that it gives from
  /// the places where it may be mounted. Every layout whose minima hold off its places satisfies
  /// these rows. Returns how many of them `layout` violates. No row is added for an unknown demand,
  /// or one that is not at points. `candidates`: those that this was made of. Errors: as
  /// compile_scene.
  Result<size_t> ask_off_place(const OffPlaceScene& of,
                               const std::vector<LuminaireCandidate>& candidates,
                               const std::vector<PointOffPlace>& points, const Layout& layout);
  /// As ask_for_more of a check, for a minimum that another test found violated: `missing` at
  /// `place`, in the demand's unit. A demand on failures is tightened at all points.
  bool ask_for_more(DemandKind kind, RuleId rule, const Subject& subject, const glm::dvec3& place,
                    double missing, const Layout& layout);

 private:
  struct Lit;       // a building with or without furniture
  class Builder;    // builds the problem
  class Displaced;  // candidates off their places

  Demands();
  void look_at(uint32_t group, const std::vector<glm::dvec3>& places, const Layout& layout,
               const Demands& all, BetweenPoints& out);
  /// The most light that candidates can give together at a place of a row, of the types and
  /// mounts for one place only one [lx].
  double max_at(const glm::dvec3& place, bool furnished) const;
  bool add_off_place(const PointOffPlace& point, Terms light, const Layout& layout);

  SceneDescription scene_;  // with all candidates
  std::unique_ptr<Lit> bare_, furnished_;
  LayoutProblem problem_;
  std::map<uint32_t, std::vector<double>> factors_;  // on the light of candidates, by group
  Hidden hidden_;
  std::vector<std::string> unlit_stair_flights_;
};

}  // namespace luxodus
