#include "actors/judge/design/design_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "actors/judge/design/binding_words.hpp"
#include "actors/judge/design/design_files.hpp"
#include "actors/judge/design/smoke_section.hpp"
#include "actors/judge/report/html.hpp"
#include "actors/judge/report/page.hpp"
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

std::string outcome(const Texts& t, const DesignRecord& d) {
  const ObjectiveRecord& objective = d.objective;
  size_t fresh = 0, kept = 0, moved = 0;
  for (const PlacedLuminaireRecord& one : d.luminaires)
    ++(one.is_new ? fresh : one.moved_from ? moved : kept);
  std::string words = t.say(fresh == 1 ? "design.luminaire" : "design.luminaires", fresh);
  if (kept > 0) words += ", " + t.say("design.kept", kept);
  if (moved > 0) words += ", " + t.say("design.moved", moved);
  if (const size_t gone = d.removed.size(); gone > 0) words += ", " + t.say("design.gone", gone);
  const bool optimal = d.outcome.end == LayoutEnd::optimal;
  const std::string proof = optimal ? t("design.optimal")
                                    : t.say("design.open", t.number(objective.bound, 4),
                                            t.number(100 * objective.gap, 2));
  std::string out =
      "<div class=\"box\"><svg viewBox=\"-1.25 -1.25 2.5 2.5\" aria-hidden=\"true\">" +
      verdict_shape("information", 0, 0, 1) + "</svg><div><p class=\"words\">" + escaped(words) +
      "</p>";
  out += paragraph(t.say("design.objective", t.word("design.objective", objective.kind),
                         t.number(objective.value, 4)) +
                   " " + proof);
  if (objective.greedy)
    out += paragraph(t.say("design.greedy", t.number(*objective.greedy, 4)), "note");
  return out + "<p class=\"chips\">" + count_chips(t, d.checks) + "</p></div></div>\n";
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
std::string kind_of(const Texts& t, const PlacedLuminaireRecord& one) {
  if (one.is_new) return one.type;
  const auto& from = one.moved_from;
  return !from ? t("design.stays") : t.say("design.moved_from", t.place(from->x, from->y, from->z));
}

/// Input of all placed luminaires, and of how many it is not stated.
std::string watts_of(const Texts& t, const DesignRecord& d) {
  double watts = 0;
  size_t unstated = 0;
  for (const PlacedTypeRecord& type : d.types)
    if (type.watts > 0)
      watts += type.watts * static_cast<double>(type.count);
    else
      unstated += type.count;
  std::string words = watts > 0 ? t.say("design.total_watts", t.number(watts, 4)) : "";
  if (unstated > 0) words += (words.empty() ? "" : " ") + t.say("design.watts_unstated", unstated);
  return words.empty() ? "" : paragraph(words);
}

std::string schedule_of(const Texts& t, const DesignRecord& d) {
  std::string types, rows;
  for (const PlacedTypeRecord& type : d.types)
    if (type.count > 0)
      types += "<tr>" + cell(type.name) + number_cell(t, type.count) +
               number_cell(t, type.emergency_lm, "lm", 4) + number_cell(t, type.cost, "", 4) +
               number_cell(t, type.watts, "W") + cell(type.battery.empty() ? "–" : type.battery) +
               "</tr>\n";
  for (const PlacedLuminaireRecord& one : d.luminaires) {
    const glm::dvec3& p = one.position;
    rows += "<tr>" + cell(one.name) + cell(kind_of(t, one)) + fixed_cell(t, p.x, 2) +
            fixed_cell(t, p.y, 2) + fixed_cell(t, p.z, 2) + fixed_cell(t, one.rotation_deg, 0) +
            "</tr>\n";
  }
  std::string gone;
  for (const std::string& name : d.removed) gone += (gone.empty() ? "" : ", ") + name;
  return table(t,
               {"column.type", "column.count", "column.emergency_flux", "design.cost",
                "design.watts", "design.battery"},
               {36, 10, 17, 13, 12, 12}, types) +
         table(t, {"design.name", "column.type", "design.x", "design.y", "design.z", "design.turn"},
               {26, 34, 10, 10, 10, 10}, rows) +
         watts_of(t, d) + (gone.empty() ? "" : paragraph(t.say("design.removed", gone)));
}

std::string ways_of(const Texts& t, const PlacedSignRecord& sign) {
  std::string out;
  for (const LeadsToRecord& way : sign.leads_to)
    out += (out.empty() ? "" : "; ") + way.route + ": " + t.word("design.arrow", way.arrow);
  return out;
}

std::string signs_of(const Texts& t, const SignPlanRecord& signs) {
  std::string types, rows;
  size_t fresh = 0;
  for (const SignTypeRecord& type : signs.types)
    if (type.count > 0)
      types += "<tr>" + cell(type.name) + number_cell(t, type.count) +
               number_cell(t, type.cost, "", 4) + number_cell(t, type.watts, "W") + "</tr>\n";
  for (const PlacedSignRecord& one : signs.placed) {
    const glm::dvec3& p = one.position;
    const bool is_new = one.is_new;
    fresh += is_new;
    rows += "<tr>" + cell(one.name) + cell(is_new ? one.type : t("design.stays")) +
            cell(is_new ? t.word("design.mount", one.mount) : "–") + fixed_cell(t, p.x, 2) +
            fixed_cell(t, p.y, 2) + fixed_cell(t, p.z, 2) + cell(ways_of(t, one)) + "</tr>\n";
  }
  const double value = signs.objective.value;
  const bool optimal = signs.objective.bound >= value;
  std::string out = heading(t, "design.signs_heading") +
                    paragraph(t.say(fresh == 1 ? "design.sign" : "design.signs", fresh) + " " +
                              t("design.signs_guide") +
                              (optimal ? std::string(" ") + t("design.signs_optimal") : ""));
  for (const UnguidedPlaces& one : signs.unguided) {
    const glm::dvec3& p = one.first;
    out += paragraph(
        t.say("design.signs_unguided", one.route, one.places, one.of, t.place(p.x, p.y, p.z)) +
        (one.behind_furniture ? std::string(" ") + t("design.signs_behind") : "") +
        (one.behind_signs ? std::string(" ") + t("design.signs_behind_signs") : ""));
  }
  std::string gone;
  for (const std::string& name : signs.removed) gone += (gone.empty() ? "" : ", ") + name;
  return out +
         table(t, {"column.type", "column.count", "design.cost", "design.watts"}, {49, 15, 18, 18},
               types) +
         table(t,
               {"design.name", "column.type", "design.mount", "design.x", "design.y", "design.z",
                "design.ways"},
               {12, 20, 20, 9, 9, 9, 21}, rows) +
         (gone.empty() ? "" : paragraph(t.say("design.signs_removed", gone)));
}

std::string binding(const Texts& t, const DesignRecord& d) {
  std::vector<ConstraintRecord> groups = d.constraints;
  std::stable_sort(groups.begin(), groups.end(), [](const auto& a, const auto& b) {
    return a.share_of_bound > b.share_of_bound;
  });
  std::string rows;
  for (const ConstraintRecord& group : groups) {
    const double share = group.share_of_bound;
    const double least = group.least_share;
    const bool tight = least <= tight_share;
    const std::string said = share > binding_share ? t.say("design.binds", t.number(share, 2))
                             : tight               ? std::string(t("design.tight"))
                                                   : std::string(t("design.slack"));
    rows += "<tr>" + cell(std::string(name_of(group.rule))) + cell(t.subject(group.subject)) +
            cell(demand_text(t, group)) +
            (std::isfinite(least) ? fixed_cell(t, 100 * least, 0) : no_number_cell()) + cell(said) +
            "</tr>\n";
  }
  std::string because;
  for (const std::string& words : because_words(t, d)) because += paragraph(words);
  return because + paragraph(t("design.binding_note"), "note") +
         table(t,
               {"design.rule", "design.subject", "design.asked", "design.least", "design.binding"},
               {8, 26, 34, 12, 20}, rows);
}

std::string others(const Texts& t, const DesignRecord& d) {
  std::string rows;
  for (const FailingRecord& check : d.failing_otherwise)
    rows += "<tr>" + cell(std::string(name_of(check.rule))) + cell(t.subject(check.subject)) +
            cell(t.rule_title(name_of(check.rule))) + cell(t.remarks(check.reasons)) + "</tr>\n";
  if (rows.empty()) return "";
  return heading(t, "design.others") + paragraph(t("design.others_note"), "note") +
         table(t, {"design.rule", "design.subject", "column.check", "column.remark"},
               {8, 26, 36, 30}, rows);
}

std::string hidden(const Texts& t, const DesignRecord& d) {
  std::string out;
  for (const HiddenByFurniture& one : joined_by_subject(d.hidden_by_furniture))
    out += paragraph(t.say("design.hidden", one.rule, t.subject(one.subject), one.points));
  return out;
}

/// The section on minima with luminaires off their places.
std::string off_place(const Texts& t, const DesignRecord& d) {
  if (!d.off_place || d.off_place->demands.empty()) return "";
  const OffPlaceRecord& off = *d.off_place;
  const ShareOffPlaceRecord& least = off.demands.front();
  const glm::dvec3& p = least.place;
  return paragraph(t.say("design.off_place", t.number(off.distance_m, 2),
                         t.number(100 * least.share, 3), t.subject(least.subject),
                         t.place(p.x, p.y, p.z)) +
                   (off.holds ? std::string() : std::string(" ") + t("design.off_place_fails")));
}

/// Adds a phrase for each reason why places were left out.
struct LeftOutWords {
  const Texts& t;
  std::string& out;
  const LeftOutWords& operator()(const std::string& why, size_t count) const {
    if (count > 0) out += (out.empty() ? "" : "; ") + t.say("design.left_" + why, count);
    return *this;
  }
};

std::string settings(const Texts& t, const DesignRecord& d) {
  const CandidatesRecord& c = d.candidates;
  const DesignSettingsRecord& s = d.settings;
  std::string unused;
  for (const UnusedType& type : d.types_not_placed)
    unused += paragraph(t.say("design.not_placed", type.name, t.number(type.lasts_h, 3), type.rules,
                              t.number(type.asked_h, 3)));
  std::string unlit;
  for (const std::string& name : d.unlit_flights)
    unlit += paragraph(t.say("design.unlit_flight", name));
  std::string rules;
  for (const std::string& rule : s.rules) rules += (rules.empty() ? "" : ", ") + rule;
  std::string left;
  LeftOut::fields(LeftOutWords{t, left}, c.left_out);
  return paragraph(t.say("design.settings", rules, t.number(s.margin, 3),
                         t.word("design.failure", s.failure))) +
         paragraph(t.say("design.candidates", c.places, c.luminaires, c.points)) +
         (left.empty() ? "" : paragraph(t.say("design.left_out", left))) + unused + unlit +
         hidden(t, d);
}

}  // namespace

std::string design_page(const DesignRecord& d, const AssessmentRecord& a,
                        const std::vector<LayoutPlan>& plans, Language language) {
  const Texts t(language);
  const Schedule schedule(a);
  std::string title = a.project.name;
  if (title.empty()) title = d.scene.title.empty() ? d.scene.name : d.scene.title;
  const std::string body =
      "<header class=\"cover\"><div>" + paragraph(t("design.page"), "kind") + "<h1>" +
      escaped(title) + "</h1></div></header>\n" + project_block(t, a.project, a.scene) +
      outcome(t, d) + notice(t, d.smoke.has_value()) + (d.smoke ? smoke_section(t, d) : "") +
      side_by_side(t, d, plans) + heading(t, "heading.plans") + plans_of(t, a, schedule) +
      heading(t, "heading.schedules") + schedule_of(t, d) + (d.signs ? signs_of(t, *d.signs) : "") +
      heading(t, "design.binding_heading") + binding(t, d) + off_place(t, d) + others(t, d) +
      heading(t, "design.settings_heading") + settings(t, d);
  return html_page({t.code(), title + " – " + t("design.page"),
                    page_rule(t, a.project, title, false) + report_style},
                   body);
}

}  // namespace luxodus
