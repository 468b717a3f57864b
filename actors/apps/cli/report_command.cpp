// luxodus report: writes the report of an assessment again from its record.
#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/report_options.hpp"
#include "actors/judge/assess/assessment_files.hpp"

namespace luxodus::cli {

namespace fs = std::filesystem;

ReportOptions ReportWords::options() const {
  ReportOptions out;
  out.language = language_of(language);
  out.letter = paper == "letter";
  out.grid_values = grid_values;
  out.pdf = pdf;
  return out;
}

void add_report_options(Command& command, ReportWords& words) {
  const std::vector<Option> options{
      {"--language",
       &words.language,
       "Language of the report",
       {.choices = {language_words.begin(), language_words.end()}, .group = "Report"}},
      {"--paper",
       &words.paper,
       "Paper size of the report",
       {.choices = {"a4", "letter"}, .group = "Report"}},
      {"--grid-values",
       &words.grid_values,
       "Illuminance at the points of calculation, written on the plans",
       {.group = "Report"}},
      {"--pdf",
       &words.pdf,
       "Report as report.pdf, too, by Chromium where one is installed",
       {.group = "Report"}}};
  command.options.insert(command.options.end(), options.begin(), options.end());
}

Result<void> write_report_and_tell(const OutputFolder& folder, const AssessmentRecord& assessment,
                                   const ReportWords& words) {
  if (auto ok = write_report(folder.path(), assessment, words.options()); !ok) return ok.problem();
  for (const char* file : {"report.html", "report.pdf"})
    if (words.pdf || std::string_view(file) == "report.html")
      std::printf("written to %s\n", (folder.named() / file).string().c_str());
  return {};
}

namespace {

Result<void> report_again(const std::string& folder, const ReportWords& words) {
  const auto read = read_assessment(folder);
  if (!read) return read.problem();
  const auto out =
      OutputFolder::claim(folder, {{"report.html", "report.pdf"}, {"plans", "schedules"}});
  if (!out) return out.problem();
  return write_report_and_tell(out.value(), read.value(), words);
}

}  // namespace

Command report_command() {
  struct Asked {
    std::string folder;
    ReportWords words;
  };
  const auto o = std::make_shared<Asked>();
  Command command{
      .name = "report",
      .summary = "Write the report of an assessment again, with new pictures",
      .heading = "Assess",
      .options = {{"folder",
                   &o->folder,
                   "Folder of an assessment",
                   {.form = Form::folder, .required = true}}},
      .notes =
          "Writes report.html, plans/ (SVG, DXF) and schedules/ (CSV) into FOLDER. Takes in "
          "the pictures of FOLDER/run/views, as `luxodus run --out FOLDER/run` makes them, or else "
          "those of FOLDER/views, which `luxodus assess` has made.\n"
          "  luxodus report out/office --pdf --language de\n"
          "  luxodus report out/office --pdf --paper letter --grid-values",
      .run = [o] { return exit_code_of(report_again(o->folder, o->words)); }};
  add_report_options(command, o->words);
  return command;
}

}  // namespace luxodus::cli
