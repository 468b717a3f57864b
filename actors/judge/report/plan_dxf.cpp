// DXF of release 12 (AC1009), which every CAD program reads: no handles, layer and block names in
// capitals, non-ASCII letters as \U+XXXX. One unit is one metre.
#include <dxflib/dl_codes.h>
#include <dxflib/dl_writer_ascii.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "actors/judge/report/hand_over.hpp"
#include "actors/judge/report/isolux.hpp"
#include "runtime/core/output_text.hpp"
#include "runtime/core/regular_file.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

constexpr double letter_m = 0.25, lamp_m = 0.15;
/// Largest file [bytes]; a plan with all lines that the limits of an assessment allow fits in.
constexpr uint64_t dxf_bytes = uint64_t{256} << 20;

struct DxfLayer {
  const char* name;
  int colour;  // AutoCAD colour index
};
constexpr std::array<DxfLayer, 12> layers{{{"WALLS", 7},
                                           {"FURNITURE", 8},
                                           {"LUMINAIRES", 3},
                                           {"SIGNS", 94},
                                           {"ROUTES", 5},
                                           {"AREAS", 4},
                                           {"ISOLUX_0_5", 6},
                                           {"ISOLUX_1", 30},
                                           {"ISOLUX_5", 150},
                                           {"ISOLUX_10", 82},
                                           {"TEXT", 7},
                                           {"SCALE", 7}}};

const char* isolux_layer(double lux) {
  return lux < 0.7 ? "ISOLUX_0_5" : lux < 2 ? "ISOLUX_1" : lux < 7 ? "ISOLUX_5" : "ISOLUX_10";
}

/// The text as one line of ASCII.
std::string plain(const std::string& text) {
  const std::string clean = clean_utf8(text);
  std::string out;
  for (size_t i = 0; i < clean.size();) {
    const auto lead = static_cast<unsigned char>(clean[i]);
    const size_t bytes = lead < 0x80 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    uint32_t code = bytes == 1 ? lead : lead & (0xffu >> (bytes + 1));
    for (size_t k = 1; k < bytes && i + k < clean.size(); ++k)
      code = code << 6 | (static_cast<unsigned char>(clean[i + k]) & 0x3fu);
    i += bytes;
    if (code >= 0x20 && code < 0x7f)
      out += static_cast<char>(code);
    else if (code < 0x20)
      out += ' ';
    else
      out += fmt::format("\\U+{:04X}", std::min(code, 0xffffu));
  }
  return out.substr(0, 255);  // longest string of release 12
}

/// Writes entities on layers, with dxflib's writer of group codes.
class Drawing {
 public:
  explicit Drawing(const fs::path& path) : out_(path.c_str(), DL_Codes::AC1009) {}
  bool open() const { return !out_.openFailed(); }

  void line(const char* layer, glm::dvec2 a, glm::dvec2 b) {
    entity("LINE", layer);
    at(a);
    out_.dxfReal(11, b.x);
    out_.dxfReal(21, b.y);
    out_.dxfReal(31, 0);
  }
  void text(const char* layer, glm::dvec2 place, const std::string& words,
            double height = letter_m) {
    entity("TEXT", layer);
    at(place);
    out_.dxfReal(40, height);
    out_.dxfString(1, plain(words));
  }
  void circle(const char* layer, glm::dvec2 place, double radius) {
    entity("CIRCLE", layer);
    at(place);
    out_.dxfReal(40, radius);
  }
  void polyline(const char* layer, const std::vector<glm::dvec2>& points, bool closed) {
    entity("POLYLINE", layer);
    out_.dxfInt(66, 1);
    at({0, 0});
    out_.dxfInt(70, closed ? 1 : 0);
    for (size_t i = 0; i < points.size() - (closed && points.front() == points.back() ? 1 : 0);
         ++i) {
      entity("VERTEX", layer);
      at(points[i]);
    }
    entity("SEQEND", layer);
  }
  /// Inserts a rotated block with attributes that only data export shows.
  void insert(const char* layer, const std::string& block, glm::dvec3 place, double turn_deg,
              const std::vector<std::pair<const char*, std::string>>& attributes) {
    entity("INSERT", layer);
    out_.dxfInt(66, 1);
    out_.dxfString(2, block);
    at(glm::dvec2(place), place.z);
    out_.dxfReal(50, turn_deg);
    for (const auto& [tag, value] : attributes) {
      entity("ATTRIB", layer);
      at(glm::dvec2(place), place.z);
      out_.dxfReal(40, letter_m / 2);
      out_.dxfString(1, plain(value));
      out_.dxfString(2, tag);
      out_.dxfInt(70, 1);  // invisible: names are drawn on layer TEXT
    }
    entity("SEQEND", layer);
  }
  /// Defines an attribute within a block.
  void define(const char* tag) {
    entity("ATTDEF", "0");
    at({0, 0});
    out_.dxfReal(40, letter_m / 2);
    out_.dxfString(1, "");
    out_.dxfString(3, tag);
    out_.dxfString(2, tag);
    out_.dxfInt(70, 1);
  }
  void begin_block(const std::string& name) {
    entity("BLOCK", "0");
    out_.dxfString(2, name);
    out_.dxfInt(70, 2);  // has attributes
    at({0, 0});
  }
  void end_block() { entity("ENDBLK", "0"); }
  void head(glm::dvec2 low, glm::dvec2 high);
  void section(const char* name) {
    out_.dxfString(0, "SECTION");
    out_.dxfString(2, name);
  }
  void end_section() { out_.dxfString(0, "ENDSEC"); }
  void end() {
    out_.dxfString(0, "EOF");
    out_.close();
  }

 private:
  void entity(const char* kind, const char* layer) {
    out_.dxfString(0, kind);
    out_.dxfString(8, layer);
  }
  void at(glm::dvec2 place, double z = 0) {
    out_.dxfReal(10, place.x);
    out_.dxfReal(20, place.y);
    out_.dxfReal(30, z);
  }
  void corner(const char* variable, glm::dvec2 place) {
    out_.dxfString(9, variable);
    at(place);
  }
  void table(const char* name, size_t entries) {
    out_.dxfString(0, "TABLE");
    out_.dxfString(2, name);
    out_.dxfInt(70, static_cast<int>(entries));
  }
  void layer(const DxfLayer& layer) {
    out_.dxfString(0, "LAYER");
    out_.dxfString(2, layer.name);
    out_.dxfInt(70, 0);
    out_.dxfInt(62, layer.colour);
    out_.dxfString(6, "CONTINUOUS");
  }

  DL_WriterA out_;
};

void Drawing::head(glm::dvec2 low, glm::dvec2 high) {
  out_.dxfString(999, "Luxodus; 1 unit = 1 m");
  section("HEADER");
  out_.dxfString(9, "$ACADVER");
  out_.dxfString(1, "AC1009");
  corner("$INSBASE", {0, 0});
  corner("$EXTMIN", low);
  corner("$EXTMAX", high);
  end_section();
  section("TABLES");
  table("LTYPE", 1);
  out_.dxfString(0, "LTYPE");
  out_.dxfString(2, "CONTINUOUS");
  out_.dxfInt(70, 0);
  out_.dxfString(3, "Solid line");
  out_.dxfInt(72, 65);
  out_.dxfInt(73, 0);
  out_.dxfReal(40, 0);
  out_.dxfString(0, "ENDTAB");
  table("LAYER", layers.size() + 1);
  layer({"0", 7});
  for (const DxfLayer& one : layers) layer(one);
  out_.dxfString(0, "ENDTAB");
  end_section();
}

std::string block_of(const LuminaireType& type) {
  return "LUMINAIRE_" + type.letter;
}

/// A block for each luminaire type: a square, crossed for mains luminaires; for signs a bar with an
/// arrow along x.
void blocks(Drawing& out, const Schedule& schedule) {
  out.section("BLOCKS");
  for (const LuminaireType& type : schedule.types()) {
    out.begin_block(block_of(type));
    const double d = lamp_m;
    out.polyline("0", {{-d, -d}, {d, -d}, {d, d}, {-d, d}}, true);
    if (!type.emergency()) {
      out.line("0", {-d, -d}, {d, d});
      out.line("0", {-d, d}, {d, -d});
    }
    out.define("NAME");
    out.define("TYPE");
    out.end_block();
  }
  out.begin_block("SIGN");
  out.line("0", {0, -0.2}, {0, 0.2});
  out.line("0", {0, 0}, {0.4, 0});
  out.line("0", {0.4, 0}, {0.3, 0.07});
  out.line("0", {0.4, 0}, {0.3, -0.07});
  for (const char* tag : {"NAME", "TYPE", "NUMBER", "FACE"}) out.define(tag);
  out.end_block();
  out.end_section();
}

void draw_luminaires(Drawing& out, const AssessmentRecord& a, const Schedule& schedule,
                     size_t level) {
  for (size_t i = 0; i < a.luminaires.size(); ++i) {
    const LuminaireRecord& one = a.luminaires[i];
    const glm::dvec3& p = one.position;
    const double z = p.z;
    if (schedule.level_of(z) != level) continue;
    const LuminaireType& type = schedule.type_of(i);
    out.insert("LUMINAIRES", block_of(type), p, 0, {{"NAME", one.name}, {"TYPE", type.letter}});
    out.text("TEXT", glm::dvec2(p) + glm::dvec2(lamp_m + 0.05, -letter_m / 2),
             fmt::format("{} {:.2f}", type.letter, schedule.above_floor(z)));
  }
}

void draw_signs(Drawing& out, const AssessmentRecord& a, const Schedule& schedule, size_t level) {
  for (size_t i = 0; i < a.signs.size(); ++i) {
    const SignRecord& one = a.signs[i];
    const glm::dvec3 &p = one.position, &f = one.facing;
    const double z = p.z;
    if (schedule.level_of(z) != level) continue;
    const double turn = std::atan2(f.y, f.x) * 180 / std::numbers::pi;
    out.insert("SIGNS", "SIGN", p, turn,
               {{"NAME", one.name},
                {"TYPE", one.lighting},
                {"NUMBER", std::to_string(i + 1)},
                {"FACE", one.file.empty() ? one.text : one.file}});
    out.text("TEXT", glm::dvec2(p) - 0.45 * glm::dvec2(f), std::to_string(i + 1));
  }
}

void draw_places(Drawing& out, const AssessmentRecord& a, const Schedule& schedule, size_t level) {
  for (const RouteRecord& route : a.places.routes) {
    const bool here = std::any_of(route.path.begin(), route.path.end(), [&](const glm::dvec3& p) {
      return schedule.level_of(p.z) == level;
    });
    if (!here) continue;
    const std::vector<glm::dvec2> path(route.path.begin(), route.path.end());
    out.polyline("ROUTES", path, false);
    const glm::dvec2 way = glm::normalize(path.back() - path[path.size() - 2]);
    const glm::dvec2 aside(-way.y, way.x);
    for (const double side : {-0.15, 0.15})
      out.line("ROUTES", path.back(), path.back() - 0.4 * way + side * aside);
    out.text("TEXT", path.front() + glm::dvec2(0, 0.1), route.name);
  }
  for (const AreaRecord& area : a.places.areas) {
    if (schedule.level_of(area.z_m) != level) continue;
    const auto& outline = area.outline;
    out.polyline("AREAS", outline, true);
    out.text("TEXT", outline.front() + glm::dvec2(0.1, 0.1), area.name);
  }
}

void scale(Drawing& out, glm::dvec2 low) {
  const glm::dvec2 at = low - glm::dvec2(0, 1.5);
  for (int i = 0; i <= 5; ++i)
    out.line("SCALE", at + glm::dvec2(i, 0), at + glm::dvec2(i, i % 5 == 0 ? 0.3 : 0.15));
  out.line("SCALE", at, at + glm::dvec2(5, 0));
  out.text("SCALE", at + glm::dvec2(0, -0.4), "0");
  out.text("SCALE", at + glm::dvec2(5, -0.4), "5 m (1 unit = 1 m)");
}

}  // namespace

Result<void> write_plan_dxf(const fs::path& path, const AssessmentRecord& a,
                            const Schedule& schedule, size_t number) {
  const PlanLevel& level = a.plan.levels[number];
  glm::dvec2 low(1e300), high(-1e300);
  const auto take = [&](const glm::dvec2& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  };
  for (const auto& [from, to] : level.walls) {
    take(from);
    take(to);
  }
  for (const PlanPoint& p : level.points) take(p.place);
  if (low.x > high.x) low = high = {0, 0};
  // dxflib writes directly to a file, so it writes a draft that replaces the plan when complete.
  const fs::path draft = path.string() + fmt::format(".{}.tmp", ::getpid());
  std::error_code ignored;
  {
    Drawing out(draft);
    if (!out.open())
      return problem_in(path, "cannot be written: is the folder there and writable?",
                        ProblemKind::system);
    out.head(low, high);
    blocks(out, schedule);
    out.section("ENTITIES");
    for (const auto& [from, to] : level.walls) out.line("WALLS", from, to);
    for (const auto& [from, to] : level.furniture) out.line("FURNITURE", from, to);
    draw_places(out, a, schedule, number);
    draw_luminaires(out, a, schedule, number);
    draw_signs(out, a, schedule, number);
    for (const IsoluxLine& one : isolux_lines(level)) {
      out.polyline(isolux_layer(one.lux), one.line.points, one.line.closed);
      out.text(isolux_layer(one.lux), one.line.points[one.line.points.size() / 2],
               fmt::format("{:g} lx", one.lux), 0.15);
    }
    scale(out, low);
    out.end_section();
    out.end();
  }
  const auto bytes = read_whole_file(draft, dxf_bytes);
  fs::remove(draft, ignored);
  if (!bytes) return bytes.problem();
  return write_file_atomically(path, bytes.value());
}

}  // namespace luxodus
