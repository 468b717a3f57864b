#include "actors/judge/design/split_problem.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace luxodus {

namespace {

/// Disjoint sets (union-find with path halving).
class Joined {
 public:
  explicit Joined(size_t count) : above_(count) { std::iota(above_.begin(), above_.end(), 0U); }

  uint32_t root(uint32_t i) {
    while (above_[i] != i) i = above_[i] = above_[above_[i]];
    return i;
  }
  void join(uint32_t a, uint32_t b) {
    a = root(a), b = root(b);
    if (a != b) above_[std::max(a, b)] = std::min(a, b);
  }
  void join(const std::vector<Term>& terms) {
    for (size_t i = 1; i < terms.size(); ++i) join(terms[i].option, terms[0].option);
  }

 private:
  std::vector<uint32_t> above_;
};

class ProblemSplitter {
 public:
  explicit ProblemSplitter(const LayoutProblem& problem)
      : problem_(problem), joined_(problem.options.size()) {}

  std::vector<ProblemPart> run() {
    if (!join_all()) return {whole()};
    if (!join_idle()) return {whole()};
    make_parts();
    if (parts_.size() < 2) return {whole()};
    for (const CoverRow& row : problem_.covers) {
      CoverRow of_part = row;
      const size_t part = part_of(row.terms->front().option);
      of_part.terms = moved(row.terms);
      parts_[part].problem.covers.push_back(std::move(of_part));
    }
    for (const FailureRows& rows : problem_.failures) add_failures(rows);
    for (const SpreadRows& rows : problem_.spreads) add_spread(rows);
    return std::move(parts_);
  }

 private:
  ProblemPart whole() const {
    ProblemPart out{problem_, std::vector<uint32_t>(problem_.options.size())};
    std::iota(out.options.begin(), out.options.end(), 0U);
    return out;
  }

  /// False if a row has no options, since it belongs to no part.
  bool join_all() {
    std::map<uint32_t, uint32_t> of_place, of_pool;
    for (uint32_t i = 0; i < problem_.options.size(); ++i) {
      const LayoutOption& option = problem_.options[i];
      joined_.join(i, of_place.try_emplace(option.place, i).first->second);
      if (option.pool != no_pool)
        joined_.join(i, of_pool.try_emplace(option.pool, i).first->second);
    }
    for (const CoverRow& row : problem_.covers) {
      if (row.terms->empty()) return false;
      joined_.join(*row.terms);
    }
    const auto light = [&](uint32_t p) -> const std::vector<Term>& {
      return *problem_.points[p].light;
    };
    for (const FailureRows& rows : problem_.failures)
      for (const uint32_t p : rows.points) {
        if (light(p).empty()) return false;
        joined_.join(light(p));
      }
    for (const SpreadRows& rows : problem_.spreads) {
      uint32_t first = 0;
      bool any = false;
      for (const auto* list : {&rows.low, &rows.high})
        for (const uint32_t p : *list) {
          if (light(p).empty()) return false;
          joined_.join(light(p));
          if (any) joined_.join(light(p).front().option, first);
          first = light(p).front().option;
          any = true;
        }
    }
    return true;
  }

  /// Adds options that no row uses to the first part. False if there is no row.
  bool join_idle() {
    std::vector<char> asked(problem_.options.size(), 0);
    const auto mark = [&](const std::vector<Term>& terms) {
      for (const Term& term : terms) asked[term.option] = 1;
    };
    for (const CoverRow& row : problem_.covers) mark(*row.terms);
    for (const FailureRows& rows : problem_.failures)
      for (const uint32_t p : rows.points) mark(*problem_.points[p].light);
    for (const SpreadRows& rows : problem_.spreads)
      for (const auto* list : {&rows.low, &rows.high})
        for (const uint32_t p : *list) mark(*problem_.points[p].light);
    const auto first = std::find(asked.begin(), asked.end(), 1);
    if (first == asked.end()) return false;
    for (uint32_t i = 0; i < asked.size(); ++i)
      if (asked[i] == 0) joined_.join(i, static_cast<uint32_t>(first - asked.begin()));
    return true;
  }

  void make_parts() {
    std::map<uint32_t, size_t> number;
    number_of_.resize(problem_.options.size());
    part_of_.resize(problem_.options.size());
    for (uint32_t i = 0; i < problem_.options.size(); ++i) {
      const auto [at, fresh] = number.try_emplace(joined_.root(i), parts_.size());
      if (fresh) {
        parts_.emplace_back();
        parts_.back().problem.groups = problem_.groups;
        parts_.back().problem.pools.assign(problem_.pools.size(), 0);
        places_.emplace_back();
        points_.emplace_back();
      }
      ProblemPart& part = parts_[at->second];
      part_of_[i] = at->second;
      number_of_[i] = static_cast<uint32_t>(part.options.size());
      part.options.push_back(i);
      LayoutOption option = problem_.options[i];
      auto& places = places_[at->second];
      option.place =
          places.try_emplace(option.place, static_cast<uint32_t>(places.size())).first->second;
      if (option.pool != no_pool) part.problem.pools[option.pool] = problem_.pools[option.pool];
      part.problem.options.push_back(option);
    }
  }

  size_t part_of(uint32_t option) const { return part_of_[option]; }

  /// Terms with the indices of the part. Rows that share terms share them in the part as well.
  Terms moved(const Terms& terms) {
    Terms& out = moved_[terms.get()];
    if (!out) {
      auto fresh = std::make_shared<std::vector<Term>>(*terms);
      for (Term& term : *fresh) term.option = number_of_[term.option];
      out = std::move(fresh);
    }
    return out;
  }

  uint32_t point_in(size_t part, uint32_t p) {
    auto& points = points_[part];
    auto& list = parts_[part].problem.points;
    const auto [at, fresh] = points.try_emplace(p, static_cast<uint32_t>(list.size()));
    if (fresh) list.push_back({moved(problem_.points[p].light), problem_.points[p].place});
    return at->second;
  }

  void add_failures(const FailureRows& rows) {
    std::map<size_t, FailureRows> of_parts;
    for (const uint32_t p : rows.points) {
      const size_t part = part_of(problem_.points[p].light->front().option);
      FailureRows& its =
          of_parts.try_emplace(part, FailureRows{rows.group, rows.least, {}}).first->second;
      its.points.push_back(point_in(part, p));
    }
    for (auto& [part, its] : of_parts) parts_[part].problem.failures.push_back(std::move(its));
  }

  void add_spread(const SpreadRows& rows) {
    const auto& some = rows.low.empty() ? rows.high : rows.low;
    if (some.empty()) return;
    const size_t part = part_of(problem_.points[some.front()].light->front().option);
    SpreadRows its{rows.group, rows.ratio, {}, {}};
    for (const uint32_t p : rows.low) its.low.push_back(point_in(part, p));
    for (const uint32_t p : rows.high) its.high.push_back(point_in(part, p));
    parts_[part].problem.spreads.push_back(std::move(its));
  }

  const LayoutProblem& problem_;
  Joined joined_;
  std::vector<ProblemPart> parts_;
  std::vector<size_t> part_of_;
  std::vector<uint32_t> number_of_;
  std::vector<std::map<uint32_t, uint32_t>> places_, points_;
  std::map<const std::vector<Term>*, Terms> moved_;
};

}  // namespace

std::vector<ProblemPart> parts_of(const LayoutProblem& problem) {
  return ProblemSplitter(problem).run();
}

}  // namespace luxodus
