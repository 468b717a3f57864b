#include "actors/judge/assess/state_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace luxodus {

namespace {

/// Names that a row lists; further ones are counted.
constexpr size_t names_listed = 12;

std::string operation_row(const StateRecord& state) {
  if (state.operation == Operation::mains) return "MAINS: not an emergency";
  std::string out = name_of(state.operation);
  if (state.operation == Operation::dark) out += ": neither mains nor emergency luminaires";
  return out + (state.seconds_after_failure ? fmt::format(", {:g} s after the failure of the mains",
                                                          *state.seconds_after_failure)
                                            : ", time after the failure of the mains not stated");
}

std::string luminaire_row(const LitRecord& luminaires) {
  std::string out = fmt::format("{} of {} lit", luminaires.lit, luminaires.of);
  const auto& names = luminaires.names;
  for (size_t i = 0; i < std::min(names.size(), names_listed); ++i)
    out += (i == 0 ? ": " : ", ") + names[i];
  if (names.size() > names_listed) out += fmt::format(" and {} more", names.size() - names_listed);
  return out;
}

std::string range_words(double low, double high) {
  const std::string from = fmt::format("{:.3g}/m", low), to = fmt::format("{:.3g}/m", high);
  return from == to ? from : from + " to " + to;
}

std::string smoke_row(const std::optional<StateSmokeRecord>& smoke) {
  if (!smoke) return "none";
  const ExtinctionRecord& all = smoke->extinction;
  std::string out = fmt::format(
      "extinction {} at {:g} nm (optical density {})", range_words(all.min, all.max),
      all.wavelength_nm, range_words(all.min / std::numbers::ln10, all.max / std::numbers::ln10));
  for (const StatedMedium& medium : smoke->media) {
    out += fmt::format("; {} \"{}\" {}", medium.kind, medium.name,
                       range_words(medium.extinction_min, medium.extinction_max));
    std::string source = medium.place;
    for (const Remark& note : medium.notes) source += ", " + english().remark(note);
    if (!source.empty()) out += " (" + source + ")";
  }
  return out;
}

std::string named_row(const std::vector<RulesRecord>& rows) {
  std::string out;
  for (const RulesRecord& row : rows) {
    out += (out.empty() ? "" : "; ") + row.edition + " (" + row.id + "), " +
           english().remark(row.what);
    if (row.status) out += ", " + english().remark(*row.status);
  }
  return out.empty() ? "none" : out;
}

/// A row for each reason; only the first has a name.
void add_unassessed(const AssessmentRecord& assessment, std::vector<StateRow>& rows) {
  const char* what = "not assessed";
  for (const NotAssessedRecord& group : assessment.not_assessed) {
    std::string why = english().remarks(group.why);
    if (group.undecided) why = english().say("views.undecided", why);
    rows.emplace_back(what,
                      fmt::format("{}: {}{}", group.words(english()), why,
                                  group.count > 1 ? fmt::format(" ({} times)", group.count) : ""));
    what = "";
  }
  if (*what != '\0') rows.emplace_back(what, "nothing");
}

/// "\"fire\", emergency operation, 60 s after the failure, in smoke of 0.2/m to 0.8/m".
std::string judged_words(const StateRecord& state) {
  std::string out = fmt::format("\"{}\", {} operation", state.scenario, name_of(state.operation));
  if (state.seconds_after_failure)
    out += fmt::format(", {:g} s after the failure", *state.seconds_after_failure);
  if (!state.smoke) return out + ", in clear air";
  const ExtinctionRecord& extinction = state.smoke->extinction;
  if (extinction.max == 0) return out + english()("headline.smoke_elsewhere");
  const std::string all = range_words(extinction.min, extinction.max);
  out += ", in smoke of " + all;
  const auto& lines = state.smoke->on_lines;
  if (!lines) return out;
  if (lines->max == 0) return out + english()("headline.no_smoke_on_lines");
  const std::string on_lines = range_words(lines->min, lines->max);
  return on_lines == all ? out : out + english().say("headline.smoke_on_lines", on_lines);
}

}  // namespace

std::string first_sentence(const AssessmentRecord& assessment, const std::string& verdict) {
  std::string rules;
  for (const RulesRecord& one : assessment.state.rules)
    rules += (rules.empty() ? "" : " and ") + one.edition;
  std::string out = fmt::format("{}, by {}: {}", judged_words(assessment.state), rules, verdict);
  size_t all = 0;
  for (const auto& [word, count] : assessment.sight_counts) all += count;
  if (all == 0) return out + "; no view of a sign was judged";
  const auto legible = assessment.sight_counts.find(name_of(SightVerdict::legible));
  return out + fmt::format("; {} of {} views of signs are legible",
                           legible == assessment.sight_counts.end() ? 0 : legible->second, all);
}

std::vector<StateRow> state_rows(const AssessmentRecord& assessment) {
  const StateRecord& state = assessment.state;
  std::vector<StateRow> rows{{"scenario", state.scenario},
                             {"operation", operation_row(state)},
                             {"luminaires", luminaire_row(state.luminaires)},
                             {"smoke", smoke_row(state.smoke)},
                             {"light", english().remark(state.light)},
                             {"rules", named_row(state.rules)}};
  if (!state.deviations.empty()) rows.emplace_back("deviations", named_row(state.deviations));
  add_unassessed(assessment, rows);
  return rows;
}

std::string state_text(const AssessmentRecord& assessment) {
  std::string out = "judged state\n";
  for (const auto& [what, words] : state_rows(assessment))
    out += fmt::format("  {:<13} {}\n", what, words);
  for (const Remark& remark : assessment.state.remarks)
    out += fmt::format("  note: {}\n", english().remark(remark));
  return out;
}

bool anything_open(const AssessmentRecord& assessment) {
  const CountsRecord& counts = assessment.verdict.counts;
  return counts.fail + counts.not_assessed + counts.not_verified > 0 ||
         assessment.sight_counts.contains(name_of(SightVerdict::undecided)) ||
         assessment.sight_counts.contains(name_of(SightVerdict::not_assessed));
}

}  // namespace luxodus
