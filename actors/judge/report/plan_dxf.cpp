// A plan as a DXF drawing: layers for walls, luminaires, signs, routes and lines of equal
// illuminance, a block for each type of luminaire.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "actors/judge/report/dxf_drawing.hpp"
#include "actors/judge/report/hand_over.hpp"
#include "actors/judge/report/isolux.hpp"
#include "runtime/core/regular_file.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

constexpr double letter_m = 0.25, lamp_m = 0.15;
constexpr const char* sign_block = "SIGN";
/// Largest file [bytes]; a plan with all lines that the limits of an assessment allow fits in.
constexpr uint64_t dxf_bytes = uint64_t{256} << 20;

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

std::string block_of(const LuminaireType& type) {
  return "LUMINAIRE_" + type.letter;
}

/// A block for each luminaire type: a square, crossed for mains luminaires; for signs a bar with an
/// arrow along x.
void blocks(DxfDrawing& out, const Schedule& schedule) {
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
  out.begin_block(sign_block);
  out.line("0", {0, -0.2}, {0, 0.2});
  out.line("0", {0, 0}, {0.4, 0});
  out.line("0", {0.4, 0}, {0.3, 0.07});
  out.line("0", {0.4, 0}, {0.3, -0.07});
  for (const char* tag : {"NAME", "TYPE", "NUMBER", "FACE"}) out.define(tag);
  out.end_block();
}

std::vector<std::string> block_names(const Schedule& schedule) {
  std::vector<std::string> out{sign_block};
  for (const LuminaireType& type : schedule.types()) out.push_back(block_of(type));
  return out;
}

void draw_luminaires(DxfDrawing& out, const AssessmentRecord& a, const Schedule& schedule,
                     size_t level) {
  for (size_t i = 0; i < a.luminaires.size(); ++i) {
    const LuminaireRecord& one = a.luminaires[i];
    const glm::dvec3& p = one.position;
    if (schedule.level_of(one) != level) continue;
    const LuminaireType& type = schedule.type_of(i);
    out.insert("LUMINAIRES", block_of(type), p, 0, {{"NAME", one.name}, {"TYPE", type.letter}});
    out.text("TEXT", glm::dvec2(p) + glm::dvec2(lamp_m + 0.05, -letter_m / 2),
             fmt::format("{} {:.2f}", type.letter, schedule.above_floor(one)), letter_m);
  }
}

void draw_signs(DxfDrawing& out, const AssessmentRecord& a, const Schedule& schedule,
                size_t level) {
  for (size_t i = 0; i < a.signs.size(); ++i) {
    const SignRecord& one = a.signs[i];
    const glm::dvec3 &p = one.position, &f = one.facing;
    if (schedule.level_of(one) != level) continue;
    const double turn = std::atan2(f.y, f.x) * 180 / std::numbers::pi;
    out.insert("SIGNS", sign_block, p, turn,
               {{"NAME", one.name},
                {"TYPE", one.lighting},
                {"NUMBER", std::to_string(i + 1)},
                {"FACE", one.file.empty() ? one.text : one.file}});
    out.text("TEXT", glm::dvec2(p) - 0.45 * glm::dvec2(f), std::to_string(i + 1), letter_m);
  }
}

void draw_places(DxfDrawing& out, const AssessmentRecord& a, const Schedule& schedule,
                 size_t level) {
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
    out.text("TEXT", path.front() + glm::dvec2(0, 0.1), route.name, letter_m);
  }
  for (const AreaRecord& area : a.places.areas) {
    if (schedule.level_of(area.z_m) != level) continue;
    const auto& outline = area.outline;
    out.polyline("AREAS", outline, true);
    out.text("TEXT", outline.front() + glm::dvec2(0.1, 0.1), area.name, letter_m);
  }
}

void scale(DxfDrawing& out, glm::dvec2 low) {
  const glm::dvec2 at = low - glm::dvec2(0, 1.5);
  for (int i = 0; i <= 5; ++i)
    out.line("SCALE", at + glm::dvec2(i, 0), at + glm::dvec2(i, i % 5 == 0 ? 0.3 : 0.15));
  out.line("SCALE", at, at + glm::dvec2(5, 0));
  out.text("SCALE", at + glm::dvec2(0, -0.4), "0", letter_m);
  out.text("SCALE", at + glm::dvec2(5, -0.4), "5 m (1 unit = 1 m)", letter_m);
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
    DxfDrawing out(draft);
    if (!out.open())
      return problem_in(path, "cannot be written: is the folder there and writable?",
                        ProblemKind::system);
    out.begin(low, high, layers, block_names(schedule));
    blocks(out, schedule);
    out.begin_entities();
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
    out.end();
  }
  const auto bytes = read_whole_file(draft, dxf_bytes);
  fs::remove(draft, ignored);
  if (!bytes) return bytes.problem();
  return write_file_atomically(path, bytes.value());
}

}  // namespace luxodus
