#include "actors/judge/report/page.hpp"

#include <array>

#include "actors/judge/report/page_style.hpp"
#include "actors/judge/report/plan_svg.hpp"
#include "actors/results/formats/html_page.hpp"

namespace luxodus {

namespace {

struct Section {
  const char* id;
  const char* heading;  // key of its text
  std::string (*html)(const PageParts&);
  const char* css_class = "";
};

constexpr std::array<Section, 15> sections{
    {{"verdict", "heading.verdict", verdict_section, "fresh"},
     {"state", "heading.state", state_section},
     {"plans", "heading.plans", plans_section, "plans"},
     {"schedules", "heading.schedules", schedules_section, "fresh"},
     {"places", "heading.places", places_section, "fresh"},
     {"sights", "heading.sights", sights_section, "fresh"},
     {"over-time", "heading.over_time", over_time_section, "fresh"},
     {"thumb", "heading.thumb", thumb_section},
     {"inputs", "heading.inputs", inputs_section, "fresh"},
     {"clauses", "heading.clauses", clauses_section, "fresh"},
     {"not-assessed", "heading.not_assessed", not_assessed_section},
     {"method", "heading.method", method_section},
     {"appendix-checks", "heading.appendix_checks", other_checks_appendix, "fresh"},
     {"appendix-signs", "heading.appendix_signs", signs_appendix, "fresh"},
     {"appendix-thumb", "heading.appendix_thumb", thumb_appendix, "fresh"}}};
constexpr size_t numbered = 12;  // later sections are appendices

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
  for (const auto& title : {text_in(parts.a["project"], "name"), text_in(parts.a["scene"], "title"),
                            text_in(parts.a["scene"], "name")})
    if (!title.empty()) return title;
  return parts.texts("page.kind");
}

/// CSS for the paper size and the texts in the margins of every page.
std::string page_rule(const PageParts& parts, bool letter) {
  const Texts& t = parts.texts;
  const Json& project = parts.a["project"];
  std::string left = title_of(parts), right;
  for (const char* key : {"document", "revision", "date"})
    if (const std::string text = text_in(project, key); !text.empty())
      right += (right.empty() ? "" : " · ") +
               (std::string(key) == "revision" ? t("project.revision") + (" " + text) : text);
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

std::string project_block(const PageParts& parts) {
  const Texts& t = parts.texts;
  const Json& project = parts.a["project"];
  std::string out = "<dl class=\"project\">\n";
  const auto add = [&](const char* key, const std::string& value) {
    out += "<div><dt>" + escaped(t(key)) + "</dt><dd>" + escaped(value.empty() ? "–" : value) +
           "</dd></div>\n";
  };
  for (const auto& [key, name] :
       {std::pair{"project.client", "client"}, std::pair{"project.document", "document"},
        std::pair{"project.address", "address"}, std::pair{"project.revision", "revision"},
        std::pair{"project.author", "author"}, std::pair{"project.date", "date"},
        std::pair{"project.checker", "checker"}})
    add(key, text_in(project, name));
  add("project.scene", text_in(parts.a["scene"], "title").empty()
                           ? text_in(parts.a["scene"], "name")
                           : text_in(parts.a["scene"], "title"));
  return out + "</dl>\n";
}

/// Scenario, operation, lit luminaires, smoke and rule sets in one line.
std::string state_line(const PageParts& parts) {
  const Texts& t = parts.texts;
  const Json& s = parts.a["state"];
  std::string out =
      t("state.scenario") + std::string(": ") +
      (text_in(s, "scenario").empty() ? t("state.no_scenario") : text_in(s, "scenario")) + " · " +
      t.word("operation", text_in(s, "operation"));
  if (const Json& seconds = s["seconds_after_failure"]; seconds.is_object())
    out += ", " + t.number(seconds["value"].get<double>(), 4) + " s";
  out += " · " + t.say("state.lit", s["luminaires"]["lit"].get<int64_t>(),
                       s["luminaires"]["of"].get<int64_t>());
  const Json& smoke = s["smoke"];
  out += std::string(" · ") + t("state.smoke") + ": ";
  if (smoke.is_object() && smoke["extinction"].is_object())
    out += t.number(smoke["extinction"]["min"].get<double>()) + "–" +
           t.number(smoke["extinction"]["max"].get<double>()) + " 1/m";
  else
    out += t("state.no_smoke");
  for (const Json& rule : s["rules"]) out += " · " + text_in(rule, "edition");
  return out;
}

std::string verdict_box(const PageParts& parts) {
  const Texts& t = parts.texts;
  const Json& v = parts.a["verdict"];
  const auto count = [&](const char* key) { return v[key].get<int64_t>(); };
  const char* mark = count("fail") > 0           ? "fail"
                     : count("not_verified") > 0 ? "not verified"
                     : count("not_assessed") > 0 ? "not assessed"
                                                 : "information";
  std::string chips;
  for (const auto& [key, verdict] :
       {std::pair{"pass", "pass"}, std::pair{"fail", "fail"},
        std::pair{"not_assessed", "not assessed"}, std::pair{"not_verified", "not verified"}})
    chips += "<span>" + std::to_string(count(key)) + " " + verdict_mark(t, "verdict", verdict) +
             "</span>\n";
  std::string out =
      "<div class=\"box\"><svg viewBox=\"-1.25 -1.25 2.5 2.5\" "
      "aria-hidden=\"true\">" +
      verdict_shape(mark, 0, 0, 1) + "</svg><div><p class=\"words\">" +
      escaped(headline(t, parts.a)) + "</p><p class=\"chips\">" + chips + "</p>";
  if (!parts.a["sights"].empty()) {
    out += "<p>" + escaped(t("verdict.sights")) + "</p><p class=\"chips\">";
    for (const auto& [verdict, times] : parts.a["sight_counts"].items())
      out += "<span>" + std::to_string(times.get<int64_t>()) + " " +
             verdict_mark(t, "sight", verdict) + "</span>\n";
    out += "</p>";
  }
  return out + "<p class=\"note\">" + escaped(state_line(parts)) + "</p></div></div>\n";
}

std::string notice_box(const Texts& t) {
  std::string out = "<div class=\"notice\">" + subheading(t("notice.heading")) + "<ul>\n";
  for (const char* key : notices) out += "<li>" + escaped(t(key)) + "</li>\n";
  return out + "</ul></div>\n";
}

/// "" for appendices, whose headings contain their letter.
std::string section_number(size_t section) {
  return section < numbered ? std::to_string(section + 1) : "";
}

}  // namespace

std::string report_page(const PageParts& parts, const PageOptions& options) {
  const Texts& t = parts.texts;
  std::string out = "<header class=\"cover\"><div>" + paragraph(t("page.kind"), "kind") + "<h1>" +
                    escaped(title_of(parts)) + "</h1></div>";
  if (const std::string logo = text_in(parts.a["project"], "logo_png"); !logo.empty())
    out += "<img alt=\"\" src=\"data:image/png;base64," + logo + "\">";
  out += "</header>\n" + project_block(parts) + verdict_box(parts) + notice_box(t);
  std::string contents, body;
  for (size_t i = 0; i < sections.size(); ++i) {
    const Section& section = sections[i];
    const std::string html = section.html(parts);
    if (html.empty()) continue;
    const auto page = options.pages.find(section.id);
    contents += fmt::format(
        "<li><a href=\"#{}\"><span class=\"n\">{}</span><span class=\"t\">{}</span><span "
        "class=\"p\">{}</span></a></li>\n",
        section.id, section_number(i), escaped(t(section.heading)),
        page == options.pages.end() ? "" : std::to_string(page->second));
    const std::string number = section_number(i);
    body += fmt::format("<h2 id=\"{}\" class=\"{}\">{}{}</h2>\n", section.id, section.css_class,
                        number.empty() ? "" : "<span class=\"n\">" + number + "</span>",
                        escaped(t(section.heading))) +
            html;
  }
  out += "<nav>" + subheading(t("page.contents")) + "<ol class=\"contents\">\n" + contents +
         "</ol></nav>\n" + body;
  return html_page({t.code(), title_of(parts) + " – " + t("page.kind"),
                    page_rule(parts, options.letter) + report_style},
                   out);
}

}  // namespace luxodus
