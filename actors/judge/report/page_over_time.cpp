// Section on guidance over time: maps of place and time, and how far walkers get.
#include <algorithm>

#include "actors/judge/report/guidance_map.hpp"
#include "actors/judge/report/page.hpp"

namespace luxodus {

namespace {

/// "up to 30 s, lost by 60 s".
std::string time_text(const Texts& t, const GuidedRoute& route) {
  const GuidedTime time = guided_time(route);
  if (!time.until_s) return t("guided.never");
  const std::string until = t.number(*time.until_s, 4);
  if (!time.lost_by_s) return t.say("guided.always", until);
  return t.say("guided.until", until, t.number(*time.lost_by_s, 4));
}

std::string lost_text(const Texts& t, const GuidedRoute& route) {
  const GuidedTime time = guided_time(route);
  return time.lost_by_s ? t.number(time.lost_at_m) + "\u00a0m" : "–";
}

std::string routes_table(const Texts& t, const OverTime& over) {
  const bool fds = std::any_of(over.routes.begin(), over.routes.end(),
                               [](const RouteOverTime& route) { return route.has_fds(); });
  std::string rows;
  for (const RouteOverTime& route : over.routes)
    rows += "<tr>" + cell(route.route) +
            html_cell(escaped(t.fixed(route.eye_height_m)) + "\u00a0m", "n") +
            cell(time_text(t, route.guided)) + html_cell(escaped(lost_text(t, route.guided)), "n") +
            cell(time_text(t, route.by_jin)) + cell(time_text(t, route.by_line)) +
            (fds ? cell(route.has_fds() ? time_text(t, route.by_fds) : "–") : "") + "</tr>\n";
  const std::string note = paragraph(t("guided.line_note"), "note");
  if (!fds)
    return note + table(t,
                        {"column.route", "column.eye_height", "column.guided", "column.lost_at",
                         "column.guided_jin", "column.guided_line"},
                        {18, 10, 22, 10, 20, 20}, rows);
  return note + paragraph(t("guided.fds_note"), "note") +
         table(t,
               {"column.route", "column.eye_height", "column.guided", "column.lost_at",
                "column.guided_jin", "column.guided_line", "column.guided_fds"},
               {14, 9, 19, 10, 16, 16, 16}, rows);
}

std::string walk_text(const Texts& t, const GuidedWalk& walk) {
  const std::string at = t.number(walk.at_m), when = t.number(walk.at_s, 4);
  return walk.end == GuidedWalk::End::arrives ? t.say("walk.arrives", when)
         : walk.end == GuidedWalk::End::lost  ? t.say("walk.lost", at, when)
                                              : t.say("walk.unknown", at, when);
}

std::string walks_table(const Texts& t, const OverTime& over) {
  std::string rows;
  for (const RouteOverTime& route : over.routes)
    for (const WalkRecord& walk : route.walks)
      rows += "<tr>" + cell(route.route) +
              html_cell(escaped(t.fixed(route.eye_height_m)) + "\u00a0m", "n") +
              html_cell(escaped(t.number(walk.start_s, 4)) + "\u00a0s", "n") +
              cell(walk_text(t, walk)) + "</tr>\n";
  if (rows.empty()) return "";
  return subheading(t("guided.walks")) +
         paragraph(t.say("guided.walks_lead", t.number(over.walking_speed_m_s.value_or(0)))) +
         table(t, {"column.route", "column.eye_height", "column.start", "column.walk"},
               {26, 12, 12, 50}, rows);
}

}  // namespace

std::string over_time_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  if (!parts.a.over_time) return "";
  const OverTime& over = *parts.a.over_time;
  std::string out = paragraph(t("guided.lead")) + paragraph(t("guided.no_aset"), "note");
  const HoldsFor& holds = over.holds_for;
  if (holds.high_albedo > 0)
    out += paragraph(t.say("guided.holds_for", t.number(holds.low_albedo),
                           t.number(holds.high_albedo), t.number(100 * holds.depth_error)),
                     "note");
  out += routes_table(t, over);
  for (const RouteOverTime& route : over.routes)
    out += "<figure class=\"plan\">" + guidance_map(over, route, t, parts.paper_width_mm) +
           "<figcaption><b>" +
           escaped(t.say("guided.map", route.route, t.fixed(route.eye_height_m))) + "</b> " +
           escaped(t("guided.map_note")) + "</figcaption></figure>\n";
  return out + walks_table(t, over);
}

}  // namespace luxodus
