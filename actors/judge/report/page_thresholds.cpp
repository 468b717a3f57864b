// Values at which signs are just read and just seen, as a table of the report.
#include <algorithm>

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
  for (const ThresholdRange& read : ranges) {
    if (!read.read) continue;
    const auto seen = std::find_if(ranges.begin(), ranges.end(), [&](const ThresholdRange& one) {
      return !one.read && one.sought == read.sought && one.sign == read.sign;
    });
    rows += "<tr>" + html_cell(escaped(t(std::string("thresholds.of.") + name_of(read.sought)))) +
            html_cell(escaped(read.sign)) + html_cell(escaped(range_text(t, read))) +
            html_cell(seen == ranges.end() ? "" : escaped(range_text(t, *seen))) + "</tr>\n";
  }
  std::string head;
  for (const char* key :
       {"thresholds.quantity", "column.sign", "thresholds.read", "thresholds.seen"})
    head += "<th>" + escaped(t(key)) + "</th>";
  return subheading(t("thresholds.heading")) + paragraph(t("thresholds.lead")) +
         "<table>\n<thead><tr>" + head + "</tr></thead>\n<tbody>\n" + rows + "</tbody>\n</table>\n";
}

}  // namespace luxodus
