#include "scenes/formats/ifc/step_solids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "scenes/formats/ifc/placements.hpp"
#include "scenes/formats/ifc/profiles.hpp"
#include "scenes/light/geometry/half_space.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"
#include "scenes/light/geometry/polygon.hpp"

namespace luxodus {

namespace {

/// A prism over a profile; the top is moved by `way`.
std::optional<Mesh> prism(const IfcProfile& profile, const glm::dvec3& way) {
  std::vector<Outline> rings{profile.outline};
  rings.insert(rings.end(), profile.holes.begin(), profile.holes.end());
  const auto triangles = fill(rings);
  if (!triangles) return std::nullopt;
  Mesh out;
  for (const Outline& ring : rings)
    for (const glm::dvec2& p : ring) out.positions.emplace_back(p, 0);
  const auto n = static_cast<uint32_t>(out.positions.size());
  for (uint32_t i = 0; i < n; ++i) out.positions.push_back(out.positions[i] + way);
  for (const glm::uvec3& t : *triangles) {
    out.triangles.push_back({t.x, t.z, t.y});
    out.triangles.push_back({t.x + n, t.y + n, t.z + n});
  }
  uint32_t first = 0;
  for (const Outline& ring : rings) {
    const auto size = static_cast<uint32_t>(ring.size());
    for (uint32_t i = 0; i < size; ++i) {
      const uint32_t a = first + i, b = first + (i + 1) % size;
      out.triangles.push_back({a, b, b + n});
      out.triangles.push_back({a, b + n, a + n});
    }
    first += size;
  }
  return out;
}

/// A base and a point above it.
Mesh spire(const Outline& base, const glm::dvec3& tip) {
  Mesh out;
  for (const glm::dvec2& p : base) out.positions.emplace_back(p, 0);
  const auto n = static_cast<uint32_t>(base.size());
  out.positions.push_back(tip);
  for (uint32_t i = 0; i < n; ++i) {
    if (i > 1) out.triangles.push_back({0, i, i - 1});
    out.triangles.push_back({i, (i + 1) % n, n});
  }
  return out;
}

/// One solid from its instances. Operands may form a graph, in which a few instances stand for a
/// tree of exponential size: what was made of an instance is remembered. Nothing is remembered of
/// one that gives no solid, since then the whole gives none.
class Solids {
 public:
  Solids(StepGraph& graph, double one_place, SolidBudget& budget)
      : graph_(graph), one_place_(one_place), budget_(budget) {}

  std::optional<Mesh> of(const StepNode& item, int depth = 0) {
    if (!item || depth > limits::solid_depth || budget_.is_spent()) return std::nullopt;
    if (const auto known = known_.find(item.id()); known != known_.end()) return known->second;
    if (item.is("IFCCSGSOLID")) return of(graph_.follow(item, 0), depth + 1);
    std::optional<Mesh> out = made(item, depth);
    if (!out || out->triangles.size() > limits::solid_triangles ||
        !budget_.spend(out->triangles.size()))
      return std::nullopt;
    for (const glm::dvec3& p : out->positions)
      if (!is_finite(p)) return std::nullopt;
    const double volume = signed_volume_of(*out);
    if (!std::isfinite(volume)) return std::nullopt;
    if (volume < 0) flip(*out);
    remembered_ += out->triangles.size();
    if (depth > 0 && remembered_ <= limits::remembered_triangles) known_.emplace(item.id(), *out);
    return out;
  }

 private:
  std::optional<Mesh> made(const StepNode& item, int depth) {
    if (item.is("IFCBOOLEANRESULT") || item.is("IFCBOOLEANCLIPPINGRESULT"))
      return operation(item, depth);
    if (item.is("IFCEXTRUDEDAREASOLID")) return extrusion(item);
    if (item.is("IFCFACETEDBREP")) return brep(item);
    if (item.is("IFCTRIANGULATEDFACESET")) return triangulated(item);
    if (item.is("IFCPOLYGONALFACESET")) return polygonal(item);
    return primitive(item);
  }

  std::optional<Mesh> placed(std::optional<Mesh> mesh, const StepNode& axes) {
    if (!mesh) return mesh;
    const Transform place = axis_placement(graph_, axes);
    for (glm::dvec3& p : mesh->positions) p = place.point(p);
    return mesh;
  }

  std::optional<Mesh> extrusion(const StepNode& item) {
    const auto profile = ifc_profile(graph_, graph_.follow(item, 0));
    const auto way = unit_vector(vector_of(graph_.follow(item, 2), {0, 0, 1}));
    const double depth = item.number(3).value_or(0);
    if (!profile || !way || !(depth > 0) || std::abs(way->z) < 1e-6) return std::nullopt;
    return placed(prism(*profile, depth * *way), graph_.follow(item, 1));
  }

  std::optional<Mesh> primitive(const StepNode& item) {
    const auto n = [&](size_t place) { return item.number(place).value_or(0); };
    std::optional<Mesh> out;
    if (item.is("IFCBLOCK") && n(1) > 0 && n(2) > 0 && n(3) > 0)
      out = prism({{{0, 0}, {n(1), 0}, {n(1), n(2)}, {0, n(2)}}, {}}, {0, 0, n(3)});
    if (item.is("IFCRIGHTCIRCULARCYLINDER") && n(1) > 0 && n(2) > 0)
      out = prism({ellipse_points(n(2), n(2)), {}}, {0, 0, n(1)});
    if (item.is("IFCRIGHTCIRCULARCONE") && n(1) > 0 && n(2) > 0)
      out = spire(ellipse_points(n(2), n(2)), {0, 0, n(1)});
    if (item.is("IFCRECTANGULARPYRAMID") && n(1) > 0 && n(2) > 0 && n(3) > 0)
      out = spire({{0, 0}, {n(1), 0}, {n(1), n(2)}, {0, n(2)}}, {n(1) / 2, n(2) / 2, n(3)});
    return placed(std::move(out), graph_.follow(item, 0));
  }

  // ---- faces

  /// Adds a flat face with holes; `rings` hold numbers of positions.
  bool add_face(Mesh& mesh, std::vector<std::vector<uint32_t>> rings) {
    if (rings.empty()) return false;
    glm::dvec3 normal(0);  // Newell
    const auto& outer = rings.front();
    for (size_t i = 0; i < outer.size(); ++i)
      normal +=
          glm::cross(mesh.positions[outer[i]] - mesh.positions[outer[0]],
                     mesh.positions[outer[(i + 1) % outer.size()]] - mesh.positions[outer[0]]);
    const auto n = unit_vector(normal);
    if (!n) return false;
    const glm::dvec3 u = glm::normalize(
        glm::cross(std::abs(n->z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0), *n));
    const glm::dvec3 v = glm::cross(*n, u);
    std::vector<Outline> flat;
    std::vector<uint32_t> number;
    for (auto& ring : rings) {
      Outline points;
      for (const uint32_t i : ring)
        points.emplace_back(glm::dot(u, mesh.positions[i]), glm::dot(v, mesh.positions[i]));
      if (!flat.empty() && points.size() >= 3 && signed_area(points) > 0) {
        std::reverse(points.begin(), points.end());
        std::reverse(ring.begin(), ring.end());
      }
      flat.push_back(std::move(points));
      number.insert(number.end(), ring.begin(), ring.end());
    }
    if (!budget_.spend(number.size())) return false;
    const auto triangles = fill(flat);
    if (!triangles) return false;
    for (const glm::uvec3& t : *triangles)
      mesh.triangles.push_back({number[t.x], number[t.y], number[t.z]});
    return mesh.triangles.size() <= limits::solid_triangles;
  }

  std::optional<Mesh> brep(const StepNode& item) {
    Mesh out;
    std::map<uint64_t, uint32_t> numbers;
    for (const uint64_t face : graph_.follow(item, 0).references(0)) {
      std::vector<std::vector<uint32_t>> rings;
      for (const uint64_t id : graph_.node(face).references(0)) {
        const StepNode bound = graph_.node(id);
        std::vector<uint32_t> ring;
        for (const uint64_t point : graph_.follow(bound, 0).references(0)) {
          const auto [at, fresh] =
              numbers.try_emplace(point, static_cast<uint32_t>(out.positions.size()));
          if (fresh) out.positions.push_back(vector_of(graph_.node(point), glm::dvec3(0)));
          ring.push_back(at->second);
        }
        if (bound.word(1) == "F") std::reverse(ring.begin(), ring.end());
        const bool outer = bound.is("IFCFACEOUTERBOUND");
        rings.insert(outer ? rings.begin() : rings.end(), std::move(ring));
      }
      if (!add_face(out, std::move(rings))) return std::nullopt;
    }
    join_identical_vertices(out);
    return out;
  }

  bool read_points(const StepNode& list, Mesh& to) {
    for (const StepValue& row : list.at(0).items) {
      if (row.items.size() < 3) return false;
      to.positions.emplace_back(row.items[0].number, row.items[1].number, row.items[2].number);
    }
    return !to.positions.empty();
  }

  static bool add_index(const StepValue& value, size_t points, std::vector<uint32_t>& to) {
    if (!(value.number >= 1 && value.number <= static_cast<double>(points))) return false;
    to.push_back(static_cast<uint32_t>(value.number) - 1);
    return true;
  }

  std::optional<Mesh> triangulated(const StepNode& item) {
    Mesh out;
    if (!read_points(graph_.follow(item, 0), out)) return std::nullopt;
    for (const StepValue& row : item.at(3).items) {
      std::vector<uint32_t> corners;
      for (const StepValue& index : row.items)
        if (!add_index(index, out.positions.size(), corners)) return std::nullopt;
      if (corners.size() != 3 || out.triangles.size() > limits::solid_triangles)
        return std::nullopt;
      out.triangles.push_back({corners[0], corners[1], corners[2]});
    }
    join_identical_vertices(out);
    return out;
  }

  std::optional<Mesh> polygonal(const StepNode& item) {
    Mesh out;
    if (!read_points(graph_.follow(item, 0), out)) return std::nullopt;
    for (const uint64_t id : item.references(2)) {
      const StepNode face = graph_.node(id);
      std::vector<std::vector<uint32_t>> rings(1);
      for (const StepValue& index : face.at(0).items)
        if (!add_index(index, out.positions.size(), rings[0])) return std::nullopt;
      for (const StepValue& hole : face.at(1).items) {
        rings.emplace_back();
        for (const StepValue& index : hole.items)
          if (!add_index(index, out.positions.size(), rings.back())) return std::nullopt;
      }
      if (!add_face(out, std::move(rings))) return std::nullopt;
    }
    join_identical_vertices(out);
    return out;
  }

  // ---- operations

  std::optional<Mesh> operation(const StepNode& item, int depth) {
    auto first = of(graph_.follow(item, 1), depth + 1);
    if (!first) return std::nullopt;
    const StepNode second = graph_.follow(item, 2);
    const std::string what = item.word(0);
    if (what != "DIFFERENCE" && what != "INTERSECTION") return std::nullopt;
    const bool cuts_off = what == "DIFFERENCE";
    if (const auto space = half_space(second)) {
      if (!second.is("IFCPOLYGONALBOUNDEDHALFSPACE"))
        return part(*first, cuts_off ? space->complement() : *space);
      auto pieces = bounds(second);
      if (!pieces) return std::nullopt;
      for (auto& sides : *pieces) sides.push_back(*space);
      return pieces_cut(*first, *pieces, cuts_off);
    }
    const auto body = of(second, depth + 1);
    const auto sides = body ? sides_of_convex(*body) : std::nullopt;
    if (!sides) return std::nullopt;
    return pieces_cut(*first, {*sides}, cuts_off);
  }

  /// The half spaces that a convex body is the intersection of; nothing if it is not convex.
  std::optional<std::vector<HalfSpace>> sides_of_convex(const Mesh& mesh) const {
    std::vector<HalfSpace> out;
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::dvec3 a = mesh.positions[t.x];
      const auto n = unit_vector(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a));
      if (!n) continue;
      const HalfSpace side{*n, glm::dot(*n, a)};
      const bool known = std::any_of(out.begin(), out.end(), [&](const HalfSpace& other) {
        return glm::dot(other.normal, side.normal) > 1 - 1e-12 &&
               std::abs(other.offset - side.offset) < one_place_;
      });
      if (known) continue;
      for (const glm::dvec3& p : mesh.positions)
        if (glm::dot(*n, p) > side.offset + 2 * one_place_) return std::nullopt;
      if (out.size() >= 2 * limits::bounding_sides) return std::nullopt;
      out.push_back(side);
    }
    return out;
  }

  /// The half space that an IfcHalfSpaceSolid fills.
  std::optional<HalfSpace> half_space(const StepNode& item) {
    if (!item.is("IFCHALFSPACESOLID") && !item.is("IFCBOXEDHALFSPACE") &&
        !item.is("IFCPOLYGONALBOUNDEDHALFSPACE"))
      return std::nullopt;
    const StepNode plane = graph_.follow(item, 0);
    if (!plane.is("IFCPLANE")) return std::nullopt;
    const Transform place = axis_placement(graph_, graph_.follow(plane, 0));
    const HalfSpace below{place.linear[2], glm::dot(place.linear[2], place.offset)};
    // By the schema the normal points away from the material where the flag is true.
    return item.word(1) == "F" ? below.complement() : below;
  }

  /// Convex pieces of the outline that bounds a half space, as half spaces of its sides.
  std::optional<std::vector<std::vector<HalfSpace>>> bounds(const StepNode& item) {
    const auto points = curve_points(graph_, graph_.follow(item, 3));
    if (!points || points->size() < 3 || points->size() > limits::bounding_sides)
      return std::nullopt;
    Outline outline = *points;
    if (signed_area(outline) < 0) std::reverse(outline.begin(), outline.end());
    std::vector<Outline> pieces{outline};
    if (!is_convex(outline)) {
      const auto triangles = fill(pieces);
      if (!triangles) return std::nullopt;
      pieces.clear();
      for (const glm::uvec3& t : *triangles)
        pieces.push_back({outline[t.x], outline[t.y], outline[t.z]});
    }
    const Transform place = axis_placement(graph_, graph_.follow(item, 2));
    std::vector<std::vector<HalfSpace>> out;
    for (const Outline& piece : pieces) {
      auto& sides = out.emplace_back();
      for (size_t i = 0; i < piece.size(); ++i) {
        const glm::dvec2 a = piece[i], way = piece[(i + 1) % piece.size()] - a;
        if (!(glm::length(way) > 0)) continue;
        const glm::dvec3 n = place.vector(glm::dvec3(glm::normalize(glm::dvec2(way.y, -way.x)), 0));
        sides.push_back({n, glm::dot(n, place.point({a, 0}))});
      }
    }
    return out;
  }

  static bool is_convex(const Outline& outline) {
    for (size_t i = 0; i < outline.size(); ++i) {
      const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()],
                       c = outline[(i + 2) % outline.size()];
      if ((b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x) < 0) return false;
    }
    return true;
  }

  /// The part of a mesh within a half space.
  std::optional<Mesh> part(const Mesh& mesh, const HalfSpace& within) {
    if (!budget_.spend(mesh.triangles.size())) return std::nullopt;
    return cut(mesh, within, one_place_);
  }

  struct Divided {
    Mesh inside;
    std::vector<Mesh> outside;
  };

  /// A mesh on both sides of a convex piece, an intersection of half spaces; `outside` is the mesh
  /// itself where nothing of it is inside.
  std::optional<Divided> divided(const Mesh& mesh, const std::vector<HalfSpace>& sides) {
    Divided out{mesh, {}};
    bool is_known = true;  // what is outside matters only where something is inside
    for (const HalfSpace& side : sides) {
      auto left = part(out.inside, side);
      if (!left) return std::nullopt;
      if (left->triangles.empty()) return Divided{{}, {mesh}};
      auto beyond = part(out.inside, side.complement());
      is_known = is_known && beyond;
      if (beyond && !beyond->triangles.empty()) out.outside.push_back(std::move(*beyond));
      out.inside = std::move(*left);
    }
    return is_known ? std::optional(std::move(out)) : std::nullopt;
  }

  /// What convex pieces, each an intersection of half spaces, cut off or have in common with a
  /// mesh. Where the sides of a piece cross the mesh, parts remain that touch each other; faces
  /// between them are within the solid.
  std::optional<Mesh> pieces_cut(const Mesh& mesh,
                                 const std::vector<std::vector<HalfSpace>>& pieces, bool cuts_off) {
    std::vector<Mesh> rest{mesh};
    Mesh inside;
    for (const std::vector<HalfSpace>& sides : pieces) {
      std::vector<Mesh> next;
      for (const Mesh& one : rest) {
        auto sorted = divided(one, sides);
        if (!sorted) return std::nullopt;
        append(inside, sorted->inside);
        std::move(sorted->outside.begin(), sorted->outside.end(), std::back_inserter(next));
      }
      rest = std::move(next);
      if (rest.size() > limits::bounding_sides) return std::nullopt;
    }
    if (!cuts_off) return inside;
    Mesh out;
    for (const Mesh& one : rest) append(out, one);
    return out;
  }

  StepGraph& graph_;
  double one_place_;
  SolidBudget& budget_;
  std::map<uint64_t, Mesh> known_;  // of operands
  size_t remembered_ = 0;           // triangles
};

}  // namespace

std::optional<Mesh> step_solid(StepGraph& graph, const StepNode& item, double one_place,
                               SolidBudget& budget) {
  return Solids(graph, one_place, budget).of(item);
}

std::optional<Mesh> step_solid(StepGraph& graph, const StepNode& item, double one_place) {
  SolidBudget own;
  return step_solid(graph, item, one_place, own);
}

std::string step_number(double x) {
  std::string out = fmt::format("{}", x);
  const size_t exponent = out.find('e');
  if (out.find('.') == std::string::npos) out.insert(std::min(exponent, out.size()), ".");
  return out;
}

std::string step_point(const glm::dvec3& p, int dimensions) {
  const std::string flat = step_number(p.x) + "," + step_number(p.y);
  return "(" + flat + (dimensions > 2 ? "," + step_number(p.z) : "") + ")";
}

std::string brep_body(StepDraft& draft, const Mesh& mesh) {
  std::vector<uint64_t> points;
  for (const glm::dvec3& p : mesh.positions)
    points.push_back(draft.add("IFCCARTESIANPOINT", step_point(p, 3)));
  std::string faces;
  for (const glm::uvec3& t : mesh.triangles) {
    const uint64_t loop = draft.add(
        "IFCPOLYLOOP", fmt::format("(#{},#{},#{})", points[t.x], points[t.y], points[t.z]));
    const uint64_t bound = draft.add("IFCFACEOUTERBOUND", fmt::format("#{},.T.", loop));
    faces += fmt::format("{}#{}", faces.empty() ? "" : ",",
                         draft.add("IFCFACE", fmt::format("(#{})", bound)));
  }
  return fmt::format("#{}", draft.add("IFCCLOSEDSHELL", "(" + faces + ")"));
}

}  // namespace luxodus
