// luxodus report: the report of an assessment, written again from its JSON.
#include "actors/assess/assessment_json.hpp"
#include "actors/cli/command.hpp"
#include "actors/cli/report_options.hpp"

namespace luxodus::cli {

namespace fs = std::filesystem;

ReportOptions ReportWords::options() const {
  ReportOptions out;
  for (size_t i = 0; i < language_words.size(); ++i)
    if (language == language_words[i]) out.language = static_cast<Language>(i);
  out.letter = paper == "letter";
  out.grid_values = grid_values;
  out.pdf = pdf;
  return out;
}

void add_report_options(CLI::App& command, ReportWords& words) {
  command.add_option("--language", words.language, "of the report: en, de, fr [en]")
      ->check(CLI::IsMember({"en", "de", "fr"}));
  command.add_option("--paper", words.paper, "of the report: a4, letter [a4]")
      ->check(CLI::IsMember({"a4", "letter"}, CLI::ignore_case));
  command.add_flag("--grid-values", words.grid_values,
                   "write the illuminance at points of calculation on the plans");
  command.add_flag("--pdf", words.pdf, "print report.pdf, too, by Chromium where one is installed");
}

Result<void> write_report_and_tell(const OutputFolder& folder, const Json& assessment,
                                   const ReportWords& words) {
  ReportOptions options = words.options();
  options.named = folder.named().string();
  if (auto ok = write_report(folder.path(), assessment, options); !ok.ok()) return ok;
  for (const char* file : {"report.html", "report.pdf"})
    if (words.pdf || std::string_view(file) == "report.html")
      std::printf("written to %s\n", (folder.named() / file).string().c_str());
  return {};
}

namespace {

Result<void> report_again(const std::string& folder, const ReportWords& words) {
  const auto read = read_assessment(folder);
  if (!read.ok()) return read.problem();
  const auto out =
      OutputFolder::claim(folder, {{"report.html", "report.pdf"}, {"plans", "schedules"}});
  if (!out.ok()) return out.problem();
  return write_report_and_tell(out.value(), read.value(), words);
}

}  // namespace

void add_report(CLI::App& app, int& exit_code) {
  auto folder = std::make_shared<std::string>();
  auto words = std::make_shared<ReportWords>();
  CLI::App* command =
      app.add_subcommand("report", "Write the report of an assessment again, with new pictures");
  command->footer(
      "Writes report.html, plans/ (SVG, DXF) and schedules/ (CSV) into FOLDER. Takes in the "
      "pictures of\nFOLDER/views or FOLDER/run/views, as `luxodus run --out FOLDER/run` makes "
      "them.\n"
      "  luxodus report out/office --pdf --language de\n"
      "  luxodus report out/office --pdf --paper letter --grid-values");
  command->add_option("folder", *folder, "folder of luxodus assess")->required();
  add_report_options(*command, *words);
  command->callback([folder, words, &exit_code] {
    const auto done = report_again(*folder, *words);
    if (done.ok()) return;
    tell(done.problem());
    exit_code = ExitCode::bad_input;
  });
}

}  // namespace luxodus::cli
