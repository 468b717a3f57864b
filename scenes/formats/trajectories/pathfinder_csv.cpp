// CSV of Pathfinder's detailed output of occupants: a line of names, a line of units, and one row
// for each occupant and time. Rows of occupants that are not active - they have left, or are not
// there yet - are skipped. z is the height of the floor.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "runtime/core/printable.hpp"
#include "runtime/core/text.hpp"
#include "scenes/formats/trajectories/trajectory_rows.hpp"

namespace luxodus {

namespace {

constexpr size_t max_cells = 256;
constexpr double metres_per_foot = 0.3048;

/// The cells of a line; quotes around a cell are taken away, and a comma within them is none.
std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> out;
  bool quoted = false;
  size_t from = 0;
  for (size_t i = 0; i <= line.size() && out.size() < max_cells; ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i < line.size() && (quoted || line[i] != ',')) continue;
    out.push_back(trimmed(line.substr(from, i - from), " \t\r\""));
    from = i + 1;
  }
  return out;
}

/// Numbers of the columns that are read.
struct Columns {
  std::optional<size_t> t, id, x, y, z, active;
  double metres = 1;  // per unit of x, y and z
};

Result<Columns> columns_of(std::string_view line, const std::string& file) {
  Columns out;
  const auto names = cells_of(line);
  for (size_t i = 0; i < names.size(); ++i)
    for (const auto& [name, at] : {std::pair{"t", &out.t},
                                   {"id", &out.id},
                                   {"x", &out.x},
                                   {"y", &out.y},
                                   {"z", &out.z},
                                   {"active", &out.active}})
      if (names[i] == name) *at = i;
  for (const auto& [name, at] :
       {std::pair{"t", out.t}, {"id", out.id}, {"x", out.x}, {"y", out.y}, {"z", out.z}})
    if (!at)
      return problem_in(file, 1,
                        fmt::format("there is no column \"{}\" in \"{}\": the CSV of Pathfinder "
                                    "has the columns t, id, x, y and z",
                                    name, excerpt(line)));
  return out;
}

Result<void> read_units(std::string_view line, const std::string& file, Columns& columns) {
  const auto units = cells_of(line);
  std::optional<std::string_view> length;
  for (const auto at : {columns.x, columns.y, columns.z}) {
    const std::string_view unit = *at < units.size() ? trimmed(units[*at], "()[] ") : "";
    if ((unit != "m" && unit != "ft") || (length && *length != unit))
      return problem_in(file, 2,
                        fmt::format("\"{}\" is no line of units: x, y and z are all in m, or all "
                                    "in ft",
                                    excerpt(line)));
    length = unit;
  }
  columns.metres = *length == "ft" ? metres_per_foot : 1;
  return {};
}

/// A row; none where the occupant is not active.
Result<std::optional<TrajectoryRow>> row_of_csv(std::string_view line, const std::string& file,
                                                int number, const Columns& columns) {
  const auto cells = cells_of(line);
  const auto cell = [&](size_t at) { return at < cells.size() ? cells[at] : std::string_view(); };
  if (columns.active) {
    const std::string_view active = cell(*columns.active);
    if (active == "0" || active == "false" || active == "FALSE")
      return std::optional<TrajectoryRow>();
  }
  const auto id = whole_of(cell(*columns.id));
  const auto t = decimal_of(cell(*columns.t));
  const auto x = decimal_of(cell(*columns.x)), y = decimal_of(cell(*columns.y)),
             z = decimal_of(cell(*columns.z));
  if (!id || !t || !x || !y || !z)
    return problem_in(
        file, number,
        fmt::format("\"{}\" is no row: t, id, x, y and z have to be numbers", excerpt(line)));
  return std::optional<TrajectoryRow>({.id = *id,
                                       .time_s = *t,
                                       .place = glm::dvec3(*x, *y, *z) * columns.metres,
                                       .facing = glm::dvec2(0)});
}

}  // namespace

Result<Trajectories> pathfinder_csv_trajectories(std::string_view bytes, const std::string& file) {
  TrajectoryRows rows(file, TrajectoryRows::Order::ascending);
  Columns columns;
  for (int number = 1; !bytes.empty(); ++number) {
    const size_t end = std::min(bytes.find('\n'), bytes.size());
    const std::string_view line = trimmed(bytes.substr(0, end));
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
    if (number == 1) {
      const auto named = columns_of(line, file);
      if (!named) return named.problem();
      columns = named.value();
    } else if (number == 2) {
      if (auto ok = read_units(line, file, columns); !ok) return ok.problem();
    } else if (!line.empty()) {
      const auto row = row_of_csv(line, file, number, columns);
      if (!row) return row.problem();
      if (!row.value()) continue;
      if (auto ok = rows.add(*row.value(), number); !ok) return ok.problem();
    }
  }
  return rows.people_of(
      {.form = "CSV of Pathfinder", .has_heights = true, .fps = std::nullopt, .people = {}});
}

}  // namespace luxodus
