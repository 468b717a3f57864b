#include "actors/judge/visibility_map/map_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "actors/results/formats/csv.hpp"
#include "actors/results/formats/npz.hpp"
#include "actors/results/formats/write_vtk.hpp"

namespace luxodus {

namespace {

/// Distance of the times of an interval from its ends, as a share of the shortest interval. The
/// nearest of all times then changes exactly at the times of the states. At the first state two
/// would be equally near, and the earlier one counts: the time before it is a trifle farther away.
constexpr double off_ends = 0.25, trifle_farther = 1 + 1e-6;

/// Centres of cells, with one more at each end.
std::vector<double> with_border(size_t count, double spacing_m, const auto& at) {
  std::vector<double> out{at(0) - spacing_m};
  for (size_t i = 0; i < count; ++i) out.push_back(at(i));
  out.push_back(out.back() + spacing_m);
  return out;
}

/// A time, and the states between which it lies; none: nothing is known.
struct Between {
  double time_s;
  std::vector<size_t> states;
};

std::vector<Between> intervals_of(const VisibilityMap& map) {
  const std::vector<double>& times = map.times_s;
  if (times.empty()) return {{0, {0}}};
  double shortest = 1;
  for (size_t i = 0; i + 1 < times.size(); ++i)
    shortest = i == 0 ? times[1] - times[0] : std::min(shortest, times[i + 1] - times[i]);
  const double off = off_ends * shortest;
  std::vector<Between> out{{times.front() - off * trifle_farther, {}}};
  if (times.size() == 1) out.push_back({times.front(), {0}});
  for (size_t i = 0; i + 1 < times.size(); ++i) {
    out.push_back({times[i] + off, {i, i + 1}});
    out.push_back({times[i + 1] - off, {i, i + 1}});
  }
  out.push_back({times.back() + off, {}});
  return out;
}

std::string answers_as_bytes(const VisibilityMap& map) {
  std::string out;
  out.reserve(map.answers.size());
  for (const SignAnswer answer : map.answers) out += static_cast<char>(answer);
  return out;
}

/// Which signs are ahead of whom: [facing][sign][row][column].
std::vector<char> ahead_of(const VisibilityMap& map) {
  std::vector<char> out;
  for (const double facing : map.facings_deg)
    for (const glm::dvec3& sign : map.sign_places)
      for (size_t row = 0; row < map.grid.rows; ++row)
        for (size_t column = 0; column < map.grid.columns; ++column)
          out.push_back(is_in_view(facing, {map.grid.x(column), map.grid.y(row)}, sign) ? 1 : 0);
  return out;
}

std::vector<double> centres(size_t count, const auto& at) {
  std::vector<double> out;
  for (size_t i = 0; i < count; ++i) out.push_back(at(i));
  return out;
}

std::string answer_words() {
  std::string out;
  for (size_t a = 0; a < sign_answers; ++a)
    out += fmt::format("{}{} {}", a == 0 ? "" : ", ", a, name_of(static_cast<SignAnswer>(a)));
  return out;
}

Result<std::string> whole_map(const VisibilityMap& map) {
  const MapGrid& grid = map.grid;
  const std::vector<size_t> shape{map.heights_m.size(), map.states(), map.signs.size(), grid.rows,
                                  grid.columns};
  return npz_of(
      {npy_texts("signs", map.signs), npy_numbers("heights_m", map.heights_m),
       npy_numbers("floor_m", {map.floor_m}),
       npy_numbers("time_points", map.times_s.empty() ? std::vector<double>{0} : map.times_s),
       npy_numbers("x_coords", centres(grid.columns, [&](size_t i) { return grid.x(i); })),
       npy_numbers("y_coords", centres(grid.rows, [&](size_t i) { return grid.y(i); })),
       npy_numbers("facing_deg", map.facings_deg),
       npy_truths("ahead", {map.facings_deg.size(), map.signs.size(), grid.rows, grid.columns},
                  ahead_of(map)),
       npy_bytes("answers", shape, answers_as_bytes(map)),
       npy_truths("surely_seen", shape, map.surely_seen),
       npy_text("answer_words", answer_words())});
}

CsvTable map_csv(const VisibilityMap& map) {
  std::vector<std::string> columns{"time_s", "height_m", "x_m", "y_m"};
  columns.insert(columns.end(), map.signs.begin(), map.signs.end());
  CsvTable table(columns);
  for (size_t state = 0; state < map.states(); ++state)
    for (size_t height = 0; height < map.heights_m.size(); ++height)
      for (size_t row = 0; row < map.grid.rows; ++row)
        for (size_t column = 0; column < map.grid.columns; ++column) {
          const size_t place = row * map.grid.columns + column;
          const auto answer = [&](size_t sign) {
            return map.answers[map.table(height, state, sign) + place];
          };
          bool any = false;
          for (size_t s = 0; s < map.signs.size(); ++s) any |= answer(s) != SignAnswer::hidden;
          if (!any) continue;
          if (map.times_s.empty())
            table.empty_cell();
          else
            table.cell(map.times_s[state]);
          table.cells(map.heights_m[height], map.grid.x(column), map.grid.y(row));
          for (size_t s = 0; s < map.signs.size(); ++s) table.cell(name_of(answer(s)));
          table.end_row();
        }
  return table;
}

/// A name without blanks and brackets, unique among those before it.
std::string array_name(const std::string& sign, std::set<std::string>& taken) {
  std::string out = sign;
  for (char& c : out)
    if (c == ' ' || c == '[' || c == ']' || c == '\t') c = '_';
  while (!taken.insert(out).second) out += '_';
  return out;
}

/// Thickness of the only layer of a volume, whose middle is at the eyes [m].
constexpr double layer_m = 0.1;

/// One layer of cells at an eye height: heights may be unevenly spaced, and layers may not.
VtkVolume volume_of(const VisibilityMap& map, size_t state, size_t height) {
  VtkVolume out;
  const MapGrid& grid = map.grid;
  out.comment =
      fmt::format("signs: {}; eyes {:g} m above the floor", answer_words(), map.heights_m[height]);
  out.origin = {grid.low.x, grid.low.y, map.floor_m + map.heights_m[height] - layer_m / 2};
  out.spacing = {grid.spacing_m, grid.spacing_m, layer_m};
  out.cells = {static_cast<int>(grid.columns), static_cast<int>(grid.rows), 1};
  std::set<std::string> taken;
  for (size_t s = 0; s < map.signs.size(); ++s) {
    std::vector<int32_t> values;
    const size_t begin = map.table(height, state, s);
    for (size_t place = 0; place < grid.places(); ++place)
      values.push_back(static_cast<int32_t>(map.answers[begin + place]));
    out.cell_data.push_back({array_name(map.signs[s], taken), 1, std::move(values)});
  }
  return out;
}

}  // namespace

EvacTable evac_table(const VisibilityMap& map, size_t height, const std::vector<EvacSign>& signs) {
  const MapGrid& grid = map.grid;
  EvacTable out;
  out.x_m = with_border(grid.columns, grid.spacing_m, [&](size_t i) { return grid.x(i); });
  out.y_m = with_border(grid.rows, grid.spacing_m, [&](size_t i) { return grid.y(i); });
  const std::vector<Between> intervals = intervals_of(map);
  out.read.assign(intervals.size() * signs.size() * out.y_m.size() * out.x_m.size(), 0);
  out.seen = out.read;
  size_t first = 0;  // of the sign's table at that time
  for (const Between& between : intervals) {
    out.times_s.push_back(between.time_s);
    for (const EvacSign& sign : signs) {
      for (size_t place = 0; !between.states.empty() && place < grid.places(); ++place) {
        bool read = true, seen = true;
        for (const size_t state : between.states) {
          const size_t cell = map.table(height, state, sign.sign) + place;
          read &= map.answers[cell] == SignAnswer::read;
          seen &= map.surely_seen[cell] != 0;
        }
        const size_t at =
            first + (place / grid.columns + 1) * out.x_m.size() + place % grid.columns + 1;
        out.read[at] = read ? 1 : 0;
        out.seen[at] = seen ? 1 : 0;
      }
      first += out.y_m.size() * out.x_m.size();
    }
  }
  return out;
}

Result<void> write_map(const std::filesystem::path& folder, const VisibilityMap& map,
                       const std::vector<EvacSign>& signs, const Json& meta) {
  std::error_code failed;
  std::filesystem::create_directories(folder / map_states_folder, failed);
  if (failed)
    return system_problem(folder / map_states_folder, "cannot make this folder", failed.value());
  for (size_t height = 0; height < map.heights_m.size(); ++height) {
    EvacTable table = evac_table(map, height, signs);
    const std::vector<size_t> shape{table.times_s.size(), signs.size(), table.y_m.size(),
                                    table.x_m.size()};
    std::vector<NpyArray> arrays{npy_numbers("time_points", table.times_s),
                                 npy_numbers("x_coords", table.x_m),
                                 npy_numbers("y_coords", table.y_m)};
    arrays.push_back(npy_truths("vis", shape, std::exchange(table.read, {})));
    arrays.push_back(npy_truths("seen", shape, std::exchange(table.seen, {})));
    arrays.push_back(npy_text("meta", meta.dump()));
    const auto bytes = npz_of(std::move(arrays));
    if (!bytes) return bytes.problem();
    const std::string name = height == 0 ? evac_map_file
                                         : fmt::format("{}/visibility_{:g}m.npz", map_states_folder,
                                                       map.heights_m[height]);
    if (auto ok = write_file_atomically(folder / name, bytes.value()); !ok) return ok;
  }
  const auto whole = whole_map(map);
  if (!whole) return whole.problem();
  if (auto ok = write_file_atomically(folder / whole_map_file, whole.value()); !ok) return ok;
  if (auto ok = write_csv(folder / map_table_file, map_csv(map)); !ok) return ok;
  for (size_t state = 0; state < map.states(); ++state)
    for (size_t height = 0; height < map.heights_m.size(); ++height) {
      const auto file = folder / map_states_folder /
                        fmt::format("state_{:04}_{:g}m.vti", state, map.heights_m[height]);
      if (auto ok = write_vti(file, volume_of(map, state, height)); !ok) return ok;
    }
  return {};
}

}  // namespace luxodus
