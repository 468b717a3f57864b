#include "actors/import/join_lines.hpp"

#include <cmath>
#include <map>
#include <utility>

namespace luxodus {
namespace {

/// Ends that differ by less are one place in most drawings [m].
constexpr double same_place_m = 1e-5;

class ShortLines {
 public:
  explicit ShortLines(std::span<const DrawnLine> lines)
      : lines_(lines), used_(lines.size(), false) {
    for (size_t i = 0; i < lines.size(); ++i) {
      if (!is_short(i)) continue;
      at_[place(lines[i].from)].push_back(i);
      at_[place(lines[i].to)].push_back(i);
    }
  }

  bool is_short(size_t i) const {
    return glm::length(lines_[i].to - lines_[i].from) < limits::shortest_wall_m;
  }
  bool used(size_t i) const { return used_[i]; }

  /// The points of the chain that this short line is in.
  std::vector<glm::dvec2> chain(size_t first) {
    used_[first] = true;
    std::vector<glm::dvec2> back = walk(lines_[first].from), ahead = walk(lines_[first].to);
    std::vector<glm::dvec2> out(back.rbegin(), back.rend());
    out.push_back(lines_[first].from);
    out.push_back(lines_[first].to);
    out.insert(out.end(), ahead.begin(), ahead.end());
    return out;
  }

 private:
  using Place = std::pair<double, double>;
  static Place place(const glm::dvec2& p) {
    return {std::round(p.x / same_place_m), std::round(p.y / same_place_m)};
  }

  std::vector<glm::dvec2> walk(glm::dvec2 at) {
    std::vector<glm::dvec2> out;
    while (true) {
      std::vector<size_t>& here = at_[place(at)];
      while (!here.empty() && used_[here.back()]) here.pop_back();
      if (here.empty()) return out;
      const size_t next = here.back();
      used_[next] = true;
      const DrawnLine& line = lines_[next];
      at = place(line.from) == place(at) ? line.to : line.from;
      out.push_back(at);
    }
  }

  std::span<const DrawnLine> lines_;
  std::vector<bool> used_;
  std::map<Place, std::vector<size_t>> at_;
};

}  // namespace

JoinedLines join_short_lines(std::span<const DrawnLine> lines) {
  ShortLines shorts(lines);
  JoinedLines out;
  for (size_t i = 0; i < lines.size(); ++i) {
    if (!shorts.is_short(i)) {
      out.lines.push_back(lines[i]);
      continue;
    }
    if (shorts.used(i)) continue;
    const std::vector<glm::dvec2> chain = shorts.chain(i);
    const size_t before = out.lines.size();
    glm::dvec2 from = chain.front();
    for (const glm::dvec2& p : chain) {
      if (glm::length(p - from) < limits::shortest_wall_m) continue;
      out.lines.push_back({from, p});
      from = p;
    }
    const glm::dvec2 end = chain.back();
    const bool some = out.lines.size() > before;
    if (some && glm::length(end - out.lines.back().from) >= limits::shortest_wall_m)
      out.lines.back().to = end;
    else if (glm::length(end - from) >= limits::shortest_joint_m)
      out.lines.push_back({from, end});
    else if (!some)
      out.dropped += chain.size() - 1;
  }
  return out;
}

}  // namespace luxodus
