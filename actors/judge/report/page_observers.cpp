// What a report says of light at the eyes, and of measured experiments with people, beside its
// verdicts on signs.
#include <algorithm>
#include <limits>
#include <map>

#include "actors/judge/report/page.hpp"

namespace luxodus {

namespace {

/// Smallest and largest of a value over the views.
struct Span {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

std::string light_at_eyes(const Texts& t, const AssessmentRecord& a) {
  Span smoky, clear;
  for (const SightRecord& sight : a.sights) {
    if (!sight.seen) continue;
    smoky.add(sight.seen->eye_light.lux);
    clear.add(sight.seen->eye_light.clear_air_lux);
  }
  if (!a.state.smoke || !(clear.high > 0)) return "";
  return paragraph(t.say("sights.eye_light", t.number(smoky.low), t.number(smoky.high),
                         t.number(clear.low), t.number(clear.high)));
}

std::string against_people(const Texts& t, const AssessmentRecord& a) {
  std::map<MeanObserver, size_t> reading;
  std::map<Untested, size_t> reasons;
  size_t views = 0;
  for (const SightRecord& sight : a.sights) {
    if (!sight.seen) continue;
    ++views;
    const StandingRecord& read = sight.seen->experiments.read;
    ++reading[read.observer];
    if (read.observer == MeanObserver::not_known) ++reasons[read.untested];
  }
  if (views == 0) return "";
  std::string why;
  for (const auto& [reason, count] : reasons)
    why += (why.empty() ? "" : ", ") +
           t.say("observer.because", t.word("untested", name_of(reason)), count);
  const size_t known = views - reading[MeanObserver::not_known];
  std::string out = t.say("observer.known", known, views);
  if (known > 0)
    out += " " + t.say("observer.read", reading[MeanObserver::yes], reading[MeanObserver::between],
                       reading[MeanObserver::no]);
  if (!why.empty()) out += " " + t.say("observer.not_known", why);
  return paragraph(out, "note");
}

}  // namespace

std::string observers_note(const PageParts& parts) {
  return light_at_eyes(parts.texts, parts.a) + against_people(parts.texts, parts.a);
}

}  // namespace luxodus
