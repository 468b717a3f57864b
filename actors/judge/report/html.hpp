// Building blocks of a report's page: cells, tables, marks of verdicts. Parameters named `text` are
// escaped; those named `html` are inserted as they are. Pure functions; any thread.
#pragma once

#include <string>
#include <vector>

#include "actors/judge/record/people_record.hpp"
#include "actors/judge/report/eye_pictures.hpp"
#include "actors/judge/report/schedule.hpp"
#include "actors/judge/texts/texts.hpp"

namespace luxodus {

/// Inputs that all sections of a page share.
struct PageParts {
  const AssessmentRecord& a;
  const Schedule& schedule;
  const Texts& texts;
  const std::vector<ReportPicture>& pictures;
  const std::optional<FollowedPeople>& people;
  double paper_width_mm = 180, paper_height_mm = 257;  // within the margins, portrait
  bool grid_values = false;
};

std::string escaped(const std::string& text);

/// A path that may break after a folder, but not before a file's extension, in a narrow column.
std::string breaking_at_slashes(const std::string& path);

std::string cell(const std::string& text);
std::string html_cell(const std::string& html, const char* css_class = "");
/// A number with its unit, right-aligned; a dash if it is not finite, or if there is none.
std::string number_cell(const Texts& texts, double value, const std::string& unit = "",
                        int digits = 3);
std::string number_cell(const Texts& texts, const std::optional<double>& value,
                        const std::string& unit = "", int digits = 3);
std::string number_cell(const Texts& texts, size_t count, const std::string& unit = "",
                        int digits = 3);
/// A dash: no number.
std::string no_number_cell();
std::string fixed_cell(const Texts& texts, double value, int decimals);
/// "cd/m²" for "cd/m2", "" for "1".
std::string unit_text(const Texts& texts, const std::string& unit);
/// The symbol and the word of a verdict. `list`: "verdict" or "sight".
std::string verdict_mark(const Texts& texts, const char* list, const std::string& verdict);
std::string verdict_cell(const Texts& texts, const char* list, const std::string& verdict);

/// The counts of checks by their verdicts, each with its mark.
std::string count_chips(const Texts& texts, const CountsRecord& counts);

/// A table whose head is repeated on every page; "" without rows.
/// `columns`: keys of texts; `widths`: a share of the page for each [%].
std::string table(const Texts& texts, const std::vector<const char*>& columns,
                  const std::vector<int>& widths, const std::string& rows,
                  const char* css_class = "");
/// A row that spans all columns.
std::string heading_row(const std::string& html, size_t columns);

std::string paragraph(const std::string& text, const char* css_class = "");
std::string figure(const std::string& html, const std::string& caption);
std::string subheading(const std::string& text);
/// Sentences in the style of remarks; "" if there are none.
std::string remark_html(const Texts& texts, const Remark& remark);
std::string remark_html(const Texts& texts, const Remarks& remarks);

/// Source of a rule's limit: "secondary", "recollection" or "none".
std::string source_status(const Rule& rule);

}  // namespace luxodus
