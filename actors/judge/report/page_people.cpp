// Section on people who were followed on their way: how many read a sign over time, where nobody
// did, what each sign gave, and who was longest without one.
#include <algorithm>
#include <cmath>

#include "actors/judge/report/page.hpp"
#include "actors/judge/report/people_map.hpp"

namespace luxodus {

namespace {

/// People of the table of those who were longest without a sign.
constexpr size_t listed_people = 10;
/// Levels of two plans of one building differ by rounding at most [m].
constexpr double same_level_m = 1e-3;

/// Rounded so that a share that is neither none nor all is not said to be.
std::string share_text(const Texts& t, double part, double all) {
  const double percent = all > 0 ? 100 * part / all : 0;
  return t.fixed(std::clamp(percent, part > 0 ? 0.1 : 0.0, part < all ? 99.9 : 100.0), 1);
}

std::string totals_text(const Texts& t, const FollowedPeople& people) {
  const PeopleTotals totals = totals_of(people.people);
  return t.say("people.totals", share_text(t, totals.read_s, totals.all_s),
               t.fixed(totals.all_s, 0), share_text(t, totals.undecided_s, totals.all_s),
               share_text(t, totals.unread_s(), totals.all_s), totals.never,
               t.number(totals.longest_unread_s, 4));
}

std::string curve_figure(const Texts& t, const FollowedPeople& people) {
  const auto svg = svg_plot_text(people_curve(people, t), {});
  if (!svg) return "";  // more points than a plot takes: curve.csv has them
  const std::string& text = svg.value();
  return "<figure class=\"chart\">" + text.substr(text.find("<svg")) + "</figure>\n";
}

std::string maps(const PageParts& parts, const FollowedPeople& people) {
  const Texts& t = parts.texts;
  std::string out;
  for (const WalkedFloor& floor : people.floors)
    for (const PlanLevel& level : parts.a.plan.levels) {
      if (floor.cells.empty() || std::abs(level.floor_m - floor.floor_m) > same_level_m) continue;
      const PlanSize size{parts.paper_width_mm, 100};
      out += "<figure class=\"plan\">" + people_map(level, floor, people.cell_m, t, size).svg +
             "<figcaption><b>" + escaped(t.say("people.map", t.fixed(floor.floor_m))) + "</b> " +
             escaped(t.say("people.map_note", t.number(people.cell_m))) +
             "</figcaption></figure>\n";
    }
  return out;
}

std::string seconds_cell(const Texts& t, double seconds) {
  return html_cell(escaped(t.number(seconds, 4)), "n");
}

std::string signs_table(const Texts& t, const FollowedPeople& people) {
  std::string rows;
  for (const PassedSign& sign : people.signs) {
    rows += "<tr>" + cell(sign.name);
    for (const double seconds : {sign.in_view_s, sign.read_s, sign.seen_s, sign.invisible_s,
                                 sign.hidden_s, sign.hidden_by_people_s, sign.undecided_s})
      rows += seconds_cell(t, seconds);
    rows += number_cell(t, sign.readers) + "</tr>\n";
  }
  return subheading(t("people.signs")) +
         table(t,
               {"column.sign", "column.in_view", "column.read_s", "column.seen_s",
                "column.invisible_s", "column.hidden_s", "column.by_people_s", "column.undecided_s",
                "column.readers"},
               {24, 10, 9, 9, 10, 9, 10, 10, 9}, rows);
}

std::string longest_table(const Texts& t, const FollowedPeople& people) {
  std::vector<const FollowedPerson*> order;
  for (const FollowedPerson& one : people.people)
    if (one.longest_unread_s > 0) order.push_back(&one);
  std::stable_sort(order.begin(), order.end(), [](const auto* a, const auto* b) {
    return a->longest_unread_s > b->longest_unread_s;
  });
  order.resize(std::min(order.size(), listed_people));
  if (order.empty()) return "";
  std::string rows;
  for (const FollowedPerson* one : order)
    rows += "<tr>" + cell(one->group) + cell(std::to_string(one->id)) +
            html_cell(escaped(t.number(one->from_s, 4) + "–" + t.number(one->to_s, 4)), "n") +
            seconds_cell(t, one->read_s) + seconds_cell(t, one->undecided_s) +
            seconds_cell(t, one->unread_s) + seconds_cell(t, one->longest_unread_s) +
            number_cell(t, one->mean_extinction) + "</tr>\n";
  return subheading(t("people.longest")) +
         table(t,
               {"column.group", "column.person", "column.there", "column.read_s",
                "column.undecided_s", "column.unread_s", "column.longest_s", "column.smoke_at_eye"},
               {20, 10, 14, 10, 11, 10, 12, 13}, rows);
}

}  // namespace

std::string people_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  if (!parts.people) return "";
  const FollowedPeople& people = *parts.people;
  if (people.scene != parts.a.scene.name || people.scenario != parts.a.scene.scenario)
    return paragraph(t.say("people.other", people.scene, people.scenario), "note");
  return paragraph(t.say("people.lead", people.people.size(), t.number(people.step_s),
                         t.number(people.field_of_view_deg))) +
         paragraph(t(people.crowd_hides ? "people.crowd" : "people.no_crowd")) +
         paragraph(totals_text(t, people)) + paragraph(t("guided.no_aset"), "note") +
         curve_figure(t, people) + maps(parts, people) + signs_table(t, people) +
         longest_table(t, people);
}

}  // namespace luxodus
