#include "tests/random/random_text.hpp"

#include <algorithm>
#include <fstream>
#include <vector>

#include "scenes/formats/scene_file/scene_file.hpp"
#include "scenes/formats/scene_file/scene_schema.hpp"
#include "scenes/light/transport/compile.hpp"
#include "tests/random/dice.hpp"

namespace luxodus::test {

namespace {

constexpr uint64_t of_texts = 0x7e875;

/// The start of every text: a scene without mistakes, with tables of most kinds.
constexpr const char* sane_scene = R"(title = "Something of most kinds"
patch_edge_m = 1.0
[run]
seed = 7
voxel_edge_m = 1
groups = "emitter"
[[material]]
name = "white"
reflectance = "white80"
[[material]]
name = "shiny"
kind = "glossy"
reflectance = 0.4
specular = 0.05
roughness = 0.2
[[material]]
name = "pane"
kind = "glass"
[[object]]
name = "room"
shape = "room"
low = [0, 0, 0]
high = [5, 4, 3]
material = "white"
floor = "grey20"
[[object]]
name = "door"
shape = "quad"
corner = [1, 1, 0]
edge_u = [0, 0, 2.1]
edge_v = [0, 1.0, 0]
material = "shiny"
door = { hinge = [1, 1, 0], open_angle_deg = 85 }
[[object]]
name = "wall"
shape = "wall"
from = [2, 0.5, 0]
to = [2, 3.5, 0]
height = 2.5
thickness = 0.1
material = "white"
opening = [{ at = 1, width = 1.0, height = 2 }]
[[object]]
name = "ball"
shape = "sphere"
radius = 0.3
mesh_tolerance_m = 0.1
material = "pane"
translate = [3, 3, 1]
repeat = [{ count = 2, step = [0, -1, 0] }]
[[emitter]]
name = "lamp"
shape = "rectangle"
position = [2.5, 2, 2.9]
size = [0.6, 0.6]
flux_lm = 3000
circuit = "mains"
emergency = "maintained"
emergency_factor = 0.1
maintenance_factor = 0.8
end_of_duration_factor = 0.7
[[emitter]]
name = "spot"
shape = "point"
position = [1.5, 1, 2]
distribution = "spot"
spot_outer_deg = 20
flux_w = 10
spectrum = "2700 K"
[[sign]]
name = "exit"
position = [4.9, 2, 2.4]
facing = [-1, 0, 0]
width = 0.4
height = 0.2
text = "EXIT"
texels = 64
letter_height = 0.1
stroke = 0.015
mains_white = 500
mains_green = 50
emergency_white = 60
emergency_green = 6
[[medium]]
name = "smoke"
kind = "layered"
layer = [{ z_low = 1.5, z_high = 3, extinction = 0.5, albedo = 0.5, phase = "hg", g = 0.6 }]
[[medium]]
name = "haze"
kind = "homogeneous"
extinction = 0.1
albedo = 0.9
box = [[0, 0], [3, 3]]
[[medium]]
name = "flame"
kind = "bounded"
body = "cone"
position = [4, 1, 0]
radius = 0.3
height = 1
extinction = 1
albedo = 0.3
emission = { power_w = 1e4, temperature_k = 1400 }
[[plane]]
name = "floor"
corner = [0, 0, 0.02]
edge_u = [5, 0, 0]
edge_v = [0, 4, 0]
cells = [5, 4]
[[probe]]
name = "probe"
position = [2.5, 1, 0.8]
[[surface_group]]
name = "walls"
objects = ["room", "door"]
[[volume_group]]
name = "upper half"
shape = "layer"
z_low = 1.5
z_high = 3
[[counting_plane]]
name = "doorway"
corner = [2, 1.5, 0]
edge_u = [0, 1, 0]
edge_v = [0, 0, 2]
[[observer]]
name = "walker"
eye = [1, 2, 1.6]
target = [4.9, 2, 2.4]
[[camera]]
name = "view"
eye = [0.5, 1, 1.6]
target = [4.9, 2, 2.4]
[[route]]
name = "way out"
path = [[1, 1, 0], [4, 2, 0]]
width = 1
[[emphasis]]
name = "exit door"
kind = "exit_door"
position = [4.9, 2, 0]
[[scenario]]
name = "fire"
operation = "emergency"
circuits = { mains = 0.9 }
media = { haze = 2 }
doors_open = ["door"]
)";

struct TextTable {
  std::string heading;  // "" at the top
  std::vector<std::string> lines;
};
using Text = std::vector<TextTable>;

Text cut(const std::string& text) {
  Text out(1);
  for (size_t at = 0; at < text.size();) {
    const size_t end = text.find('\n', at);
    const std::string line = text.substr(at, end - at);
    if (line.front() == '[')
      out.push_back({line, {}});
    else
      out.back().lines.push_back(line);
    at = end + 1;
  }
  return out;
}

/// The kind of a table: "material" for [[material]], "scene" at the top.
std::string kind_of(const TextTable& table) {
  std::string out;
  for (const char c : table.heading)
    if (c != '[' && c != ']') out += c;
  return out.empty() ? "scene" : out;
}

class TextWriter {
 public:
  explicit TextWriter(uint64_t number) : dice_(number, of_texts), text_(cut(sane_scene)) {}

  std::string write() {
    const int harms = dice_.chance(0.05) ? 0 : dice_.whole(1, dice_.chance(0.2) ? 12 : 3);
    for (int i = 0; i < harms; ++i) harm();
    std::string out;
    for (const TextTable& t : text_) {
      if (!t.heading.empty()) out += t.heading + "\n";
      for (const std::string& line : t.lines) out += line + "\n";
    }
    if (dice_.chance(0.03))
      out[static_cast<size_t>(dice_.below(static_cast<int>(out.size())))] =
          static_cast<char>(dice_.below(256));
    return out;
  }

 private:
  TextTable& any_table() { return text_[static_cast<size_t>(dice_.below(count(text_)))]; }
  template <class List>
  static int count(const List& list) {
    return static_cast<int>(list.size());
  }

  void harm() {
    TextTable& table = any_table();
    const int what = dice_.below(20);
    if (what < 2) return add_table();
    if (what == 2) {
      const TextTable again = table;
      text_.push_back(again);
      return;
    }
    if (what < 7) return add_key(table);
    if (table.lines.empty()) return;
    const auto line = table.lines.begin() + dice_.below(count(table.lines));
    if (what == 7) {
      table.lines.erase(line);
    } else if (what == 8 && dice_.chance(0.2)) {
      const std::string again = *line;
      table.lines.push_back(again);
    } else {
      const std::string key = line->substr(0, line->find(' '));
      *line = key + " = " + value_of(kind_of(table), key);
    }
  }

  /// The tables of the schema that describe what a table of this kind may contain.
  static std::vector<const TableSpec*> specs_of(const std::string& kind) {
    std::vector<const TableSpec*> out;
    for (const TableSpec& t : scene_schema().tables) {
      const bool own = t.name == kind;
      const bool part = t.name.size() > kind.size() && t.name.substr(0, kind.size()) == kind &&
                        t.name[kind.size()] == '.';
      if (own || part) out.push_back(&t);
    }
    return out;
  }

  void add_key(TextTable& table) {
    const auto specs = specs_of(kind_of(table));
    if (specs.empty()) return;
    const TableSpec& spec = *dice_.any(specs);
    if (spec.keys.empty()) return;
    const KeySpec& key = dice_.any(spec.keys);
    const std::string begin = std::string(key.name) + " = ";
    const bool twice = dice_.chance(0.03);
    if (!twice) std::erase_if(table.lines, [&](const auto& l) { return l.starts_with(begin); });
    table.lines.push_back(begin + value_for(key));
  }

  void add_table() {
    const TableSpec& spec = dice_.any(scene_schema().tables);
    const std::string kind(spec.name.substr(0, spec.name.find('.')));
    if (kind == "scene") return;
    const bool single = kind == "run" || kind == "assessment";
    TextTable table{single ? "[" + kind + "]" : "[[" + kind + "]]", {}};
    const auto take = [&](const TableSpec& from) {
      for (const KeySpec& key : from.keys) {
        const bool wanted = key.fallback == "required" ? dice_.chance(0.97) : dice_.chance(0.15);
        if (wanted) table.lines.push_back(std::string(key.name) + " = " + value_for(key));
      }
    };
    for (const TableSpec* own : specs_of(kind))
      if (own->name == kind) take(*own);
    if (spec.name != kind) take(spec);
    text_.push_back(std::move(table));
  }

  std::string value_of(const std::string& kind, const std::string& name) {
    for (const TableSpec* spec : specs_of(kind)) {
      for (const KeySpec& key : spec->keys)
        if (key.name == name) return value_for(key);
    }
    return odd_value();
  }

  std::string value_for(const KeySpec& key) {
    return dice_.chance(0.3) ? odd_value() : fitting_value(key);
  }

  std::string odd_value() {
    static const std::vector<std::string> odd = {"nan",
                                                 "inf",
                                                 "-inf",
                                                 "-1",
                                                 "0",
                                                 "-0.0",
                                                 "1e308",
                                                 "-1e308",
                                                 "1e-320",
                                                 "5e-324",
                                                 "1e400",
                                                 "9223372036854775807",
                                                 "-9223372036854775808",
                                                 "0x7fffffff",
                                                 "true",
                                                 "false",
                                                 "\"\"",
                                                 "\"nan\"",
                                                 "\"../..\"",
                                                 "[]",
                                                 "{}",
                                                 "[[]]",
                                                 "[nan, 0, 0]",
                                                 "[1, 2]",
                                                 "[0, 0, 0]",
                                                 "[inf, 1, 1]",
                                                 "[1e300, 1e300, 1e300]",
                                                 "[1, \"2\", 3]",
                                                 "[[0, 0], [0, 0], [0, 0]]",
                                                 "[[1, nan]]",
                                                 "{ a = 1 }",
                                                 "{ srgb = [2, 0, 0] }",
                                                 "1979-05-27",
                                                 "07:32:00",
                                                 "'''\n\nlines'''",
                                                 "\"\\u0000\"",
                                                 "\"\\u001b[2J\"",
                                                 "[{ }]",
                                                 "[{ name = 1 }, 2]"};
    if (dice_.chance(0.05)) return '"' + std::string(300, 'x') + '"';
    return dice_.any(odd);
  }

  std::string number_for(const KeySpec& key) {
    const toml::Interval range = toml::interval_of(key.range).value_or(toml::Interval{-10, 10});
    const int where = dice_.below(10);
    double v = std::clamp(dice_.between(-5, 10), range.low, range.high);
    if (where == 0) v = range.low;
    if (where == 1) v = range.high;
    if (where == 2) v = std::clamp(dice_.magnitude(1e-9, 1e9), range.low, range.high);
    if (key.type == "integer" && where > 1)
      v = std::clamp(1.0 * dice_.whole(0, 40), range.low, 64.);
    if (key.type == "integer") return std::to_string(static_cast<int64_t>(v));
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", v);
    return text;
  }

  std::string list_for(const KeySpec& key, int count) {
    std::string out;
    for (int i = 0; i < count; ++i) out += (i > 0 ? ", " : "") + number_for(key);
    return "[" + out + "]";
  }

  std::string rows_for(const KeySpec& key, int width) {
    const int rows = dice_.whole(1, 6);
    std::string out;
    for (int i = 0; i < rows; ++i) out += (i > 0 ? ", " : "") + list_for(key, width);
    return "[" + out + "]";
  }

  std::string fitting_value(const KeySpec& key) {
    const std::string_view type = key.type;
    if (!key.fallback.empty() && key.fallback != "required" && dice_.chance(0.15))
      return std::string(key.fallback);
    if (type == "number" || type == "integer") return number_for(key);
    if (type == "flag") return dice_.chance(0.5) ? "true" : "false";
    if (type == "choice") return '"' + std::string(dice_.any(toml::words_of(key.range))) + '"';
    if (type == "name") return "\"name " + std::to_string(dice_.below(30)) + '"';
    if (type == "text") return dice_.any(texts_);
    if (type == "texts") return "[" + dice_.any(texts_) + "]";
    if (type == "path") return dice_.any(paths_);
    if (type == "paths") return "[" + dice_.any(paths_) + "]";
    if (type == "point" || type == "direction" || type == "scale") return list_for(key, 3);
    if (type == "pair") return list_for(key, 2);
    if (type == "numbers") return list_for(key, dice_.whole(1, 6));
    if (type == "pairs" || type == "corners") return rows_for(key, 2);
    if (type == "points") return rows_for(key, 3);
    if (type == "factors") return "{ haze = " + number_for(key) + ", mains = 2 }";
    if (type == "words") return R"({ a = "white" })";
    if (type == "table") return "{ " + inner_keys() + " }";
    if (type == "tables") return "[{ " + inner_keys() + " }]";
    return dice_.any(spectra_);
  }

  /// Keys of any nested table: most will be refused by name.
  std::string inner_keys() {
    const TableSpec& spec = dice_.any(scene_schema().tables);
    std::string out;
    for (const KeySpec& key : spec.keys) {
      if (key.type == "table" || key.type == "tables") continue;
      if (key.fallback != "required" && dice_.chance(0.7)) continue;
      out += (out.empty() ? "" : ", ") + std::string(key.name) + " = " + fitting_value(key);
    }
    return out;
  }

  Dice dice_;
  Text text_;
  const std::vector<std::string> texts_ = {"\"white\"", "\"shiny\"", "\"pane\"", "\"grey50\"",
                                           "\"open\"",  "\"room\"",  "\"door\"", "\"nobody\"",
                                           "\"mains\"", "\"lamp\"",  "\"x0\"",   "\"EXIT 1\""};
  const std::vector<std::string> paths_ = {
      "\"" LUX_SOURCE_DIR "/scenes/library/luminaires/wall_bulkhead.ies\"",
      "\"" LUX_SOURCE_DIR "/scenes/library/luminaires/bulkhead.ldt\"",
      "\"" LUX_SOURCE_DIR "/scenes/library/luminaires\"", "\"nowhere.obj\"", "\"scene.toml\""};
  const std::vector<std::string> spectra_ = {"0",
                                             "1",
                                             "0.5",
                                             "\"grey50\"",
                                             "{ srgb = [0.5, 0.4, 0.3] }",
                                             "{ linear_rgb = [0, 0, 1] }",
                                             "[[400, 0.2], [700, 0.6]]",
                                             "\"2700 K\"",
                                             "\"led 4000 K\"",
                                             "\"D65\"",
                                             "[[550, 1], [550.001, 1]]",
                                             "[[380, 0], [780, 0]]",
                                             "\"grey101\"",
                                             "\"-1 K\""};
};

/// Limits an accepted scene so that it is traced quickly.
void moderate(RunSettings& run) {
  run.batch_particles = std::clamp<int64_t>(run.batch_particles, 1, 32);
  run.eye_path_factor = std::min(run.eye_path_factor, 1.0);
}

}  // namespace

std::string random_text(uint64_t number) {
  return TextWriter(number).write();
}

Verdict check_text(uint64_t number, const std::filesystem::path& file, const EmbreeDevice& device) {
  std::ofstream(file, std::ios::binary) << random_text(number);
  const ReadScene read = read_scene(file);
  Verdict verdict;
  if (read.scene) {
    RandomScene scene;
    scene.description = *read.scene;
    moderate(scene.description.run);
    const auto scenario = find_scenario(scene.description, "");
    if (scenario.ok()) scene.scenario = scenario.value();
    return check_scene(scene, number, device);
  }
  if (read.problems.empty()) verdict.findings.emplace_back("refused without a word");
  for (const Problem& p : read.problems.list()) {
    if (verdict.refusal.empty()) verdict.refusal = kind_of_refusal(p.what);
    const bool own = p.where.file == file.string();
    // If a text names itself as another file, the place is where it does so.
    const bool named = p.what.find("named at ") != std::string::npos;
    if (p.where.file.empty() || (own && p.where.line < 1 && !named) || p.what.empty())
      verdict.findings.push_back("a mistake without a place: " + p.text());
    if (p.text().find('\n') != std::string::npos)
      verdict.findings.push_back("a mistake in several lines: " + p.text());
  }
  return verdict;
}

}  // namespace luxodus::test
