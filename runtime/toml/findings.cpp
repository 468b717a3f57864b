#include "runtime/toml/findings.hpp"

#include <algorithm>

namespace luxodus::toml {

void Findings::problem(Problem p) {
  if (problems_.size() >= limits::toml_problems || !said_.insert(p.text()).second) return;
  if (std::find(files_.begin(), files_.end(), p.where.file) == files_.end())
    files_.push_back(p.where.file);
  problems_.push_back(std::move(p));
  if (problems_.size() == limits::toml_problems)
    problems_.push_back({problems_.back().where, "more problems follow; the first " +
                                                     std::to_string(limits::toml_problems) +
                                                     " are shown"});
}

void Findings::warning(SourcePlace where, std::string what) {
  Problem p{std::move(where), std::move(what)};
  if (warned_.size() < limits::toml_problems && warned_.insert(p.text()).second)
    warnings_.push_back(std::move(p));
}

Problems Findings::take_problems() {
  const auto rank = [this](const Problem& p) {
    const auto file = std::find(files_.begin(), files_.end(), p.where.file) - files_.begin();
    return std::pair(file, p.where.line);
  };
  std::stable_sort(problems_.begin(), problems_.end(),
                   [&](const Problem& a, const Problem& b) { return rank(a) < rank(b); });
  Problems out;
  for (Problem& p : problems_) out.add(std::move(p));
  problems_.clear();
  return out;
}

}  // namespace luxodus::toml
