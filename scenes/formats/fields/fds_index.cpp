// Reads an .smv file line by line. One table maps keywords to the functions that read them; all
// others are skipped, because releases of FDS add keywords freely.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "runtime/core/printable.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/formats/fields/data_set_fields.hpp"
#include "scenes/formats/fields/fds_case.hpp"

namespace luxodus::fds {

namespace {

namespace fs = std::filesystem;
using data_set::number_in;
using data_set::trimmed;
using data_set::words_of;

/// Largest coordinate [m]; FDS writes five decimals.
constexpr double farthest_m = 1e6;
/// The SURFACE type of a vent that is open.
constexpr std::string_view open_surface = "OPEN";
/// Events are written in the order of time, but for rounding and for steps of processes [s].
constexpr double event_slack_s = 0.5;

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

/// "SOOT EXTINCTION COEFFICIENT": the species before the quantity. FDS computes extinctions of soot
/// unless a species is named.
Output output_of(std::string_view label) {
  struct Row {
    std::string_view ending;
    Quantity quantity;
  };
  // "OPTICAL DENSITY" before "DENSITY", which it ends with.
  static constexpr Row rows[] = {{"EXTINCTION COEFFICIENT", Quantity::extinction},
                                 {"OPTICAL DENSITY", Quantity::optical_density},
                                 {"VISIBILITY", Quantity::visibility},
                                 {"DENSITY", Quantity::density}};
  if (label == "HRRPUV") return {Quantity::heat_release, {}};
  for (const Row& row : rows) {
    if (!ends_with(label, row.ending)) continue;
    const std::string_view species = trimmed(label.substr(0, label.size() - row.ending.size()));
    // The density of all gases has no species.
    if (species.empty() && row.quantity == Quantity::density) return {};
    return {row.quantity, species.empty() ? std::string(soot) : excerpt(species)};
  }
  return {};
}

/// The unit that FDS writes for a quantity; "" for others.
std::string_view unit_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::extinction:
    case Quantity::optical_density:
      return "1/m";
    case Quantity::density:
      return "kg/m3";
    case Quantity::heat_release:
      return "kW/m3";
    case Quantity::visibility:
      return "m";
    case Quantity::other:
      break;
  }
  return "";
}

/// "FDS-6.11.1-138-ge06f10c-master" and "FDS6.7.6-1538-g1488ab9": 6.11 and 6.7.
std::optional<Release> release_of(std::string_view version) {
  constexpr std::string_view name = "FDS";
  if (version.substr(0, name.size()) != name) return std::nullopt;
  version.remove_prefix(name.size());
  if (!version.empty() && (version.front() == '-' || version.front() == ' '))
    version.remove_prefix(1);
  const size_t dot = version.find('.');
  if (dot == std::string_view::npos) return std::nullopt;
  const size_t end = std::min(version.find_first_not_of("0123456789", dot + 1), version.size());
  const auto major = number_in<int>(version.substr(0, dot));
  const auto minor = number_in<int>(version.substr(dot + 1, end - dot - 1));
  if (!major || !minor) return std::nullopt;
  return Release{*major, *minor};
}

class IndexReader {
 public:
  IndexReader(const fs::path& path, std::string_view text)
      : path_(path), folder_(path.parent_path()), lines_(lines_of(text)) {
    out_.file = path.string();
    out_.folder = folder_;
  }

  Result<Case> read() {
    for (at_ = 0; at_ < lines_.size() && !problem_; ++at_) {
      const std::string_view line = lines_[at_];
      if (line.empty() || data_set::is_space(line.front())) continue;
      const auto words = words_of(line);
      if (!words.empty()) keyword(words.front(), line);
    }
    if (!problem_) finish();
    if (problem_) return *problem_;
    return std::move(out_);
  }

 private:
  void keyword(std::string_view word, std::string_view line) {
    if (word == "FDSVERSION") return version();
    if (word == "HRRPUV_MINMAX") return heat_range();
    if (word == "INPF") return void(input_file_ = excerpt(trimmed(next_line())));
    if (word == "CSVF") return csv_file();
    if (word == "SURFACE") return surface();
    if (word == "SURFDEF") return void(default_surface_ = trimmed(next_line()));
    if (word == "GRID") return grid(line);
    if (word == "TRNX" || word == "TRNY" || word == "TRNZ")
      return nodes(static_cast<size_t>(word.back() - 'X'));
    if (word == "OBST") return obstructions();
    if (word == "VENT") return vents();
    if (word == "GEOM") return bodies(line);
    if (word == "SLCF" || word == "SLCC") return slice(line, word == "SLCC");
    if (word == "SLCT") return unread("terrain slices (SLCT)");
    if (word == "SMOKF3D" || word == "SMOKG3D" || word == "SMOKE3D") return smoke(line);
    if (word == "PL3D") return plot(line);
    if (word == "HIDE_OBST" || word == "SHOW_OBST") return change(line, word == "SHOW_OBST");
    if (word == "DEVICE_ACT") return device_event();
  }

  // ---- lines and numbers

  bool failed() const { return problem_.has_value(); }
  void fail(std::string what) {
    if (!problem_) problem_ = problem_in(path_.string(), static_cast<int>(at_) + 1, what);
  }

  /// The next line; "" and a problem at the end of the file.
  std::string_view next_line() {
    if (at_ + 1 >= lines_.size()) {
      fail("the file ends in the middle of what this keyword says: is it whole?");
      return {};
    }
    return lines_[++at_];
  }

  template <class T>
  T number(const std::vector<std::string_view>& words, size_t place, const char* what) {
    if (place >= words.size()) {
      fail(fmt::format("{} is missing here", what));
      return {};
    }
    const auto value = number_in<T>(words[place]);
    if (!value) {
      fail(fmt::format("{} is no number: \"{}\"", what, excerpt(words[place])));
      return {};
    }
    return *value;
  }

  double metres(const std::vector<std::string_view>& words, size_t place) {
    const auto value = number<double>(words, place, "a coordinate");
    if (!(std::abs(value) <= farthest_m)) fail("a coordinate is not finite or beyond 1000 km");
    return value;
  }

  /// The number of lines that follow: no more than the file has.
  size_t count(const std::vector<std::string_view>& words, size_t place) {
    const auto value = number<int64_t>(words, place, "the number of entries");
    if (value < 0 || value > static_cast<int64_t>(lines_.size())) {
      fail(fmt::format("{} entries are announced, the file has {} lines", value, lines_.size()));
      return 0;
    }
    return static_cast<size_t>(value);
  }

  /// The mesh of a file or an event, counted from 1 in the index. Meshes may be listed after it, so
  /// its number is checked at the end.
  size_t mesh_number(std::string_view line) {
    const auto value = number<int64_t>(words_of(line), 1, "the number of the mesh");
    if (failed()) return 0;
    if (value < 1 || value > static_cast<int64_t>(limits::meshes)) {
      fail(fmt::format("mesh {} cannot be: 1 to {} are read", value, limits::meshes));
      return 0;
    }
    return static_cast<size_t>(value) - 1;
  }

  /// A file of results, in the folder of the index or below it.
  fs::path file_name() {
    const std::string_view name = trimmed(next_line());
    if (failed()) return {};
    const fs::path path = fs::path(std::string(name)).lexically_normal();
    const bool inside = !path.empty() && !path.is_absolute() && *path.begin() != ".." &&
                        name.find('\0') == std::string_view::npos;
    if (!inside) {
      fail(
          fmt::format("\"{}\" is no file in the folder of this index: results are read from "
                      "there alone",
                      excerpt(name)));
      return {};
    }
    return folder_ / path;
  }

  Mesh* last_mesh(const char* keyword) {
    if (out_.meshes.empty()) fail(fmt::format("{} stands before any GRID", keyword));
    return failed() ? nullptr : &out_.meshes.back();
  }

  /// A number from 0 to 1; none where the line ends before it.
  std::optional<double> share(const std::vector<std::string_view>& words, size_t place,
                              const char* what) {
    if (place >= words.size()) return std::nullopt;
    const auto value = number<double>(words, place, what);
    if (!failed() && !(value >= 0 && value <= 1))
      fail(fmt::format("{} is not from 0 to 1: \"{}\"", what, excerpt(words[place])));
    return value;
  }

  // ---- keywords

  void version() {
    out_.version = excerpt(trimmed(next_line()));
    out_.release = release_of(out_.version);
  }

  void heat_range() {
    const auto highest = number<double>(words_of(next_line()), 1, "the highest HRRPUV");
    if (failed()) return;
    if (!(highest > 0 && highest < 1e9)) return fail("the highest HRRPUV cannot be");
    out_.highest_heat_kw_m3 = highest;
  }

  /// Bodies of triangles lie in files of their own, which are not read.
  void bodies(std::string_view line) {
    const auto words = words_of(line);
    const auto said = words.size() > 1 ? number_in<int64_t>(words[1]) : std::nullopt;
    bodies_ += std::clamp<int64_t>(said.value_or(1), 0, 1'000'000);
  }

  void csv_file() {
    const bool is_heat = trimmed(next_line()) == "hrr";
    if (!is_heat || failed()) return;
    out_.heat_release_file = file_name();
  }

  /// Name, then ignition temperature and emissivity, then type, width, height and colour.
  void surface() {
    Surface surface;
    surface.name = excerpt(trimmed(next_line()));
    next_line();
    const auto words = words_of(next_line());
    for (int i = 0; i < 3; ++i)
      surface.rgb[i] = share(words, 3 + static_cast<size_t>(i), "the colour of a surface")
                           .value_or(surface.rgb[i]);
    surface.opacity = share(words, 6, "the opacity of a surface").value_or(1);
    if (!failed()) out_.surfaces.push_back(std::move(surface));
  }

  /// "x0 x1 y0 y1 z0 z1 id and six surfaces ! name": without them the name is empty, and the
  /// surface is the first.
  static ObstructionLabel label_of(std::string_view line) {
    ObstructionLabel label;
    const size_t mark = line.find('!');
    if (mark != std::string_view::npos) label.name = excerpt(trimmed(line.substr(mark + 1)));
    const auto words = words_of(line.substr(0, mark));
    size_t most = 0;
    for (size_t i = 7; i < words.size() && i < 13; ++i) {
      const auto same = static_cast<size_t>(std::count(words.begin() + 7, words.end(), words[i]));
      const auto surface = number_in<size_t>(words[i]);
      if (!surface || same <= most) continue;
      most = same;
      label.surface = *surface;
    }
    return label;
  }

  void grid(std::string_view line) {
    if (out_.meshes.size() == limits::meshes)
      return fail(fmt::format("there are more than {} meshes", limits::meshes));
    Mesh mesh;
    mesh.line = static_cast<int>(at_) + 1;
    mesh.name = excerpt(trimmed(line.substr(4)));
    const auto words = words_of(next_line());
    int64_t all = 1;
    for (int axis = 0; axis < 3 && !failed(); ++axis) {
      mesh.cells[axis] = number<int>(words, static_cast<size_t>(axis), "the number of cells");
      if (!failed() && (mesh.cells[axis] < 1 || mesh.cells[axis] > limits::side_cells))
        return fail(fmt::format("the mesh has {} cells along {}: 1 to {} are read",
                                mesh.cells[axis], "xyz"[axis], limits::side_cells));
      all *= mesh.cells[axis];
    }
    if (all > limits::mesh_cells)
      return fail(
          fmt::format("the mesh has {} cells: at most {} are read", all, limits::mesh_cells));
    out_.meshes.push_back(std::move(mesh));
  }

  /// After a number of lines to skip come lines "index coordinate".
  void nodes(size_t axis) {
    Mesh* mesh = last_mesh("TRN");
    if (mesh == nullptr) return;
    for (size_t skip = count(words_of(next_line()), 0); skip > 0 && !failed(); --skip) next_line();
    std::vector<double>& at = mesh->nodes[axis];
    if (!at.empty()) return fail("the nodes of this mesh are given twice");
    const int wanted = mesh->cells[static_cast<int>(axis)] + 1;
    for (int i = 0; i < wanted && !failed(); ++i) {
      at.push_back(metres(words_of(next_line()), 1));
      if (i > 0 && !failed() && !(at[at.size() - 1] > at[at.size() - 2]))
        fail("the nodes of the mesh do not ascend");
    }
  }

  /// Reads a number of lines with boxes in metres and names, then as many with node numbers.
  void obstructions() {
    Mesh* mesh = last_mesh("OBST");
    if (mesh == nullptr) return;
    const size_t n = count(words_of(next_line()), 0);
    for (size_t i = 0; i < n && !failed(); ++i) mesh->labels.push_back(label_of(next_line()));
    for (size_t i = 0; i < n && !failed(); ++i) {
      const std::string_view line = next_line();
      const auto words = words_of(line.substr(0, line.find('!')));
      NodeBox box;
      for (int axis = 0; axis < 3 && !failed(); ++axis) {
        const auto place = 2 * static_cast<size_t>(axis);
        box.low[axis] = number<int>(words, place, "a node of an obstruction");
        box.high[axis] = number<int>(words, place + 1, "a node of an obstruction");
        box.low[axis] = std::clamp(box.low[axis], 0, mesh->cells[axis]);
        box.high[axis] = std::clamp(box.high[axis], 0, mesh->cells[axis]);
      }
      mesh->obstructions.push_back(box);
      own_colour(words, mesh->labels[i]);
    }
  }

  /// "... colour type [r g b a]": -3 announces a colour of its own.
  void own_colour(const std::vector<std::string_view>& words, ObstructionLabel& label) {
    if (words.size() < 11 || words[6] != "-3") return;
    glm::dvec3 rgb(0);
    for (int i = 0; i < 3; ++i)
      rgb[i] = share(words, 8 + static_cast<size_t>(i), "the colour of an obstruction").value_or(0);
    label.rgb = rgb;
    label.opacity = share(words, 11, "the opacity of an obstruction").value_or(1);
  }

  /// The last vents are the plain faces of the mesh. Surfaces count from 0.
  void vents() {
    Mesh* mesh = last_mesh("VENT");
    if (mesh == nullptr) return;
    const auto counts = words_of(next_line());
    const size_t n = count(counts, 0), plain = count(counts, 1);
    for (size_t i = 0; i < n && !failed(); ++i) {
      const std::string_view line = next_line();
      if (i + plain >= n) continue;
      const auto words = words_of(line.substr(0, line.find('!')));
      Opening opening;
      for (int axis = 0; axis < 3; ++axis) {
        opening.low[axis] = metres(words, 2 * static_cast<size_t>(axis));
        opening.high[axis] = metres(words, 2 * static_cast<size_t>(axis) + 1);
      }
      const auto surface = number<int64_t>(words, 7, "the surface of a vent");
      if (failed()) return;
      const auto& surfaces = out_.surfaces;
      if (surface < 0 || surface >= static_cast<int64_t>(surfaces.size())) continue;
      const std::string& name = surfaces[static_cast<size_t>(surface)].name;
      if (name == open_surface) mesh->openings.push_back(opening);
      if (is_symmetric(name)) ++symmetric_faces_;
    }
    for (size_t i = 0; i < n && !failed(); ++i) next_line();
  }

  /// Label, short label and unit of a file's values.
  Output labelled_output() {
    const Output output = output_of(trimmed(next_line()));
    next_line();
    const std::string_view unit = trimmed(next_line());
    if (failed() || output.quantity == Quantity::other) return {};
    if (const std::string_view known = unit_of(output.quantity); unit != known) {
      fail(fmt::format("the unit is \"{}\", that of FDS is \"{}\"", excerpt(unit), known));
      return {};
    }
    note_species(output);
    return output;
  }

  void note_species(const Output& output) {
    if (output.species.empty()) return;
    auto& list = output.quantity == Quantity::density ? out_.dense : out_.absorbing;
    if (std::find(list.begin(), list.end(), output.species) != list.end()) return;
    if (list.size() == limits::species)
      return fail(fmt::format("there are files of more than {} species", limits::species));
    list.push_back(output.species);
  }

  /// "SLCF 1 # STRUCTURED %name & I1 I2 J1 J2 K1 K2 ! number ...", then file, label, short, unit.
  void slice(std::string_view line, bool of_cells) {
    Slice slice;
    slice.line = static_cast<int>(at_) + 1;
    slice.of_cells = of_cells;
    slice.mesh = mesh_number(line);
    const size_t from = line.find('&');
    if (from == std::string_view::npos) return;  // on terrain or unstructured geometry
    const std::string_view range = line.substr(from + 1);
    const auto words = words_of(range.substr(0, range.find('!')));
    int flat = 0;
    for (int axis = 0; axis < 3 && !failed(); ++axis) {
      const auto place = 2 * static_cast<size_t>(axis);
      slice.nodes.low[axis] = number<int>(words, place, "a node of a slice");
      slice.nodes.high[axis] = number<int>(words, place + 1, "a node of a slice");
      flat += slice.nodes.low[axis] < slice.nodes.high[axis] ? 0 : 1;
    }
    if (failed() || flat > 1) return;
    // Files of slices that are not read may lie anywhere, so only the others are checked.
    const size_t file_line = at_;
    next_line();
    slice.output = labelled_output();
    const Quantity quantity = slice.output.quantity;
    const bool wanted =
        quantity == Quantity::visibility || (flat == 0 && quantity != Quantity::other);
    if (failed() || !wanted) return;
    const size_t label_line = std::exchange(at_, file_line);
    slice.file = file_name();
    at_ = label_line;
    auto& list = quantity == Quantity::visibility ? out_.visibility : out_.slices;
    if (!failed()) list.push_back(std::move(slice));
  }

  void smoke(std::string_view line) {
    Smoke3d smoke;
    smoke.line = static_cast<int>(at_) + 1;
    smoke.mesh = mesh_number(line);
    const auto words = words_of(line);
    const double mass_extinction =
        words.size() > 2 ? number<double>(words, 2, "mass extinction") : 0;
    smoke.file = file_name();
    if (smoke.file.extension() == ".s16") return unread("Smoke3D of 16 bits (.s16)");
    smoke.output = labelled_output();
    if (failed() || smoke.output.quantity == Quantity::other) return;
    if (smoke.output.quantity == Quantity::density && mass_extinction > 0) {
      if (!(mass_extinction < 1e6)) return fail("a mass extinction of over 1e6 m2/kg cannot be");
      const auto [known, is_new] =
          out_.mass_extinction_m2_per_kg.try_emplace(smoke.output.species, mass_extinction);
      if (!is_new && known->second != mass_extinction)
        return fail(fmt::format("the mass extinction of {} is {:g} m2/kg here and {:g} m2/kg above",
                                smoke.output.species, mass_extinction, known->second));
    }
    out_.smoke.push_back(std::move(smoke));
  }

  /// "PL3D 45.2" means 45.02 s; the file name, CASE_1_45p02.q, states it correctly.
  void plot(std::string_view line) {
    Plot3d plot;
    plot.line = static_cast<int>(at_) + 1;
    const auto words = words_of(line);
    const auto mesh = number<int64_t>(words, 2, "the number of the mesh");
    if (failed()) return;
    if (mesh < 1 || mesh > static_cast<int64_t>(limits::meshes))
      return fail(fmt::format("mesh {} cannot be: 1 to {} are read", mesh, limits::meshes));
    plot.mesh = static_cast<size_t>(mesh) - 1;
    plot.file = file_name();
    if (failed()) return;
    const std::string stem = plot.file.stem().string();
    const size_t from = stem.rfind('_'), point = stem.rfind('p');
    const bool named = from != std::string::npos && point != std::string::npos && point > from;
    const auto whole =
        named ? number_in<int64_t>(std::string_view(stem).substr(from + 1, point - from - 1))
              : std::nullopt;
    const auto hundredths =
        named ? number_in<int64_t>(std::string_view(stem).substr(point + 1)) : std::nullopt;
    if (!whole || !hundredths || *hundredths < 0 || *hundredths > 99 ||
        std::abs(static_cast<double>(*whole)) > 1e9)
      return fail("the name of this PLOT3D file does not end in its time, as in CASE_1_45p02.q");
    plot.time_s = static_cast<double>(*whole) + static_cast<double>(*hundredths) / 100;
    for (Output& output : plot.outputs) output = labelled_output();
    if (!failed()) out_.plots.push_back(std::move(plot));
  }

  /// "number time": an obstruction of the mesh by its place in the list, from 1.
  void change(std::string_view line, bool appears) {
    Change change;
    change.mesh = mesh_number(line);
    change.appears = appears;
    change.line = static_cast<int>(at_) + 1;
    const auto words = words_of(next_line());
    const auto which = number<int64_t>(words, 0, "the number of the obstruction");
    change.time_s = number<double>(words, 1, "a time");
    if (failed()) return;
    if (which < 1) return fail("obstructions count from 1");
    if (!std::isfinite(change.time_s)) return fail("a time is not finite");
    change.obstruction = static_cast<size_t>(which) - 1;
    happens_at(change.time_s);
    out_.changes.push_back(change);
  }

  /// "number time state" of a device: says only how far the run was.
  void device_event() {
    const auto words = words_of(next_line());
    const auto time = words.size() > 1 ? number_in<double>(words[1]) : std::nullopt;
    if (time && std::isfinite(*time)) happens_at(*time);
  }

  /// A restarted run writes its events behind those of the part that was abandoned, which are void.
  void happens_at(double time_s) {
    if (time_s < latest_s_ - event_slack_s) {
      if (++restarts_ > limits::restarts)
        return fail(fmt::format("times of events go back more than {} times", limits::restarts));
      std::erase_if(out_.changes, [&](const Change& c) { return c.time_s > time_s; });
      if (restarts_ == 1)
        out_.notes.push_back(
            fmt::format("line {}: events go back from {:.6g} to {:.6g} s, as after a restart: the "
                        "later records hold, here and wherever events go back",
                        at_ + 1, latest_s_, time_s));
      latest_s_ = time_s;
    }
    latest_s_ = std::max(latest_s_, time_s);
  }

  /// An obstruction that vanishes twice, or appears twice, did so once in a part of the run that a
  /// restart made void. One process writes all events of an obstruction: if their times go back, by
  /// however little, that was a restart, too. Which event is void is known from the order of the
  /// records, not from that of times. Requires: changes in the order of the index.
  void drop_void_changes() {
    std::map<std::pair<size_t, size_t>, std::vector<size_t>> kept;  // by mesh and obstruction
    std::vector<uint8_t> is_void(out_.changes.size(), 0);
    bool told = false;
    for (size_t i = 0; i < out_.changes.size(); ++i) {
      const Change& change = out_.changes[i];
      std::vector<size_t>& events = kept[{change.mesh, change.obstruction}];
      while (!events.empty()) {
        const Change& before = out_.changes[events.back()];
        const bool again = before.appears == change.appears && before.time_s != change.time_s;
        if (!again && before.time_s <= change.time_s) break;
        is_void[events.back()] = 1;
        events.pop_back();
        if (again && !std::exchange(told, true))
          out_.notes.push_back(fmt::format(
              "line {}: an obstruction {} at {:.6g} s that does so at {:.6g} s, too, as after a "
              "restart: the later record holds, here and for others of this kind",
              before.line, change.appears ? "appears" : "vanishes", before.time_s, change.time_s));
      }
      events.push_back(i);
    }
    size_t count = 0;
    for (size_t i = 0; i < out_.changes.size(); ++i)
      if (is_void[i] == 0) out_.changes[count++] = out_.changes[i];
    out_.changes.resize(count);
  }

  void note_what_is_left_out() {
    if (bodies_ > 0)
      out_.building_notes.push_back(fmt::format(
          "{} bod{} of triangles (GEOM) {} left out: their files are not read. The input file {} "
          "has them",
          bodies_, bodies_ == 1 ? "y" : "ies", bodies_ == 1 ? "is" : "are",
          input_file_.empty() ? "(.fds)" : input_file_));
    if (symmetric_faces_ > 0)
      out_.building_notes.push_back(fmt::format(
          "{} face{} MIRROR or PERIODIC: the building goes on behind {}, and an opaque wall is put "
          "there",
          symmetric_faces_, symmetric_faces_ == 1 ? " is" : "s are",
          symmetric_faces_ == 1 ? "it" : "them"));
  }

  /// Records what is not read, because its format is not documented.
  void unread(const std::string& what) {
    if (out_.unread.find(what) == std::string::npos)
      out_.unread += (out_.unread.empty() ? "" : " and ") + what;
  }

  // ---- the end

  void finish() {
    at_ = 0;
    if (out_.meshes.empty())
      return fail("there is no mesh (GRID) in this file: is it the .smv index of an FDS case?");
    for (const Mesh& mesh : out_.meshes) {
      for (size_t axis = 0; axis < 3 && !failed(); ++axis) {
        at_ = static_cast<size_t>(mesh.line) - 1;
        if (mesh.nodes[axis].empty())
          fail(fmt::format("the mesh has no nodes along {} (TRN{}): is the file whole?",
                           "xyz"[axis], "XYZ"[axis]));
      }
    }
    const auto surface = std::find_if(out_.surfaces.begin(), out_.surfaces.end(),
                                      [&](const Surface& s) { return s.name == default_surface_; });
    if (surface != out_.surfaces.end())
      out_.default_surface = static_cast<size_t>(surface - out_.surfaces.begin());
    const auto beyond = [&](const auto& list) {
      for (const auto& entry : list) {
        if (failed() || entry.mesh < out_.meshes.size()) continue;
        at_ = static_cast<size_t>(entry.line) - 1;
        fail(fmt::format("it belongs to mesh {}, and there are {}", entry.mesh + 1,
                         out_.meshes.size()));
      }
    };
    beyond(out_.slices);
    beyond(out_.visibility);
    beyond(out_.smoke);
    beyond(out_.plots);
    beyond(out_.changes);
    for (const Change& change : out_.changes) {
      if (failed()) return;
      at_ = static_cast<size_t>(change.line) - 1;
      if (change.obstruction >= out_.meshes[change.mesh].obstructions.size())
        fail(fmt::format("it is of obstruction {}, and the mesh has {}", change.obstruction + 1,
                         out_.meshes[change.mesh].obstructions.size()));
    }
    drop_void_changes();
    std::stable_sort(out_.changes.begin(), out_.changes.end(),
                     [](const Change& a, const Change& b) { return a.time_s < b.time_s; });
    note_what_is_left_out();
  }

  const fs::path path_;
  const fs::path folder_;
  std::vector<std::string_view> lines_;
  size_t at_ = 0;  // the line being read
  std::string default_surface_, input_file_;
  int64_t bodies_ = 0;
  size_t symmetric_faces_ = 0, restarts_ = 0;
  double latest_s_ = -std::numeric_limits<double>::infinity();
  Case out_;
  std::optional<Problem> problem_;
};

}  // namespace

Result<Case> read_case(const fs::path& index) {
  auto text = read_regular_file(index, limits::index_bytes);
  if (!text) return text.problem();
  return IndexReader(index, text.value()).read();
}

}  // namespace luxodus::fds
