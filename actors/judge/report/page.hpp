// The page of a report: one self-contained HTML document for a browser and for paper, from the
// record of an assessment. Its sections are in page_*.cpp. Pure functions; any thread.
#pragma once

#include <map>
#include <string>

#include "actors/judge/report/html.hpp"

namespace luxodus {

struct PageOptions {
  bool letter = false;               // paper size Letter instead of A4
  std::map<std::string, int> pages;  // page number by heading id, for the printed contents
};

std::string report_page(const PageParts& parts, const PageOptions& options);

/// CSS of a printed page: paper, and texts in its margins. `title`: of the document.
std::string page_rule(const Texts& texts, const ProjectRecord& project, const std::string& title,
                      bool letter);
/// Client, document, revision, people and dates; a dash for what is not stated.
std::string project_block(const Texts& texts, const ProjectRecord& project,
                          const SceneRecord& scene);

// Sections without their headings; "" if a section has no content.
std::string verdict_section(const PageParts& parts);
std::string state_section(const PageParts& parts);
std::string plans_section(const PageParts& parts);
std::string rooms_section(const PageParts& parts);
std::string luminaires_section(const PageParts& parts);
std::string schedules_section(const PageParts& parts);
std::string surfaces_section(const PageParts& parts);
std::string places_section(const PageParts& parts);
std::string sights_section(const PageParts& parts);
/// The picture of the judged state by the camera "cover"; null where there is none.
const ReportPicture* cover_picture(const PageParts& parts);
/// Part of sights_section: the light at the eyes, and how views stand to experiments with people.
std::string observers_note(const PageParts& parts);
/// Part of sights_section; "" if no thresholds were sought.
std::string thresholds_table(const PageParts& parts);
std::string over_time_section(const PageParts& parts);
std::string people_section(const PageParts& parts);
std::string thumb_section(const PageParts& parts);
std::string inputs_section(const PageParts& parts);
std::string not_assessed_section(const PageParts& parts);
std::string method_section(const PageParts& parts);
std::string other_checks_appendix(const PageParts& parts);
std::string signs_appendix(const PageParts& parts);
/// Every rule that was applied, with the provenance of its limit.
std::string clauses_appendix(const PageParts& parts);
/// How many rules were applied, and of how many the limit was read in no source.
struct Provenance {
  size_t rules = 0, secondary = 0, recollected = 0;
};
Provenance provenance_of(const AssessmentRecord& assessment);

/// The verdict in words: "3 checks fail, 2 not assessed".
std::string verdict_words(const Texts& texts, const CountsRecord& counts);
/// The first sentence of a report: state, rules, and counts of checks and views. In English it is
/// that of first_words (actors/judge/assess).
std::string headline(const Texts& texts, const AssessmentRecord& assessment);

}  // namespace luxodus
