// Layouts by the integer program, by greedy choice, and by a genetic algorithm as in the
// literature, on the same candidates and demands.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <limits>
#include <numeric>

#include "actors/judge/assess/assessment.hpp"
#include "actors/judge/design/demands.hpp"
#include "actors/judge/design/solve_layout.hpp"
#include "runtime/core/clock.hpp"
#include "runtime/core/random.hpp"
#include "scenes/formats/scene_file/scene_file.hpp"
#include "tests/bench/tables.hpp"
#include "tests/kit/temporary_folder.hpp"

namespace luxodus::bench {

namespace {

const std::atomic<bool> no_interrupt{false};

/// A genetic algorithm with the operators that are common for luminaires and signs: binary strings,
/// tournaments of two, uniform crossover, bit flips, elitism, and a penalty for unmet demands.
class GeneticAlgorithm {
 public:
  GeneticAlgorithm(const LayoutProblem& problem, uint64_t seed)
      : problem_(problem), index_(problem), sums_(index_), random_(seed, RandomStream::layout, 7) {
    random_.start(seed);
    // Penalties are in luminaires, in the unit of the objective.
    double sum = 0, count = 0;
    for (const LayoutOption& option : problem.options)
      if (!option.fixed) sum += option.weight, ++count;
    if (sum > 0) luminaire_ = sum / count;
  }

  struct Best {
    double objective = std::numeric_limits<double>::infinity();  // of a valid layout
    int generations = 0;
    double at_seconds = 0;  // when it was found
  };

  Best run(double seconds) {
    const SystemClock clock;
    const Nanoseconds began = clock.now();
    const auto now = [&] { return 1e-9 * static_cast<double>(clock.now() - began); };
    for (int i = 0; i < population_size; ++i) add(random_layout(0.02 + 0.2 * i / population_size));
    while (now() < seconds) {
      ++best_.generations;
      std::vector<Layout> next{population_[fittest()]};
      while (static_cast<int>(next.size()) < population_size)
        next.push_back(mutated(crossed(tournament(), tournament())));
      population_.clear();
      fitness_.clear();
      const double before = best_.objective;
      for (Layout& layout : next) add(std::move(layout));
      if (best_.objective < before) best_.at_seconds = now();
    }
    return best_;
  }

 private:
  static constexpr int population_size = 60;

  Layout random_layout(double share) {
    Layout out(problem_.options.size(), 0);
    std::vector<char> taken(problem_.places(), 0);
    for (size_t i = 0; i < out.size(); ++i) {
      const LayoutOption& option = problem_.options[i];
      if (!option.fixed && (random_.uniform_double() >= share || taken[option.place] != 0))
        continue;
      out[i] = taken[option.place] = 1;
    }
    return out;
  }

  void add(Layout layout) {
    sums_.set(layout);
    double missing = 0;
    for (const Violation& v : sums_.violations()) missing += 1 - v.share;
    const double objective = objective_of(problem_, layout);
    if (missing == 0) best_.objective = std::min(best_.objective, objective);
    // An unmet demand, however small, costs more than half a luminaire.
    const double penalty = 2 * luminaire_, of_any = 0.5 * luminaire_;
    fitness_.push_back(objective + penalty * missing + (missing > 0 ? of_any : 0));
    population_.push_back(std::move(layout));
  }

  size_t fittest() const {
    return static_cast<size_t>(std::min_element(fitness_.begin(), fitness_.end()) -
                               fitness_.begin());
  }
  const Layout& tournament() {
    const size_t a = random_.bits() % population_.size(), b = random_.bits() % population_.size();
    return population_[fitness_[a] <= fitness_[b] ? a : b];
  }
  /// Crossover place by place, so that no place gets two options.
  Layout crossed(const Layout& a, const Layout& b) {
    std::vector<char> from_a(problem_.places());
    for (char& one : from_a) one = (random_.bits() & 1) != 0;
    Layout out(a.size());
    for (size_t i = 0; i < out.size(); ++i)
      out[i] = from_a[problem_.options[i].place] != 0 ? a[i] : b[i];
    return out;
  }
  /// On average one place gets another option, or none, and one luminaire moves to another place.
  Layout mutated(Layout layout) {
    for (int flips = static_cast<int>(random_.bits() % 4); flips > 0; --flips) {
      const size_t i = random_.bits() % layout.size();
      if (problem_.options[i].fixed) continue;
      const bool on = layout[i] == 0;
      for (size_t k = 0; k < layout.size(); ++k)
        if (problem_.options[k].place == problem_.options[i].place && !problem_.options[k].fixed)
          layout[k] = 0;
      layout[i] = on ? 1 : 0;
    }
    return layout;
  }

  const LayoutProblem& problem_;
  LayoutIndex index_;
  LayoutSums sums_;
  Random random_;
  std::vector<Layout> population_;
  std::vector<double> fitness_;
  double luminaire_ = 1;  // mean weight of a luminaire
  Best best_;
};

std::unique_ptr<Demands> demands_of(const std::string& text) {
  const test::TemporaryFolder folder;
  auto read = read_scene(folder.write("scene.toml", text));
  if (!read.scene) {
    std::printf("%s\n", read.problems.list().front().text().c_str());
    return nullptr;
  }
  const SceneDescription& scene = *read.scene;
  const auto scenario = judged_scenario(scene, "");
  const auto codes = judged_codes(scene, {}, {});
  if (!scenario || !codes) return nullptr;
  const SceneDescription switched = as_switched(scene, scenario.value());
  constexpr int threads = 2;
  const auto candidates =
      find_candidates(switched, *switched.design, codes.value(), scenario.value(), threads);
  if (!candidates) return nullptr;
  auto made = Demands::make(switched, *switched.design, candidates->all, codes.value(),
                            scenario.value(), threads);
  return made ? std::move(made).value() : nullptr;
}

void print_row(const char* name, const std::string& text, double seconds) {
  const auto demands = demands_of(text);
  if (!demands) return;
  const LayoutProblem& problem = demands->problem();
  SolveSettings settings;
  settings.seconds = seconds;
  const LayoutAnswer program =
      solve_layout(problem, settings, no_interrupt, [](const std::string&, double, double) {});
  const auto best = GeneticAlgorithm(problem, 1).run(seconds);
  std::printf("| %s | %zu | %zu | %g | %g | %g | %.1f | %g | %d | %.1f |\n", name,
              problem.options.size(), problem.points.size(), program.greedy_objective,
              program.objective, program.bound, program.seconds, best.objective, best.generations,
              best.at_seconds);
  std::fflush(stdout);
}

std::string office(const std::string& design) {
  return std::string("include = [\"") + LUX_SOURCE_DIR +
         "/scenes/library/office_floor.toml\"]\n[design]\nplace_signs = false\nexisting = "
         "\"removed\"\nspacing_m = 1.2\nover = [\"corridor, west\", \"corridor, east\", \"side "
         "corridor\", \"open plan\"]\n" +
         design;
}

/// Five types of one luminaire, dimmed to five fluxes, each with its price.
std::string five_types() {
  std::string out;
  constexpr double shares[] = {0.5, 0.75, 1, 1.5, 2};
  for (int i = 0; i < 5; ++i)
    out += fmt::format(
        "[[design.type]]\nname = \"type {}\"\nfile = \"{}/scenes/library/luminaires/"
        "emergency_corridor.ldt\"\nemergency = \"non-maintained\"\nemergency_factor = {}\n"
        "maintenance_factor = 0.8\nend_of_duration_factor = 0.8\ncost = {}\n",
        i + 1, LUX_SOURCE_DIR, shares[i], 100 + 60 * shares[i]);
  return out;
}

}  // namespace

void print_layouts(double share) {
  const double seconds = 60 * share;
  std::printf(
      "| case | candidates | points | greedy | program | bound | [s] | genetic | generations | "
      "found at [s] |\n|---|---|---|---|---|---|---|---|---|---|\n");
  print_row("office floor, no failures", office("failure = \"none\"\n"), seconds);
  print_row("office floor, two", office("failure = \"two\"\n"), seconds);
  print_row("office floor, two, five types, cost",
            office("failure = \"two\"\nobjective = \"cost\"\n") + five_types(), seconds);
}

}  // namespace luxodus::bench
