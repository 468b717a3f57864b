#include "actors/judge/design/side_by_side.hpp"

#include <algorithm>

#include "actors/judge/assess/record_assessment.hpp"
#include "actors/judge/report/html.hpp"
#include "actors/judge/report/plan_svg.hpp"

namespace luxodus {

namespace {

/// Two of these fit side by side on a page.
constexpr PlanSize small_plan{128, 84};

std::string caption(const Texts& t, const DesignRecord& design, const std::string& name) {
  const SmokeRecord& smoke = *design.smoke;
  for (const SmokeLayoutRecord& one : smoke.layouts)
    if (one.name == name)
      return t.say(name == smoke.recommended ? "design.side_recommended" : "design.side_layout",
                   name, one.luminaires, t.word("design.objective", design.objective.kind),
                   t.number(one.objective, 4));
  return name;
}

}  // namespace

std::vector<LayoutPlan> layout_plans(const DesignResult& result, const std::string& version) {
  std::vector<LayoutPlan> out;
  if (!result.smoke) return out;
  for (const JudgedLayout& one : result.smoke->layouts)
    if (one.has_usual_signs())
      out.push_back({one.name, record_of(*one.layout.variant, result.assessment, version)});
  if (out.size() < 2) out.clear();
  return out;
}

std::string side_by_side(const Texts& t, const DesignRecord& design,
                         const std::vector<LayoutPlan>& plans) {
  if (plans.empty() || !design.smoke) return "";
  std::string out = "<h2>" + escaped(t("design.side_heading")) + "</h2>\n" +
                    paragraph(t("design.side_note"), "note");
  const size_t levels = Schedule(plans.front().drawn).levels();
  for (size_t level = 0; level < levels; ++level) {
    out += "<div class=\"maps\">\n";
    for (const LayoutPlan& one : plans) {
      const Schedule schedule(one.drawn);
      out += figure(Plans(one.drawn, schedule, t, small_plan).installation(level).svg,
                    caption(t, design, one.name));
    }
    out += "</div>\n";
  }
  return out;
}

}  // namespace luxodus
