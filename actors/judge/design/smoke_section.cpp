#include "actors/judge/design/smoke_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "actors/judge/report/html.hpp"
#include "actors/results/formats/svg_plot.hpp"

namespace luxodus {

namespace {

/// "62 %", "62 to 70 %".
std::string share_words(const Texts& t, const LegibleShare& share) {
  const std::string least = t.fixed(100 * share.least, 0), most = t.fixed(100 * share.most, 0);
  return least == most ? least + " %" : t.say("design.smoke_range", least, most);
}

/// "+2.1 to +5.0 %", "-1.1 to 0 %", "0 %".
std::string difference_words(const Texts& t, const ShareDifference& difference) {
  const auto percent = [&](double share) {
    const double tenths = std::round(1000 * share);
    if (tenths == 0) return std::string("0");
    return (tenths > 0 ? "+" : "−") + t.fixed(std::abs(tenths) / 10, 1);
  };
  const std::string least = percent(difference.least), most = percent(difference.most);
  return least == most ? least + " %" : t.say("design.smoke_range", least, most);
}

/// "120 s", "60 to 120 s", "never".
std::string until_words(const Texts& t, const GuidedRecord& guided) {
  const auto &least = guided.min_s, &most = guided.max_s;
  const auto seconds = [&](const std::optional<double>& value) { return t.fixed(*value, 0); };
  if (!most) return t("design.smoke_until_never");
  if (!least) return t.say("design.smoke_until_up_to", seconds(most));
  if (guided.never_lost) return t.say("design.smoke_until_last", seconds(least));
  return least == most ? t.say("design.smoke_until_s", seconds(least))
                       : t.say("design.smoke_until_range", seconds(least), seconds(most));
}

/// "120 of 2133", "120 to 140 of 2133".
std::string people_words(const Texts& t, const PeopleUnreadRecord& people) {
  const std::string least = t.fixed(people.least_s, 0), most = t.fixed(people.most_s, 0),
                    all = t.fixed(people.all_s, 0);
  return least == most ? t.say("design.people_s", least, all)
                       : t.say("design.people_range", least, most, all);
}

const SmokeLayoutRecord& named_layout(const SmokeRecord& smoke, const std::string& name) {
  for (const SmokeLayoutRecord& one : smoke.layouts)
    if (one.name == name) return one;
  return smoke.layouts[0];
}

/// Upper end of the difference from the first layout, over all layouts with unchanged signs.
double max_beyond_first(const SmokeRecord& smoke) {
  double out = 0;
  for (const SmokeLayoutRecord& one : smoke.layouts)
    if (!one.has_other_signs()) out = std::max(out, one.beyond_first.most);
  return out;
}

/// Among layouts of larger objective, the one that loses most places on balance.
const SmokeLayoutRecord* most_veiling(const SmokeRecord& smoke) {
  const SmokeLayoutRecord& first = smoke.layouts[0];
  const SmokeLayoutRecord* out = nullptr;
  int64_t most = 1;  // one place may be a statistical fluctuation
  for (const SmokeLayoutRecord& one : smoke.layouts) {
    const auto net = static_cast<int64_t>(one.places_lost) - static_cast<int64_t>(one.places_won);
    if (one.has_other_signs() || net <= most || !(one.objective > first.objective)) continue;
    most = net;
    out = &one;
  }
  return out;
}

PlotSeries series_of(const Texts& t, const char* name, const SmokeRecord& smoke,
                     const std::function<bool(const SmokeLayoutRecord&)>& belongs) {
  PlotSeries out;
  out.name = t(name);
  out.line = false;
  for (const SmokeLayoutRecord& one : smoke.layouts) {
    if (!belongs(one)) continue;
    out.x.push_back(one.objective);
    out.y.push_back(50 * (one.worst.least + one.worst.most));
    out.error.push_back(50 * (one.worst.most - one.worst.least));
    const std::string layout = one.name;
    out.labels.push_back(
        one.guided ? t.say("design.smoke_until_label", layout, until_words(t, *one.guided))
                   : layout);
  }
  return out;
}

std::string plot_of(const Texts& t, const DesignRecord& design) {
  const SmokeRecord& smoke = *design.smoke;
  SvgPlot plot;
  plot.title = t("design.smoke_plot");
  plot.label_x = t.word("design.objective", design.objective.kind);
  plot.label_y = t("design.smoke_axis");
  plot.height = 420;
  const auto as_they_are = [](const SmokeLayoutRecord& one) { return !one.has_other_signs(); };
  for (PlotSeries series :
       {series_of(t, "design.smoke_front", smoke,
                  [&](const SmokeLayoutRecord& one) { return one.on_front; }),
        series_of(t, "design.smoke_others", smoke,
                  [&](const SmokeLayoutRecord& one) { return as_they_are(one) && !one.on_front; }),
        series_of(t, "design.smoke_bright", smoke,
                  std::mem_fn(&SmokeLayoutRecord::has_brighter_signs)),
        series_of(t, "design.smoke_low", smoke, std::mem_fn(&SmokeLayoutRecord::has_low_signs))})
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  const auto svg = svg_plot_text(plot, {});
  return svg ? figure(svg.value(), t("design.smoke_plot_note")) : "";
}

std::string rows_of(const Texts& t, const SmokeRecord& smoke) {
  std::string out;
  for (const SmokeLayoutRecord& one : smoke.layouts) {
    std::string by_scenario;
    for (const SmokeScenarioRecord& scenario : one.scenarios)
      by_scenario +=
          (by_scenario.empty() ? "" : "; ") + scenario.name + ": " + share_words(t, scenario.all);
    const std::string name =
        one.has_brighter_signs() ? t.say("design.smoke_bright_row", smoke.layouts[0].name)
        : one.has_low_signs()    ? t.say("design.smoke_low_row", smoke.layouts[0].name)
                                 : one.name + (one.on_front ? " ●" : "");
    const std::string file = one.file;
    out += "<tr>" + cell(name) + number_cell(t, one.luminaires) + number_cell(t, one.cost, "", 4) +
           number_cell(t, one.watts, "W") + cell(by_scenario) +
           cell(&one == &smoke.layouts[0] ? "–" : difference_words(t, one.beyond_first)) +
           (one.guided ? cell(until_words(t, *one.guided)) : "") +
           (one.people ? cell(people_words(t, *one.people)) : "") +
           html_cell(file.empty() ? "–"
                                  : "<a href=\"" + escaped(file) + "\">" + escaped(file) + "</a>") +
           "</tr>\n";
  }
  return out;
}

/// What ended the elimination rounds, and which layouts are not ranked; "" if all are.
std::string end_words(const Texts& t, const SmokeRecord& smoke) {
  if (smoke.end == RaceEnd::interrupted) return t("design.smoke_interrupted");
  std::string open;
  int rounds = 0;
  for (const SmokeLayoutRecord& one : smoke.layouts) {
    rounds = std::max(rounds, one.rounds);
    if (one.open) open += (open.empty() ? "" : ", ") + one.name;
  }
  if (open.empty()) return "";
  return t.say(smoke.end == RaceEnd::time ? "design.smoke_time" : "design.smoke_rounds", rounds,
               open);
}

}  // namespace

std::vector<std::string> smoke_words(const Texts& t, const SmokeRecord& smoke) {
  const SmokeLayoutRecord &first = smoke.layouts[0], &best = named_layout(smoke, smoke.recommended);
  const std::string first_name = first.name, best_name = best.name;
  std::vector<std::string> out{
      t.say("design.smoke_first", first_name, share_words(t, first.worst))};
  if (first.people && best.people)
    out.push_back(best_name == first_name
                      ? t.say("design.people_same", first_name, people_words(t, *first.people))
                      : t.say("design.people_better", best_name, best.luminaires, first.luminaires,
                              people_words(t, *best.people), first_name,
                              people_words(t, *first.people)));
  else if (best_name == first_name)
    out.emplace_back(t("design.smoke_same"));
  else
    out.push_back(t.say("design.smoke_better", best_name, best.luminaires, first.luminaires,
                        share_words(t, best.worst), difference_words(t, best.beyond_first),
                        first_name));
  for (const SmokeLayoutRecord& one : smoke.layouts) {
    constexpr double rounding = 1e-9;
    const bool helps = one.beyond_first.least > max_beyond_first(smoke) + rounding;
    if (one.has_brighter_signs())
      out.push_back(t.say(helps ? "design.smoke_signs_help" : "design.smoke_signs",
                          t.number(one.sign_factor, 2), share_words(t, one.worst)));
    if (one.has_low_signs())
      out.push_back(t.say(helps ? "design.smoke_low_helps" : "design.smoke_low_signs",
                          one.low_signs, t.number(low_sign_height_m, 2),
                          share_words(t, one.worst)));
  }
  if (const SmokeLayoutRecord* veiling = most_veiling(smoke))
    out.push_back(t.say("design.smoke_veil", veiling->name, veiling->places_lost, first_name));
  if (first.guided)
    out.push_back(!first.guided->max_s ? t.say("design.smoke_until_no", first_name)
                                       : t.say("design.smoke_until_first", first_name,
                                               until_words(t, *first.guided)));
  if (const std::string ended = end_words(t, smoke); !ended.empty()) out.push_back(ended);
  return out;
}

std::string smoke_section(const Texts& t, const DesignRecord& design) {
  const SmokeRecord& smoke = *design.smoke;
  std::string out = "<h2>" + escaped(t("design.smoke_heading")) + "</h2>\n";
  for (const std::string& words : smoke_words(t, smoke)) out += paragraph(words);
  out += plot_of(t, design);
  const bool followed = smoke.layouts[0].guided.has_value(),
             people = smoke.layouts[0].people.has_value();
  std::vector<const char*> columns{"design.smoke_layout", "column.count",
                                   "design.smoke_cost",   "design.smoke_watts",
                                   "design.smoke_read",   "design.smoke_beyond_first",
                                   "design.smoke_file"};
  std::vector<int> widths{14, 8, 10, 10, 26, 14, 18};
  if (followed) {
    columns.insert(columns.end() - 1, "design.smoke_until");
    widths = {12, 8, 8, 8, 22, 12, 12, 18};
  }
  if (people) {
    columns.insert(columns.end() - 1, "design.people_column");
    widths.insert(widths.end() - 1, 12);
    widths[4] -= 8;
    widths.back() -= 4;
  }
  out += table(t, columns, widths, rows_of(t, smoke)) +
         paragraph(t.say("design.smoke_note", t.number(smoke.ahead_deg, 2)), "note");
  if (people) out += paragraph(t("design.people_note"), "note");
  return followed ? out + paragraph(t("design.smoke_until_note"), "note") : out;
}

}  // namespace luxodus
