#include "scenes/formats/dxf/dxf_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <system_error>
#include <utility>

#include "runtime/core/printable.hpp"
#include "runtime/core/reading_share.hpp"
#include "runtime/core/regular_file.hpp"
#include "scenes/formats/dxf/dxf_curves.hpp"
#include "scenes/formats/dxf/dxf_groups.hpp"
#include "scenes/formats/dxf/dxf_names.hpp"

namespace luxodus {
namespace {

namespace fs = std::filesystem;

/// Metres per unit of $INSUNITS, by its value; 0 for none.
constexpr std::array<double, 25> metres_of_insunits{
    0,
    0.0254,
    0.3048,
    1609.344,
    1e-3,
    1e-2,
    1,
    1e3,
    2.54e-8,
    2.54e-5,
    0.9144,
    1e-10,
    1e-9,
    1e-6,
    0.1,
    10,
    100,
    1e9,
    149597870700.0,
    9460730472580800.0,
    3.0856775814913673e16,  // astronomical unit, light year, pc
    1200.0 / 3937,
    100.0 / 3937,
    3600.0 / 3937,
    6336000.0 / 3937};  // US survey ft, in, yd, mile

/// Kinds that are told apart in the notes; all further ones are one.
constexpr size_t max_unread_kinds = 40;

bool finite(const glm::dvec2& p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

std::string counted_words(size_t count, const char* one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

/// Reads the sections of a drawing record by record.
class PlanReader {
 public:
  PlanReader(std::string_view text, ReadingPart* part) : records_(text), part_(part) {}

  Result<DxfPlan> read() {
    DxfRecord record;
    while (!fault_ && !ended_ && records_.next(record)) take(record);
    if (!in_drawing_) return problem("this is no DXF drawing");
    if (!fault_ && records_.fault()) fault_ = records_.fault();
    if (fault_) return *fault_;
    end_polyline();
    if (too_many_)
      return problem(
          fmt::format("more than {} lines or blocks: export the layers of walls and lights alone",
                      limits::dxf_plan_things));
    tell_notes();
    if (plan_.segments.empty() && plan_.inserts.empty()) return nothing_found();
    return std::move(plan_);
  }

 private:
  // ---- sections ------------------------------------------------------------------------------

  void take(const DxfRecord& record) {
    constexpr size_t records_of_a_word = 8192;
    if (part_ != nullptr && ++taken_ % records_of_a_word == 0) part_->at(records_.at());
    if (record.kind == "SECTION") {
      in_drawing_ = true;
      end_block();
      section_ = record.text(2);
      if (section_ == "HEADER") take_header(record);
    } else if (record.kind == "EOF") {
      ended_ = in_drawing_;
    } else if (section_ == "TABLES") {
      if (record.kind == "LAYER") take_layer(record);
    } else if (section_ == "BLOCKS") {
      take_of_block(record);
    } else if (section_ == "ENTITIES" && record.kind != "ENDSEC") {
      take_entity(record);
    }
  }

  void take_header(const DxfRecord& record) {
    std::string_view version, code_page;
    for (size_t i = 0; i + 1 < record.groups.size(); ++i) {
      if (record.groups[i].code != 9) continue;
      const DxfGroup& value = record.groups[i + 1];
      if (record.groups[i].value == "$ACADVER") version = value.value;
      if (record.groups[i].value == "$DWGCODEPAGE") code_page = value.value;
      if (record.groups[i].value == "$INSUNITS") take_unit(value);
    }
    names_ = DxfNames(version, code_page);
  }

  void take_unit(const DxfGroup& group) {
    const auto unit = integer_of(group);
    if (!unit) {
      fault_ = unit.problem();
    } else if (unit.value() < 0 || static_cast<size_t>(unit.value()) >= metres_of_insunits.size()) {
      plan_.unit_problem = fmt::format(
          "the unit of length of the drawing, $INSUNITS = {}, is none "
          "that DXF has",
          unit.value());
    } else {
      plan_.metres_per_unit = metres_of_insunits[static_cast<size_t>(unit.value())];
    }
  }

  void take_layer(const DxfRecord& record) {
    const bool frozen = (integer(record, 70, 0) & 1) != 0, off = integer(record, 62, 7) < 0;
    if (off || frozen) plan_.hidden_layers[names_.utf8(record.text(2))] = frozen ? "frozen" : "off";
  }

  void take_of_block(const DxfRecord& record) {
    constexpr int external_reference = 4;
    if (record.kind == "BLOCK") {
      end_block();
      too_many_ = too_many_ || plan_.blocks.size() >= limits::dxf_plan_things;
      if (too_many_) return;
      block_ = &plan_.blocks[names_.utf8(record.text(2))];
      *block_ = {};
      block_->base = point(record, 0);
      block_->foreign = (integer(record, 70, 0) & external_reference) != 0;
    } else if (record.kind == "ENDBLK" || record.kind == "ENDSEC") {
      end_block();
    } else if (block_ != nullptr) {
      take_entity(record);
    }
  }

  void end_block() {
    end_polyline();
    block_ = nullptr;
  }

  // ---- entities ------------------------------------------------------------------------------

  void take_entity(const DxfRecord& record) {
    const std::string_view kind = record.kind;
    if (kind == "VERTEX" && in_polyline_) return take_vertex(record);
    end_polyline();
    if (kind == "SEQEND" || kind == "VERTEX" || kind == "ATTRIB") return;  // parts of others
    if (kind == "VIEWPORT") return;  // a window of a sheet of paper; each has one
    if (integer(record, 67, 0) == 1) return pass_over(kind, of_paper_);
    if (integer(record, 60, 0) == 1) return pass_over(kind, invisible_);
    constexpr std::array<std::string_view, 8> read_kinds{
        "LINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE", "LWPOLYLINE", "POLYLINE", "INSERT"};
    if (std::find(read_kinds.begin(), read_kinds.end(), kind) == read_kinds.end())
      return leave_out(kind);
    if (record.cut) say_too_many();
    if (kind == "LINE") {
      add(layer_of(record), {point(record, 0), point(record, 1)});
    } else if (kind == "ARC" || kind == "CIRCLE") {
      take_arc(record, kind == "ARC");
    } else if (kind == "ELLIPSE") {
      take_ellipse(record);
    } else if (kind == "SPLINE") {
      take_spline(record);
    } else if (kind == "LWPOLYLINE") {
      take_light_polyline(record);
    } else if (kind == "POLYLINE") {
      begin_polyline(record);
    } else {
      take_insert(record);
    }
  }

  void pass_over(std::string_view kind, size_t& count) {
    if (block_ == nullptr) ++count;
    in_polyline_ = skips_polyline_ = kind == "POLYLINE";  // with its vertices
  }

  void take_arc(const DxfRecord& record, bool part_of_it) {
    const DxfAxes axes = axes_of(record);
    const double radius = number(record, 40, 0), degree = std::numbers::pi / 180;
    const double from = part_of_it ? number(record, 50, 0) : 0;
    const double to = part_of_it ? number(record, 51, 360) : 360;
    add(layer_of(record),
        elliptic_arc(axes.plan(solid_point(record, 0)), radius * glm::dvec2(axes.x),
                     radius * glm::dvec2(axes.y), from * degree, to * degree));
  }

  void take_ellipse(const DxfRecord& record) {
    const DxfAxes axes = axes_of(record);
    const glm::dvec3 major = solid_point(record, 1);
    const glm::dvec3 minor = glm::cross(axes.z, major) * number(record, 40, 1);
    add(layer_of(record),
        elliptic_arc(point(record, 0), glm::dvec2(major), glm::dvec2(minor), number(record, 41, 0),
                     number(record, 42, 2 * std::numbers::pi)));
  }

  void take_spline(const DxfRecord& record) {
    const std::vector<double> knots = numbers(record, 40), weights = numbers(record, 41);
    const std::vector<glm::dvec2> corners = points(record, 10, 20), fit = points(record, 11, 21);
    std::vector<glm::dvec2> curve = b_spline(integer(record, 71, 3), knots, corners, weights);
    if (curve.empty() && fit.size() >= 2) {
      // No sound curve through these points is stated: lines between them are close to it.
      curve = fit;
      if ((integer(record, 70, 0) & 1) != 0) curve.push_back(fit.front());
    }
    if (curve.empty()) return leave_out("SPLINE whose knots do not fit its points");
    add(layer_of(record), curve);
  }

  void take_light_polyline(const DxfRecord& record) {
    polyline_ = {};
    polyline_.layer = layer_of(record);
    polyline_.closed = (integer(record, 70, 0) & 1) != 0;
    polyline_.axes = axes_of(record);
    const double height = number(record, 38, 0);
    for (const DxfGroup& group : record.groups) {
      if (group.code == 10)
        polyline_.corners.push_back({{value(group), 0, height}, 0});
      else if (group.code == 20 && !polyline_.corners.empty())
        polyline_.corners.back().at.y = value(group);
      else if (group.code == 42 && !polyline_.corners.empty())
        polyline_.corners.back().bulge = value(group);
    }
    in_polyline_ = true;
    end_polyline();
  }

  void begin_polyline(const DxfRecord& record) {
    constexpr int of_lines_in_space = 8, mesh = 16, polyface_mesh = 64;
    const int flags = integer(record, 70, 0);
    in_polyline_ = true;
    skips_polyline_ = (flags & (mesh | polyface_mesh)) != 0;
    if (skips_polyline_) return leave_out("POLYLINE that is a mesh");
    polyline_ = {};
    polyline_.layer = layer_of(record);
    polyline_.closed = (flags & 1) != 0;
    polyline_.axes =
        DxfAxes((flags & of_lines_in_space) != 0 ? glm::dvec3(0, 0, 1) : extrusion_of(record));
  }

  void take_vertex(const DxfRecord& record) {
    constexpr int of_spline_frame = 16;
    if (skips_polyline_ || (integer(record, 70, 0) & of_spline_frame) != 0) return;
    if (polyline_.corners.size() >= limits::dxf_plan_things) return say_too_many();
    polyline_.corners.push_back({solid_point(record, 0), number(record, 42, 0)});
  }

  /// Ends the last polyline, because some files do not mark its end.
  void end_polyline() {
    if (!in_polyline_) return;
    in_polyline_ = false;
    if (std::exchange(skips_polyline_, false)) return;
    const auto& corners = polyline_.corners;
    const size_t sides = corners.size() < 2 ? 0 : corners.size() - (polyline_.closed ? 0 : 1);
    std::vector<glm::dvec2> way;
    for (size_t i = 0; i < sides; ++i) {
      const auto& [from, bulge] = corners[i];
      const glm::dvec3& to = corners[(i + 1) % corners.size()].at;
      if (way.empty()) way.push_back(polyline_.axes.plan(from));
      for (const glm::dvec2& p : bulged_side(glm::dvec2(from), glm::dvec2(to), bulge))
        way.push_back(polyline_.axes.plan({p, to.z}));
    }
    add(polyline_.layer, way);
  }

  void take_insert(const DxfRecord& record) {
    const DxfAxes axes = axes_of(record);
    const double turn = number(record, 50, 0) * std::numbers::pi / 180;
    const glm::dvec3 along(std::cos(turn), std::sin(turn), 0);
    const glm::dvec3 across(-along.y, along.x, 0);
    const bool back = number(record, 41, 1) < 0, down = number(record, 42, 1) < 0;
    const glm::dvec2 x = axes.plan(back ? -along : along), y = axes.plan(down ? -across : across);
    DxfInsert insert;
    insert.block = names_.utf8(record.text(2));
    insert.layer = layer_of(record);
    const double degrees = std::atan2(x.y, x.x) * 180 / std::numbers::pi;
    insert.rotation_deg = std::round((degrees < 0 ? degrees + 360 : degrees) * 1e9) / 1e9;
    insert.mirrored = x.x * y.y - x.y * y.x < 0;
    insert.axes = {x * std::abs(number(record, 41, 1)), y * std::abs(number(record, 42, 1))};
    if (std::abs(axes.z.z) < 1 - 1e-6 && block_ == nullptr) ++tilted_;
    const int columns = std::max(1, integer(record, 70, 1)),
              rows = std::max(1, integer(record, 71, 1));
    const double width = number(record, 44, 0), height = number(record, 45, 0);
    const glm::dvec3 corner = solid_point(record, 0);
    if (static_cast<size_t>(columns) > limits::dxf_plan_things ||
        static_cast<size_t>(rows) > limits::dxf_plan_things ||
        insert_count() + static_cast<size_t>(columns) * static_cast<size_t>(rows) >
            limits::dxf_plan_things)
      return say_too_many();
    insert_count() += static_cast<size_t>(columns) * static_cast<size_t>(rows);
    std::vector<DxfInsert>& inserts = block_ != nullptr ? block_->inserts : plan_.inserts;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        insert.at = axes.plan(corner + column * width * along + row * height * across);
        if (finite(insert.at)) inserts.push_back(insert);
      }
    }
  }

  // ---- values --------------------------------------------------------------------------------

  double value(const DxfGroup& group) {
    const auto number = number_of(group);
    if (!number) say_fault(number.problem());
    return number ? number.value() : 0;
  }
  double number(const DxfRecord& record, int code, double otherwise) {
    const DxfGroup* group = record.find(code);
    return group != nullptr ? value(*group) : otherwise;
  }
  int integer(const DxfRecord& record, int code, int otherwise) {
    const DxfGroup* group = record.find(code);
    if (group == nullptr) return otherwise;
    const auto number = integer_of(*group);
    if (!number) say_fault(number.problem());
    return number ? number.value() : otherwise;
  }
  /// Point `index` of a record: codes 10 + index, 20 + index, 30 + index.
  glm::dvec3 solid_point(const DxfRecord& record, int index) {
    return {number(record, 10 + index, 0), number(record, 20 + index, 0),
            number(record, 30 + index, 0)};
  }
  glm::dvec2 point(const DxfRecord& record, int index) {
    return glm::dvec2(solid_point(record, index));
  }
  glm::dvec3 extrusion_of(const DxfRecord& record) {
    return {number(record, 210, 0), number(record, 220, 0), number(record, 230, 1)};
  }
  DxfAxes axes_of(const DxfRecord& record) { return DxfAxes(extrusion_of(record)); }
  std::vector<double> numbers(const DxfRecord& record, int code) {
    std::vector<double> out;
    for (const DxfGroup& group : record.groups)
      if (group.code == code) out.push_back(value(group));
    return out;
  }
  std::vector<glm::dvec2> points(const DxfRecord& record, int code_x, int code_y) {
    std::vector<glm::dvec2> out;
    for (const DxfGroup& group : record.groups) {
      if (group.code == code_x) out.emplace_back(value(group), 0);
      if (group.code == code_y && !out.empty()) out.back().y = value(group);
    }
    return out;
  }
  const std::string& layer_of(const DxfRecord& record) {
    const std::string_view name = record.text(8);
    return names_.utf8(name.empty() ? "0" : name);
  }

  // ---- what is found -------------------------------------------------------------------------

  void add(const std::string& layer, const std::vector<glm::dvec2>& way) {
    std::vector<DxfSegment>& segments = block_ != nullptr ? block_->segments : plan_.segments;
    for (size_t i = 0; i + 1 < way.size(); ++i) {
      if (!finite(way[i]) || !finite(way[i + 1]) || way[i] == way[i + 1]) continue;
      if (++segment_count() > limits::dxf_plan_things) return say_too_many();
      segments.push_back({layer, way[i], way[i + 1]});
    }
  }

  void leave_out(std::string_view kind) {
    auto& unread = block_ != nullptr ? block_->unread : unread_;
    const bool told_apart = unread.size() < max_unread_kinds;
    ++unread[told_apart || unread.contains(std::string(kind)) ? std::string(kind)
                                                              : "entities of other kinds"];
  }

  size_t& segment_count() { return segments_of_[block_ != nullptr ? 1 : 0]; }
  size_t& insert_count() { return inserts_of_[block_ != nullptr ? 1 : 0]; }

  // Many drawings carry libraries of blocks that nobody opens: these are no reason to reject them.
  void say_fault(const Problem& fault) {
    std::optional<Problem>& of_it = block_ != nullptr ? block_->problem : fault_;
    if (!of_it) of_it = fault;
  }
  void say_too_many() {
    if (block_ == nullptr)
      too_many_ = true;
    else
      say_fault(problem(fmt::format("the blocks of the drawing hold more than {} lines or blocks",
                                    limits::dxf_plan_things)));
  }

  void tell_notes() {
    std::vector<std::string>& notes = plan_.notes;
    for (const auto& [kind, count] : unread_)
      notes.push_back(fmt::format("not read: {} {}", count, excerpt(kind)));
    if (of_paper_ > 0)
      notes.push_back(fmt::format("not read: {} of the paper space, whose sheets are no building",
                                  counted_words(of_paper_, "thing")));
    if (invisible_ > 0)
      notes.push_back(
          fmt::format("not read: {} set invisible", counted_words(invisible_, "thing")));
    std::map<std::string, size_t> on_layer, of_block;
    for (const DxfSegment& s : plan_.segments) ++on_layer[s.layer];
    for (const DxfInsert& i : plan_.inserts) ++on_layer[i.layer], ++of_block[i.block];
    for (const auto& [layer, state] : plan_.hidden_layers)
      if (const auto it = on_layer.find(layer); it != on_layer.end())
        notes.push_back(
            fmt::format("the layer \"{}\" is {} in the drawing; what is on it ({}) is "
                        "read all the same",
                        excerpt(layer), state, counted_words(it->second, "thing")));
    for (const auto& [name, count] : of_block)
      if (const auto it = plan_.blocks.find(name); it != plan_.blocks.end() && it->second.foreign)
        notes.push_back(
            fmt::format("the block \"{}\" is another drawing (an external reference), "
                        "which is not read: bind it",
                        excerpt(name)));
    if (tilted_ > 0)
      notes.push_back(
          fmt::format("{} tilted against the plan: places and turns are those seen "
                      "from above",
                      counted_words(tilted_, "block") + (tilted_ == 1 ? " is" : " are")));
    for (std::string& note : names_.notes()) notes.push_back(std::move(note));
    if (!ended_)
      notes.emplace_back("the drawing does not end with EOF: it may have been cut short");
  }

  Problem nothing_found() const {
    std::string what =
        "there are no lines, polylines, arcs or blocks in the model space of this drawing";
    for (size_t i = 0; i < plan_.notes.size(); ++i)
      what += (i == 0 ? " (" : "; ") + plan_.notes[i] + (i + 1 == plan_.notes.size() ? ")" : "");
    return problem(what);
  }

  struct Corner {
    glm::dvec3 at;
    double bulge = 0;
  };
  struct Polyline {
    std::string layer;
    bool closed = false;
    DxfAxes axes{glm::dvec3(0, 0, 1)};
    std::vector<Corner> corners;
  };

  DxfRecords records_;
  ReadingPart* part_;
  DxfNames names_{"", ""};
  DxfPlan plan_;
  std::optional<Problem> fault_;
  std::string section_;
  DxfBlock* block_ = nullptr;  // whose contents are being read; null in the model space
  Polyline polyline_;
  bool in_drawing_ = false, ended_ = false, too_many_ = false;
  bool in_polyline_ = false, skips_polyline_ = false;
  std::array<size_t, 2> segments_of_{}, inserts_of_{};  // the model space, and all blocks
  size_t taken_ = 0, of_paper_ = 0, invisible_ = 0, tilted_ = 0;
  std::map<std::string, size_t> unread_;
};

/// Why the bytes are no DXF in text; nothing where they may be.
std::optional<std::string> other_kind(std::string_view text) {
  if (text.starts_with("AutoCAD Binary DXF"))
    return "this is a drawing in binary DXF: save it as DXF in text (ASCII)";
  if (text.starts_with("AC10") || text.starts_with("AC1.") || text.starts_with("AC2."))
    return "this is a DWG drawing: save it as DXF in text (ASCII)";
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    return "this is text in UTF-16: save it as DXF in ASCII or UTF-8";
  return std::nullopt;
}

}  // namespace

Result<DxfPlan> dxf_plan_of(const std::string& text, const std::string& file, ReadingPart* part) {
  if (const auto other = other_kind(text)) return problem_in(file, *other);
  std::string_view drawing = text;
  if (drawing.starts_with("\xef\xbb\xbf")) drawing.remove_prefix(3);  // byte order mark
  auto plan = PlanReader(drawing, part).read();
  if (!plan) return problem_in(file, plan.problem().where.line, plan.problem());
  return plan;
}

Result<DxfPlan> read_dxf_plan(const fs::path& file, ReadingShare* reading) {
  std::error_code unknown;
  const uint64_t bytes = fs::file_size(file, unknown);
  ReadingPart part(reading, unknown ? 0 : bytes);
  const auto text = read_regular_file(file, limits::dxf_plan_bytes);
  if (!text) return text.problem();
  return dxf_plan_of(text.value(), file.string(), &part);
}

}  // namespace luxodus
