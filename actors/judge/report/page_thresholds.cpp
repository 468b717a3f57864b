// Values at which signs are just read and just seen, as a table of the report.
#include "actors/judge/record/threshold_record.hpp"
#include "actors/judge/report/page.hpp"

namespace luxodus {

namespace {

/// "at least 0.4 … 1.9 (9); always (2)".
std::string range_text(const Texts& t, const ThresholdRange& range) {
  std::string out;
  const auto add = [&](const std::string& part) { out += (out.empty() ? "" : "; ") + part; };
  const std::string low = t.number(range.low), high = t.number(range.high);
  if (range.found > 0)
    add(t.say(range.above ? "thresholds.from" : "thresholds.up_to",
              low == high ? low : low + " … " + high, range.found));
  if (range.always > 0) add(t.say("thresholds.always", range.always));
  if (range.never > 0) add(t.say("thresholds.never", range.never));
  if (range.not_assessed > 0) add(t.say("thresholds.not_assessed", range.not_assessed));
  return out;
}

}  // namespace

std::string thresholds_table(const PageParts& parts) {
  const Texts& t = parts.texts;
  const auto ranges = ranges_of(parts.a.thresholds);
  if (ranges.empty()) return "";
  std::string rows;
  for (const ThresholdRange& range : ranges)
    rows += "<tr>" + html_cell(escaped(t(std::string("thresholds.of.") + name_of(range.sought)))) +
            html_cell(escaped(range.sign)) +
            html_cell(escaped(t(range.read ? "thresholds.read" : "thresholds.seen"))) +
            html_cell(escaped(range_text(t, range))) + "</tr>\n";
  return subheading(t("thresholds.heading")) + paragraph(t("thresholds.lead")) +
         "<table>\n<thead><tr><th>" + escaped(t("thresholds.quantity")) + "</th><th>" +
         escaped(t("column.sign")) + "</th><th></th><th>" + escaped(t("thresholds.values")) +
         "</th></tr></thead>\n<tbody>\n" + rows + "</tbody>\n</table>\n";
}

}  // namespace luxodus
