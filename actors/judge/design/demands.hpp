// What must hold of a layout, as numbers: the light of every candidate at every point that the
// rules of the scene ask for, by the code mode's own light (actors/judge/assess/code_light.hpp),
// and the rows that follow from the rules, the failure of luminaires and the planning margin.
// Thread rule: one thread, which has rows run on others.
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

/// "no place below 0.1 lx": our reading of "not in total darkness" after a failure [lx].
inline constexpr double never_dark_lx = 0.1;

/// Whether a layout of luminaires decides a rule; what others decide stays as the scene has it.
bool is_of_luminaires(const std::string& rule);

/// What was found between the points of the grid.
struct BetweenPoints {
  size_t added = 0;                                        // points where a minimum breaks
  double least = std::numeric_limits<double>::infinity();  // share of what is planned
};

/// A point where a minimum does not hold with luminaires off their places.
struct PointOffPlace {
  DemandKind kind = DemandKind::minimum;
  std::string rule;
  Subject subject;
  glm::dvec3 place{0};
  double least = 0;  // what is asked for there [lx]
};

/// In which luminaires are mounted off their places. Keeps references.
struct OffPlaceScene {
  const SceneDescription& scene;  // as for Demands::make
  const DesignSettings& design;
  const Scenario& doors;
  int threads = 1;
};

namespace limits {
/// Candidates whose light off their places is computed for one question; each has nine places.
inline constexpr size_t displaced_candidates = 4'000;
}  // namespace limits

class Demands {
 public:
  /// `scene`: as the circuits of the judged state leave it (as_switched).
  /// Errors: as compile_scene.
  static Result<std::unique_ptr<Demands>> make(const SceneDescription& scene,
                                               const DesignSettings& design,
                                               const std::vector<LuminaireCandidate>& candidates,
                                               const std::vector<CodeChoice>& codes,
                                               const Scenario& doors, int threads);
  ~Demands();

  const LayoutProblem& problem() const { return problem_; }

  /// Whether a check cannot pass with any layout, since furniture hides places from all candidates.
  bool is_hidden(const Check& check) const;

  /// Rules and subjects that are asked for without furniture alone, and how many points furniture
  /// hides from all candidates.
  using Hidden = std::map<std::pair<std::string, Subject>, size_t>;
  const Hidden& hidden() const { return hidden_; }

  /// Flights of stairs with a tread that no candidate lights: nothing is asked for there.
  const std::vector<std::string>& unlit_stair_flights() const { return unlit_stair_flights_; }

  /// After an assessment has found that a check of a layout fails, though its rows hold: asks for
  /// more where it is worst, by as much as was missing. False where there is nothing to ask for.
  bool ask_for_more(const Check& check, const Layout& layout);
  /// Looks between the darkest points of each minimum and those next to them, and asks for the
  /// minimum where a layout has less than planned there, by more than a hundredth. Where no
  /// candidate reaches is a body, or behind one; `all`: the demands of all candidates, where these
  /// are made of a layout's own.
  BetweenPoints look_between(const Layout& layout, const Demands* all = nullptr);
  /// Asks at points for as much of the least light that each candidate gives from the places where
  /// it may be mounted. Every layout whose minima hold off its places keeps these rows. Returns how
  /// many of them a layout breaks; no row where nothing is known of a demand, or it is none at
  /// points. `candidates`: those that this was made of. Errors: as compile_scene.
  Result<size_t> ask_off_place(const OffPlaceScene& of,
                               const std::vector<LuminaireCandidate>& candidates,
                               const std::vector<PointOffPlace>& points, const Layout& layout);
  /// As ask_for_more of a check, of a minimum that does not hold elsewhere: `missing` at `place`,
  /// in its unit. Of a demand on failures everywhere.
  bool ask_for_more(DemandKind kind, const std::string& rule, const Subject& subject,
                    const glm::dvec3& place, double missing, const Layout& layout);

 private:
  struct Lit;       // a building, with furniture or without
  class Builder;    // of the problem
  class Displaced;  // candidates off their places

  Demands();
  void look_at(uint32_t group, const std::vector<glm::dvec3>& places, const Layout& layout,
               const Demands& all, BetweenPoints& out);
  /// What all candidates together give at a place of a row [lx].
  double max_at(const glm::dvec3& place, bool furnished) const;
  bool add_off_place(const PointOffPlace& point, Terms light, const Layout& layout);

  SceneDescription scene_;  // with all candidates
  std::unique_ptr<Lit> bare_, furnished_;
  LayoutProblem problem_;
  std::map<uint32_t, std::vector<double>> factors_;  // of the light of candidates, by group
  Hidden hidden_;
  std::vector<std::string> unlit_stair_flights_;
};

}  // namespace luxodus
