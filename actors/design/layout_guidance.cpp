#include "actors/design/layout_guidance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "actors/assess/guiding_views.hpp"
#include "scenes/transport/compile.hpp"

namespace luxodus {

namespace {

/// The building of a heat at another time: its layouts and its signs, in the smoke of that time.
SceneDescription at_time(const SceneDescription& then, const SceneDescription& base) {
  SceneDescription out = then;
  out.signs = base.signs;
  return out;
}

/// One route for eyes of one height, as it is and as it may be.
struct RouteTables {
  GuidedRoute least, most;
};

class Following {
 public:
  Following(const GuidanceOptions& options, const std::atomic<bool>& interrupt,
            const AssessProgress& progress)
      : options_(options), interrupt_(interrupt), progress_(progress) {}

  /// Adds a state to the tables of a heat's layouts. Errors: as guidance_of.
  Result<void> add_state(const Heat& heat, const SceneDescription& then,
                         std::vector<std::vector<RouteTables>>& tables) {
    const SceneDescription scene = at_time(then, *heat.base);
    const auto scenario = find_scenario(scene, options_.scenario);
    if (!scenario) return scenario.problem();
    const GuidingViews views(scene);
    AssessOptions asked = options_.asked;
    asked.wanted = [&](const SightRow& row) { return views.can_guide(row); };
    auto state = HeatState::make(*heat.lights, scene, scenario.value(), asked, progress_);
    if (!state) return state.problem();
    SightsInLights& sights = state.value()->sights();
    for (int round = 0; round < options_.rounds; ++round) {
      std::vector<bool> open;
      for (size_t i = 0; i < sights.lights(); ++i) open.push_back(sights.is_open(i));
      if (std::find(open.begin(), open.end(), true) == open.end()) break;
      if (auto ok = sights.trace(round, open, interrupt_, progress_); !ok) return ok.problem();
    }
    for (size_t i = 0; i < heat.members.size(); ++i)
      add_row(scene, views, sights.rows(i), tables[heat.members[i]]);
    return {};
  }

 private:
  static void add_row(const SceneDescription& scene, const GuidingViews& views,
                      const std::vector<SightRow>& rows, std::vector<RouteTables>& tables) {
    std::map<std::tuple<std::string, double, double>, Guidance> best;  // route, height, place
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
          const auto found = best.find({from_route(scene.routes[r]), height, walker.along_m});
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
  const std::atomic<bool>& interrupt_;
  const AssessProgress& progress_;
};

}  // namespace

FirstLoss first_loss_of(const std::vector<GuidedUntil>& routes) {
  FirstLoss out{routes.front().least.until_s, routes.front().most.until_s, true};
  const auto earlier = [](const std::optional<double>& a, const std::optional<double>& b) {
    return a && b ? std::optional(std::min(*a, *b)) : std::nullopt;
  };
  for (const GuidedUntil& route : routes) {
    out.least_s = earlier(out.least_s, route.least.until_s);
    out.most_s = earlier(out.most_s, route.most.until_s);
    out.never_lost = out.never_lost && !route.least.lost_by_s;
  }
  return out;
}

Result<std::vector<std::vector<GuidedUntil>>> guidance_of(const std::vector<Heat>& heats,
                                                          size_t layouts,
                                                          const GuidanceOptions& options,
                                                          const std::atomic<bool>& interrupt,
                                                          const AssessProgress& progress) {
  std::vector<std::vector<RouteTables>> tables(layouts);
  for (const double time : options.times_s) {
    const auto then = options.scene_at(time);
    if (!then) return then.problem();
    const auto tell = [&](const std::string& what, double share) {
      progress(fmt::format("{:g} s, {}", time, what), share);
    };
    for (const Heat& heat : heats)
      if (auto ok = Following(options, interrupt, tell).add_state(heat, *then.value(), tables); !ok)
        return ok.problem();
  }
  std::vector<std::vector<GuidedUntil>> out(layouts);
  const SceneDescription& scene = *heats.front().base;
  const std::vector<double>& heights = scene.assessment.eye_heights_m;
  for (size_t i = 0; i < layouts; ++i)
    for (size_t k = 0; k < tables[i].size(); ++k)
      out[i].push_back({scene.routes[k / heights.size()].name, heights[k % heights.size()],
                        guided_time(tables[i][k].least), guided_time(tables[i][k].most)});
  return out;
}

}  // namespace luxodus
