#include "scenes/formats/fields/fds_sources.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "runtime/core/printable.hpp"
#include "scenes/formats/fields/fds_between.hpp"

namespace luxodus::fds {

namespace {

/// Soot of flaming fires at 633 nm [m2/kg]; the default of FDS.
constexpr double usual_mass_extinction = 8700;
/// How late a frame may be: FDS writes at the first of its steps after a tick.
constexpr double step_of_fds_s = 0.1;
/// Steps differ by as much, because FDS writes at the first of its steps after a tick.
constexpr double uneven_steps = 1.02;

bool covers(const Mesh& mesh, const NodeBox& nodes) {
  return nodes.low == glm::ivec3(0) && nodes.high == mesh.cells;
}

template <class List, class Fits>
const typename List::value_type* first_of(const List& list, const Fits& fits) {
  const auto at = std::find_if(list.begin(), list.end(), fits);
  return at == list.end() ? nullptr : &*at;
}

/// Frames of an output in all PLOT3D files of a mesh.
Result<FrameFiles> plots_of(const Case& fire, size_t mesh, const Output& output) {
  FrameFiles out;
  for (const Plot3d& plot : fire.plots) {
    if (plot.mesh != mesh) continue;
    const auto at = std::find(plot.outputs.begin(), plot.outputs.end(), output);
    if (at == plot.outputs.end()) continue;
    auto one = open_plot3d(fire, plot, static_cast<size_t>(at - plot.outputs.begin()));
    if (!one) return one.problem();
    for (Frame& frame : one->frames) {
      frame.file = static_cast<uint32_t>(out.files.size());
      out.frames.push_back(frame);
    }
    out.files.push_back(plot.file);
  }
  keep_later_frames(out);
  return out;
}

Result<FrameFiles> files_of(const Case& fire, Form form, const Output& output, size_t mesh) {
  if (form == Form::plot) return plots_of(fire, mesh, output);
  if (form == Form::smoke) {
    const auto* smoke = first_of(
        fire.smoke, [&](const Smoke3d& s) { return s.mesh == mesh && s.output == output; });
    return smoke != nullptr ? open_smoke3d(fire, *smoke) : FrameFiles{};
  }
  const auto* slice = first_of(fire.slices, [&](const Slice& s) {
    return s.mesh == mesh && s.output == output && s.of_cells == (form == Form::cell_slice) &&
           covers(fire.meshes[mesh], s.nodes);
  });
  return slice != nullptr ? open_slice(fire, *slice) : FrameFiles{};
}

struct Candidate {
  FireSource source;
  Form form;
  Quantity quantity;
};

constexpr Candidate candidates[] = {
    {FireSource::cell_extinction, Form::cell_slice, Quantity::extinction},
    {FireSource::cell_extinction, Form::cell_slice, Quantity::optical_density},
    {FireSource::cell_soot, Form::cell_slice, Quantity::density},
    {FireSource::node_extinction, Form::node_slice, Quantity::extinction},
    {FireSource::node_extinction, Form::node_slice, Quantity::optical_density},
    {FireSource::node_soot, Form::node_slice, Quantity::density},
    {FireSource::plot3d, Form::plot, Quantity::extinction},
    {FireSource::plot3d, Form::plot, Quantity::optical_density},
    {FireSource::plot3d, Form::plot, Quantity::density},
    {FireSource::smoke3d, Form::smoke, Quantity::density},
};

/// Opens each series once. A series without a whole frame of each mesh has no meshes.
class SeriesShelf {
 public:
  explicit SeriesShelf(const Case& fire) : fire_(fire) {}

  Result<const Series*> open(const Candidate& c, const std::string& species) {
    const auto [at, fresh] = series_.try_emplace({c.form, c.quantity, species});
    if (!fresh) return &at->second;
    Series& out = at->second;
    out = {c.form, {c.quantity, species}, c.source, {}};
    for (size_t mesh = 0; mesh < fire_.meshes.size(); ++mesh) {
      auto files = files_of(fire_, c.form, out.output, mesh);
      if (!files) return files.problem();
      if (files->frames.empty()) {
        out.meshes.clear();
        break;
      }
      out.meshes.push_back(std::move(files.value()));
    }
    return &out;
  }

 private:
  const Case& fire_;
  std::map<std::tuple<Form, Quantity, std::string>, Series> series_;
};

/// The frame of a mesh at a tick. Requires: it has one.
const Frame& frame_at(const FrameFiles& files, double time_s) {
  return *std::min_element(files.frames.begin(), files.frames.end(),
                           [&](const Frame& a, const Frame& b) {
                             return std::abs(a.time_s - time_s) < std::abs(b.time_s - time_s);
                           });
}

/// Times of frames, each tick once.
std::vector<double> ticks_of(const FrameFiles& files) {
  std::vector<double> out;
  for (const Frame& frame : files.frames) {
    if (!out.empty() && frame.time_s <= out.back() + same_tick_s) continue;
    out.push_back(frame.time_s);
  }
  return out;
}

bool has_tick(const std::vector<double>& ticks, double time_s) {
  const auto next = std::lower_bound(ticks.begin(), ticks.end(), time_s - same_tick_s);
  return next != ticks.end() && *next <= time_s + same_tick_s;
}

/// The lower median of the times between ticks.
std::optional<double> step_of(const std::vector<double>& ticks) {
  if (ticks.size() < 2) return std::nullopt;
  std::vector<double> steps;
  for (size_t i = 1; i < ticks.size(); ++i) steps.push_back(ticks[i] - ticks[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>((steps.size() - 1) / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

/// The frame nearest to a time among those that all meshes of all series have; none where there is
/// none.
std::optional<Picked> picked(const std::vector<const Series*>& series, double at_s) {
  std::vector<std::vector<double>> ticks;
  for (const Series* one : series)
    for (const FrameFiles& files : one->meshes) ticks.push_back(ticks_of(files));
  std::vector<double> common;
  for (const double t : ticks.front())
    if (std::all_of(ticks.begin(), ticks.end(), [&](const auto& of) { return has_tick(of, t); }))
      common.push_back(t);
  if (common.empty()) return std::nullopt;
  Picked out;
  out.common = common.size();
  out.first_s = common.front();
  out.last_s = common.back();
  for (const std::vector<double>& of : ticks) {
    const auto lone = std::count_if(of.begin(), of.end(), [&](double t) {
      return t > out.first_s && t < out.last_s && !has_tick(common, t);
    });
    out.partial = std::max(out.partial, static_cast<size_t>(lone));
    // Frames that all have are as far apart as those of the series that has the fewest.
    if (const auto step = step_of(of)) out.step_s = std::max(*step, out.step_s.value_or(*step));
  }
  const auto nearest = std::min_element(common.begin(), common.end(), [&](double a, double b) {
    return std::abs(a - at_s) < std::abs(b - at_s);
  });
  out.time_s = *nearest;
  if (nearest != common.begin()) out.previous_s = *(nearest - 1);
  if (nearest + 1 != common.end()) out.next_s = *(nearest + 1);
  for (const Series* one : series) {
    std::vector<Frame>& frames = out.frames.emplace_back();
    for (const FrameFiles& files : one->meshes) frames.push_back(frame_at(files, out.time_s));
  }
  return out;
}

class SmokeChooser {
 public:
  SmokeChooser(const Case& fire, const FireOptions& options)
      : fire_(fire), options_(options), smokes_(smokes_of(fire, options)), shelf_(fire) {}

  Result<Picked> choose() {
    auto nearest = nearest_of_all();
    if (!nearest) return nearest.problem();
    if (!nearest.value()) return wrong(nothing_words());
    if (auto ok = is_in_reach(*nearest.value()); !ok) return ok.problem();
    return std::move(*nearest.value());
  }

  /// The best files, with the frame nearest to the time; none where there are none.
  Result<std::optional<Picked>> nearest_of_all() {
    if (auto ok = can_scale(); !ok) return ok.problem();
    std::optional<Picked> nearest;
    for (const Candidate& c : candidates) {
      if (!allowed(c.source)) continue;
      const auto series = series_by(c);
      if (!series) return series.problem();
      if (series->empty()) continue;
      auto found = picked(series.value(), options_.at_s);
      if (!found) continue;
      const bool near = is_near(*found);
      if (!near && nearest && distance_of(*nearest) <= distance_of(*found)) continue;
      for (const Series* one : series.value()) found->series.push_back(*one);
      nearest = std::move(found);
      if (near) break;
    }
    return nearest;
  }

 private:
  Problem wrong(std::string what) const { return problem_in(fire_.file, std::move(what)); }

  bool allowed(FireSource source) const {
    const auto& list = options_.sources;
    return list.empty() || std::find(list.begin(), list.end(), source) != list.end();
  }

  /// A stated mass extinction replaces that of one species.
  Result<void> can_scale() const {
    if (!options_.mass_extinction_m2_per_kg || smokes_.size() < 2) return {};
    return wrong(fmt::format(
        "this case has the smoke of {}, each with its own mass extinction: 'mass_extinction' is "
        "for one; leave it out",
        fmt::join(smokes_, " and ")));
  }

  /// Whether the extinction of a species can be computed from a quantity.
  bool can_convert(Quantity quantity, const std::string& species) const {
    const bool known = mass_extinction_of_fds(fire_, species).has_value();
    if (quantity == Quantity::density)
      return known || options_.mass_extinction_m2_per_kg.has_value();
    return known || !options_.mass_extinction_m2_per_kg;
  }

  /// The series of a species: of a candidate itself, else of its form, else of the best form.
  Result<const Series*> series_of(const Candidate& c, const std::string& species) {
    for (const int round : {0, 1, 2})
      for (const Candidate& other : candidates) {
        const bool fits = round == 0   ? other.form == c.form && other.quantity == c.quantity
                          : round == 1 ? other.form == c.form
                                       : true;
        if (!fits || !allowed(other.source) || !can_convert(other.quantity, species)) continue;
        auto series = shelf_.open(other, species);
        if (!series || !series.value()->meshes.empty()) return series;
      }
    return nullptr;
  }

  /// One series for each species; none where the candidate has nothing, or a species is missing.
  Result<std::vector<const Series*>> series_by(const Candidate& c) {
    bool has_own = false;
    for (const std::string& species : smokes_) {
      if (!can_convert(c.quantity, species)) continue;
      const auto own = shelf_.open(c, species);
      if (!own) return own.problem();
      has_own |= !own.value()->meshes.empty();
    }
    std::vector<const Series*> out;
    if (!has_own) return out;
    for (const std::string& species : smokes_) {
      const auto series = series_of(c, species);
      if (!series) return series.problem();
      if (series.value() != nullptr) {
        out.push_back(series.value());
        continue;
      }
      if (std::find(missing_.begin(), missing_.end(), species) == missing_.end())
        missing_.push_back(species);
      return std::vector<const Series*>();
    }
    return out;
  }

  /// Distance of a series from the time: of its nearest frame, or of the farther one of the two
  /// around the time [s].
  double distance_of(const Picked& p) const {
    const double nearest = std::abs(p.time_s - options_.at_s);
    const auto other = other_frame(p);
    return other ? std::max(nearest, std::abs(*other - options_.at_s)) : nearest;
  }

  /// Between frames: the one on the other side of the time.
  std::optional<double> other_frame(const Picked& p) const {
    if (!options_.between_frames) return std::nullopt;
    return options_.at_s > p.time_s ? p.next_s : p.previous_s;
  }

  /// Whether a series is so near to the time that no worse source is used instead. Frames that are
  /// far apart are near only at their own times.
  bool is_near(const Picked& p) const {
    if (distance_of(p) <= fire_window_s) return true;
    const auto other = other_frame(p);
    return other && std::abs(p.time_s - options_.at_s) <= step_of_fds_s &&
           is_of_frame(options_.at_s, p.time_s, *other);
  }

  /// The time lies within the results, and no frames are missing around it.
  Result<void> is_in_reach(const Picked& p) const {
    const bool beyond =
        options_.at_s > p.last_s + fire_window_s || options_.at_s < p.first_s - fire_window_s;
    const char* source = source_words(p.series.front().source);
    if (beyond)
      return wrong(
          fmt::format("there is no frame near {:g} s: whole frames of {} reach from "
                      "{:.6g} to {:.6g} s",
                      options_.at_s, source, p.first_s, p.last_s));
    const double away = std::abs(p.time_s - options_.at_s);
    if (away <= std::max(fire_window_s, uneven_steps * p.step_s.value_or(away))) return {};
    return wrong(fmt::format(
        "there is no frame near {:g} s: the nearest of {} is that of {:.6g} s, and frames usually "
        "follow each other after {:.3g} s; take a time that has one",
        options_.at_s, source, p.time_s, *p.step_s));
  }

  /// What the case lacks.
  std::string nothing_words() const {
    if (!missing_.empty())
      return fmt::format(
          "light is absorbed by {} in this case, and {} is in no {} with a whole frame of all its "
          "{} meshes: its smoke would be missing; add &SLCF XB=..., QUANTITY='EXTINCTION "
          "COEFFICIENT', SPEC_ID='{}', CELL_CENTERED=T / to the input file, with an XB that holds "
          "all meshes",
          fmt::join(smokes_, " and "), missing_.front(), wanted_words(" or "), fire_.meshes.size(),
          missing_.front());
    std::string out = fmt::format(
        "this case has no {} with a whole frame of all its {} meshes{}: wait for it where it "
        "still runs{}",
        wanted_words(", no "), fire_.meshes.size(),
        fire_.unread.empty() ? "" : "; " + fire_.unread + " are not read",
        allowed(FireSource::cell_extinction)
            ? ", or add &SLCF XB=..., QUANTITY='EXTINCTION COEFFICIENT', CELL_CENTERED=T / to "
              "its input file, with an XB that holds all meshes"
            : "");
    if (smokes_.empty() && !fire_.dense.empty())
      out += fmt::format(
          "; it has the density of {}, whose mass extinction is not in its index: if it is "
          "smoke, state its 'mass_extinction'",
          fmt::join(fire_.dense, " and "));
    return out;
  }

  std::string wanted_words(const char* between) const {
    std::string out;
    for (const Candidate& c : candidates)
      if (allowed(c.source) && out.find(source_words(c.source)) == std::string::npos)
        out += (out.empty() ? "" : between) + std::string(source_words(c.source));
    return out;
  }

  const Case& fire_;
  const FireOptions& options_;
  const std::vector<std::string> smokes_;
  SeriesShelf shelf_;
  std::vector<std::string> missing_;
};

}  // namespace

std::vector<std::string> smokes_of(const Case& fire, const FireOptions& options) {
  std::vector<std::string> out;
  const auto take = [&](const std::string& species) {
    if (std::find(out.begin(), out.end(), species) == out.end()) out.push_back(species);
  };
  const auto holds = [](const std::vector<std::string>& list, const char* species) {
    return std::find(list.begin(), list.end(), species) != list.end();
  };
  if (holds(fire.dense, soot) || holds(fire.absorbing, soot)) take(soot);
  for (const std::string& species : fire.absorbing) take(species);
  for (const auto& [species, coefficient] : fire.mass_extinction_m2_per_kg) take(species);
  if (out.empty() && options.mass_extinction_m2_per_kg && fire.dense.size() == 1) out = fire.dense;
  return out;
}

std::optional<double> mass_extinction_of_fds(const Case& fire, const std::string& species) {
  const auto at = fire.mass_extinction_m2_per_kg.find(species);
  if (at != fire.mass_extinction_m2_per_kg.end()) return at->second;
  return species == soot ? std::optional(usual_mass_extinction) : std::nullopt;
}

Result<Picked> choose_smoke(const Case& fire, const FireOptions& options) {
  return SmokeChooser(fire, options).choose();
}

Result<std::optional<double>> smoke_time_near(const Case& fire, double at_s) {
  FireOptions options;
  options.at_s = at_s;
  const auto nearest = SmokeChooser(fire, options).nearest_of_all();
  if (!nearest) return nearest.problem();
  if (!nearest.value()) return std::optional<double>();
  return std::optional(std::clamp(at_s, nearest.value()->first_s, nearest.value()->last_s));
}

Result<std::optional<Picked>> choose_heat(const Case& fire, double time_s) {
  SeriesShelf shelf(fire);
  for (const Form form : {Form::cell_slice, Form::node_slice, Form::plot, Form::smoke}) {
    const auto series = shelf.open({FireSource::cell_extinction, form, Quantity::heat_release}, "");
    if (!series) return series.problem();
    if (series.value()->meshes.empty()) continue;
    auto found = picked({series.value()}, time_s);
    if (!found || std::abs(found->time_s - time_s) > fire_window_s) continue;
    found->series.push_back(*series.value());
    return found;
  }
  return std::optional<Picked>();
}

}  // namespace luxodus::fds
