// The report of an assessment: one page that needs nothing beside itself and prints well. Summary
// first, then plans, signs, every check, and how it was found.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "actors/assess/assessment_json.hpp"
#include "actors/assess/plan_drawing.hpp"
#include "actors/assess/state_words.hpp"
#include "scenes/format/base64.hpp"
#include "scenes/format/output_text.hpp"

namespace luxodus {

namespace {

constexpr const char* style =
    "body { font-family: sans-serif; max-width: 70rem; margin: 2rem auto; padding: 0 1rem; "
    "color: #1b1b1b; }\n"
    "table { border-collapse: collapse; font-size: 0.8rem; width: 100%; margin: 0.5rem 0; }\n"
    "td, th { border: 1px solid #bbb; padding: 0.2rem 0.45rem; text-align: left; vertical-align: "
    "top; }\n"
    "td.n { text-align: right; white-space: nowrap; }\n"
    "svg, img { width: 100%; height: auto; }\n"
    ".pass, .legible { background: #e0f3e4; }\n"
    ".fail, .invisible { background: #fbdcd9; }\n"
    ".undecided, .not-assessed, .not-verified { background: #fdf3cf; }\n"
    ".visible-but-not-legible { background: #fde6c8; }\n"
    ".hidden-by-the-building, .information { background: #ececec; }\n"
    ".sum { font-size: 1.2rem; padding: 0.8rem; border: 1px solid #888; }\n"
    "figure { margin: 1rem 0; break-inside: avoid; }\n"
    ".maps { display: grid; grid-template-columns: 1fr 1fr 1fr; gap: 0 1rem; }\n"
    "figcaption { font-size: 0.8rem; }\n"
    "tr { break-inside: avoid; }\n"
    "@media print { body { max-width: none; margin: 0; } h2 { break-after: avoid; } }\n";

std::string text_of(const Json& object, const char* key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_string() ? at->get<std::string>() : std::string();
}

/// The class of a verdict: its words with hyphens.
std::string class_of(std::string verdict) {
  std::replace(verdict.begin(), verdict.end(), ' ', '-');
  return verdict;
}

std::string cell(const std::string& text) {
  return "<td>" + xml_escape(text) + "</td>";
}

std::string number_cell(const Json& value, const std::string& unit = "") {
  if (!value.is_number()) return "<td class=\"n\"></td>";
  return "<td class=\"n\">" + readable_number(value.get<double>()) +
         (unit.empty() || unit == "1" ? "" : " " + xml_escape(unit)) + "</td>";
}

/// A measured value with its standard error.
std::string measured_cell(const Json& row, const char* key) {
  const auto at = row.find(key);
  if (at == row.end() || !(*at)["value"].is_number()) return "<td></td>";
  std::string text = readable_number((*at)["value"].get<double>());
  if (at->contains("standard_error") && (*at)["standard_error"].is_number())
    text += " &plusmn; " + readable_number((*at)["standard_error"].get<double>(), 2);
  return "<td class=\"n\">" + text + "</td>";
}

std::string heading(const std::vector<const char*>& columns) {
  std::string out = "<table>\n<tr>";
  for (const char* column : columns) out += std::string("<th>") + column + "</th>";
  return out + "</tr>\n";
}

std::string verdict_cell(const Json& row) {
  const std::string verdict = text_of(row, "verdict");
  return "<td class=\"" + class_of(verdict) + "\">" + xml_escape(verdict) + "</td>";
}

// ---- the codes ---------------------------------------------------------------------------------

std::string check_row(const Json& check) {
  const std::string unit = text_of(check, "unit");
  std::string place;
  if (const auto at = check.find("worst_place"); at != check.end())
    place = fmt::format("({:.2f}, {:.2f}, {:.2f})", (*at)[0].get<double>(), (*at)[1].get<double>(),
                        (*at)[2].get<double>());
  const Json& limit = check["limit"];
  std::string margin;
  if (check["margin"].is_number())
    margin = fmt::format("{:+.0f} %", 100 * check["margin"].get<double>());
  const std::string rule = text_of(check, "rule") + ", " + text_of(check, "edition") +
                           (text_of(check, "clause").empty() ? "" : ", ") +
                           text_of(check, "clause");
  return "<tr>" + verdict_cell(check) + cell(text_of(check, "subject")) +
         cell(text_of(check, "title")) + number_cell(check["value"], unit) +
         (limit.is_number() ? "<td class=\"n\">" + text_of(check, "sense") + " " +
                                  readable_number(limit.get<double>()) + "</td>"
                            : "<td></td>") +
         "<td class=\"n\">" + margin + "</td>" + cell(place) + cell(text_of(check, "condition")) +
         cell(text_of(check, "reason")) + cell(rule) + "</tr>\n";
}

const std::vector<const char*> check_columns{"verdict", "of what", "check",        "value",
                                             "limit",   "margin",  "worst at [m]", "condition",
                                             "note",    "rule"};

std::string checks_table(const Json& checks, const char* verdict) {
  std::string rows;
  for (const Json& check : checks)
    if (text_of(check, "verdict") == verdict) rows += check_row(check);
  return rows.empty() ? "" : heading(check_columns) + rows + "</table>\n";
}

// ---- sights ------------------------------------------------------------------------------------

const std::array<const char*, 6> sight_words{"legible",      "visible but not legible",
                                             "invisible",    "undecided",
                                             "not assessed", "hidden by the building"};

/// Metres of routes or square metres of areas, at the first eye height, by verdict.
std::string amount(const Json& sights, const std::string& sign, const char* verdict,
                   const char* unit) {
  double sum = 0;
  std::optional<double> height;
  for (const Json& sight : sights) {
    if (sight["stands_for"]["unit"] != unit || text_of(sight, "from").starts_with("observer"))
      continue;
    if (!height) height = sight["eye_height"]["value"].get<double>();
    if (text_of(sight, "sign") == sign && text_of(sight, "verdict") == verdict &&
        sight["eye_height"]["value"].get<double>() == *height)
      sum += sight["stands_for"]["value"].get<double>();
  }
  return sum > 0 ? readable_number(sum) + " " + (unit[1] == '\0' ? "m" : "m²") : std::string();
}

/// Of each sign, from how much of the routes and areas that it faces which verdict.
std::string signs_table(const Json& sights) {
  std::vector<std::string> signs;
  for (const Json& sight : sights)
    if (std::find(signs.begin(), signs.end(), text_of(sight, "sign")) == signs.end())
      signs.push_back(text_of(sight, "sign"));
  std::string out = "<table>\n<tr><th>sign</th>";
  for (const char* word : sight_words) out += std::string("<th>") + word + "</th>";
  out += "</tr>\n";
  for (const std::string& sign : signs) {
    out += "<tr>" + cell(sign);
    for (const char* word : sight_words) {
      const std::string routes = amount(sights, sign, word, "m");
      const std::string areas = amount(sights, sign, word, "m2");
      const std::string both = routes + (routes.empty() || areas.empty() ? "" : ", ") + areas;
      out +=
          both.empty() ? "<td></td>" : "<td class=\"n " + class_of(word) + "\">" + both + "</td>";
    }
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

/// What the simulation and the rules of thumb say differently.
std::string differences_table(const Json& sights) {
  std::string rows;
  int left = 200;
  for (const Json& sight : sights) {
    if (!sight.contains("jin") || left == 0) continue;
    const bool read = text_of(sight, "verdict") == "legible";
    const bool decided = read || text_of(sight, "verdict") == "visible but not legible" ||
                         text_of(sight, "verdict") == "invisible";
    const bool jin = sight["jin"]["legible"].get<bool>();
    const bool code = sight["viewing_distance"]["within"].get<bool>();
    if (!decided || (jin == read && code == read)) continue;
    --left;
    rows += "<tr>" + verdict_cell(sight) + cell(text_of(sight, "sign")) +
            cell(fmt::format("{}, {:.1f} m along, eye {:.2f} m", text_of(sight, "from"),
                             sight["along"]["value"].get<double>(),
                             sight["eye_height"]["value"].get<double>())) +
            number_cell(sight["distance"]["value"], "m") + measured_cell(sight, "reading_level") +
            measured_cell(sight, "legend") + measured_cell(sight, "ground") +
            number_cell(sight["transmission"]["value"]) + cell(jin ? "legible" : "too far") +
            cell(code ? "near enough" : "too far") + "</tr>\n";
  }
  if (rows.empty()) return "<p>None: the simulation and the rules agree wherever both speak.</p>\n";
  return heading({"simulated", "sign", "from", "distance", "visibility level of the detail",
                  "legend [cd/m2]", "ground [cd/m2]", "transmission", "Jin, V = C/K",
                  "viewing distance of the code"}) +
         rows + "</table>\n" + (left == 0 ? "<p>The first 200 of them.</p>\n" : "");
}

std::string sweep_table(const Json& sweep) {
  std::vector<double> factors;
  std::map<std::string, std::map<double, const Json*>> by_sign;
  for (const Json& row : sweep) {
    const double factor = row["smoke_factor"].get<double>();
    if (std::find(factors.begin(), factors.end(), factor) == factors.end())
      factors.push_back(factor);
    by_sign[text_of(row, "sign")][factor] = &row;
  }
  std::string out = "<table>\n<tr><th>sign</th>";
  for (const double factor : factors)
    out += "<th>smoke &times; " + readable_number(factor) + "</th>";
  out += "<th>lost from</th></tr>\n";
  for (const auto& [sign, rows] : by_sign) {
    out += "<tr>" + cell(sign);
    double lost = std::nan("");
    for (const double factor : factors) {
      const auto at = rows.find(factor);
      const double legible = at == rows.end() ? 0 : (*at->second)["legible"].get<double>();
      const double places = at == rows.end() ? 0 : (*at->second)["places"].get<double>();
      if (legible == 0 && std::isnan(lost)) lost = factor;
      if (legible > 0) lost = std::nan("");
      out += fmt::format("<td class=\"n\">{:.0f} of {:.0f}</td>", legible, places);
    }
    out += "<td class=\"n\">" +
           (std::isnan(lost) ? std::string("never") : "&times; " + readable_number(lost)) +
           "</td></tr>\n";
  }
  return out + "</table>\n";
}

// ---- the page ----------------------------------------------------------------------------------

std::string figure(const std::string& drawing, const std::string& caption) {
  return "<figure>" + drawing + "<figcaption>" + xml_escape(caption) + "</figcaption></figure>\n";
}

std::string summary(const Json& a) {
  std::string out = state_html(a) + "<p class=\"sum\"><b>" + xml_escape(verdict_words(a)) + ".</b>";
  if (!a["sights"].empty()) {
    out += " Signs, from all places on the routes: ";
    bool first = true;
    for (const auto& [word, count] : a["sight_counts"].items()) {
      out += fmt::format("{}{} {}", first ? "" : ", ", count.get<int>(), word);
      first = false;
    }
    out += ".";
  }
  return out + "</p>\n";
}

std::string method(const Json& a) {
  const Json& m = a["method"];
  return fmt::format(
      "<h2>Method</h2>\n<p>Codes: direct light of the emergency luminaires without reflections and "
      "smoke, at the end of the rated duration, with the maintenance factor; glare with the "
      "highest emergency flux and without it. Points on routes are {} m apart, in areas {} m.</p>\n"
      "<p>Signs: luminances that arrive at the eye with all light and smoke of the scenario, by "
      "{} paths from the eyes (seed {}); thresholds by Adrian (1989) for an age of {} years, with "
      "the veil of glare by CIE 146; photopic. Legible: the smallest detail of the legend at "
      "visibility level 7 or more, by two standard errors, when looked at; to notice a sign is "
      "another matter. Errors are standard errors.</p>\n"
      "<p>The texts of the codes were not at hand: each check names the secondary source that it "
      "is quoted from (assessment.json, quoted_from). This report does not say that a building "
      "complies with a code.</p>\n"
      "<p>Scene {} (content {}), scenario {}; Luxodus {}; {:.0f} s.</p>\n",
      route_grid_m, area_grid_m, m["eye_paths"].get<int64_t>(), m["seed"].get<uint64_t>(),
      a["people"]["age"]["value"].get<double>(), xml_escape(text_of(a["scene"], "file")),
      text_of(a["scene"], "content_hash"), xml_escape(text_of(a["scene"], "scenario")),
      text_of(a, "version"), m["seconds"]["value"].get<double>());
}

std::vector<double> heights_of(const Json& a) {
  std::vector<double> heights;
  for (const Json& sight : a["sights"]) {
    const double height = sight["eye_height"]["value"].get<double>();
    if (!text_of(sight, "from").starts_with("observer") &&
        std::find(heights.begin(), heights.end(), height) == heights.end())
      heights.push_back(height);
  }
  return heights;
}

std::string eye_plans(const Json& a) {
  const std::vector<double> heights = heights_of(a);
  std::string out;
  for (const double height : heights)
    out += figure(plan_of_sights(a, height, ""),
                  fmt::format("From where on the routes a sign is legible, eyes at {:.2f} m: green "
                              "one is, yellow undecided, orange one is seen but none read, red "
                              "none is seen, grey none has a clear line. Black: signs, and where "
                              "they face.",
                              height));
  return out;
}

/// A small map for each sign, at the first height.
std::string sign_plans(const Json& a) {
  const std::vector<double> heights = heights_of(a);
  if (heights.empty()) return "";
  std::string out = "<div class=\"maps\">\n";
  for (const Json& sign : a["plan"]["signs"]) {
    const auto name = sign["name"].get<std::string>();
    out += figure(plan_of_sights(a, heights.front(), name), name);
  }
  return out + "</div>\n";
}

}  // namespace

std::string assessment_page(const Json& a, const std::vector<ReportPicture>& pictures) {
  std::string title = text_of(a["scene"], "title");
  if (title.empty()) title = text_of(a["scene"], "name");
  std::string out =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" +
      xml_escape(title) + "</title>\n<style>\n" + style + "</style>\n</head>\n<body>\n";
  out += "<h1>" + xml_escape(title) + "</h1>\n" + summary(a);
  for (const Json& warning : a["warnings"])
    out += "<p class=\"fail\">" + xml_escape(warning.get<std::string>()) + "</p>\n";
  out += "<h2>What fails</h2>\n";
  const std::string fails = checks_table(a["checks"], "fail");
  out += fails.empty() ? "<p>Nothing.</p>\n" : fails;
  out += "<h2>Plans</h2>\n" +
         figure(plan_of_light(a),
                "Direct illuminance on the floor by all emergency luminaires, in clear air and "
                "without furniture [lx].") +
         eye_plans(a);
  if (!a["sights"].empty()) {
    out +=
        "<h2>Signs</h2>\n<p>From how much of the routes [m] and areas [m²] that it faces, eyes at "
        "the first height.</p>\n" +
        signs_table(a["sights"]) + sign_plans(a);
    out += "<h2>Where the rules of thumb say otherwise</h2>\n" + differences_table(a["sights"]);
  }
  if (!a["sweep"].empty())
    out += "<h2>Density of the smoke</h2>\n<p>From how many places each sign is legible.</p>\n" +
           sweep_table(a["sweep"]);
  for (const char* verdict : {"not assessed", "not verified", "pass", "information"})
    if (const std::string table = checks_table(a["checks"], verdict); !table.empty())
      out += "<h2>Checks: " + std::string(verdict) + "</h2>\n" + table;
  if (!pictures.empty()) out += "<h2>Pictures</h2>\n";
  for (const ReportPicture& picture : pictures)
    out += figure("<img alt=\"\" src=\"data:image/png;base64," + base64(picture.png) + "\">",
                  picture.caption);
  return out + method(a) + "</body>\n</html>\n";
}

}  // namespace luxodus
