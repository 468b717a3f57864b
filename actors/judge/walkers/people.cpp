// Time goes in frames. At each look all people who are on their way are asked together what they
// read; between two looks they walk along their lines at the speed that the smoke at the last look
// leaves them.
#include "actors/judge/walkers/people.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "actors/judge/walk/follow.hpp"
#include "actors/judge/walkers/smoke_speed.hpp"
#include "runtime/core/random.hpp"
#include "scenes/emergency/guidance.hpp"
#include "scenes/emergency/sign_geometry.hpp"

namespace luxodus {

namespace {

/// Deviations from the mean speed beyond which a speed is drawn again, and how often.
constexpr double most_deviations = 2;
constexpr int most_draws = 1000;
/// A walker looks to the place that is reached after this way [m]: where a line bends twice within
/// a cell, the walker does not look aside.
constexpr double look_ahead_m = 0.5;
/// Users of RandomStream::layout with lower numbers are those of layouts of luminaires.
constexpr uint32_t random_part = 3;
/// A time is a frame if it is this near to it, in frames.
constexpr double frame_rounding = 1e-6;

int64_t first_frame(double time_s) {
  return static_cast<int64_t>(std::ceil(time_s * walker_fps - frame_rounding));
}
int64_t last_frame(double time_s) {
  return static_cast<int64_t>(std::floor(time_s * walker_fps + frame_rounding));
}
int64_t frames_between_looks(const PeopleOptions& options) {
  return std::max<int64_t>(1, std::llround(options.look_s * walker_fps));
}

/// A normal number within the deviations (Box and Muller's transform).
double drawn_deviation(Random& random) {
  for (int i = 0; i < most_draws; ++i) {
    const double u = random.uniform_double();
    const double v = random.uniform_double();
    const double out = std::sqrt(-2 * std::log1p(-u)) * std::cos(2 * std::numbers::pi * v);
    if (std::abs(out) <= most_deviations) return out;
  }
  return 0;
}

/// A line that is walked along.
class Position {
 public:
  Position() = default;
  explicit Position(const glm::dvec2& at) : at_(at) {}

  void take(WalkingLine line) {
    line_ = std::move(line);
    next_ = 0;
  }
  const glm::dvec2& at() const { return at_; }
  bool is_at_end() const { return next_ == line_.size(); }

  /// Walks so far, and returns what is left of it at the end of the line [m].
  double walk(double length_m) {
    while (length_m > 0 && !is_at_end()) {
      const double to_next = glm::distance(at_, line_[next_]);
      if (to_next > length_m) {
        at_ += (line_[next_] - at_) * (length_m / to_next);
        return 0;
      }
      at_ = line_[next_++];
      length_m -= to_next;
    }
    return length_m;
  }

  /// Unit direction to a place ahead on the line; 0 at its end.
  glm::dvec2 ahead() const {
    Position on = *this;
    on.walk(look_ahead_m);
    const double length = glm::distance(on.at_, at_);
    return length > 0 ? (on.at_ - at_) / length : glm::dvec2(0);
  }

 private:
  glm::dvec2 at_{0};
  WalkingLine line_;
  size_t next_ = 0;
};

struct Walker {
  double clear_m_s = 0, speed_m_s = 0;
  int64_t leaves_at = 0;  // the first look at or after this frame
  bool on_way = false, inside = true;
  glm::dvec2 facing{0};
  std::set<uint32_t> read;  // signs that were read, by number of the scene
  Position position;
  WalkerOutcome outcome;
};

/// Starts, speeds and times of people are drawn by their numbers alone.
class Draw {
 public:
  explicit Draw(uint64_t seed) : random_(seed, RandomStream::layout, random_part) {}

  /// So many cells, each at most once. Requires: there are as many.
  std::vector<CellNumber> starts(std::vector<CellNumber> cells, size_t count) {
    random_.start(0);
    for (size_t i = 0; i < count; ++i) {
      const auto left = static_cast<double>(cells.size() - i);
      std::swap(cells[i], cells[i + static_cast<size_t>(random_.uniform_double() * left)]);
    }
    cells.resize(count);
    return cells;
  }
  Walker walker(size_t number, const PeopleOptions& options) {
    random_.start(number + 1);
    Walker out;
    const double leaves_s = options.leave_from_s +
                            random_.uniform_double() * (options.leave_to_s - options.leave_from_s);
    out.leaves_at = first_frame(leaves_s);
    out.clear_m_s = options.speed_m_s + options.speed_deviation_m_s * drawn_deviation(random_);
    out.speed_m_s = out.clear_m_s;
    return out;
  }

 private:
  Random random_;
};

class Walking {
 public:
  Walking(const PeopleFloor& floor, const PeopleOptions& options, WaysOut& ways, const AskEyes& ask)
      : floor_(floor), options_(options), ways_(ways), ask_(ask) {}

  Result<PeopleWalked> run(const std::function<void(double share)>& progress) {
    if (auto ok = begin(); !ok) return ok.problem();
    const int64_t first = first_frame(options_.from_s), last = last_frame(options_.until_s);
    const int64_t apart = frames_between_looks(options_);
    for (int64_t frame = first; frame <= last && inside_ > 0; ++frame) {
      if ((frame - first) % apart == 0) {
        if (auto ok = look(frame); !ok) return ok.problem();
        progress(static_cast<double>(frame - first) / static_cast<double>(last - first + 1));
      }
      write(frame);
      if (frame < last) move(frame);
    }
    for (const Walker& one : people_) out_.people.push_back(one.outcome);
    return std::move(out_);
  }

 private:
  Result<void> begin() {
    std::optional<size_t> named;
    if (!options_.came_by.empty()) {
      const auto way = ways_.way_named(options_.came_by);
      if (!way) return way.problem();
      named = way.value();
    }
    Draw draw(options_.seed);
    const auto count = static_cast<size_t>(options_.count);
    const auto starts = draw.starts(floor_.start_cells, count);
    for (size_t i = 0; i < count; ++i) {
      Walker one = draw.walker(i, options_);
      one.outcome.way = named ? *named : nearest_way(starts[i]);
      one.position = Position(floor_.space.centre(starts[i]));
      auto line = ways_.along(one.outcome.way, starts[i]);
      if (!line) return unreachable(one.outcome.way, starts[i]);
      one.position.take(std::move(*line));
      one.facing = one.position.ahead();
      people_.push_back(std::move(one));
    }
    inside_ = count;
    return {};
  }

  Problem unreachable(size_t way, CellNumber from) const {
    const glm::dvec2 at = floor_.space.centre(from);
    return problem_in(
        ways_.ways()[way].route->place,
        fmt::format("people at ({:.4g}, {:.4g}) m cannot reach the route \"{}\", or its line "
                    "is closed off: choose another place by --within, or another --came-by",
                    at.x, at.y, ways_.ways()[way].route->name));
  }

  size_t nearest_way(CellNumber from) {
    size_t out = 0;
    for (size_t way = 1; way < ways_.ways().size(); ++way)
      if (ways_.distance_to_end_m(way, from) < ways_.distance_to_end_m(out, from)) out = way;
    return out;
  }

  /// All people who are on their way look; those whose time has come set out.
  Result<void> look(int64_t frame) {
    std::vector<size_t> looking;
    std::vector<glm::dvec3> eyes;
    for (size_t i = 0; i < people_.size(); ++i) {
      const Walker& one = people_[i];
      if (!one.inside || one.outcome.left_s || one.leaves_at > frame) continue;
      looking.push_back(i);
      eyes.emplace_back(one.position.at(), floor_.floor_m + floor_.eye_height_m);
    }
    if (eyes.empty()) return {};
    const double time_s = static_cast<double>(frame) / walker_fps;
    const auto found = ask_(std::clamp(time_s, options_.from_s, options_.until_s), eyes);
    if (!found) return found.problem();
    for (size_t k = 0; k < looking.size(); ++k) {
      Walker& one = people_[looking[k]];
      const std::span all(found->answers);
      choose(one, eyes[k], all.subspan(k * floor_.signs.size(), floor_.signs.size()));
      one.on_way = true;
      one.facing = one.position.ahead();
      one.speed_m_s = speed_in_smoke(one.clear_m_s, found->extinctions[k]);
    }
    return {};
  }

  /// Follows the nearest of the signs that are read for the first time. Who sets out looks around.
  void choose(Walker& one, const glm::dvec3& eye, std::span<const SignAnswer> answers) {
    const WaysAhead ahead(floor_.scene, eye - glm::dvec3(0, 0, floor_.eye_height_m));
    const glm::dvec2 facing = one.on_way ? one.facing : glm::dvec2(0);
    double nearest_m = std::numeric_limits<double>::infinity();
    bool is_undecided = false;
    for (size_t s = 0; s < floor_.signs.size(); ++s) {
      const uint32_t number = floor_.signs[s];
      const bool is_read = answers[s] == SignAnswer::read;
      if (!(is_read || answers[s] == SignAnswer::undecided) || one.read.contains(number)) continue;
      const Sign& sign = floor_.scene.signs[number];
      const SignView view = view_of_sign(sign, eye);
      if (!in_field_of_view(eye, facing, view.centre, options_.field_of_view_deg)) continue;
      const auto routes = ahead.led_along(sign, view);
      if (routes.empty()) continue;
      is_undecided = is_undecided || !is_read;
      if (!is_read) continue;
      one.read.insert(number);
      if (view.distance_m < nearest_m && follow(one, number, view, routes))
        nearest_m = view.distance_m;
    }
    ++out_.looks;
    out_.undecided_looks += is_undecided && std::isinf(nearest_m) ? 1 : 0;
  }

  /// Takes the shortest of the ways that a sign leads along; false if none can be reached.
  bool follow(Walker& one, uint32_t sign, const SignView& view,
              const std::vector<const EscapeRoute*>& routes) {
    std::optional<size_t> best;
    double rest_m = 0, at_m = 0;
    for (const EscapeRoute* route : routes) {
      const auto way = ways_.way_of(*route);
      if (!way) continue;
      const double passed_m = passed_at_m(*route, view.centre);
      const double left_m = ways_.ways()[*way].to_m - passed_m;
      if (best && left_m >= rest_m) continue;
      best = way;
      rest_m = left_m;
      at_m = passed_m;
    }
    const auto cell = floor_.space.cell_of(one.position.at());
    if (!best || !cell) return false;
    auto line = ways_.past(*best, at_m, *cell);
    if (!line) return false;
    one.position.take(std::move(*line));
    one.outcome.way = *best;
    one.outcome.sign = sign;
    return true;
  }

  void write(int64_t frame) {
    for (size_t i = 0; i < people_.size(); ++i) {
      Walker& one = people_[i];
      if (!one.inside) continue;
      out_.places.push_back({frame, static_cast<int64_t>(i + 1), one.position.at(), one.facing});
      if (one.outcome.left_s) {
        one.inside = false;
        --inside_;
      }
    }
  }

  void move(int64_t frame) {
    for (Walker& one : people_) {
      if (!one.inside || !one.on_way) continue;
      const double left_m = one.position.walk(one.speed_m_s / walker_fps);
      if (one.position.is_at_end())
        one.outcome.left_s = static_cast<double>(frame + 1) / walker_fps - left_m / one.speed_m_s;
      else
        one.facing = one.position.ahead();
    }
  }

  const PeopleFloor& floor_;
  const PeopleOptions& options_;
  WaysOut& ways_;
  const AskEyes& ask_;
  std::vector<Walker> people_;
  size_t inside_ = 0;
  PeopleWalked out_;
};

}  // namespace

Result<void> check_people(const PeopleOptions& options) {
  if (options.count < 1 || options.count > limits::walkers)
    return problem(fmt::format("{} people cannot walk: give a --count from 1 to {}", options.count,
                               limits::walkers));
  if (!(options.speed_deviation_m_s >= 0 &&
        options.speed_m_s > most_deviations * options.speed_deviation_m_s))
    return problem(
        fmt::format("a speed of {:g} m/s with a deviation of {:g} m/s lets people stand still: "
                    "give a --speed whose mean is more than {:g} deviations",
                    options.speed_m_s, options.speed_deviation_m_s, most_deviations));
  if (!(options.until_s > options.from_s))
    return problem(fmt::format("the people walk from {:g} to {:g} s: give an --until that is later",
                               options.from_s, options.until_s));
  if (!(options.leave_from_s >= options.from_s && options.leave_to_s >= options.leave_from_s &&
        options.leave_to_s <= options.until_s))
    return problem(
        fmt::format("people who set out between {:g} and {:g} s do not do so within "
                    "{:g} to {:g} s: give another --leave-at or --until",
                    options.leave_from_s, options.leave_to_s, options.from_s, options.until_s));
  const double rows = options.count * (options.until_s - options.from_s) * walker_fps;
  if (rows > static_cast<double>(limits::written_rows))
    return problem(
        fmt::format("{} people for {:g} s take up to {:.3g} rows; at most {} are "
                    "written: give a smaller --count or an earlier --until",
                    options.count, options.until_s - options.from_s, rows, limits::written_rows));
  return {};
}

Result<PeopleWalked> walk_people(const PeopleFloor& floor, const PeopleOptions& options,
                                 WaysOut& ways, const AskEyes& ask,
                                 const std::function<void(double share)>& progress) {
  return Walking(floor, options, ways, ask).run(progress);
}

}  // namespace luxodus
