// Geometry of an import: pieces of meshes, door leaves, floors of rooms, and whether rooms are
// closed. All in double precision, since models may be far from their origin.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "actors/import/building.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"
#include "scenes/light/geometry/polygon.hpp"

namespace luxodus {
namespace {

/// Vertices closer than this are merged [m]: shapes come in single precision.
constexpr double one_place_m = 1e-4;

/// For each vertex the first vertex at its place, found on a grid.
std::vector<uint32_t> places_of(const Mesh& mesh) {
  std::map<std::array<int64_t, 3>, uint32_t> first;
  std::vector<uint32_t> out;
  out.reserve(mesh.positions.size());
  for (uint32_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::dvec3 p = mesh.positions[i] / one_place_m;
    out.push_back(first.try_emplace({std::llround(p.x), std::llround(p.y), std::llround(p.z)}, i)
                      .first->second);
  }
  return out;
}

uint32_t root_of(std::vector<uint32_t>& parent, uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// ---- rays --------------------------------------------------------------------------------------

/// Distance along a ray to a triangle; nothing where it misses (Moeller and Trumbore 1997).
std::optional<double> meets(const glm::dvec3& from, const glm::dvec3& way, const glm::dvec3& a,
                            const glm::dvec3& b, const glm::dvec3& c) {
  constexpr double edge = 1e-9;  // tolerance on both sides: a crack is not an opening
  const glm::dvec3 u = b - a, v = c - a, p = glm::cross(way, v);
  const double det = glm::dot(u, p);
  if (std::abs(det) < 1e-14) return std::nullopt;
  const glm::dvec3 s = from - a;
  const double s_u = glm::dot(s, p) / det;
  const glm::dvec3 q = glm::cross(s, u);
  const double s_v = glm::dot(way, q) / det;
  if (s_u < -edge || s_v < -edge || s_u + s_v > 1 + edge) return std::nullopt;
  const double distance = glm::dot(v, q) / det;
  return distance > 1e-6 ? std::optional(distance) : std::nullopt;
}

/// Whether a ray enters a box within `way`.
bool passes_box(const glm::dvec3& from, const glm::dvec3& way, const Bounds& box, double within) {
  double enter = 0, leave = within;
  for (glm::length_t i = 0; i < 3; ++i) {
    const double a = (box.low[i] - 1e-6 - from[i]) / way[i];
    const double b = (box.high[i] + 1e-6 - from[i]) / way[i];
    if (std::isnan(a) || std::isnan(b)) continue;  // parallel to the plane, which does not limit it
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

// ---- outlines ----------------------------------------------------------------------------------

/// Loops of directed edges, each from a vertex to the next.
std::vector<std::vector<uint32_t>> loops_of(std::multimap<uint32_t, uint32_t> edges) {
  std::vector<std::vector<uint32_t>> loops;
  while (!edges.empty()) {
    std::vector<uint32_t> loop;
    uint32_t at = edges.begin()->first;
    for (auto edge = edges.find(at); edge != edges.end(); edge = edges.find(at)) {
      loop.push_back(at);
      at = edge->second;
      edges.erase(edge);
      if (at == loop.front()) break;
    }
    if (loop.empty()) break;
    if (at == loop.front() && loop.size() >= 3) loops.push_back(std::move(loop));
  }
  return loops;
}

/// Removes points on the straight line between their neighbours.
std::vector<glm::dvec2> without_straight_points(const std::vector<glm::dvec2>& loop) {
  constexpr double off_line_m = 1e-3;
  std::vector<glm::dvec2> out = loop;
  for (size_t i = 0; i < out.size() && out.size() > 3;) {
    const glm::dvec2 before = out[(i + out.size() - 1) % out.size()],
                     after = out[(i + 1) % out.size()];
    const glm::dvec2 line = after - before;
    const double length = glm::length(line);
    const glm::dvec2 d = out[i] - before;
    const double off = length > 0 ? std::abs(line.x * d.y - line.y * d.x) / length : 0;
    if (off < off_line_m)
      out.erase(out.begin() + static_cast<std::ptrdiff_t>(i));
    else
      ++i;
  }
  return out;
}

}  // namespace

std::vector<Mesh> connected_pieces(const Mesh& mesh) {
  const std::vector<uint32_t> place = places_of(mesh);
  std::vector<uint32_t> parent(mesh.positions.size());
  std::iota(parent.begin(), parent.end(), 0u);
  for (const glm::uvec3& t : mesh.triangles)
    for (const uint32_t corner : {t.y, t.z})
      parent[root_of(parent, place[corner])] = root_of(parent, place[t.x]);
  std::map<uint32_t, size_t> number;
  std::vector<Mesh> pieces;
  std::vector<std::map<uint32_t, uint32_t>> moved;
  for (const glm::uvec3& t : mesh.triangles) {
    const uint32_t root = root_of(parent, place[t.x]);
    const auto [it, fresh] = number.try_emplace(root, pieces.size());
    if (fresh) pieces.emplace_back(), moved.emplace_back();
    Mesh& piece = pieces[it->second];
    glm::uvec3 corners;
    for (glm::length_t i = 0; i < 3; ++i) {
      const auto [to, added] =
          moved[it->second].try_emplace(t[i], static_cast<uint32_t>(piece.positions.size()));
      if (added) piece.positions.push_back(mesh.positions[t[i]]);
      corners[i] = to->second;
    }
    piece.triangles.push_back(corners);
  }
  return pieces;
}

namespace {

/// A connected piece of a door, with its extent in the door's axes: width, thickness, height.
struct MeasuredPiece {
  DoorPiece piece;
  Bounds bounds;
  double covered_m2 = 0;  // projected onto the opening, seen from the front
};

/// Axes of a door: columns are width, thickness and height in scene coordinates.
glm::dmat3 door_axes(const std::vector<DoorPiece>& parts, const Transform& place) {
  Bounds local;
  const glm::dmat3 to_local = glm::transpose(place.linear);
  for (const DoorPiece& part : parts)
    for (const glm::dvec3& p : part.mesh.positions) local.extend(to_local * (p - place.offset));
  const glm::dvec3 size = local.high - local.low;
  // By the schema the width runs along x; some exporters use y.
  const bool along_x = size.x >= size.y;
  return {place.linear[along_x ? 0 : 1], place.linear[along_x ? 1 : 0], place.linear[2]};
}

std::vector<MeasuredPiece> measured_pieces(const std::vector<DoorPiece>& parts,
                                           const glm::dmat3& axes, const glm::dvec3& origin) {
  const glm::dmat3 to_local = glm::transpose(axes);
  std::vector<MeasuredPiece> out;
  for (const DoorPiece& part : parts)
    for (Mesh& mesh : connected_pieces(part.mesh)) {
      MeasuredPiece m;
      for (const glm::dvec3& p : mesh.positions) m.bounds.extend(to_local * (p - origin));
      for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 normal = glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                             mesh.positions[t.z] - mesh.positions[t.x]);
        m.covered_m2 += std::abs(glm::dot(normal, axes[1])) / 4;  // both sides of a closed body
      }
      m.piece = {std::move(mesh), part.material};
      out.push_back(std::move(m));
    }
  return out;
}

/// Whether a piece is a leaf: it covers much of the opening, or it is a frame of panes narrower
/// than the whole.
bool is_leaf(const MeasuredPiece& piece, const glm::dvec3& whole) {
  constexpr double min_cover = 0.3, min_width = 0.3, max_width = 0.95, min_height = 0.7;
  const glm::dvec3 size = piece.bounds.high - piece.bounds.low;
  return piece.covered_m2 > min_cover * whole.x * whole.z ||
         (size.x > min_width * whole.x && size.x < max_width * whole.x &&
          size.z > min_height * whole.z);
}

/// Whether a piece lies within a leaf, like a pane, or on it, like a handle.
bool is_on(const Bounds& leaf, const Bounds& piece) {
  const glm::dvec3 margin(0.02, 0.15, 0.02);
  return glm::all(glm::greaterThanEqual(piece.low, leaf.low - margin)) &&
         glm::all(glm::lessThanEqual(piece.high, leaf.high + margin));
}

}  // namespace

DoorPieces door_pieces(const std::vector<DoorPiece>& parts, const Transform& place,
                       const std::string& operation) {
  const glm::dmat3 axes = door_axes(parts, place);
  std::vector<MeasuredPiece> pieces = measured_pieces(parts, axes, place.offset);
  Bounds whole;
  for (const MeasuredPiece& piece : pieces) whole.extend(piece.bounds);
  std::vector<std::pair<DoorLeaf, Bounds>> leaves;
  std::vector<MeasuredPiece> others;
  for (MeasuredPiece& piece : pieces) {
    if (!is_leaf(piece, whole.high - whole.low)) {
      others.push_back(std::move(piece));
      continue;
    }
    // Overlapping pieces are layers of one leaf.
    const auto at = std::find_if(leaves.begin(), leaves.end(), [&](const auto& leaf) {
      return is_on(leaf.second, piece.bounds) || is_on(piece.bounds, leaf.second);
    });
    auto& [leaf, bounds] = at != leaves.end() ? *at : leaves.emplace_back();
    bounds.extend(piece.bounds);
    leaf.pieces.push_back(std::move(piece.piece));
  }
  DoorPieces out;
  for (MeasuredPiece& piece : others) {
    const auto at = std::find_if(leaves.begin(), leaves.end(), [&](const auto& leaf) {
      return is_on(leaf.second, piece.bounds);
    });
    (at != leaves.end() ? at->first.pieces : out.frame).push_back(std::move(piece.piece));
  }
  if (leaves.empty() && !out.frame.empty()) {  // no frame can be distinguished: all of it turns
    leaves.emplace_back(DoorLeaf{std::move(out.frame), {}}, whole);
    out.frame.clear();
  }
  const double middle = (whole.low.x + whole.high.x) / 2;
  for (auto& [leaf, bounds] : leaves) {
    const bool right = leaves.size() > 1 ? (bounds.low.x + bounds.high.x) / 2 > middle
                                         : operation.ends_with("_RIGHT");
    // The hinge's line runs through the leaf, along its hinged edge.
    leaf.hinge.point =
        place.offset + axes * glm::dvec3(right ? bounds.high.x : bounds.low.x,
                                         (bounds.low.y + bounds.high.y) / 2, bounds.low.z);
    // In right-handed axes a left leaf turns from width to thickness.
    const double turn = glm::determinant(axes) > 0 ? 90 : -90;
    leaf.hinge.open_angle_deg = right ? -turn : turn;
    out.leaves.push_back(std::move(leaf));
  }
  return out;
}

namespace {

/// Outer boundaries of the triangles that look down at one height.
void add_floors(const Mesh& mesh, const std::vector<uint32_t>& place,
                const std::vector<glm::uvec3>& triangles, double z, std::vector<FloorOutline>& to) {
  // Edges shared by two triangles run both ways and cancel; the boundary remains.
  std::map<std::pair<uint32_t, uint32_t>, int> count;
  for (const glm::uvec3& t : triangles) {
    const uint32_t corner[3] = {place[t.x], place[t.y], place[t.z]};
    for (int i = 0; i < 3; ++i) {
      const uint32_t a = corner[i], b = corner[(i + 1) % 3];
      if (a == b) continue;
      if (const auto back = count.find({b, a}); back != count.end() && back->second > 0)
        --back->second;
      else
        ++count[{a, b}];
    }
  }
  std::multimap<uint32_t, uint32_t> edges;
  for (const auto& [edge, n] : count)
    for (int i = 0; i < n; ++i) edges.emplace(edge.first, edge.second);
  for (const auto& loop : loops_of(std::move(edges))) {
    std::vector<glm::dvec2> points;
    for (const uint32_t i : loop) points.emplace_back(mesh.positions[i].x, mesh.positions[i].y);
    points = without_straight_points(points);
    // Seen from above, the outer boundary of a face that looks down runs clockwise, and holes the
    // other way.
    if (signed_area(points) > -limits::smallest_floor_m2) continue;
    const auto checked = checked_outline(points);
    if (checked) to.push_back({checked.value(), z});
  }
}

}  // namespace

std::vector<FloorOutline> floor_outlines(const Mesh& mesh) {
  constexpr double level_m = 1e-2, level_cosine = 0.99;
  std::vector<FloorOutline> out;
  const std::vector<uint32_t> place = places_of(mesh);
  const double outward = signed_volume_of(mesh) < 0 ? -1 : 1;
  std::map<int64_t, std::vector<glm::uvec3>> levels;
  for (glm::uvec3 t : mesh.triangles) {
    const glm::dvec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    const glm::dvec3 normal = outward * glm::cross(b - a, c - a);
    if (!(normal.z < -level_cosine * glm::length(normal))) continue;
    if (outward < 0) std::swap(t.y, t.z);
    // Levels a centimetre apart are one; neighbouring bins are joined.
    int64_t level = std::llround((a.z + b.z + c.z) / 3 / level_m);
    for (const int64_t near : {level - 1, level + 1})
      if (!levels.contains(level) && levels.contains(near)) level = near;
    levels[level].push_back(t);
  }
  for (const auto& [level, triangles] : levels) {
    double z = 0;
    for (const glm::uvec3& t : triangles) z += mesh.positions[t.x].z;
    add_floors(mesh, place, triangles, z / static_cast<double>(triangles.size()), out);
  }
  return out;
}

PartRays::PartRays(const std::vector<BuildingStorey>& storeys, Hit hit) {
  for (const BuildingStorey& storey : storeys)
    for (const BuildingPart& part : storey.parts)
      if (!part.mesh.triangles.empty() && (hit == Hit::all || !part.furniture))
        parts_.push_back({&part.mesh, bounds_of(part.mesh)});
  if (!parts_.empty()) grow(0, parts_.size());
}

/// Builds the tree: halves along the axis in which the parts' centres spread most.
void PartRays::grow(size_t first, size_t end) {
  constexpr size_t leaf_parts = 4;
  const size_t at = nodes_.size();
  nodes_.emplace_back();
  Bounds box, middles;
  for (size_t i = first; i < end; ++i) {
    box.extend(parts_[i].box);
    middles.extend(parts_[i].box.low + parts_[i].box.high);
  }
  nodes_[at].box = box;
  if (end - first <= leaf_parts) {
    nodes_[at].first = first;
    nodes_[at].end = end;
    return;
  }
  const glm::dvec3 extent = middles.high - middles.low;
  const glm::length_t axis = extent.x >= std::max(extent.y, extent.z) ? 0
                             : extent.y >= extent.z                   ? 1
                                                                      : 2;
  const auto place = [&](size_t i) { return parts_.begin() + static_cast<std::ptrdiff_t>(i); };
  const size_t half = first + (end - first) / 2;
  std::nth_element(place(first), place(half), place(end), [&](const Part& a, const Part& b) {
    return a.box.low[axis] + a.box.high[axis] < b.box.low[axis] + b.box.high[axis];
  });
  grow(first, half);
  nodes_[at].second_child = nodes_.size();
  grow(half, end);
}

std::optional<double> PartRays::first(const glm::dvec3& from, const glm::dvec3& way) const {
  constexpr double endless = 1e300;
  double nearest = endless;
  std::vector<size_t> open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const size_t at = open.back();
    const Node& node = nodes_[at];
    open.pop_back();
    if (!passes_box(from, way, node.box, nearest)) continue;
    if (!node.is_leaf()) {
      open.push_back(node.second_child);
      open.push_back(at + 1);
    }
    for (size_t i = node.first; i < node.end; ++i) {
      const Mesh& mesh = *parts_[i].mesh;
      if (!passes_box(from, way, parts_[i].box, nearest)) continue;
      for (const glm::uvec3& t : mesh.triangles)
        nearest = std::min(
            nearest, meets(from, way, mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z])
                         .value_or(endless));
    }
  }
  return nearest < endless ? std::optional(nearest) : std::nullopt;
}

namespace {

/// The centre of the floor's largest triangle: within the room, whatever its shape.
std::optional<glm::dvec2> middle_of(const std::vector<glm::dvec2>& outline) {
  const auto triangles = triangulate(outline);
  if (!triangles) return std::nullopt;
  glm::dvec2 middle(0);
  double largest = -1;
  for (const glm::uvec3& t : triangles.value()) {
    const std::array<glm::dvec2, 3> corners{outline[t.x], outline[t.y], outline[t.z]};
    if (const double area = std::abs(signed_area(corners)); area > largest) {
      largest = area;
      middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    }
  }
  return middle;
}

/// Points spread evenly over an outline: of a grid those within, and its middle.
std::vector<glm::dvec2> points_within(const std::vector<glm::dvec2>& outline) {
  constexpr int steps = 16;
  Bounds box;
  for (const glm::dvec2& p : outline) box.extend(glm::dvec3(p, 0));
  std::vector<glm::dvec2> out;
  if (const auto middle = middle_of(outline)) out.push_back(*middle);
  const glm::dvec2 low(box.low), size(box.high - box.low);
  for (int i = 0; i < steps * steps; ++i) {
    const glm::dvec2 p =
        low + size * glm::dvec2((i % steps + 0.5) / steps, (i / steps + 0.5) / steps);
    if (is_within(outline, p)) out.push_back(p);
  }
  return out;
}

}  // namespace

namespace {

/// A level of a floor: heights within its tolerance of each other.
struct FloorLevel {
  size_t points = 0;
  double top_m = 0;
};

/// The level with the most of these heights, the lowest of several. A window that slides over the
/// sorted heights: fixed bins would divide a level that lies on the edge between two.
FloorLevel main_level(std::vector<double> heights_m) {
  constexpr double level_m = 0.01;
  std::sort(heights_m.begin(), heights_m.end());
  FloorLevel best;
  size_t first = 0;
  for (size_t last = 0; last < heights_m.size(); ++last) {
    while (heights_m[last] - heights_m[first] > level_m) ++first;
    if (last + 1 - first > best.points) best = {last + 1 - first, heights_m[last]};
  }
  return best;
}

}  // namespace

void set_on_floor(const PartRays& solids, BuildingRoom& room) {
  // Raised floors end below a metre, and a slab may lie half a metre below the space.
  constexpr double from_m = 1, under_m = 0.5;
  const double up = std::min(room.height_m / 2, from_m);
  const auto points = points_within(room.outline);
  std::vector<double> heights_m;
  for (const glm::dvec2& p : points) {
    const double from = room.z_m + up;
    const auto way = solids.first(glm::dvec3(p, from), {0, 0, -1});
    if (way && *way <= up + under_m) heights_m.push_back(from - *way);
  }
  if (heights_m.empty()) return;
  const auto found = static_cast<double>(heights_m.size());
  const FloorLevel level = main_level(std::move(heights_m));
  room.floor_share = found / static_cast<double>(points.size());
  room.level_share = static_cast<double>(level.points) / found;
  room.height_m -= level.top_m - room.z_m;
  room.z_m = level.top_m;
}

void look_for_openings(const PartRays& solids, BuildingRoom& room) {
  const auto middle = middle_of(room.outline);
  if (!middle) return;
  const glm::dvec3 from(*middle, room.z_m + room.height_m / 2);
  constexpr int rays = 500;
  std::map<std::string, int> ways;
  int open = 0;
  for (int i = 0; i < rays; ++i) {  // a spiral of equal solid angles
    const double z = 1 - (2 * i + 1.0) / rays, r = std::sqrt(1 - z * z);
    const double turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const glm::dvec3 way(r * std::cos(turn), r * std::sin(turn), z);
    if (solids.first(from, way)) continue;
    ++open;
    ++ways[z > 0.7 ? "up" : z < -0.7 ? "down" : "sideways"];
  }
  room.open_share = static_cast<double>(open) / rays;
  int most = 0;
  for (const auto& [way, count] : ways)
    if (count > most) {
      most = count;
      room.open_towards = way;
    }
}

}  // namespace luxodus
