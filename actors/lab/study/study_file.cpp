#include "actors/lab/study/study_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "actors/cast/process/planned_nodes.hpp"
#include "actors/lab/study/results.hpp"
#include "actors/lab/study/study_schema.hpp"
#include "runtime/core/printable.hpp"
#include "runtime/core/regular_file.hpp"
#include "runtime/toml/document.hpp"
#include "runtime/toml/table_reader.hpp"
#include "runtime/toml/words.hpp"

namespace luxodus {

namespace {

using toml::Findings;
using toml::TableReader;

struct CostKey {
  const char* key;
  double SimCosts::*value;
};
constexpr std::array cost_keys{
    CostKey{"particle_ns", &SimCosts::particle_ns},
    CostKey{"ray_ns", &SimCosts::ray_ns},
    CostKey{"collision_ns", &SimCosts::collision_ns},
    CostKey{"reference_ns", &SimCosts::reference_ns},
    CostKey{"look_ns", &SimCosts::look_ns},
    CostKey{"switch_ns", &SimCosts::switch_ns},
    CostKey{"turn_ns", &SimCosts::turn_ns},
    CostKey{"build_ns", &SimCosts::build_ns},
    CostKey{"build_byte_ns", &SimCosts::build_byte_ns},
    CostKey{"lease_ns", &SimCosts::lease_ns},
    CostKey{"pack_byte_ns", &SimCosts::pack_byte_ns},
    CostKey{"count_byte_ns", &SimCosts::count_byte_ns},
    CostKey{"receive_ns", &SimCosts::receive_ns},
    CostKey{"send_ns", &SimCosts::send_ns},
    CostKey{"frame_byte_ns", &SimCosts::frame_byte_ns},
    CostKey{"wake_ns", &SimCosts::wake_ns},
    CostKey{"rest_ns", &SimCosts::rest_ns},
};

Nanoseconds span_of(double seconds_said) {
  return std::llround(seconds_said * 1e9);
}

Problems only(const Problem& problem) {
  Problems problems;
  problems.add(problem);
  return problems;
}

/// Calls `take` with each value of a sweep: a single one, or those of a list.
template <class Take>
void for_each_value(TableReader& keys, std::string_view key, const Take& take) {
  const toml::Value* said = keys.value(key);
  if (!said) return;
  const toml::List* list = said->as_list();
  if (!list) return take(*said);
  if (list->empty() || list->size() > limits::study_values)
    return keys.problem(key, fmt::format("'{}' must be one value, or a list of 1 to {}", key,
                                         limits::study_values));
  for (const toml::Value& value : *list) take(value);
}

template <class T>
void add_once(TableReader& keys, std::string_view key, std::vector<T>& values, const T& value) {
  if (std::find(values.begin(), values.end(), value) == values.end())
    values.push_back(value);
  else
    keys.problem(key, fmt::format("'{}' says {} twice", key, value));
}

StudyAxis read_axis(TableReader& keys, const toml::KeySpec& spec) {
  StudyAxis axis;
  axis.key = spec.name;
  if (spec.type == "choice sweep") {
    for_each_value(keys, spec.name, [&](const toml::Value& value) {
      if (const auto word = keys.chosen(spec.name, value))
        add_once(keys, spec.name, axis.words, *word);
    });
    if (axis.words.empty()) axis.words.push_back(keys.default_text(spec.name).value());
    return axis;
  }
  for_each_value(keys, spec.name, [&](const toml::Value& value) {
    if (spec.type == "integer sweep" && !value.as_integer())
      return keys.problem(
          spec.name, fmt::format("'{}' must be whole numbers, not {}", spec.name, value.kind()));
    if (const auto number = keys.checked(spec.name, value))
      add_once(keys, spec.name, axis.numbers, *number);
  });
  if (axis.numbers.empty()) axis.numbers.push_back(keys.some_number(spec.name));
  return axis;
}

const std::vector<double>& values_of(const std::vector<StudyAxis>& axes, std::string_view key) {
  return std::find_if(axes.begin(), axes.end(), [&](auto& axis) { return axis.key == key; })
      ->numbers;
}

/// Every point must be able to run: a study takes hours, and would fail only at its end.
void check_coordination(TableReader& keys, const std::vector<StudyAxis>& axes) {
  for (const double nodes : values_of(axes, "nodes"))
    for (const double fan_out : values_of(axes, "fan_out"))
      for (const double shards : values_of(axes, "tally_shards"))
        if (const auto fault = coordination_fault(
                static_cast<int>(nodes), static_cast<uint32_t>(fan_out), static_cast<int>(shards)))
          return keys.problem(
              fault->option,
              fmt::format("no run has nodes = {}, fan_out = {} and tally_shards = {}: {}", nodes,
                          fan_out, shards, fault->what));
}

std::vector<StudyAxis> read_axes(TableReader& top) {
  TableReader keys = top.inner("sweep", {"sweep"});
  std::vector<StudyAxis> axes;
  for (const toml::KeySpec& spec : study_schema().table("sweep").keys)
    axes.push_back(read_axis(keys, spec));
  if (keys.clean()) check_coordination(keys, axes);
  return axes;
}

template <class Names>
void check_known(TableReader& keys, std::string_view key, const std::string& said,
                 const Names& known, std::string_view what) {
  if (said.empty() || std::find(known.begin(), known.end(), said) != known.end()) return;
  std::string text = fmt::format("'{}' is \"{}\", which is no {}", key, excerpt(said), what);
  if (const auto near = toml::nearest_word(said, known)) {
    text += fmt::format("; did you mean \"{}\"?", *near);
  } else {
    text += "; known here:";
    for (const auto name : known) text += fmt::format(" {}", name);
  }
  keys.problem(key, std::move(text));
}

StudyPlot read_plot(TableReader& keys) {
  StudyPlot plot;
  plot.name = keys.text("name");
  plot.title = keys.text("title");
  plot.x = keys.text("x");
  plot.y = keys.text("y");
  plot.log_x = keys.flag("log_x");
  plot.log_y = keys.flag("log_y");
  plot.explain = keys.text("explain");
  std::vector<std::string_view> axes, columns;
  for (const toml::KeySpec& spec : study_schema().table("sweep").keys)
    if (spec.type != "choice sweep") axes.push_back(spec.name);
  for (const StudyColumn& column : study_columns()) columns.push_back(column.name);
  check_known(keys, "x", plot.x, axes, "key of [sweep] that has numbers");
  check_known(keys, "y", plot.y, columns, "column of the results");
  return plot;
}

void read_plots(TableReader& top, Study& study, Findings& findings) {
  for (const toml::Table* table : top.tables("plot", limits::study_plots)) {
    TableReader keys(*table, study_schema(), {"plot"}, findings);
    StudyPlot plot = read_plot(keys);
    const auto same = [&](const StudyPlot& other) { return other.name == plot.name; };
    if (std::any_of(study.plots.begin(), study.plots.end(), same))
      keys.problem("name", fmt::format("there are two plots \"{}\"", plot.name));
    const auto is_x = [&](const StudyAxis& axis) { return axis.key == plot.x; };
    const auto x = std::find_if(study.axes.begin(), study.axes.end(), is_x);
    if (x != study.axes.end() && x->size() < 2)
      keys.problem("x", fmt::format("'{}' has one value: a plot needs two at least", plot.x));
    study.plots.push_back(std::move(plot));
  }
}

size_t runs_of(const Study& study) {
  double runs = study.seeds;
  for (const StudyAxis& axis : study.axes) runs *= static_cast<double>(axis.size());
  return static_cast<size_t>(std::min(runs, 1e15));
}

void read_top(const toml::Table& table, Study& study, Findings& findings) {
  TableReader top(table, study_schema(), {"study"}, findings);
  study.title = top.text("title");
  study.question = top.text("question");
  study.scene = top.path("scene");
  study.scenario = top.text("scenario");
  study.whole_tally = top.choice("tally") == "scene";
  study.costs = top.path("costs");
  study.seeds = static_cast<int>(top.integer("seeds"));
  study.first_seed = static_cast<uint64_t>(top.integer("first_seed"));
  study.cores = static_cast<uint32_t>(top.integer("cores"));
  study.jitter = span_of(1e-3 * top.number("jitter_ms"));
  study.crash_for = span_of(top.number("crash_for_s"));
  study.axes = read_axes(top);
  read_plots(top, study, findings);
  const auto& on = study.axis("on").words;
  const bool simulates = std::any_of(on.begin(), on.end(), [](auto& w) { return !is_real(w); });
  if (simulates && study.costs.empty() && !top.has("costs"))
    top.problem("simulated runs need 'costs', a file of `luxodus study calibrate`");
  if (runs_of(study) > limits::study_runs)
    top.problem("sweep", fmt::format("these are {} runs; at most {} are allowed: vary less at once",
                                     runs_of(study), limits::study_runs));
}

}  // namespace

// ---- studies -----------------------------------------------------------------------------------

std::string StudyAxis::text(size_t value) const {
  return of_words() ? words[value] : fmt::format("{}", numbers[value]);
}

const StudyAxis& Study::axis(std::string_view key) const {
  const auto at =
      std::find_if(axes.begin(), axes.end(), [&](auto& axis) { return axis.key == key; });
  if (at == axes.end()) throw std::logic_error("no axis '" + std::string(key) + "' in a study");
  return *at;
}

double Study::number(const StudyPoint& point, std::string_view key) const {
  const StudyAxis& of = axis(key);
  return of.numbers[point.values[static_cast<size_t>(&of - axes.data())]];
}

int64_t Study::whole(const StudyPoint& point, std::string_view key) const {
  return std::llround(number(point, key));
}

const std::string& Study::word(const StudyPoint& point, std::string_view key) const {
  const StudyAxis& of = axis(key);
  return of.words[point.values[static_cast<size_t>(&of - axes.data())]];
}

std::vector<const StudyAxis*> Study::varied() const {
  std::vector<const StudyAxis*> out;
  for (const StudyAxis& axis : axes)
    if (axis.size() > 1) out.push_back(&axis);
  return out;
}

std::vector<StudyPoint> Study::points() const {
  std::vector<StudyPoint> out;
  StudyPoint point{std::vector<size_t>(axes.size(), 0)};
  for (;;) {
    out.push_back(point);
    size_t axis = axes.size();
    while (axis > 0 && ++point.values[axis - 1] == axes[axis - 1].size()) point.values[--axis] = 0;
    if (axis == 0) return out;
  }
}

ReadStudy parse_study(std::string_view text, const std::filesystem::path& file) {
  const auto document = toml::parse(text, file.string(), limits::study_file_bytes);
  if (!document) return {std::nullopt, only(document.problem()), {}};
  Study study;
  study.file = file;
  Findings findings;
  read_top(document->top, study, findings);
  if (findings.any_problem()) return {std::nullopt, findings.take_problems(), {}};
  return {std::move(study), {}, findings.take_warnings()};
}

ReadStudy read_study(const std::filesystem::path& file) {
  const auto text = read_regular_file(file, limits::study_file_bytes);
  if (!text) return {std::nullopt, only(text.problem()), {}};
  return parse_study(text.value(), file);
}

// ---- costs -------------------------------------------------------------------------------------

ReadCosts read_costs(const std::filesystem::path& file) {
  const auto text = read_regular_file(file, limits::study_file_bytes);
  if (!text) return {std::nullopt, only(text.problem())};
  const auto document = toml::parse(text.value(), file.string(), limits::study_file_bytes);
  if (!document) return {std::nullopt, only(document.problem())};
  Findings findings;
  TableReader keys(document->top, study_schema(), {"costs"}, findings);
  MeasuredCosts measured;
  for (const CostKey& cost : cost_keys) measured.costs.*cost.value = keys.number(cost.key);
  measured.machine = keys.text("machine");
  measured.scene = keys.text("scene");
  if (findings.any_problem()) return {std::nullopt, findings.take_problems()};
  return {std::move(measured), {}};
}

std::string costs_text(const MeasuredCosts& measured) {
  std::string text = "# What work costs, measured by `luxodus study calibrate`.\n";
  text += fmt::format("machine = \"{}\"\nscene = \"{}\"\n", measured.machine, measured.scene);
  for (const CostKey& cost : cost_keys)
    text += fmt::format("{} = {}\n", cost.key, measured.costs.*cost.value);
  return text;
}

}  // namespace luxodus
