// Guidance of routes over the states of a scene, as an assessment finds it and its record holds it.
// Plain values; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "actors/results/formats/json_fields.hpp"
#include "scenes/emergency/guidance.hpp"

namespace luxodus {

/// A state of an assessment over time.
struct TimedState {
  double at_s = 0;
  Operation operation = Operation::mains;
  std::optional<double> seconds_after_failure;
  size_t lit = 0;  // number of lit luminaires
  struct Frame {
    std::string medium;
    double time_s = 0;
    static constexpr void fields(auto&& field, auto& m) {
      field("medium", m.medium)("time", m.time_s, {.unit = "s"});
    }
  };
  std::vector<Frame> frames;  // times whose smoke the fire simulations give
  static constexpr void fields(auto&& field, auto& m) {
    field("at", m.at_s, {.unit = "s"})("operation", m.operation);
    field("after_failure", m.seconds_after_failure, {.unit = "s", .or_null = true});
    field("lit_luminaires", m.lit)("frames", m.frames);
  }
};

/// A guided time as JSON: a place is known only where guidance was lost.
struct GuidedTimeRecord {
  std::optional<double> until_s, lost_by_s, lost_at_m;
  explicit GuidedTimeRecord(const GuidedTime& time = {});
  static constexpr void fields(auto&& field, auto& m) {
    field("until", m.until_s, {.unit = "s", .or_null = true});
    field("lost_by", m.lost_by_s, {.unit = "s", .or_null = true});
    field("lost_at", m.lost_at_m, {.unit = "m", .or_null = true});
  }
};

/// A walk over a guided route.
struct WalkRecord : GuidedWalk {
  static constexpr void fields(auto&& field, auto& m) {
    field("start", m.start_s, {.unit = "s"})("end", m.end);
    field("at", m.at_m, {.unit = "m"})("at_time", m.at_s, {.unit = "s"});
  }
};

/// How one route guides people of one eye height, over all states. Guidance at a state is written
/// as a text with a letter for each place: "g" guided, "u" undecided, "n" not guided.
struct RouteOverTime {
  std::string route;
  double eye_height_m = 0;
  GuidedRoute guided;
  GuidedRoute by_jin;   // verdict of Jin's law on the same signs
  GuidedRoute by_line;  // verdict of the line-of-sight method
  /// Verdict of FDS's VISIBILITY: a sign is seen if it is no farther away than VISIBILITY at the
  /// place. Has no states if the case has no slices of it.
  GuidedRoute by_fds;
  std::vector<std::vector<std::optional<double>>> visibility_m;  // by FDS; by state and place
  /// By state and place: the sign that guides, or would guide if it were read; "" if there is none.
  std::vector<std::vector<std::string>> signs;
  std::vector<WalkRecord> walks;  // one walker starts at each state; empty without walking speed

  bool has_fds() const { return !by_fds.at.empty(); }
  static constexpr void fields(auto&& field, auto& m) {
    const auto time_of = [](const GuidedRoute& route) {
      return derived([&route] { return GuidedTimeRecord(guided_time(route)); });
    };
    const auto time_by_fds = derived([&m] {
      std::optional<GuidedTimeRecord> out;
      if (m.has_fds()) out.emplace(guided_time(m.by_fds));
      return out;
    });
    field("route", m.route)("eye_height", m.eye_height_m, {.unit = "m"});
    field("length", m.guided.length_m, {.unit = "m"})("places", m.guided.along_m);
    field("guided", m.guided.at)("jin", m.by_jin.at)("line_of_sight", m.by_line.at);
    field("signs", m.signs);
    field("time", time_of(m.guided))("time_by_jin", time_of(m.by_jin));
    field("time_by_line_of_sight", time_of(m.by_line));
    field("fds", m.by_fds.at, {.or_left_out = true})("time_by_fds", time_by_fds);
    field("fds_visibility", m.visibility_m, {.or_null = true, .or_left_out = true});
    field("walks", m.walks);
  }
};

/// For which smoke the verdicts hold.
struct HoldsFor {
  double low_albedo = 0, high_albedo = 0;  // both 0: there is no smoke
  double depth_error = 0;                  // largest error of smoke sources
  static constexpr void fields(auto&& field, auto& m) {
    field("albedo_min", m.low_albedo)("albedo_max", m.high_albedo);
    field("optical_depth_error", m.depth_error);
  }
};

struct OverTime {
  std::vector<TimedState> states;
  std::vector<RouteOverTime> routes;
  std::optional<double> walking_speed_m_s;
  HoldsFor holds_for;
  std::vector<std::string> warnings;  // comparisons that could not be made
  int64_t paths = 0;                  // number of paths from eyes

  /// Says what guidance is, and what it is not.
  static const char* what();
  static constexpr void fields(auto&& field, auto& m) {
    field("what", derived([] { return std::string(what()); }));
    field("walking_speed", m.walking_speed_m_s, {.unit = "m/s", .or_null = true});
    field("guiding_angle", derived([] { return guiding_angle_deg; }), {.unit = "deg"});
    field("eye_paths", m.paths)("holds_for", m.holds_for)("states", m.states)("routes", m.routes);
  }
};

}  // namespace luxodus
