#include "actors/judge/design/design_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "actors/judge/design/binding_words.hpp"
#include "actors/judge/design/design_files.hpp"
#include "actors/judge/design/json_cells.hpp"
#include "actors/judge/design/smoke_section.hpp"
#include "actors/judge/report/html.hpp"
#include "actors/judge/report/page_style.hpp"
#include "actors/judge/report/plan_svg.hpp"
#include "actors/results/formats/html_page.hpp"

namespace luxodus {

namespace {

/// Groups with a smaller share of the bound are not listed as binding.
constexpr double binding_share = 0.05;
/// A group is tight within this factor of its requirement.
constexpr double tight_share = 1.02;

std::string heading(const Texts& t, const char* key) {
  return "<h2>" + escaped(t(key)) + "</h2>\n";
}

std::string outcome(const Texts& t, const Json& d) {
  const Json& objective = d["objective"];
  size_t fresh = 0, kept = 0, moved = 0;
  for (const Json& one : d["luminaires"])
    ++(one["is_new"].get<bool>() ? fresh : one["moved_from"].is_null() ? kept : moved);
  std::string words = t.say(fresh == 1 ? "design.luminaire" : "design.luminaires", fresh);
  if (kept > 0) words += ", " + t.say("design.kept", kept);
  if (moved > 0) words += ", " + t.say("design.moved", moved);
  if (const size_t gone = d["removed"].size(); gone > 0) words += ", " + t.say("design.gone", gone);
  const bool optimal = d["outcome"]["end"] == "optimal";
  const std::string proof =
      optimal ? t("design.optimal")
              : t.say("design.open", t.number(objective["bound"].get<double>(), 4),
                      t.number(100 * objective["gap"].get<double>(), 2));
  std::string out =
      "<div class=\"box\"><svg viewBox=\"-1.25 -1.25 2.5 2.5\" aria-hidden=\"true\">" +
      verdict_shape("information", 0, 0, 1) + "</svg><div><p class=\"words\">" + escaped(words) +
      "</p>";
  out += paragraph(t.say("design.objective", t.word("design.objective", text_in(objective, "kind")),
                         t.number(objective["value"].get<double>(), 4)) +
                   " " + proof);
  if (objective["greedy"].is_number())
    out +=
        paragraph(t.say("design.greedy", t.number(objective["greedy"].get<double>(), 4)), "note");
  const Json& c = d["checks"];
  std::string chips;
  for (const auto& [key, verdict] :
       {std::pair{"pass", "pass"}, std::pair{"fail", "fail"},
        std::pair{"not_assessed", "not assessed"}, std::pair{"not_verified", "not verified"}})
    chips += "<span>" + std::to_string(c[key].get<int64_t>()) + " " +
             verdict_mark(t, "verdict", verdict) + "</span>\n";
  return out + "<p class=\"chips\">" + chips + "</p></div></div>\n";
}

std::string notice(const Texts& t, bool in_smoke) {
  std::string out = "<div class=\"notice\"><ul>\n";
  for (const char* key :
       {"design.notice_codes", in_smoke ? "design.notice_in_smoke" : "design.notice_smoke",
        "design.notice_candidates"})
    out += "<li>" + escaped(t(key)) + "</li>\n";
  return out + "</ul></div>\n";
}

std::string plans_of(const Texts& t, const AssessmentRecord& a, const Schedule& schedule) {
  const Plans plans(a, schedule, t, {});
  std::string out;
  for (size_t i = 0; i < schedule.levels(); ++i) {
    out += figure(plans.installation(i).svg, t("design.plan_installation"));
    out += figure(plans.isolux(i, false).svg, t("design.plan_isolux"));
  }
  return out;
}

/// Kind of a luminaire in the schedule.
std::string kind_of(const Texts& t, const Json& one) {
  if (one["is_new"].get<bool>()) return text_in(one, "type");
  const Json& from = one["moved_from"];
  return from.is_null()
             ? t("design.stays")
             : t.say("design.moved_from",
                     t.place(from[0].get<double>(), from[1].get<double>(), from[2].get<double>()));
}

std::string schedule_of(const Texts& t, const Json& d) {
  std::string types, rows;
  for (const Json& type : d["types"])
    if (type["count"].get<int64_t>() > 0)
      types += "<tr>" + cell(text_in(type, "name")) + number_cell(t, type["count"]) +
               number_cell(t, type["emergency_lm"], "lm", 4) + number_cell(t, type["cost"], "", 4) +
               number_cell(t, type["watts"], "W") +
               cell(text_in(type, "battery").empty() ? "–" : text_in(type, "battery")) + "</tr>\n";
  for (const Json& one : d["luminaires"]) {
    const Json& p = one["position"];
    rows += "<tr>" + cell(text_in(one, "name")) + cell(kind_of(t, one)) +
            fixed_cell(t, p[0].get<double>(), 2) + fixed_cell(t, p[1].get<double>(), 2) +
            fixed_cell(t, p[2].get<double>(), 2) +
            fixed_cell(t, one["rotation_deg"].get<double>(), 0) + "</tr>\n";
  }
  std::string gone;
  for (const Json& name : d["removed"])
    gone += (gone.empty() ? "" : ", ") + name.get<std::string>();
  return table(t,
               {"column.type", "column.count", "column.emergency_flux", "design.cost",
                "design.watts", "design.battery"},
               {36, 10, 17, 13, 12, 12}, types) +
         table(t, {"design.name", "column.type", "design.x", "design.y", "design.z", "design.turn"},
               {26, 34, 10, 10, 10, 10}, rows) +
         (gone.empty() ? "" : paragraph(t.say("design.removed", gone)));
}

std::string ways_of(const Texts& t, const Json& sign) {
  std::string out;
  for (const Json& way : sign["leads_to"])
    out += (out.empty() ? "" : "; ") + text_in(way, "route") + ": " +
           t.word("design.arrow", text_in(way, "arrow"));
  return out;
}

std::string signs_of(const Texts& t, const Json& signs) {
  std::string types, rows;
  size_t fresh = 0;
  for (const Json& type : signs["types"])
    if (type["count"].get<int64_t>() > 0)
      types += "<tr>" + cell(text_in(type, "name")) + number_cell(t, type["count"]) +
               number_cell(t, type["cost"], "", 4) + number_cell(t, type["watts"], "W") + "</tr>\n";
  for (const Json& one : signs["placed"]) {
    const Json& p = one["position"];
    const bool is_new = one["is_new"].get<bool>();
    fresh += is_new;
    rows += "<tr>" + cell(text_in(one, "name")) +
            cell(is_new ? text_in(one, "type") : t("design.stays")) +
            cell(is_new ? t.word("design.mount", text_in(one, "mount")) : "–") +
            fixed_cell(t, p[0].get<double>(), 2) + fixed_cell(t, p[1].get<double>(), 2) +
            fixed_cell(t, p[2].get<double>(), 2) + cell(ways_of(t, one)) + "</tr>\n";
  }
  const double value = signs["objective"]["value"].get<double>();
  const bool optimal = signs["objective"]["bound"].get<double>() >= value;
  std::string out = heading(t, "design.signs_heading") +
                    paragraph(t.say(fresh == 1 ? "design.sign" : "design.signs", fresh) + " " +
                              t("design.signs_guide") +
                              (optimal ? std::string(" ") + t("design.signs_optimal") : ""));
  for (const Json& one : signs["unguided"]) {
    const Json& p = one["first"];
    out += paragraph(
        t.say("design.signs_unguided", text_in(one, "route"), one["places"].get<int64_t>(),
              one["of"].get<int64_t>(),
              t.place(p[0].get<double>(), p[1].get<double>(), p[2].get<double>())) +
        (one["behind_furniture"].get<bool>() ? std::string(" ") + t("design.signs_behind") : "") +
        (one["behind_signs"].get<bool>() ? std::string(" ") + t("design.signs_behind_signs") : ""));
  }
  std::string gone;
  for (const Json& name : signs["removed"])
    gone += (gone.empty() ? "" : ", ") + name.get<std::string>();
  return out +
         table(t, {"column.type", "column.count", "design.cost", "design.watts"}, {49, 15, 18, 18},
               types) +
         table(t,
               {"design.name", "column.type", "design.mount", "design.x", "design.y", "design.z",
                "design.ways"},
               {12, 20, 20, 9, 9, 9, 21}, rows) +
         (gone.empty() ? "" : paragraph(t.say("design.signs_removed", gone)));
}

std::string binding(const Texts& t, const Json& d) {
  std::vector<const Json*> groups;
  for (const Json& group : d["constraints"]) groups.push_back(&group);
  std::stable_sort(groups.begin(), groups.end(), [](const Json* a, const Json* b) {
    return (*a)["share_of_bound"].get<double>() > (*b)["share_of_bound"].get<double>();
  });
  std::string rows;
  for (const Json* one : groups) {
    const Json& group = *one;
    const double share = group["share_of_bound"].get<double>();
    const Json& least = group["least_share"];
    const bool tight = least.is_number() && least.get<double>() <= tight_share;
    const std::string said = share > binding_share ? t.say("design.binds", t.number(share, 2))
                             : tight               ? std::string(t("design.tight"))
                                                   : std::string(t("design.slack"));
    rows +=
        "<tr>" + cell(text_in(group, "rule")) + cell(subject_text(t, group["subject"])) +
        cell(demand_text(t, group)) +
        (least.is_number() ? fixed_cell(t, 100 * least.get<double>(), 0) : html_cell("–", "n")) +
        cell(said) + "</tr>\n";
  }
  std::string because;
  for (const std::string& words : because_words(t, d)) because += paragraph(words);
  return because + paragraph(t("design.binding_note"), "note") +
         table(t,
               {"design.rule", "design.subject", "design.asked", "design.least", "design.binding"},
               {8, 26, 34, 12, 20}, rows);
}

std::string others(const Texts& t, const Json& d) {
  std::string rows;
  for (const Json& check : d["failing_otherwise"])
    rows += "<tr>" + cell(text_in(check, "rule")) + cell(subject_text(t, check["subject"])) +
            cell(t.rule_title(text_in(check, "rule"))) + cell(said(t, check["reasons"])) +
            "</tr>\n";
  if (rows.empty()) return "";
  return heading(t, "design.others") + paragraph(t("design.others_note"), "note") +
         table(t, {"design.rule", "design.subject", "column.check", "column.remark"},
               {8, 26, 36, 30}, rows);
}

std::string hidden(const Texts& t, const Json& d) {
  std::vector<HiddenByFurniture> all;
  for (const Json& one : d["hidden_by_furniture"])
    all.push_back(
        {text_in(one, "rule"), read_subject(one["subject"]).value(), one["points"].get<size_t>()});
  std::string out;
  for (const HiddenByFurniture& one : joined_by_subject(all))
    out += paragraph(t.say("design.hidden", one.rule, t.subject(one.subject), one.points));
  return out;
}

/// The section on minima with luminaires off their places.
std::string off_place(const Texts& t, const Json& d) {
  if (!d.contains("off_place") || d["off_place"]["demands"].empty()) return "";
  const Json& off = d["off_place"];
  const Json& least = off["demands"].front();
  const Json& p = least["place"];
  return paragraph(
      t.say("design.off_place", t.number(off["distance_m"].get<double>(), 2),
            t.number(100 * least["share"].get<double>(), 3), subject_text(t, least["subject"]),
            t.place(p[0].get<double>(), p[1].get<double>(), p[2].get<double>())) +
      (off["holds"].get<bool>() ? std::string() : std::string(" ") + t("design.off_place_fails")));
}

std::string settings(const Texts& t, const Json& d) {
  const Json& c = d["candidates"];
  const Json& s = d["settings"];
  std::string unused;
  for (const Json& type : d["types_not_placed"])
    unused += paragraph(t.say("design.not_placed", text_in(type, "name"),
                              t.number(type["lasts_h"].get<double>(), 3), text_in(type, "rules"),
                              t.number(type["asked_h"].get<double>(), 3)));
  std::string unlit;
  for (const Json& name : d["unlit_flights"])
    unlit += paragraph(t.say("design.unlit_flight", name.get<std::string>()));
  std::string rules;
  for (const Json& rule : s["rules"])
    rules += (rules.empty() ? "" : ", ") + rule.get<std::string>();
  std::string left;
  for (const auto& [why, count] : c["left_out"].items())
    if (count.get<int64_t>() > 0)
      left += (left.empty() ? "" : "; ") + t.say("design.left_" + why, count.get<int64_t>());
  return paragraph(t.say("design.settings", rules, t.number(s["margin"].get<double>(), 3),
                         t.word("design.failure", text_in(s, "failure")))) +
         paragraph(t.say("design.candidates", c["places"].get<int64_t>(),
                         c["luminaires"].get<int64_t>(), c["points"].get<int64_t>())) +
         (left.empty() ? "" : paragraph(t.say("design.left_out", left))) + unused + unlit +
         hidden(t, d);
}

}  // namespace

std::string design_page(const Json& d, const AssessmentRecord& a, const std::vector<LayoutPlan>& plans,
                        Language language) {
  const Texts t(language);
  const Schedule schedule(a);
  std::string title = text_in(d["scene"], "title");
  if (title.empty()) title = text_in(d["scene"], "name");
  const std::string body =
      "<header class=\"cover\"><div>" + paragraph(t("design.page"), "kind") + "<h1>" +
      escaped(title) + "</h1></div></header>\n" + outcome(t, d) + notice(t, d.contains("smoke")) +
      (d.contains("smoke") ? smoke_section(t, d) : "") + side_by_side(t, d, plans) +
      heading(t, "heading.plans") + plans_of(t, a, schedule) + heading(t, "heading.schedules") +
      schedule_of(t, d) + (d.contains("signs") ? signs_of(t, d["signs"]) : "") +
      heading(t, "design.binding_heading") + binding(t, d) + off_place(t, d) + others(t, d) +
      heading(t, "design.settings_heading") + settings(t, d);
  return html_page({t.code(), title + " – " + t("design.page"), report_style}, body);
}

}  // namespace luxodus
