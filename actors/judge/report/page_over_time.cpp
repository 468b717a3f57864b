// Section on guidance over time: maps of place and time, and how far walkers get.
#include <algorithm>

#include "actors/judge/report/guidance_map.hpp"
#include "actors/judge/report/page.hpp"

namespace luxodus {

namespace {

double number_in(const Json& measured) {
  return measured["value"].get<double>();
}

/// "up to 30 s, lost by 60 s".
std::string time_text(const Texts& t, const Json& time) {
  if (!time["until"].is_object()) return t("guided.never");
  const std::string until = t.number(number_in(time["until"]), 4);
  if (!time["lost_by"].is_object()) return t.say("guided.always", until);
  return t.say("guided.until", until, t.number(number_in(time["lost_by"]), 4));
}

std::string lost_text(const Texts& t, const Json& time) {
  return time["lost_at"].is_object() ? t.number(number_in(time["lost_at"])) + "\u00a0m" : "–";
}

bool has_fds(const Json& route) {
  const auto at = route.find("time_by_fds");
  return at != route.end() && !at->is_null();
}

std::string routes_table(const Texts& t, const Json& over) {
  const Json& routes = over["routes"];
  const bool fds = std::any_of(routes.begin(), routes.end(), has_fds);
  std::string rows;
  for (const Json& route : over["routes"])
    rows +=
        "<tr>" + cell(text_in(route, "route")) +
        html_cell(escaped(t.fixed(number_in(route["eye_height"]))) + "\u00a0m", "n") +
        cell(time_text(t, route["time"])) + html_cell(escaped(lost_text(t, route["time"])), "n") +
        cell(time_text(t, route["time_by_jin"])) +
        cell(time_text(t, route["time_by_line_of_sight"])) +
        (fds ? cell(has_fds(route) ? time_text(t, route["time_by_fds"]) : "–") : "") + "</tr>\n";
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

std::string walk_text(const Texts& t, const Json& walk) {
  const std::string end = text_in(walk, "end"), at = t.number(number_in(walk["at"])),
                    when = t.number(number_in(walk["at_time"]), 4);
  return end == "arrives" ? t.say("walk.arrives", when)
         : end == "lost"  ? t.say("walk.lost", at, when)
                          : t.say("walk.unknown", at, when);
}

std::string walks_table(const Texts& t, const Json& over) {
  std::string rows;
  for (const Json& route : over["routes"])
    for (const Json& walk : route["walks"])
      rows += "<tr>" + cell(text_in(route, "route")) +
              html_cell(escaped(t.fixed(number_in(route["eye_height"]))) + "\u00a0m", "n") +
              html_cell(escaped(t.number(number_in(walk["start"]), 4)) + "\u00a0s", "n") +
              cell(walk_text(t, walk)) + "</tr>\n";
  if (rows.empty()) return "";
  return subheading(t("guided.walks")) +
         paragraph(t.say("guided.walks_lead", t.number(number_in(over["walking_speed"])))) +
         table(t, {"column.route", "column.eye_height", "column.start", "column.walk"},
               {26, 12, 12, 50}, rows);
}

}  // namespace

std::string over_time_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  const auto at = parts.a.find("over_time");
  if (at == parts.a.end()) return "";
  const Json& over = *at;
  std::string out = paragraph(t("guided.lead")) + paragraph(t("guided.no_aset"), "note");
  const Json& holds = over["holds_for"];
  if (holds["albedo_max"].get<double>() > 0)
    out += paragraph(t.say("guided.holds_for", t.number(holds["albedo_min"].get<double>()),
                           t.number(holds["albedo_max"].get<double>()),
                           t.number(100 * holds["optical_depth_error"].get<double>())),
                     "note");
  out += routes_table(t, over);
  for (const Json& route : over["routes"])
    out += "<figure class=\"plan\">" + guidance_map(over, route, t, parts.paper_width_mm) +
           "<figcaption><b>" +
           escaped(t.say("guided.map", text_in(route, "route"),
                         t.fixed(number_in(route["eye_height"])))) +
           "</b> " + escaped(t("guided.map_note")) + "</figcaption></figure>\n";
  return out + walks_table(t, over);
}

}  // namespace luxodus
