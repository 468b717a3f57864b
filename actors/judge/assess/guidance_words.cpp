#include "actors/judge/assess/guidance_words.hpp"

#include <fmt/format.h>

namespace luxodus {

namespace {

/// "up to 30 s, lost by 60 s at 4 m", "never", "up to the last state, 90 s".
std::string time_words(const GuidedRoute& route) {
  const GuidedTime time = guided_time(route);
  if (!time.until_s)
    return fmt::format("not from the first state on (at {:.3g} m)", time.lost_at_m);
  if (!time.lost_by_s) return fmt::format("up to the last state, {:g} s", *time.until_s);
  return fmt::format("up to {:g} s, lost by {:g} s (at {:.3g} m)", *time.until_s, *time.lost_by_s,
                     time.lost_at_m);
}

std::string walk_words(const GuidedWalk& walk, double speed_m_s) {
  const std::string out =
      fmt::format("sets out at {:g} s with {:g} m/s: ", walk.start_s, speed_m_s);
  if (walk.end == GuidedWalk::End::arrives)
    return out + fmt::format("guided to the end, at {:.3g} s", walk.at_s);
  return out + fmt::format("{} at {:.3g} m, at {:.3g} s",
                           walk.end == GuidedWalk::End::lost
                               ? "guidance is lost"
                               : "still on the way after the last state,",
                           walk.at_m, walk.at_s);
}

}  // namespace

CsvTable guidance_csv(const OverTime& over_time) {
  CsvTable table({"route", "eye_height_m", "at_s", "along_m", "guidance", "sign", "jin",
                  "line_of_sight", "fds_visibility_m", "fds"});
  for (const RouteOverTime& route : over_time.routes)
    for (size_t t = 0; t < over_time.states.size(); ++t)
      for (size_t i = 0; i < route.guided.along_m.size(); ++i) {
        std::optional<double> visibility_m;
        std::optional<std::string> fds;
        if (route.has_fds()) visibility_m = route.visibility_m[t][i];
        if (route.has_fds()) fds = name_of(route.by_fds.at[t][i]);
        table.row(route.route, route.eye_height_m, over_time.states[t].at_s,
                  route.guided.along_m[i], name_of(route.guided.at[t][i]), route.signs[t][i],
                  name_of(route.by_jin.at[t][i]), name_of(route.by_line.at[t][i]), visibility_m,
                  fds);
      }
  return table;
}

std::string guidance_text(const OverTime& over_time) {
  std::string out =
      fmt::format("guided routes over {} states. {}\n", over_time.states.size(), OverTime::what());
  for (const RouteOverTime& route : over_time.routes) {
    out += fmt::format("  route \"{}\", eyes at {:g} m: guided {}; by Jin's law {}\n", route.route,
                       route.eye_height_m, time_words(route.guided), time_words(route.by_jin));
    out += fmt::format("    by lines of sight {}\n", time_words(route.by_line));
    if (route.has_fds())
      out += fmt::format("    by FDS's VISIBILITY {}\n", time_words(route.by_fds));
    for (const WalkRecord& walk : route.walks)
      out += "    " + walk_words(walk, over_time.walking_speed_m_s.value_or(0)) + "\n";
  }
  return out;
}

}  // namespace luxodus
