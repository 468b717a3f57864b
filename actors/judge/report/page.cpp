#include "actors/judge/report/page.hpp"

#include <array>

#include "actors/judge/report/overview.hpp"
#include "actors/judge/report/page_style.hpp"
#include "actors/judge/report/plan_svg.hpp"
#include "actors/results/formats/html_page.hpp"
#include "runtime/core/base64.hpp"

namespace luxodus {

namespace {

struct Section {
  const char* id;
  const char* heading;  // key of its text
  std::string (*html)(const PageParts&);
  const char* css_class = "";
};

constexpr std::array<Section, 18> sections{
    {{"verdict", "heading.verdict", verdict_section},
     {"plans", "heading.plans", plans_section, "plans"},
     {"rooms", "heading.rooms", rooms_section},
     {"luminaires", "heading.luminaires", luminaires_section},
     {"schedules", "heading.schedules", schedules_section},
     {"surfaces", "heading.surfaces", surfaces_section},
     {"places", "heading.places", places_section},
     {"sights", "heading.sights", sights_section},
     {"over-time", "heading.over_time", over_time_section, "fresh"},
     {"people", "heading.people", people_section, "fresh"},
     {"thumb", "heading.thumb", thumb_section},
     {"state", "heading.state", state_section},
     {"inputs", "heading.inputs", inputs_section},
     {"not-assessed", "heading.not_assessed", not_assessed_section},
     {"method", "heading.method", method_section},
     {"appendix-checks", "heading.appendix_checks", other_checks_appendix, "fresh"},
     {"appendix-signs", "heading.appendix_signs", signs_appendix, "fresh"},
     {"appendix-clauses", "heading.appendix_clauses", clauses_appendix, "fresh"}}};
constexpr size_t numbered = 15;  // later sections are appendices

/// Height of the drawing on the cover.
constexpr double cover_mm = 76;

constexpr std::array<const char*, 5> notices{"notice.calculation", "notice.secondary",
                                             "notice.legibility", "notice.authority",
                                             "notice.measure"};

/// A string of CSS; all bytes except letters, digits and spaces are escaped by number.
std::string css_text(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte >= 0x80 || c == ' ' || (c >= '0' && c <= '9') ||
                       (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    out += plain ? std::string(1, c) : fmt::format("\\{:06x} ", byte);
  }
  return out + "\"";
}

std::string title_of(const PageParts& parts) {
  for (const auto& title : {parts.a.project.name, parts.a.scene.title, parts.a.scene.name})
    if (!title.empty()) return title;
  return parts.texts("page.kind");
}

/// The storeys seen obliquely from above; "" without any.
std::string drawing_of_storeys(const PageParts& parts) {
  const std::string drawing =
      overview_svg(parts.a, parts.schedule, parts.texts, {parts.paper_width_mm, cover_mm});
  return drawing.empty() ? "" : "<figure class=\"cover\">" + drawing + "</figure>\n";
}

std::string cover_figure(const Texts& t, const ReportPicture& rendering) {
  return "<figure class=\"cover\"><img alt=\"\" src=\"data:image/png;base64," +
         base64(rendering.png) + "\"><figcaption>" + escaped(t("cover.rendering")) +
         "</figcaption></figure>\n";
}

/// Scenario, operation, lit luminaires, smoke and rule sets in one line.
std::string state_line(const PageParts& parts) {
  const Texts& t = parts.texts;
  const StateRecord& s = parts.a.state;
  std::string out = t("state.scenario") + std::string(": ") +
                    (s.scenario.empty() ? t("state.no_scenario") : s.scenario) + " · " +
                    t.word("operation", name_of(s.operation));
  if (s.seconds_after_failure) out += ", " + t.number(*s.seconds_after_failure, 4) + " s";
  out += " · " + t.say("state.lit", s.luminaires.lit, s.luminaires.of);
  out += std::string(" · ") + t("state.smoke") + ": ";
  if (s.smoke)
    out += t.number(s.smoke->extinction.min) + "–" + t.number(s.smoke->extinction.max) + " 1/m";
  else
    out += t("state.no_smoke");
  for (const RulesRecord& rule : s.rules) out += " · " + rule.edition;
  return out;
}

std::string provenance_line(const Texts& t, const AssessmentRecord& a) {
  const Provenance p = provenance_of(a);
  if (p.rules == 0) return "";
  return paragraph(t.say("verdict.provenance", p.rules, p.secondary, p.recollected), "note");
}

std::string verdict_box(const PageParts& parts) {
  const Texts& t = parts.texts;
  const CountsRecord& counts = parts.a.verdict.counts;
  const CheckVerdict mark = counts.fail > 0           ? CheckVerdict::fail
                            : counts.not_verified > 0 ? CheckVerdict::not_verified
                            : counts.not_assessed > 0 ? CheckVerdict::not_assessed
                                                      : CheckVerdict::information;
  std::string out =
      "<div class=\"box\"><svg viewBox=\"-1.25 -1.25 2.5 2.5\" "
      "aria-hidden=\"true\">" +
      verdict_shape(name_of(mark), 0, 0, 1) + "</svg><div><p class=\"words\">" +
      escaped(headline(t, parts.a)) + "</p><p class=\"chips\">" + count_chips(t, counts) + "</p>";
  if (!parts.a.sights.empty()) {
    out += "<p>" + escaped(t("verdict.sights")) + "</p><p class=\"chips\">";
    for (const auto& [verdict, times] : parts.a.sight_counts)
      out +=
          "<span>" + std::to_string(times) + " " + verdict_mark(t, "sight", verdict) + "</span>\n";
    out += "</p>";
  }
  return out + "<p class=\"note\">" + escaped(state_line(parts)) + "</p>" +
         provenance_line(t, parts.a) + "</div></div>\n";
}

std::string notice_box(const Texts& t) {
  std::string out = "<div class=\"notice\">" + subheading(t("notice.heading")) + "<ul>\n";
  for (const char* key : notices) out += "<li>" + escaped(t(key)) + "</li>\n";
  return out + "</ul></div>\n";
}

/// Numbers sections, and letters appendices, in the order in which they stand on the page.
class SectionCounter {
 public:
  std::string next(const Texts& t, bool appendix) {
    if (!appendix) return std::to_string(++sections_);
    return t.say("page.appendix", std::string(1, static_cast<char>('A' + appendices_++)));
  }

 private:
  int sections_ = 0, appendices_ = 0;
};

std::string heading_html(const Section& section, const std::string& number, bool appendix,
                         const Texts& t) {
  return fmt::format("<h2 id=\"{}\" class=\"{}\"><span class=\"{}\">{}</span>{}</h2>\n", section.id,
                     section.css_class, appendix ? "a" : "n", escaped(number),
                     escaped(t(section.heading)));
}

/// Plans stand on sheets of their own: the heading is on the first, which may be landscape.
std::string within_first_sheet(const std::string& heading, const std::string& html) {
  const size_t end = html.find(">\n");
  if (!html.starts_with("<section") || end == std::string::npos) return heading + html;
  return html.substr(0, end + 2) + heading + html.substr(end + 2);
}

}  // namespace

std::string page_rule(const Texts& t, const ProjectRecord& project, const std::string& title,
                      bool letter) {
  const std::string revision =
      project.revision.empty() ? "" : t("project.revision") + (" " + project.revision);
  std::string left = title, right;
  for (const std::string& text : {project.document, revision, project.date})
    if (!text.empty()) right += (right.empty() ? "" : " · ") + text;
  const std::string of = t("page.of");
  // "Page {0} of {1}", in which the browser counts.
  const size_t first = of.find("{0}"), second = of.find("{1}");
  const std::string page = css_text(of.substr(0, first)) + " counter(page) " +
                           css_text(of.substr(first + 3, second - first - 3)) + " counter(pages)";
  const char* paper = letter ? "Letter" : "A4";
  constexpr const char* font =
      "font-family: \"Liberation Sans\", Arial, Helvetica, \"DejaVu Sans\", sans-serif; color: "
      "#5c6670;";
  return fmt::format(
      "@page {{ size: {0}; margin: 20mm 15mm 20mm 15mm;\n"
      "  @top-left {{ content: {1}; {5} font-size: 7.5pt; width: 55%; text-align: left }}\n"
      "  @top-right {{ content: {2}; {5} font-size: 7.5pt; width: 45%; text-align: right }}\n"
      "  @bottom-left {{ content: {3}; {5} font-size: 6.2pt; line-height: 1.25; width: 84%; "
      "text-align: left }}\n"
      "  @bottom-right {{ content: {4}; {5} font-size: 8pt; width: 16%; text-align: right }} }}\n"
      "@page wide {{ size: {0} landscape }}\n",
      paper, css_text(left), css_text(right), css_text(t("notice.footer")), page, font);
}

std::string project_block(const Texts& t, const ProjectRecord& project, const SceneRecord& scene) {
  std::string out = "<dl class=\"project\">\n";
  const auto add = [&](const char* key, const std::string& value) {
    out += "<div><dt>" + escaped(t(key)) + "</dt><dd>" + escaped(value.empty() ? "–" : value) +
           "</dd></div>\n";
  };
  add("project.client", project.client);
  add("project.document", project.document);
  add("project.address", project.address);
  add("project.revision", project.revision);
  add("project.author", project.author);
  add("project.date", project.date);
  add("project.checker", project.checker);
  add("project.scene", scene.title.empty() ? scene.name : scene.title);
  return out + "</dl>\n";
}

std::string report_page(const PageParts& parts, const PageOptions& options) {
  const Texts& t = parts.texts;
  std::string out = "<header class=\"cover\"><div>" + paragraph(t("page.kind"), "kind") + "<h1>" +
                    escaped(title_of(parts)) + "</h1></div>";
  if (const std::string logo = parts.a.project.logo_png; !logo.empty())
    out += "<img alt=\"\" src=\"data:image/png;base64," + logo + "\">";
  out += "</header>\n";
  const ReportPicture* const rendering = cover_picture(parts);
  out += rendering == nullptr ? drawing_of_storeys(parts) : cover_figure(t, *rendering);
  out += project_block(t, parts.a.project, parts.a.scene) + verdict_box(parts) + notice_box(t);
  std::string contents, body;
  SectionCounter counter;
  for (size_t i = 0; i < sections.size(); ++i) {
    const Section& section = sections[i];
    const std::string html = section.html(parts);
    if (html.empty()) continue;
    const bool appendix = i >= numbered;
    const std::string number = counter.next(t, appendix);
    const auto page = options.pages.find(section.id);
    contents += fmt::format(
        "<li><a href=\"#{}\"><span class=\"{}\">{}</span><span class=\"t\">{}</span><span "
        "class=\"p\">{}</span></a></li>\n",
        section.id, appendix ? "a" : "n", escaped(number), escaped(t(section.heading)),
        page == options.pages.end() ? "" : std::to_string(page->second));
    const std::string heading = heading_html(section, number, appendix, t);
    body += std::string_view(section.css_class) == "plans" ? within_first_sheet(heading, html)
                                                           : heading + html;
  }
  out += "<nav>" + subheading(t("page.contents")) + "<ol class=\"contents\">\n" + contents +
         "</ol></nav>\n" + (rendering == nullptr ? "" : drawing_of_storeys(parts)) + body;
  return html_page({t.code(), title_of(parts) + " – " + t("page.kind"),
                    page_rule(t, parts.a.project, title_of(parts), options.letter) + report_style},
                   out);
}

}  // namespace luxodus
