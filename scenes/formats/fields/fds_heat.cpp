#include "scenes/formats/fields/fds_heat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "scenes/formats/fields/data_set_fields.hpp"

namespace luxodus::fds {

namespace {

/// A time after the last line by less than this counts as that line [s].
constexpr double heat_window_s = 1;

/// Fields between commas, or between semicolons where DECIMAL_SPECIFIER of FDS is COMMA.
std::vector<std::string_view> fields_of(std::string_view line, char between) {
  std::vector<std::string_view> fields;
  for (size_t from = 0; from <= line.size();) {
    const size_t end = std::min(line.find(between, from), line.size());
    std::string_view field = data_set::trimmed(line.substr(from, end - from));
    if (field.size() > 1 && field.front() == '"' && field.back() == '"')
      field = field.substr(1, field.size() - 2);
    fields.push_back(field);
    from = end + 1;
  }
  return fields;
}

/// A number with a point, or with a comma where semicolons separate fields.
std::optional<double> number_of(std::string_view field, char between) {
  if (between == ',') return data_set::number_in<double>(field);
  std::string with_point(field);
  std::replace(with_point.begin(), with_point.end(), ',', '.');
  return data_set::number_in<double>(with_point);
}

struct HeatLine {
  double time_s = 0;
  double heat_kw = 0;
};

struct HeatTable {
  std::vector<HeatLine> lines;
  std::optional<BackStep> back;
};

/// The first line has units, the second the names of the columns.
Result<HeatTable> heat_table(const std::string& file, std::string_view text) {
  HeatTable out;
  size_t time_column = 0, heat_column = 0;
  char between = ',';
  for (int number = 1; !text.empty(); ++number) {
    const size_t end = text.find('\n');
    if (end == std::string_view::npos && number > 2) break;  // cut off: the run is in progress
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (number == 1 || data_set::trimmed(line).empty()) continue;
    if (number == 2 && line.find(';') != std::string_view::npos) between = ';';
    const auto fields = fields_of(line, between);
    if (number == 2) {
      const auto column = [&](std::string_view name) {
        return static_cast<size_t>(std::find(fields.begin(), fields.end(), name) - fields.begin());
      };
      time_column = column("Time");
      heat_column = column("HRR");
      if (std::max(time_column, heat_column) >= fields.size())
        return problem_in(file, number, "there are no columns Time and HRR");
      continue;
    }
    const auto at = [&](size_t column) {
      return column < fields.size() ? number_of(fields[column], between) : std::nullopt;
    };
    const auto time = at(time_column), heat = at(heat_column);
    if (!time || !heat || !std::isfinite(*time) || !std::isfinite(*heat))
      return problem_in(file, number, "the time or the heat release is no number");
    // A restarted run appends its lines behind those of the part that was abandoned.
    if (!out.back && !out.lines.empty() && *time <= out.lines.back().time_s)
      out.back = BackStep{out.lines.back().time_s, *time};
    while (!out.lines.empty() && *time <= out.lines.back().time_s) out.lines.pop_back();
    out.lines.push_back({*time, *heat});
  }
  return out;
}

}  // namespace

Result<HeatRelease> heat_release(const Case& fire, double time_s) {
  if (!fire.heat_release_file)
    return problem_in(fire.file, "the index names no _hrr.csv: the power of flames is not known");
  const std::string file = fire.heat_release_file->string();
  const auto text = read_text_within(fire, *fire.heat_release_file, limits::heat_release_bytes);
  if (!text) return text.problem();
  const auto table = heat_table(file, text.value());
  if (!table) return table.problem();
  const auto& lines = table->lines;
  const auto next = std::find_if(lines.begin(), lines.end(),
                                 [&](const HeatLine& l) { return l.time_s >= time_s; });
  if (next == lines.end()) {
    if (!lines.empty() && time_s <= lines.back().time_s + heat_window_s)
      return HeatRelease{lines.back().heat_kw, table->back};
    return problem_in(file, fmt::format("it ends at {:g} s, and {:g} s are asked for",
                                        lines.empty() ? 0 : lines.back().time_s, time_s));
  }
  if (next == lines.begin()) return HeatRelease{next->heat_kw, table->back};
  const HeatLine& before = *(next - 1);
  const double share = (time_s - before.time_s) / (next->time_s - before.time_s);
  return HeatRelease{before.heat_kw + share * (next->heat_kw - before.heat_kw), table->back};
}

}  // namespace luxodus::fds
