// The verdict on the whole in words, which a report shows first.
#include "actors/judge/report/page.hpp"

namespace luxodus {

namespace {

std::string range_text(const Texts& t, const Json& extinction) {
  const double low = extinction["min"].get<double>(), high = extinction["max"].get<double>();
  return low == high ? t.say("headline.extinction", t.number(low))
                     : t.say("headline.extinctions", t.number(low), t.number(high));
}

/// "\"fire\", emergency operation, 60 s after the failure, in smoke of 0.2/m to 0.8/m"
std::string judged_text(const Texts& t, const Json& state) {
  const std::string operation = t.word("operation", text_in(state, "operation"));
  std::string out = t.say("headline.state", text_in(state, "scenario"), operation);
  if (const Json& seconds = state["seconds_after_failure"]; seconds.is_object())
    out += t.say("headline.seconds", t.number(seconds["value"].get<double>(), 6));
  const Json& smoke = state["smoke"];
  if (!smoke.is_object() || !smoke["extinction"].is_object()) return out + t("headline.clear");
  return out + t.say("headline.smoke", range_text(t, smoke["extinction"]));
}

}  // namespace

std::string verdict_words(const Texts& t, const Json& a) {
  const Json& v = a["verdict"];
  const auto count = [&](const char* key) { return v[key].get<int64_t>(); };
  const auto fails = count("fail"), unverified = count("not_verified");
  std::string out = fails + unverified + count("pass") == 0 ? t("verdict.none_made")
                    : fails == 0                            ? t("verdict.none_fails")
                    : fails == 1                            ? t("verdict.one_fails")
                                                            : t.say("verdict.some_fail", fails);
  const auto add = [&](const char* one, const char* many, int64_t times) {
    out += ", " + t.say(times < 2 ? one : many, times);
  };
  add("verdict.unassessed_one", "verdict.unassessed", count("not_assessed"));
  if (unverified > 0) add("verdict.unverified_one", "verdict.unverified", unverified);
  return out;
}

std::string headline(const Texts& t, const Json& a) {
  std::string rules;
  for (const Json& rule : a["state"]["rules"])
    rules += (rules.empty() ? "" : t("headline.and")) + text_in(rule, "edition");
  std::string out = t.say("headline.by", judged_text(t, a["state"]), rules, verdict_words(t, a));
  int64_t all = 0, legible = 0;
  for (const auto& [verdict, times] : a["sight_counts"].items()) {
    all += times.get<int64_t>();
    if (verdict == "legible") legible = times.get<int64_t>();
  }
  return out + (all == 0 ? t("headline.no_views") : t.say("headline.views", legible, all));
}

}  // namespace luxodus
