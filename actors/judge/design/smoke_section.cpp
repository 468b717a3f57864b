#include "actors/judge/design/smoke_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "actors/judge/design/json_cells.hpp"
#include "actors/results/formats/svg_plot.hpp"

namespace luxodus {

namespace {

Json share_json(const LegibleShare& share) {
  return {{"least", number_json(share.least)}, {"most", number_json(share.most)}};
}

Json difference_json(const ShareDifference& difference) {
  return {{"least", number_json(difference.least)}, {"most", number_json(difference.most)}};
}

Json optional_seconds(const std::optional<double>& seconds) {
  return seconds ? number_json(*seconds) : Json();
}

Json guided_json(const JudgedLayout& one) {
  if (one.guided.empty()) return {};
  Json routes = Json::array();
  for (const GuidedUntil& route : one.guided)
    routes.push_back({{"route", route.route},
                      {"height_m", number_json(route.height_m)},
                      {"until_least_s", optional_seconds(route.least.until_s)},
                      {"until_most_s", optional_seconds(route.most.until_s)}});
  const FirstLoss loss = first_loss_of(one.guided);
  return {{"until_least_s", optional_seconds(loss.min_s)},
          {"until_most_s", optional_seconds(loss.max_s)},
          {"never_lost", loss.never_lost},
          {"routes", std::move(routes)}};
}

Json layout_json(const SmokeStage& stage, const JudgedLayout& one) {
  Json scenarios = Json::array();
  for (const SmokeVerdict& verdict : one.smoke) {
    Json heights = Json::array();
    for (size_t i = 0; i < verdict.by_height.size(); ++i) {
      Json share = share_json(verdict.by_height[i]);
      share["height_m"] = number_json(stage.heights_m[i]);
      heights.push_back(std::move(share));
    }
    scenarios.push_back({{"name", verdict.scenario},
                         {"all", share_json(verdict.all)},
                         {"beyond_first", difference_json(verdict.beyond_first)},
                         {"by_height", std::move(heights)}});
  }
  return {{"name", one.name},
          {"file", file_of(one)},
          {"on_front", one.on_front},
          {"objective", number_json(one.objective)},
          {"luminaires", one.placed},
          {"cost", number_json(one.cost)},
          {"watts", number_json(one.watts)},
          {"sign_factor", number_json(one.sign_factor)},
          {"low_signs", one.low_signs.size()},
          {"rounds", one.rounds},
          {"open", one.is_open},
          {"guided", guided_json(one)},
          {"places_lost", one.lost},
          {"places_won", one.won},
          {"worst", share_json(one.worst())},
          {"beyond_first", difference_json(difference_of(stage.layouts.front(), one))},
          {"scenarios", std::move(scenarios)}};
}

double min_of(const Json& layout) {
  return layout["worst"]["least"].get<double>();
}
double max_of(const Json& layout) {
  return layout["worst"]["most"].get<double>();
}
double surely_beyond_first(const Json& layout) {
  return layout["beyond_first"]["least"].get<double>();
}
bool has_brighter_signs(const Json& layout) {
  return layout["sign_factor"].get<double>() != 1;
}
bool has_low_signs(const Json& layout) {
  return layout["low_signs"].get<size_t>() > 0;
}
bool has_other_signs(const Json& layout) {
  return has_brighter_signs(layout) || has_low_signs(layout);
}

/// "62 %", "62 to 70 %".
std::string share_words(const Texts& t, const Json& share) {
  const std::string least = t.fixed(100 * share["least"].get<double>(), 0),
                    most = t.fixed(100 * share["most"].get<double>(), 0);
  return least == most ? least + " %" : t.say("design.smoke_range", least, most);
}

/// "+2.1 to +5.0 %", "-1.1 to 0 %", "0 %".
std::string difference_words(const Texts& t, const Json& difference) {
  const auto percent = [&](const char* end) {
    const double tenths = std::round(1000 * difference[end].get<double>());
    if (tenths == 0) return std::string("0");
    return (tenths > 0 ? "+" : "−") + t.fixed(std::abs(tenths) / 10, 1);
  };
  const std::string least = percent("least"), most = percent("most");
  return least == most ? least + " %" : t.say("design.smoke_range", least, most);
}

bool is_followed(const Json& layout) {
  return !layout["guided"].is_null();
}

/// "120 s", "60 to 120 s", "never".
std::string until_words(const Texts& t, const Json& guided) {
  const Json &least = guided["until_least_s"], &most = guided["until_most_s"];
  const auto seconds = [&](const Json& value) { return t.fixed(value.get<double>(), 0); };
  if (most.is_null()) return t("design.smoke_until_never");
  if (least.is_null()) return t.say("design.smoke_until_up_to", seconds(most));
  if (guided["never_lost"].get<bool>()) return t.say("design.smoke_until_last", seconds(least));
  return least == most ? t.say("design.smoke_until_s", seconds(least))
                       : t.say("design.smoke_until_range", seconds(least), seconds(most));
}

const Json& named_layout(const Json& smoke, const std::string& name) {
  const Json& layouts = smoke["layouts"];
  for (const Json& one : layouts)
    if (text_in(one, "name") == name) return one;
  return layouts[0];
}

/// Upper end of the difference from the first layout, over all layouts with unchanged signs.
double max_beyond_first(const Json& smoke) {
  double out = 0;
  for (const Json& one : smoke["layouts"])
    if (!has_other_signs(one)) out = std::max(out, one["beyond_first"]["most"].get<double>());
  return out;
}

/// Among layouts of larger objective, the one that loses most places on balance.
const Json* most_veiling(const Json& smoke) {
  const Json& first = smoke["layouts"][0];
  const Json* out = nullptr;
  int64_t most = 1;  // one place may be a statistical fluctuation
  for (const Json& one : smoke["layouts"]) {
    const int64_t net = one["places_lost"].get<int64_t>() - one["places_won"].get<int64_t>();
    if (has_other_signs(one) || net <= most ||
        !(one["objective"].get<double>() > first["objective"].get<double>()))
      continue;
    most = net;
    out = &one;
  }
  return out;
}

PlotSeries series_of(const Texts& t, const char* name, const Json& smoke,
                     const std::function<bool(const Json&)>& belongs) {
  PlotSeries out;
  out.name = t(name);
  out.line = false;
  for (const Json& one : smoke["layouts"]) {
    if (!belongs(one)) continue;
    out.x.push_back(one["objective"].get<double>());
    out.y.push_back(50 * (min_of(one) + max_of(one)));
    out.error.push_back(50 * (max_of(one) - min_of(one)));
    const std::string layout = text_in(one, "name");
    out.labels.push_back(
        is_followed(one) ? t.say("design.smoke_until_label", layout, until_words(t, one["guided"]))
                         : layout);
  }
  return out;
}

std::string plot_of(const Texts& t, const Json& design) {
  const Json& smoke = design["smoke"];
  SvgPlot plot;
  plot.title = t("design.smoke_plot");
  plot.label_x = t.word("design.objective", text_in(design["objective"], "kind"));
  plot.label_y = t("design.smoke_axis");
  plot.height = 420;
  const auto as_they_are = [](const Json& one) { return !has_other_signs(one); };
  for (PlotSeries series : {series_of(t, "design.smoke_front", smoke,
                                      [&](const Json& one) { return one["on_front"].get<bool>(); }),
                            series_of(t, "design.smoke_others", smoke,
                                      [&](const Json& one) {
                                        return as_they_are(one) && !one["on_front"].get<bool>();
                                      }),
                            series_of(t, "design.smoke_bright", smoke, has_brighter_signs),
                            series_of(t, "design.smoke_low", smoke, has_low_signs)})
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  const auto svg = svg_plot_text(plot, {});
  return svg ? figure(svg.value(), t("design.smoke_plot_note")) : "";
}

std::string rows_of(const Texts& t, const Json& smoke) {
  std::string out;
  for (const Json& one : smoke["layouts"]) {
    std::string by_scenario;
    for (const Json& scenario : one["scenarios"])
      by_scenario += (by_scenario.empty() ? "" : "; ") + text_in(scenario, "name") + ": " +
                     share_words(t, scenario["all"]);
    const std::string name =
        has_brighter_signs(one)
            ? t.say("design.smoke_bright_row", text_in(smoke["layouts"][0], "name"))
        : has_low_signs(one) ? t.say("design.smoke_low_row", text_in(smoke["layouts"][0], "name"))
                             : text_in(one, "name") + (one["on_front"].get<bool>() ? " ●" : "");
    const std::string file = text_in(one, "file");
    out += "<tr>" + cell(name) + number_cell(t, one["luminaires"]) +
           number_cell(t, one["cost"], "", 4) + number_cell(t, one["watts"], "W") +
           cell(by_scenario) +
           cell(&one == &smoke["layouts"][0] ? "–" : difference_words(t, one["beyond_first"])) +
           (is_followed(one) ? cell(until_words(t, one["guided"])) : "") +
           html_cell(file.empty() ? "–"
                                  : "<a href=\"" + escaped(file) + "\">" + escaped(file) + "</a>") +
           "</tr>\n";
  }
  return out;
}

/// What ended the elimination rounds, and which layouts are not ranked; "" if all are.
std::string end_words(const Texts& t, const Json& smoke) {
  const std::string end = text_in(smoke, "end");
  if (end == name_of(RaceEnd::interrupted)) return t("design.smoke_interrupted");
  std::string open;
  int64_t rounds = 0;
  for (const Json& one : smoke["layouts"]) {
    rounds = std::max(rounds, one["rounds"].get<int64_t>());
    if (one["open"].get<bool>()) open += (open.empty() ? "" : ", ") + text_in(one, "name");
  }
  if (open.empty()) return "";
  return t.say(end == name_of(RaceEnd::time) ? "design.smoke_time" : "design.smoke_rounds", rounds,
               open);
}

}  // namespace

std::string file_of(const JudgedLayout& layout) {
  if (layout.sign_factor != 1) return "alternatives/layout_A_brighter_signs.toml";
  if (!layout.low_signs.empty()) return "alternatives/layout_A_low_signs.toml";
  return layout.name == "A" ? "layout.toml" : "alternatives/layout_" + layout.name + ".toml";
}

Json smoke_json(const SmokeStage& stage) {
  Json layouts = Json::array();
  for (const JudgedLayout& one : stage.layouts) layouts.push_back(layout_json(stage, one));
  Json heights = Json::array();
  for (const double height : stage.heights_m) heights.push_back(number_json(height));
  return {{"scenarios", stage.scenarios},
          {"heights_m", std::move(heights)},
          {"ahead_deg", number_json(ahead_deg)},
          {"end", name_of(stage.end)},
          {"traces", stage.traces},
          {"paths", stage.paths},
          {"recommended", stage.recommended().name},
          {"layouts", std::move(layouts)}};
}

std::vector<std::string> smoke_words(const Texts& t, const Json& smoke) {
  const Json &first = smoke["layouts"][0],
             &best = named_layout(smoke, text_in(smoke, "recommended"));
  const std::string first_name = text_in(first, "name"), best_name = text_in(best, "name");
  std::vector<std::string> out{
      t.say("design.smoke_first", first_name, share_words(t, first["worst"]))};
  if (best_name == first_name)
    out.emplace_back(t("design.smoke_same"));
  else
    out.push_back(t.say("design.smoke_better", best_name, best["luminaires"].get<int64_t>(),
                        first["luminaires"].get<int64_t>(), share_words(t, best["worst"]),
                        difference_words(t, best["beyond_first"]), first_name));
  for (const Json& one : smoke["layouts"]) {
    constexpr double rounding = 1e-9;
    const bool helps = surely_beyond_first(one) > max_beyond_first(smoke) + rounding;
    if (has_brighter_signs(one))
      out.push_back(t.say(helps ? "design.smoke_signs_help" : "design.smoke_signs",
                          t.number(one["sign_factor"].get<double>(), 2),
                          share_words(t, one["worst"])));
    if (has_low_signs(one))
      out.push_back(t.say(helps ? "design.smoke_low_helps" : "design.smoke_low_signs",
                          one["low_signs"].get<int64_t>(), t.number(low_sign_height_m, 2),
                          share_words(t, one["worst"])));
  }
  if (const Json* veiling = most_veiling(smoke))
    out.push_back(t.say("design.smoke_veil", text_in(*veiling, "name"),
                        (*veiling)["places_lost"].get<int64_t>(), first_name));
  if (is_followed(first))
    out.push_back(
        first["guided"]["until_most_s"].is_null()
            ? t.say("design.smoke_until_no", first_name)
            : t.say("design.smoke_until_first", first_name, until_words(t, first["guided"])));
  if (const std::string ended = end_words(t, smoke); !ended.empty()) out.push_back(ended);
  return out;
}

std::string smoke_section(const Texts& t, const Json& design) {
  const Json& smoke = design["smoke"];
  std::string out = "<h2>" + escaped(t("design.smoke_heading")) + "</h2>\n";
  for (const std::string& words : smoke_words(t, smoke)) out += paragraph(words);
  out += plot_of(t, design);
  const bool followed = is_followed(smoke["layouts"][0]);
  std::vector<const char*> columns{"design.smoke_layout", "column.count",
                                   "design.smoke_cost",   "design.smoke_watts",
                                   "design.smoke_read",   "design.smoke_beyond_first",
                                   "design.smoke_file"};
  std::vector<int> widths{14, 8, 10, 10, 26, 14, 18};
  if (followed) {
    columns.insert(columns.end() - 1, "design.smoke_until");
    widths = {12, 8, 8, 8, 22, 12, 12, 18};
  }
  out +=
      table(t, columns, widths, rows_of(t, smoke)) +
      paragraph(t.say("design.smoke_note", t.number(smoke["ahead_deg"].get<double>(), 2)), "note");
  return followed ? out + paragraph(t("design.smoke_until_note"), "note") : out;
}

}  // namespace luxodus
