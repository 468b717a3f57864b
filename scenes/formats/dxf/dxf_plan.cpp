#include "scenes/formats/dxf/dxf_plan.hpp"

#include <dxflib/dl_creationadapter.h>
#include <dxflib/dl_dxf.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "runtime/core/isolated_job.hpp"
#include "runtime/core/reading_share.hpp"
#include "runtime/core/regular_file.hpp"

namespace luxodus {
namespace {

namespace fs = std::filesystem;

/// dxflib holds one group at a time; the result takes a few times the memory of the text.
constexpr IsolatedLimits dxf_limits{uint64_t{2} << 30, 60};

/// A quarter of a circle becomes this many chords: they deviate by 0.5 % of the radius.
constexpr int chords_of_quarter = 8;

/// Metres per unit of the header's $INSUNITS; 0 for codes that are no lengths used in buildings.
double metres_of(int insunits) {
  switch (insunits) {
    case 1:
      return 0.0254;
    case 2:
      return 0.3048;
    case 4:
      return 1e-3;
    case 5:
      return 1e-2;
    case 6:
      return 1;
    case 7:
      return 1e3;
    default:
      return 0;
  }
}

bool finite(const glm::dvec2& p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

/// Collects what dxflib reports.
class PlanCollector : public DL_CreationAdapter {
 public:
  /// Collects from a text of `bytes` bytes, read from `text`, which outlives this.
  PlanCollector(std::istream& text, size_t bytes) : text_(text), bytes_(bytes) {}

  DxfPlan plan;
  bool too_many = false;

  /// dxflib calls it for every group of the text: a code and a value.
  void processCodeValuePair(unsigned int, const std::string&) override {
    constexpr size_t groups_of_a_word = 65'536;
    if (++groups_ % groups_of_a_word != 0) return;
    const auto at = static_cast<double>(std::max<std::streamoff>(0, text_.tellg()));
    tell_share(std::min(1.0, at / static_cast<double>(bytes_)));
  }
  void setVariableInt(const std::string& key, int value, int) override {
    if (key == "$INSUNITS") plan.metres_per_unit = metres_of(value);
  }
  void addBlock(const DL_BlockData&) override { in_block_ = true; }
  void endBlock() override { in_block_ = false; }

  void addLine(const DL_LineData& line) override { add({line.x1, line.y1}, {line.x2, line.y2}); }
  void addArc(const DL_ArcData& arc) override {
    double sweep = arc.angle2 - arc.angle1;
    if (sweep <= 0) sweep += 360;
    if (!(sweep > 0 && sweep <= 360)) return;
    const glm::dvec2 centre(arc.cx, arc.cy);
    const auto at = [&](double degrees) {
      const double a = degrees * std::numbers::pi / 180;
      return centre + arc.radius * glm::dvec2(std::cos(a), std::sin(a));
    };
    const int chords = static_cast<int>(std::ceil(sweep / 90 * chords_of_quarter));
    for (int i = 0; i < chords; ++i)
      add(at(arc.angle1 + sweep * i / chords), at(arc.angle1 + sweep * (i + 1) / chords));
  }

  void addPolyline(const DL_PolylineData& polyline) override {
    end_polyline();
    closed_ = (polyline.flags & 1) != 0;
    polyline_layer_ = attributes.getLayer();
    in_polyline_ = true;
  }
  void addVertex(const DL_VertexData& vertex) override {
    if (in_polyline_ && vertices_.size() < limits::dxf_plan_things)
      vertices_.push_back({{vertex.x, vertex.y}, vertex.bulge});
  }
  void endEntity() override { end_polyline(); }
  void endSequence() override { end_polyline(); }

  void addInsert(const DL_InsertData& insert) override {
    const glm::dvec2 at(insert.ipx, insert.ipy);
    if (in_block_ || !finite(at) || !std::isfinite(insert.angle)) return;
    if (plan.inserts.size() >= limits::dxf_plan_things) {
      too_many = true;
      return;
    }
    plan.inserts.push_back({insert.name, attributes.getLayer(), at, std::fmod(insert.angle, 360)});
  }

  /// Ends the last polyline, because some files do not mark its end.
  void end_polyline() {
    if (!in_polyline_) return;
    in_polyline_ = false;
    const size_t sides = vertices_.size() < 2 ? 0 : vertices_.size() - (closed_ ? 0 : 1);
    for (size_t i = 0; i < sides; ++i) {
      const auto& [from, bulge] = vertices_[i];
      add_bulged(from, vertices_[(i + 1) % vertices_.size()].first, bulge, polyline_layer_);
    }
    vertices_.clear();
  }

 private:
  void add(const glm::dvec2& from, const glm::dvec2& to) { add(from, to, attributes.getLayer()); }
  void add(const glm::dvec2& from, const glm::dvec2& to, const std::string& on) {
    if (in_block_ || !finite(from) || !finite(to) || from == to) return;
    if (plan.segments.size() >= limits::dxf_plan_things) {
      too_many = true;
      return;
    }
    plan.segments.push_back({on, from, to});
  }

  /// Adds a side with a bulge, the tangent of a quarter of its arc's angle.
  void add_bulged(const glm::dvec2& from, const glm::dvec2& to, double bulge,
                  const std::string& on) {
    const double angle = 4 * std::atan(bulge);
    if (!std::isfinite(angle) || std::abs(angle) < 1e-6) return add(from, to, on);
    const glm::dvec2 chord = to - from;
    const glm::dvec2 centre =
        (from + to) / 2.0 + glm::dvec2(-chord.y, chord.x) * ((1 - bulge * bulge) / (4 * bulge));
    const int chords =
        static_cast<int>(std::ceil(std::abs(angle) / (std::numbers::pi / 2) * chords_of_quarter));
    glm::dvec2 last = from;
    for (int i = 1; i <= chords; ++i) {
      const double a = angle * i / chords;
      const glm::dvec2 r = from - centre;
      const glm::dvec2 next = i == chords
                                  ? to
                                  : centre + glm::dvec2(r.x * std::cos(a) - r.y * std::sin(a),
                                                        r.x * std::sin(a) + r.y * std::cos(a));
      add(last, next, on);
      last = next;
    }
  }

  std::istream& text_;
  size_t bytes_, groups_ = 0;
  bool in_block_ = false, in_polyline_ = false, closed_ = false;
  std::string polyline_layer_;
  std::vector<std::pair<glm::dvec2, double>> vertices_;
};

// ---- from process to process --------------------------------------------------------------------

void dxf_answer(PlainReader& question, PlainWriter& out) {
  std::string path;
  if (!question.get(path)) throw std::runtime_error("no question");
  const auto text = read_regular_file(path, limits::dxf_plan_bytes);
  const auto plan = text ? dxf_plan_of(text.value(), path) : text.problem();
  out.put(static_cast<uint8_t>(plan.ok()));
  if (!plan) return out.put(plan.problem());
  out.put(plan->metres_per_unit);
  out.put(static_cast<uint64_t>(plan->segments.size()));
  for (const DxfSegment& s : plan->segments) {
    out.put(s.layer);
    out.put(s.from);
    out.put(s.to);
  }
  out.put(static_cast<uint64_t>(plan->inserts.size()));
  for (const DxfInsert& i : plan->inserts) {
    out.put(i.block);
    out.put(i.layer);
    out.put(i.at);
    out.put(i.rotation_deg);
  }
}

const IsolatedJob dxf_job("dxf", dxf_answer);

bool get(PlainReader& in, DxfPlan& plan) {
  uint64_t count = 0;
  if (!in.get(plan.metres_per_unit) || !in.get(count) || count > limits::dxf_plan_things)
    return false;
  plan.segments.resize(count);
  for (DxfSegment& s : plan.segments)
    if (!in.get(s.layer) || !in.get(s.from) || !in.get(s.to) || !finite(s.from) || !finite(s.to))
      return false;
  if (!in.get(count) || count > limits::dxf_plan_things) return false;
  plan.inserts.resize(count);
  for (DxfInsert& i : plan.inserts)
    if (!in.get(i.block) || !in.get(i.layer) || !in.get(i.at) || !in.get(i.rotation_deg) ||
        !finite(i.at) || !std::isfinite(i.rotation_deg))
      return false;
  return true;
}

}  // namespace

Result<DxfPlan> dxf_plan_of(const std::string& text, const std::string& file) {
  if (text.starts_with("AutoCAD Binary DXF") || text.starts_with("AC10"))
    return problem_in(file, "this is a binary drawing (DWG, binary DXF): save it as DXF in text");
  std::istringstream stream(text);
  PlanCollector collector(stream, text.size());
  DL_Dxf reader;
  if (!reader.in(stream, &collector)) return problem_in(file, "this is no DXF drawing");
  collector.end_polyline();
  if (collector.too_many)
    return problem_in(file, fmt::format("more than {} lines or blocks: export the layers of walls "
                                        "and lights alone",
                                        limits::dxf_plan_things));
  if (collector.plan.segments.empty() && collector.plan.inserts.empty())
    return problem_in(file, "there are no lines, polylines, arcs or blocks in this drawing");
  return std::move(collector.plan);
}

Result<DxfPlan> read_dxf_plan(const fs::path& file, ReadingShare* reading) {
  const std::string name = file.string();
  std::error_code unknown;
  const uint64_t bytes = fs::file_size(file, unknown);
  ReadingPart part(reading, unknown ? 0 : bytes);
  auto in = dxf_job.run([&](PlainWriter& question) { question.put(name); }, dxf_limits,
                        [&](double share) { part.at_share(share); });
  if (!in) return problem_in(name, in.problem());
  const Problem damaged = problem_in(name, "cannot be read: the reader gave no sound answer");
  uint8_t good = 0;
  if (!in->get(good)) return damaged;
  if (good != 1) {
    Problem why;
    return in->get(why) ? problem_in(name, std::move(why)) : damaged;
  }
  DxfPlan plan;
  if (!get(in.value(), plan)) return damaged;
  return plan;
}

}  // namespace luxodus
