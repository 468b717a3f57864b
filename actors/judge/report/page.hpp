// The page of a report: one HTML document that needs nothing beside itself, for a browser and for
// paper. From the JSON of an assessment; pure; any thread. Its sections are in page_*.cpp.
#pragma once

#include <map>
#include <string>

#include "actors/judge/report/html.hpp"

namespace luxodus {

struct PageOptions {
  bool letter = false;               // paper: Letter, else A4
  std::map<std::string, int> pages;  // of the headings by their ids, for the contents on paper
};

std::string report_page(const PageParts& parts, const PageOptions& options);

// Sections, without their headings; "" where there is nothing to say.
std::string verdict_section(const PageParts& parts);
std::string state_section(const PageParts& parts);
std::string plans_section(const PageParts& parts);
std::string schedules_section(const PageParts& parts);
std::string places_section(const PageParts& parts);
std::string sights_section(const PageParts& parts);
std::string over_time_section(const PageParts& parts);
std::string thumb_section(const PageParts& parts);
std::string inputs_section(const PageParts& parts);
std::string clauses_section(const PageParts& parts);
std::string not_assessed_section(const PageParts& parts);
std::string method_section(const PageParts& parts);
std::string other_checks_appendix(const PageParts& parts);
std::string signs_appendix(const PageParts& parts);
std::string thumb_appendix(const PageParts& parts);

/// The verdict in words: "3 checks fail, 2 not assessed".
std::string verdict_words(const Texts& texts, const Json& assessment);
/// What stands first: what was judged, by which rules, and what came of it, views of signs
/// included. In English what first_words (actors/judge/assess) says on a terminal.
std::string headline(const Texts& texts, const Json& assessment);

}  // namespace luxodus
