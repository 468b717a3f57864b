// Sections on what people read of the signs with all light and smoke, and on differences from rules
// of thumb.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "actors/judge/report/page.hpp"
#include "actors/judge/report/plan_svg.hpp"
#include "runtime/core/base64.hpp"

namespace luxodus {

namespace {

/// Visibility level from which the smallest detail of a legend is read.
constexpr double reading_level = 7;
constexpr size_t thumb_places = 10;

std::vector<double> heights_of(const AssessmentRecord& a) {
  std::set<double, std::greater<>> heights;
  for (const SightRecord& sight : a.sights)
    if (!sight.by_observer()) heights.insert(sight.eye_height_m);
  return {heights.begin(), heights.end()};
}

/// Length of routes and size of areas.
struct Amount {
  double metres = 0, square_metres = 0;
  bool none() const { return metres == 0 && square_metres == 0; }
  void take(const SightRecord& sight) {
    const double value = sight.stands_for.value;
    (sight.stands_for.unit == "m" ? metres : square_metres) += value;
  }
  std::string text(const Texts& t) const {
    if (none()) return "–";
    std::string out = metres > 0 ? t.number(metres) + "\u00a0m" : "";
    if (square_metres > 0) out += (out.empty() ? "" : ", ") + t.number(square_metres) + "\u00a0m²";
    return out;
  }
};

/// Where a person stands, and on which route or in which area.
using Place = std::tuple<Subject, double, double, double>;

/// For each eye height, the share of routes and areas by the verdict on the best sign.
std::string heights_table(const PageParts& parts, const std::vector<double>& heights) {
  const Texts& t = parts.texts;
  std::string rows;
  for (const double height : heights) {
    std::map<Place, std::pair<size_t, const SightRecord*>> best;
    for (const SightRecord& sight : parts.a.sights) {
      if (sight.by_observer() || sight.eye_height_m != height) continue;
      const Place place{sight.from, sight.eye.x, sight.eye.y, sight.eye.z};
      const auto known = best.try_emplace(place, rank_of(sight.verdict), &sight).first;
      if (rank_of(sight.verdict) < known->second.first)
        known->second = {rank_of(sight.verdict), &sight};
    }
    std::array<Amount, sight_ranks.size()> amounts;
    for (const auto& [place, one] : best) amounts[one.first].take(*one.second);
    rows += "<tr>" + html_cell("<b>" + escaped(t.fixed(height)) + "\u00a0m</b>", "n");
    for (const Amount& amount : amounts) rows += html_cell(escaped(amount.text(t)), "n");
    rows += "</tr>\n";
  }
  return table(
      t,
      {"column.eye_height", "sight.legible", "sight.undecided", "sight.visible but not legible",
       "sight.invisible", "sight.not assessed", "sight.hidden by the building"},
      {10, 15, 15, 15, 15, 15, 15}, rows);
}

/// For one eye height, a row for each sign.
std::string signs_table(const PageParts& parts, double height) {
  const Texts& t = parts.texts;
  std::string rows;
  const auto& signs = parts.a.signs;
  for (size_t i = 0; i < signs.size(); ++i) {
    std::array<Amount, sight_ranks.size()> amounts;
    bool any = false;
    for (const SightRecord& sight : parts.a.sights) {
      if (sight.by_observer() || sight.eye_height_m != height || sight.sign != signs[i].name)
        continue;
      any = true;
      amounts[rank_of(sight.verdict)].take(sight);
    }
    if (!any) continue;
    rows += "<tr>" + html_cell("<b>" + std::to_string(i + 1) + "</b>", "n") + cell(signs[i].name);
    for (const Amount& amount : amounts) rows += html_cell(escaped(amount.text(t)), "n");
    rows += "</tr>\n";
  }
  return table(t,
               {"column.number", "column.sign", "sight.legible", "sight.undecided",
                "sight.visible but not legible", "sight.invisible", "sight.not assessed",
                "sight.hidden by the building"},
               {5, 17, 13, 13, 13, 13, 13, 13}, rows);
}

/// "75 years", "protan (no cones for long wavelengths), 75 years".
std::string eyes_text(const Texts& t, const std::string& name) {
  const size_t space = name.find(' ');
  const bool number = name.find_first_not_of("0123456789.") == std::string::npos;
  if (number) return t.say("inputs.years", name);
  const std::string kind = t.word("eyes", name.substr(0, space));
  return space == std::string::npos ? kind
                                    : kind + ", " + t.say("inputs.years", name.substr(space + 1));
}

/// For each kind of eyes, the number of views by verdict, of those that light decides.
std::string eyes_table(const PageParts& parts) {
  const Texts& t = parts.texts;
  const PeopleRecord& people = parts.a.people;
  std::vector<std::array<size_t, sight_ranks.size()>> counts(1 + people.other_eyes.size());
  for (const SightRecord& sight : parts.a.sights) {
    if (!sight.seen || sight.seen->other_eyes.size() != people.other_eyes.size()) continue;
    ++counts[0][rank_of(sight.verdict)];
    for (size_t e = 0; e < people.other_eyes.size(); ++e)
      ++counts[1 + e][rank_of(sight.seen->other_eyes[e].verdict)];
  }
  std::string rows;
  for (size_t e = 0; e < counts.size(); ++e) {
    rows += "<tr>" + cell(e == 0 ? t.say("inputs.years", t.number(people.age_years))
                                 : eyes_text(t, people.other_eyes[e - 1]));
    for (size_t rank = 0; rank < 5; ++rank) rows += html_cell(std::to_string(counts[e][rank]), "n");
    rows += "</tr>\n";
  }
  return table(t,
               {"column.eyes", "sight.legible", "sight.undecided", "sight.visible but not legible",
                "sight.invisible", "sight.not assessed"},
               {35, 13, 13, 13, 13, 13}, rows);
}

/// A difference of chromaticity by what can be noticed, some 0.004: less is 0, and not the rest of
/// a rounding. NaN stays.
double told(double chromatic_difference) {
  return std::round(1e4 * chromatic_difference) / 1e4;
}

std::string observers_table(const PageParts& parts) {
  const Texts& t = parts.texts;
  std::string rows;
  for (const SightRecord& sight : parts.a.sights) {
    if (!sight.by_observer() || sight.verdict == SightVerdict::hidden) continue;
    rows += "<tr>" + verdict_cell(t, "sight", name_of(sight.verdict)) +
            cell(t.subject(sight.from)) + cell(sight.sign) + number_cell(t, sight.distance_m, "m") +
            (sight.seen ? number_cell(t, sight.seen->look.reading_level.value) +
                              number_cell(t, sight.seen->margin.read_within_m, "m") +
                              number_cell(t, told(sight.seen->look.chromatic_difference))
                        : no_number_cell() + no_number_cell() + no_number_cell()) +
            "</tr>\n";
  }
  return table(t,
               {"column.verdict", "column.from", "column.sign", "column.distance",
                "column.reading_level", "column.read_within", "column.chromatic_difference"},
               {23, 20, 17, 10, 10, 10, 10}, rows);
}

/// Suffix of a picture's name and key of its caption: human view first, then luminance.
constexpr std::array<std::pair<const char*, const char*>, 3> picture_kinds{
    {{"_human", "view.human"}, {"_luminance", "view.luminance"}, {"", "view.plain"}}};

/// Whether a picture shows another scene or scenario, in which smoke may hide less.
bool is_of_another_state(const AssessmentRecord& a, const ReportPicture& picture) {
  const auto scene = png_text(picture.png, "Scene"), scenario = png_text(picture.png, "Scenario");
  return (scene && *scene != a.scene.name) || (scenario && *scenario != a.scene.scenario);
}

/// Pictures of the judged state by camera and kind.
using CameraPictures = std::map<std::string, std::map<size_t, const ReportPicture*>>;

CameraPictures pictures_by_camera(const PageParts& parts, size_t& others) {
  CameraPictures out;
  for (const ReportPicture& picture : parts.pictures) {
    if (is_of_another_state(parts.a, picture)) {
      ++others;
      continue;
    }
    size_t kind = 0;
    while (!picture.name.ends_with(picture_kinds[kind].first)) ++kind;
    const size_t ending = std::string_view(picture_kinds[kind].first).size();
    const std::string name = picture.name.substr(0, picture.name.size() - ending);
    const std::string camera = png_text(picture.png, "View").value_or(name);
    if (camera != cover_camera) out[camera][kind] = &picture;
  }
  return out;
}

/// Pictures by camera; the plain exposure is shown only if there is no better picture.
std::string pictures(const PageParts& parts) {
  const Texts& t = parts.texts;
  size_t others = 0;
  std::string out;
  for (const auto& [camera, kinds] : pictures_by_camera(parts, others))
    for (const auto& [kind, picture] : kinds) {
      const std::string name = picture_kinds[kind].second;
      if (name == "view.plain" && kinds.size() > 1) continue;
      out += figure("<img alt=\"" + escaped(camera) + "\" src=\"data:image/png;base64," +
                        base64(picture->png) + "\">",
                    camera + ": " + t(name));
    }
  out = out.empty() ? paragraph(t("sights.no_pictures"), "note")
                    : "<div class=\"pictures\">\n" + out + "</div>\n";
  if (others > 0) out += paragraph(t.say("sights.other_pictures", others), "note");
  return out;
}

std::string sweep_table(const PageParts& parts) {
  const Texts& t = parts.texts;
  std::vector<double> factors;
  std::map<std::string, std::map<double, const SweepRow*>> by_sign;
  for (const SweepRow& row : parts.a.sweep) {
    const double factor = row.factor;
    if (std::find(factors.begin(), factors.end(), factor) == factors.end())
      factors.push_back(factor);
    by_sign[row.sign][factor] = &row;
  }
  if (factors.empty()) return "";
  std::string out = subheading(t("sights.sweep")) + paragraph(t("sights.sweep_lead")) +
                    "<table>\n<thead><tr><th>" + escaped(t("column.sign")) + "</th>";
  for (const double factor : factors) out += "<th>× " + escaped(t.number(factor)) + "</th>";
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& [sign, rows] : by_sign) {
    out += "<tr>" + cell(sign);
    for (const double factor : factors) {
      const auto at = rows.find(factor);
      const bool known = at != rows.end();
      out += html_cell(
          known ? escaped(t.say("sights.of", at->second->legible, at->second->places)) : "–", "n");
    }
    out += "</tr>\n";
  }
  return out + "</tbody>\n</table>\n";
}

/// A place where a rule of thumb and the simulation differ.
struct Difference {
  const SightRecord* sight;
  double by;  // logarithm of the ratio of the visibility level to the reading level
};

std::vector<Difference> differences(const std::vector<SightRecord>& sights) {
  std::vector<Difference> out;
  for (const SightRecord& sight : sights) {
    const bool read = sight.verdict == SightVerdict::legible;
    if (!sight.seen || (!read && sight.verdict != SightVerdict::visible &&
                        sight.verdict != SightVerdict::invisible))
      continue;
    if (sight.seen->jin.legible == read && sight.seen->viewing_distance.within == read) continue;
    const double level = sight.seen->look.reading_level.value;
    const double known = std::isfinite(level) ? std::abs(level) : 0;
    out.push_back({&sight, std::abs(std::log(std::max(known, 1e-6) / reading_level))});
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Difference& a, const Difference& b) { return a.by > b.by; });
  return out;
}

std::string measured(const Texts& t, const Uncertain& number) {
  if (!std::isfinite(number.value)) return "–";
  return t.number(number.value) +
         (std::isfinite(number.error) ? " ± " + t.number(number.error, 2) : "");
}

std::string thumb_table(const PageParts& parts, const std::vector<Difference>& all, size_t most) {
  const Texts& t = parts.texts;
  std::string rows;
  for (size_t i = 0; i < std::min(all.size(), most); ++i) {
    const SightRecord& s = *all[i].sight;
    const LookRecord& look = s.seen->look;
    const bool read = s.verdict == SightVerdict::legible;
    const auto said = [&](bool rule, const char* yes, const char* no) {
      return html_cell((rule != read ? "<b>" : "") + escaped(t(rule ? yes : no)) +
                       (rule != read ? "</b>" : ""));
    };
    rows +=
        "<tr>" + verdict_cell(t, "sight", name_of(s.verdict)) + cell(s.sign) +
        html_cell(escaped(t.subject(s.from)) + "<br>" +
                  escaped(t.place(s.eye.x, s.eye.y, s.eye.z))) +
        number_cell(t, s.distance_m, "m") +
        html_cell(escaped(measured(t, look.reading_level)), "n") +
        html_cell(escaped(measured(t, look.legend_cd_m2) + " / " + measured(t, look.ground_cd_m2)),
                  "n") +
        number_cell(t, look.transmission) +
        said(s.seen->jin.legible, "thumb.legible", "thumb.too_far") +
        said(s.seen->viewing_distance.within, "thumb.near", "thumb.too_far") + "</tr>\n";
  }
  return table(
      t,
      {"column.simulated", "column.sign", "column.from", "column.distance", "column.reading_level",
       "column.luminances", "column.transmission", "column.jin", "column.viewing"},
      {13, 11, 16, 8, 12, 13, 8, 8, 11}, rows);
}

}  // namespace

const ReportPicture* cover_picture(const PageParts& parts) {
  for (const ReportPicture& picture : parts.pictures)
    if (picture.name == cover_camera && !is_of_another_state(parts.a, picture)) return &picture;
  return nullptr;
}

std::string sights_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  if (parts.a.sights.empty()) return paragraph(t("sights.none"));
  const auto heights = heights_of(parts.a);
  std::string out = paragraph(t("sights.lead"));
  out += heights_table(parts, heights) + observers_note(parts);
  const Plans plans(parts.a, parts.schedule, t, {parts.paper_width_mm, 90});
  for (const double height : heights)
    for (size_t level = 0; level < parts.schedule.levels(); ++level)
      out += "<figure class=\"plan\">" + plans.sights(level, height, "").svg + "<figcaption><b>" +
             escaped(parts.schedule.levels() > 1
                         ? t.say("plan.level", t.fixed(parts.schedule.floor(level))) + ": "
                         : "") +
             escaped(t.say("plan.sights", t.fixed(height))) + ".</b> " +
             escaped(t("plan.sights_note")) + "</figcaption></figure>\n";
  if (const std::string rows = observers_table(parts); !rows.empty())
    out += subheading(t("sights.observers")) + rows + paragraph(t("sights.chromatic_note"), "note");
  if (!parts.a.people.other_eyes.empty())
    out += subheading(t("sights.eyes")) + paragraph(t("sights.eyes_lead")) + eyes_table(parts);
  return out + sweep_table(parts) + thresholds_table(parts) + subheading(t("sights.pictures")) +
         pictures(parts);
}

std::string thumb_section(const PageParts& parts) {
  const Texts& t = parts.texts;
  const auto all = differences(parts.a.sights);
  if (all.empty()) return paragraph(t("thumb.none"));
  const size_t shown = std::min(all.size(), thumb_places);
  return paragraph(t.say("thumb.lead", all.size(), shown)) + thumb_table(parts, all, shown) +
         (all.size() > shown ? paragraph(t("thumb.all"), "note") : "");
}

std::string signs_appendix(const PageParts& parts) {
  const Texts& t = parts.texts;
  const auto heights = heights_of(parts.a);
  if (heights.empty()) return "";
  std::string out = paragraph(t("sights.by_sign"));
  for (const double height : heights)
    out += subheading(t.say("sights.eyes_at", t.fixed(height))) + signs_table(parts, height);
  const Plans plans(parts.a, parts.schedule, t, {parts.paper_width_mm / 3 - 4, 60});
  out += subheading(t.say("sights.maps", t.fixed(heights.front()))) + "<div class=\"maps\">\n";
  const auto& signs = parts.a.signs;
  for (size_t i = 0; i < signs.size(); ++i) {
    const size_t level = parts.schedule.level_of(signs[i]);
    out += figure(plans.sights(level, heights.front(), signs[i].name).svg,
                  std::to_string(i + 1) + " · " + signs[i].name);
  }
  return out + "</div>\n";
}

}  // namespace luxodus
