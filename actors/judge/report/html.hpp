// Pieces of a report's page: cells, tables, marks of verdicts. Text is escaped by whoever says
// `text`; what is called `html` is taken as it is. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/report/eye_pictures.hpp"
#include "actors/judge/report/schedule.hpp"
#include "actors/judge/texts/remark_json.hpp"

namespace luxodus {

/// What all parts of a page are made of.
struct PageParts {
  const Json& a;  // the assessment
  const Schedule& schedule;
  const Texts& texts;
  const std::vector<ReportPicture>& pictures;
  std::string folder;  // of the assessment, for the commands that the page names
  double paper_width_mm = 180, paper_height_mm = 257;  // within the margins, upright
  bool grid_values = false;
};

std::string escaped(const std::string& text);

std::string cell(const std::string& text);
std::string html_cell(const std::string& html, const char* css_class = "");
/// A number with its unit, to the right; a dash where there is no number.
std::string number_cell(const Texts& texts, const Json& value, const std::string& unit = "",
                        int digits = 3);
std::string fixed_cell(const Texts& texts, double value, int decimals);
/// "cd/m²" for "cd/m2", "" for "1".
std::string unit_text(const Texts& texts, const std::string& unit);
/// The mark of a verdict, and its word. `list`: "verdict" or "sight".
std::string verdict_mark(const Texts& texts, const char* list, const std::string& verdict);
std::string verdict_cell(const Texts& texts, const char* list, const std::string& verdict);

/// A table whose head is repeated on every page. Empty where there are no rows.
/// `columns`: keys of texts; `widths`: shares of the page [%], as many.
std::string table(const Texts& texts, const std::vector<const char*>& columns,
                  const std::vector<int>& widths, const std::string& rows,
                  const char* css_class = "");
/// A row over all columns.
std::string heading_row(const std::string& html, size_t columns);

std::string paragraph(const std::string& text, const char* css_class = "");
std::string figure(const std::string& html, const std::string& caption);
std::string subheading(const std::string& text);
/// Sentences of remarks, as JSON holds them: of a list, or of one. Empty where there is none.
std::string said(const Texts& texts, const Json& remarks);
/// The same, set apart as remarks are.
std::string remark_html(const Texts& texts, const Json& remarks);

/// 'route "corridor"' with its kind in the language.
std::string subject_text(const Texts& texts, const Json& subject);
/// "4.2.1 of 2013" of a check.
std::string clause_text(const Texts& texts, const Json& check);
/// "verified", "secondary", "recollection" or "none": how well the limit of a check is known.
std::string source_status(const Json& check);

}  // namespace luxodus
