#include "actors/judge/design/alternatives.hpp"

#include <algorithm>
#include <limits>

#include "actors/judge/design/greedy.hpp"

namespace luxodus {

namespace {

/// Layouts that are made for each wished one.
constexpr size_t made_of_each = 6;
/// Noise of scores that makes greedy layouts start elsewhere.
constexpr double loud = 2;
/// Share of the best layout's luminaires that a swap removes.
constexpr double swapped = 0.3;
constexpr double sum_rounding = 1e-9;

/// Option chosen at each place; -1 for none.
std::vector<int64_t> options_of_places(const LayoutProblem& problem, const Layout& layout) {
  std::vector<int64_t> out(problem.places(), -1);
  for (size_t i = 0; i < layout.size(); ++i)
    if (layout[i] != 0) out[problem.options[i].place] = static_cast<int64_t>(i);
  return out;
}

class Alternatives {
 public:
  Alternatives(const LayoutProblem& problem, const Layout& best, const AlternativesWish& wish,
               const std::atomic<bool>& interrupt)
      : problem_(problem),
        index_(problem),
        best_(best),
        wish_(wish),
        most_(objective_of(problem, best) * (1 + wish.dearer) + sum_rounding),
        interrupt_(interrupt),
        random_(wish.seed, RandomStream::layout, 2) {}

  std::vector<Layout> find() {
    for (size_t i = 0; i < made_of_each * wish_.count && !interrupt_; ++i) {
      random_.start(i);
      switch (i % 3) {
        case 0:
          add_completed({});
          break;  // from an empty layout
        case 1:
          add_completed(without_some());
          break;  // swaps in the best layout
        default:
          add(enriched(pool_.empty() ? best_ : pool_[random_.bits() % pool_.size()]));
      }
    }
    return chosen();
  }

 private:
  void add_completed(const Layout& begun) {
    if (const auto layout = completed(index_, begun, loud, random_)) add(pruned(index_, *layout));
  }

  void add(Layout layout) {
    if (objective_of(problem_, layout) > most_) return;
    LayoutSums sums(index_);
    sums.set(layout);
    if (sums.holds()) pool_.push_back(std::move(layout));
  }

  Layout without_some() {
    Layout out = best_;
    for (size_t i = 0; i < out.size(); ++i)
      if (out[i] != 0 && !problem_.options[i].fixed && random_.uniform_double() < swapped)
        out[i] = 0;
    return out;
  }

  /// Adds luminaires at free places, up to a random objective within the limit.
  Layout enriched(Layout layout) {
    std::vector<int64_t> places = options_of_places(problem_, layout);
    double objective = objective_of(problem_, layout);
    const double limit = objective + random_.uniform_double() * (most_ - objective);
    for (size_t tries = 0; tries < problem_.options.size(); ++tries) {
      const size_t i = random_.bits() % problem_.options.size();
      const LayoutOption& option = problem_.options[i];
      if (option.pool != no_pool || places[option.place] >= 0 || objective + option.weight > limit)
        continue;
      layout[i] = 1;
      places[option.place] = static_cast<int64_t>(i);
      objective += option.weight;
    }
    return layout;
  }

  /// Repeatedly takes the layout that differs most from all taken ones.
  std::vector<Layout> chosen() const {
    std::vector<Layout> out;
    std::vector<size_t> least(pool_.size());  // distance to the nearest taken layout
    for (size_t i = 0; i < pool_.size(); ++i)
      least[i] = places_that_differ(problem_, pool_[i], best_);
    while (out.size() < wish_.count) {
      const auto most = std::max_element(least.begin(), least.end());
      if (most == least.end() || *most == 0) break;
      out.push_back(pool_[static_cast<size_t>(most - least.begin())]);
      for (size_t i = 0; i < pool_.size(); ++i)
        least[i] = std::min(least[i], places_that_differ(problem_, pool_[i], out.back()));
    }
    return out;
  }

  const LayoutProblem& problem_;
  const LayoutIndex index_;
  const Layout& best_;
  const AlternativesWish& wish_;
  const double most_;  // largest objective
  const std::atomic<bool>& interrupt_;
  Random random_;
  std::vector<Layout> pool_;
};

}  // namespace

size_t places_that_differ(const LayoutProblem& problem, const Layout& a, const Layout& b) {
  const auto in_a = options_of_places(problem, a), in_b = options_of_places(problem, b);
  size_t count = 0;
  for (size_t i = 0; i < in_a.size(); ++i) count += in_a[i] != in_b[i];
  return count;
}

std::vector<Layout> alternatives_to(const LayoutProblem& problem, const Layout& best,
                                    const AlternativesWish& wish,
                                    const std::atomic<bool>& interrupt) {
  return Alternatives(problem, best, wish, interrupt).find();
}

}  // namespace luxodus
