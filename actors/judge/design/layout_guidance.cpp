#include "actors/judge/design/layout_guidance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "actors/judge/assess/guiding_views.hpp"
#include "actors/judge/design/smoke_differences.hpp"
#include "scenes/light/transport/compile.hpp"

namespace luxodus {

namespace {

/// The building of a group at another time: its signs, in the smoke of that time.
SceneDescription at_time(const SceneDescription& then, const SceneDescription& base) {
  SceneDescription out = then;
  out.signs = base.signs;
  return out;
}

/// Guidance of one route for one eye height; undecided views do not guide in `least`, and guide in
/// `most`.
struct RouteTables {
  GuidedRoute least, most;
};

/// Tables by layout, in one scenario.
using LayoutTables = std::vector<std::vector<RouteTables>>;

class GuidanceTracer {
 public:
  GuidanceTracer(const GuidanceOptions& options, const std::string& scenario,
                 const std::atomic<bool>& interrupt, const AssessProgress& progress)
      : options_(options), scenario_(scenario), interrupt_(interrupt), progress_(progress) {}

  /// Adds a state to the tables of a group's layouts. Errors: as guidance_of.
  Result<void> add_state(const LayoutGroup& group, const SceneDescription& then,
                         LayoutTables& tables) {
    const SceneDescription scene = at_time(then, *group.base);
    const auto scenario = find_scenario(scene, scenario_);
    if (!scenario) return scenario.problem();
    const GuidingViews views(scene);
    AssessOptions asked = options_.asked;
    asked.wanted = [&](const SightRow& row) { return views.can_guide(row); };
    asked.sure_errors = sure_errors_of_races;
    auto state = LayoutGroupState::make(*group.lights, scene, scenario.value(), asked, progress_);
    if (!state) return state.problem();
    SightsInLights& sights = state.value()->sights();
    for (int round = 0; round < options_.rounds; ++round) {
      std::vector<bool> open;
      for (size_t i = 0; i < sights.lights(); ++i) open.push_back(sights.is_open(i));
      if (std::find(open.begin(), open.end(), true) == open.end()) break;
      if (auto ok = sights.trace(round, open, interrupt_, progress_); !ok) return ok.problem();
    }
    for (size_t i = 0; i < group.members.size(); ++i)
      add_row(scene, views, sights.rows(i), tables[group.members[i]]);
    return {};
  }

 private:
  static void add_row(const SceneDescription& scene, const GuidingViews& views,
                      const std::vector<SightRow>& rows, std::vector<RouteTables>& tables) {
    std::map<std::tuple<Subject, double, double>, Guidance> best;  // by route, height, place
    for (const SightRow& row : rows) {
      auto& at =
          best.insert({{row.from, row.height_m, row.along_m}, Guidance::not_guided}).first->second;
      if (row.sight.verdict == SightVerdict::legible) at = Guidance::guided;
      if (row.sight.verdict == SightVerdict::undecided) at = std::min(at, Guidance::undecided);
    }
    size_t next = 0;
    for (size_t r = 0; r < scene.routes.size(); ++r)
      for (const double height : scene.assessment.eye_heights_m) {
        if (next == tables.size()) {
          GuidedRoute empty;
          empty.length_m = length_of(scene.routes[r]);
          for (const Walker& walker : views.people(r)) empty.along_m.push_back(walker.along_m);
          tables.push_back({empty, empty});
        }
        RouteTables& table = tables[next++];
        std::vector<Guidance> least, most;
        for (const Walker& walker : views.people(r)) {
          const auto found = best.find({subject_of(scene.routes[r]), height, walker.along_m});
          const Guidance here = found == best.end() ? Guidance::not_guided : found->second;
          least.push_back(here == Guidance::guided ? here : Guidance::not_guided);
          most.push_back(here == Guidance::not_guided ? here : Guidance::guided);
        }
        for (const auto& [to, at] : {std::pair{&table.least, &least}, {&table.most, &most}}) {
          to->times_s.push_back(scene.at_s.value_or(0));
          to->at.push_back(*at);
        }
      }
  }

  const GuidanceOptions& options_;
  const std::string& scenario_;
  const std::atomic<bool>& interrupt_;
  const AssessProgress& progress_;
};

std::vector<GuidedUntil> guided_until(const SceneDescription& scene,
                                      const std::vector<RouteTables>& tables) {
  const std::vector<double>& heights = scene.assessment.eye_heights_m;
  std::vector<GuidedUntil> out;
  for (size_t k = 0; k < tables.size(); ++k)
    out.push_back({scene.routes[k / heights.size()].name, heights[k % heights.size()],
                   guided_time(tables[k].least), guided_time(tables[k].most)});
  return out;
}

bool is_lost_before(const std::vector<GuidedUntil>& a, const std::vector<GuidedUntil>& b) {
  const FirstLoss first = first_loss_of(a), second = first_loss_of(b);
  return std::pair(first.min_s, first.max_s) < std::pair(second.min_s, second.max_s);
}

}  // namespace

FirstLoss first_loss_of(const std::vector<GuidedUntil>& routes) {
  FirstLoss out{routes.front().least.until_s, routes.front().most.until_s, true};
  const auto earlier = [](const std::optional<double>& a, const std::optional<double>& b) {
    return a && b ? std::optional(std::min(*a, *b)) : std::nullopt;
  };
  for (const GuidedUntil& route : routes) {
    out.min_s = earlier(out.min_s, route.least.until_s);
    out.max_s = earlier(out.max_s, route.most.until_s);
    out.never_lost = out.never_lost && !route.least.lost_by_s;
  }
  return out;
}

Result<std::vector<std::vector<GuidedUntil>>> guidance_of(const std::vector<LayoutGroup>& groups,
                                                          size_t layouts,
                                                          const GuidanceOptions& options,
                                                          const std::atomic<bool>& interrupt,
                                                          const AssessProgress& progress) {
  std::vector<LayoutTables> tables(options.scenarios.size(), LayoutTables(layouts));
  for (const double time : options.times_s) {
    const auto then = options.scene_at(time);
    if (!then) return then.problem();
    for (size_t s = 0; s < options.scenarios.size(); ++s) {
      const std::string& scenario = options.scenarios[s];
      const AssessProgress tell = [&](const std::string& what, double share) {
        progress(fmt::format("\"{}\", {:g} s, {}", scenario, time, what), share);
      };
      GuidanceTracer tracer(options, scenario, interrupt, tell);
      for (const LayoutGroup& group : groups)
        if (auto ok = tracer.add_state(group, *then.value(), tables[s]); !ok) return ok.problem();
    }
  }
  std::vector<std::vector<GuidedUntil>> out(layouts);
  for (const LayoutTables& of_scenario : tables)
    for (size_t i = 0; i < layouts; ++i) {
      auto guided = guided_until(*groups.front().base, of_scenario[i]);
      if (out[i].empty() || is_lost_before(guided, out[i])) out[i] = std::move(guided);
    }
  return out;
}

}  // namespace luxodus
