// Tests what a report says of signs beside their verdicts: thresholds, light at the eyes, and how
// views stand to people of experiments.
#include <catch2/catch.hpp>

#include "actors/judge/report/report.hpp"
#include "tests/unit/actors/judge/assess/assessed_room.hpp"

namespace luxodus {

using namespace test;

namespace {

/// The page with spaces instead of tags, each run of blanks as one.
std::string words_of_page(const AssessmentRecord& record, Language language) {
  ReportOptions options;
  options.language = language;
  std::string out;
  bool in_tag = false;
  for (const char c : report_html(record, {}, options)) {
    in_tag = c == '<' || (in_tag && c != '>');
    const bool blank = in_tag || c == '>' || c == ' ' || c == '\n';
    if (!blank)
      out += c;
    else if (!out.empty() && out.back() != ' ')
      out += ' ';
  }
  return out;
}

ThresholdRecord threshold(bool read, ThresholdEnd end, double value) {
  ThresholdRecord out;
  out.sought = Sought::luminance;
  out.sign = "exit <1>";
  out.read = read;
  out.end = end;
  out.above = true;
  if (end == ThresholdEnd::found) out.at = {value, 0.1};
  return out;
}

AssessmentRecord in_smoke() {
  AssessOptions options;
  options.rounds = 1;
  return recorded(with_smoke(0.6, 0.99), options);
}

void check_that_page_says(const AssessmentRecord& record, Language language,
                          const std::string& words) {
  INFO(words);
  CHECK(words_of_page(record, language).find(words) != std::string::npos);
}

}  // namespace

TEST_CASE("thresholds are a table with a row for each sign and quantity", "[report]") {
  AssessmentRecord record = in_smoke();
  const std::string none = words_of_page(record, Language::en);
  CHECK(none.find("Where signs are just read and seen") == std::string::npos);
  record.thresholds = {
      threshold(true, ThresholdEnd::found, 0.5), threshold(true, ThresholdEnd::found, 2),
      threshold(true, ThresholdEnd::nowhere, 0), threshold(false, ThresholdEnd::found, 0.25)};
  check_that_page_says(record, Language::en,
                       "Luminance: factor on all signs exit &lt;1&gt; at least 0.5 … 2 (2); "
                       "never (1) at least 0.25 (1)");
  check_that_page_says(record, Language::de,
                       "Leuchtdichte: Faktor auf alle Zeichen exit &lt;1&gt; mindestens 0,5 … 2 "
                       "(2); nie (1) mindestens 0,25 (1)");
  check_that_page_says(record, Language::fr,
                       "Luminance : facteur sur tous les panneaux exit &lt;1&gt; au moins 0,5 … 2 "
                       "(2); jamais (1) au moins 0,25 (1)");
}

TEST_CASE("a report says what light the eyes get, and what no experiment knows", "[report]") {
  AssessmentRecord record = in_smoke();
  std::vector<SightRecord> seen;
  for (const SightRecord& sight : record.sights)
    if (sight.seen) seen.push_back(sight);
  REQUIRE(seen.size() >= 2);
  seen.resize(2);
  seen[0].seen->eye_light = {0.5, 2};
  seen[1].seen->eye_light = {1.5, 4};
  seen[0].seen->experiments.read = {MeanObserver::yes, Untested::nothing};
  seen[1].seen->experiments.read = {MeanObserver::not_known, Untested::distance};
  record.sights = seen;
  check_that_page_says(record, Language::en,
                       "0.5 to 1.5 lx straight; without the smoke it would be 2 to 4 lx");
  check_that_page_says(record, Language::en, "1 of 2 views are within what experiments");
  check_that_page_says(record, Language::en, "In 1 of these the mean observer would read the sign");
  check_that_page_says(record, Language::en, "no experiment is known: distance (1)");
  check_that_page_says(record, Language::de, "kein Versuch bekannt: Entfernung (1)");
  check_that_page_says(record, Language::fr, "aucun essai n’est connu : distance (1)");
  record.state.smoke.reset();
  CHECK(words_of_page(record, Language::en).find("without the smoke it would be") ==
        std::string::npos);
}

}  // namespace luxodus
