// The verdict on the whole in words, which a report shows first.
#include "actors/judge/report/page.hpp"

namespace luxodus {

namespace {

std::string range_text(const Texts& t, double low, double high) {
  const std::string from = t.number(low), to = t.number(high);
  return from == to ? t.say("headline.extinction", from) : t.say("headline.extinctions", from, to);
}

/// "\"fire\", emergency operation, 60 s after the failure, in smoke of 0.2/m to 0.8/m"
std::string judged_text(const Texts& t, const StateRecord& state) {
  const std::string operation = t.word("operation", name_of(state.operation));
  std::string out = t.say("headline.state", state.scenario, operation);
  if (state.seconds_after_failure)
    out += t.say("headline.seconds", t.number(*state.seconds_after_failure, 6));
  if (!state.smoke) return out + t("headline.clear");
  const ExtinctionRecord& all = state.smoke->extinction;
  if (all.max == 0) return out + t("headline.smoke_elsewhere");
  const std::string range = range_text(t, all.min, all.max);
  out += t.say("headline.smoke", range);
  const auto& lines = state.smoke->on_lines;
  if (!lines) return out;
  if (lines->max == 0) return out + t("headline.no_smoke_on_lines");
  const std::string on_lines = range_text(t, lines->min, lines->max);
  return on_lines == range ? out : out + t.say("headline.smoke_on_lines", on_lines);
}

}  // namespace

std::string verdict_words(const Texts& t, const CountsRecord& counts) {
  const size_t fails = counts.fail, unverified = counts.not_verified;
  std::string out = fails + unverified + counts.pass == 0 ? t("verdict.none_made")
                    : fails == 0                          ? t("verdict.none_fails")
                    : fails == 1                          ? t("verdict.one_fails")
                                                          : t.say("verdict.some_fail", fails);
  const auto add = [&](const char* one, const char* many, size_t times) {
    out += ", " + t.say(times < 2 ? one : many, times);
  };
  add("verdict.unassessed_one", "verdict.unassessed", counts.not_assessed);
  if (unverified > 0) add("verdict.unverified_one", "verdict.unverified", unverified);
  return out;
}

std::string headline(const Texts& t, const AssessmentRecord& a) {
  std::string rules;
  for (const RulesRecord& rule : a.state.rules)
    rules += (rules.empty() ? "" : t("headline.and")) + rule.edition;
  std::string out =
      t.say("headline.by", judged_text(t, a.state), rules, verdict_words(t, a.verdict.counts));
  size_t all = 0, legible = 0;
  for (const auto& [verdict, times] : a.sight_counts) {
    all += times;
    if (verdict == name_of(SightVerdict::legible)) legible = times;
  }
  return out + (all == 0 ? t("headline.no_views") : t.say("headline.views", legible, all));
}

}  // namespace luxodus
