// Snaps obstructions and holes to the nodes of meshes by the rules of FDS 6.9 (User's Guide,
// "Obstruct basics" and "Creating voids"): each mesh snaps on its own, to the nearest node.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/core/reading_share.hpp"
#include "scenes/formats/fds_input/input_building.hpp"
#include "scenes/formats/fds_input/input_states.hpp"

namespace luxodus {

namespace {

using fds_input::Box;
using fds_input::is_there;
using fds_input::too_many_objects;
using fds_input::too_much_to_compare;

/// Share of a cell: an object this far beyond a mesh still touches its face.
constexpr double half_cell = 0.5;
/// Share of a cell: a thinner object loses its thickness where it straddles the cell's middle.
constexpr double thin = 0.25;
/// Share of a cell by which holes extend beyond the mesh.
constexpr double beyond = 0.001;

/// The part of an obstruction in a mesh, on its nodes and as written.
struct Piece {
  fds::NodeBox nodes;
  Box box;
};

class MeshSnapper {
 public:
  MeshSnapper(const std::vector<FdsInputMesh>& all, size_t which) : all_(all), mesh_(all[which]) {
    for (int axis = 0; axis < 3; ++axis) {
      cell_[axis] = (mesh_.box.high[axis] - mesh_.box.low[axis]) / mesh_.cells[axis];
      inverse_[axis] = 1.0 / cell_[axis];
    }
  }

  std::array<std::vector<double>, 3> nodes() const {
    std::array<std::vector<double>, 3> out;
    for (int axis = 0; axis < 3; ++axis) {
      auto& along = out[static_cast<size_t>(axis)];
      for (int i = 0; i <= mesh_.cells[axis]; ++i)
        along.push_back(mesh_.box.low[axis] + i * cell_[axis]);
      along.back() = mesh_.box.high[axis];
    }
    return out;
  }

  /// Nothing where the obstruction is outside this mesh, or flat along two axes.
  std::optional<Piece> snap(const FdsObstruction& obstruction) const {
    Piece out;
    out.box = obstruction.box;
    for (int axis = 0; axis < 3; ++axis)
      if (!onto_near_face(obstruction.box, axis, out.box)) return std::nullopt;
    const glm::dvec3 middle = (obstruction.box.low + obstruction.box.high) / 2.0;
    out.box.low = glm::max(out.box.low, mesh_.box.low);
    out.box.high = glm::min(out.box.high, mesh_.box.high);
    if (glm::any(glm::greaterThan(out.box.low, out.box.high))) return std::nullopt;
    int flat = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const bool within =
          middle[axis] >= mesh_.box.low[axis] && middle[axis] <= mesh_.box.high[axis];
      along(axis, obstruction.thicken && within, out);
      flat += out.nodes.low[axis] == out.nodes.high[axis] ? 1 : 0;
    }
    return flat > 1 ? std::nullopt : std::optional(out);
  }

  /// A hole on the nodes of the mesh.
  Piece snap(const Box& hole) const {
    Piece cut;
    for (int axis = 0; axis < 3; ++axis) {
      const double margin = beyond * cell_[axis];
      cut.box.low[axis] = std::max(hole.low[axis], mesh_.box.low[axis] - margin);
      cut.box.high[axis] = std::min(hole.high[axis], mesh_.box.high[axis] + margin);
      cut.nodes.low[axis] = node(cut.box.low[axis], axis);
      cut.nodes.high[axis] = node(cut.box.high[axis], axis);
    }
    return cut;
  }

  /// Whether a hole removes more than a face of a piece: on the nodes, and as written.
  static bool takes_of(const Piece& hole, const Piece& piece) {
    for (int axis = 0; axis < 3; ++axis) {
      const int low = std::max(hole.nodes.low[axis], piece.nodes.low[axis]);
      const int high = std::min(hole.nodes.high[axis], piece.nodes.high[axis]);
      const bool flat = piece.nodes.low[axis] == piece.nodes.high[axis];
      if (high < low || (high == low && !flat)) return false;
    }
    return glm::all(glm::lessThan(hole.box.low, piece.box.high)) &&
           glm::all(glm::greaterThan(hole.box.high, piece.box.low));
  }

  /// The remainder of a piece, which a hole cuts if it removes whole cells. `cut`: the hole.
  static std::vector<Piece> without(const Piece& piece, const Piece& cut) {
    if (!takes_of(cut, piece)) return {piece};
    std::vector<Piece> out;
    Piece rest = piece;
    for (int axis = 0; axis < 3; ++axis) {
      if (rest.nodes.low[axis] < cut.nodes.low[axis]) {
        out.push_back(rest);
        out.back().nodes.high[axis] = rest.nodes.low[axis] = cut.nodes.low[axis];
        out.back().box.high[axis] = rest.box.low[axis] = cut.box.low[axis];
      }
      if (rest.nodes.high[axis] > cut.nodes.high[axis]) {
        out.push_back(rest);
        out.back().nodes.low[axis] = rest.nodes.high[axis] = cut.nodes.high[axis];
        out.back().box.low[axis] = rest.box.high[axis] = cut.box.high[axis];
      }
    }
    return out;
  }

  /// An opening in a face of the mesh, on its nodes; nothing where it is in no face.
  std::optional<fds::Opening> opening(const FdsOpening& opening) const {
    Box box = opening.box;
    if (opening.mesh_face) {
      const int axis = *opening.mesh_face / 2;
      const bool high = *opening.mesh_face % 2 == 1;
      box = mesh_.box;
      (high ? box.low : box.high)[axis] = high ? mesh_.box.high[axis] : mesh_.box.low[axis];
    }
    fds::Opening out;
    bool in_face = false;
    for (int axis = 0; axis < 3; ++axis) {
      if (box.low[axis] - mesh_.box.high[axis] >= half_cell * cell_[axis] ||
          mesh_.box.low[axis] - box.high[axis] >= half_cell * cell_[axis])
        return std::nullopt;
      const int low = std::clamp(node(box.low[axis], axis), 0, mesh_.cells[axis]);
      const int high = std::clamp(node(box.high[axis], axis), 0, mesh_.cells[axis]);
      const bool flat = box.low[axis] == box.high[axis];
      if (flat ? low != 0 && low != mesh_.cells[axis] : low == high) return std::nullopt;
      in_face = in_face || flat;
      out.low[axis] = place(low, axis);
      out.high[axis] = place(high, axis);
    }
    return in_face ? std::optional(out) : std::nullopt;
  }

 private:
  /// FDS multiplies by the inverse of a cell: a place in the middle of a cell rounds as there.
  int node(double at, int axis) const {
    const double n = std::round((at - mesh_.box.low[axis]) * inverse_[axis]);
    return static_cast<int>(std::clamp(n, -1.0, mesh_.cells[axis] + 1.0));
  }
  double place(int node, int axis) const {
    return node == mesh_.cells[axis] ? mesh_.box.high[axis]
                                     : mesh_.box.low[axis] + node * cell_[axis];
  }

  const FdsInputMesh* mesh_at(const glm::dvec3& at) const {
    for (const FdsInputMesh& m : all_)
      if (glm::all(glm::greaterThanEqual(at, m.box.low)) &&
          glm::all(glm::lessThanEqual(at, m.box.high)))
        return &m;
    return nullptr;
  }

  /// Turns an object beyond a face, by less than half a cell, into a plate on the face. False where
  /// another mesh with a gap before it owns the object.
  bool onto_near_face(const Box& box, int axis, Box& out) const {
    const double low = mesh_.box.low[axis], high = mesh_.box.high[axis];
    const bool below = box.high[axis] < low && box.high[axis] >= low - half_cell * cell_[axis];
    const bool above = box.low[axis] > high && box.low[axis] < high + half_cell * cell_[axis];
    if (!below && !above) return true;
    glm::dvec3 at = (glm::max(box.low, mesh_.box.low) + glm::min(box.high, mesh_.box.high)) / 2.0;
    const double face = below ? low : high, away = below ? -cell_[axis] : cell_[axis];
    at[axis] = face + 0.01 * away;
    const FdsInputMesh* behind = mesh_at(at);
    at[axis] = face + 0.51 * away;
    if (behind == nullptr && mesh_at(at) != nullptr) return false;
    const double cell =
        behind == nullptr ? cell_[axis]
                          : (behind->box.high[axis] - behind->box.low[axis]) / behind->cells[axis];
    const bool near =
        below ? box.high[axis] >= low - half_cell * cell : box.low[axis] < high + half_cell * cell;
    if (near) out.low[axis] = out.high[axis] = face;
    return true;
  }

  void along(int axis, bool thicken, Piece& piece) const {
    int& low = piece.nodes.low[axis];
    int& high = piece.nodes.high[axis];
    double& from = piece.box.low[axis];
    double& to = piece.box.high[axis];
    low = std::clamp(node(from, axis), 0, mesh_.cells[axis]);
    high = std::clamp(node(to, axis), 0, mesh_.cells[axis]);
    if (thicken && low == high) {
      const double middle = ((from + to) / 2 - mesh_.box.low[axis]) * inverse_[axis];
      low = std::clamp(static_cast<int>(middle), 0, mesh_.cells[axis]);
      high = std::min(low + 1, mesh_.cells[axis]);
      from = place(low, axis);
      to = place(high, axis);
    } else if (!thicken && low != high && to - from < thin * cell_[axis]) {
      if (from - place(low, axis) < place(high, axis) - to)
        high = low;
      else
        low = high;
    }
  }

  const std::vector<FdsInputMesh>& all_;
  const FdsInputMesh& mesh_;
  glm::dvec3 cell_{0}, inverse_{0};
};

/// The open holes that extend into a mesh, on its nodes.
std::vector<Piece> holes_of(const FdsInput& input, const FdsInputOptions& options,
                            const FdsInputMesh& mesh, const MeshSnapper& snapper) {
  std::vector<Piece> out;
  for (const FdsHole& hole : input.holes)
    if (is_there(hole.title, hole.course, options) &&
        glm::all(glm::lessThanEqual(hole.box.low, mesh.box.high)) &&
        glm::all(glm::greaterThanEqual(hole.box.high, mesh.box.low)))
      out.push_back(snapper.snap(hole.box));
  return out;
}

/// Adds the obstructions of a mesh, cut by open holes, with the times at which they come and go.
/// `pairs` counts comparisons; `done` counts obstructions over all meshes.
Result<void> fill_mesh(const FdsInput& input, const FdsInputOptions& options,
                       const MeshSnapper& snapper, const std::vector<Piece>& holes, uint64_t& pairs,
                       size_t m, fds::Case& out, ReadingPart& done) {
  fds::Mesh& mesh = out.meshes[m];
  uint64_t number = m * input.obstructions.size();
  for (const FdsObstruction& o : input.obstructions) {
    done.at(number++);
    if (!fds_input::is_ever_there(o, options)) continue;
    const auto whole = snapper.snap(o);
    if (!whole) continue;
    std::vector<Piece> pieces{*whole};
    for (size_t h = 0; o.permit_hole && h < holes.size(); ++h) {
      pairs += pieces.size();
      if (pairs > limits::fds_input_pairs) return too_much_to_compare(input);
      const auto is_cut = [&](const Piece& piece) {
        return MeshSnapper::takes_of(holes[h], piece);
      };
      if (std::none_of(pieces.begin(), pieces.end(), is_cut)) continue;
      std::vector<Piece> left;
      for (const Piece& piece : pieces)
        for (const Piece& part : MeshSnapper::without(piece, holes[h])) left.push_back(part);
      pieces = std::move(left);
      if (pieces.size() > limits::fire_objects) return too_many_objects(input);
    }
    for (const Piece& piece : pieces) {
      bool there = o.course.at_start;
      for (const double at_s : o.course.turns_s)
        out.changes.push_back({m, mesh.obstructions.size(), at_s, there = !there, 0});
      mesh.obstructions.push_back(piece.nodes);
      mesh.labels.push_back({o.title.name, o.surface, o.rgb, o.opacity});
    }
    if (mesh.obstructions.size() > limits::fire_objects) return too_many_objects(input);
  }
  return {};
}

}  // namespace

Result<fds::Case> snapped_case(const FdsInput& input, const FdsInputOptions& options) {
  if (auto ok = fds_input::names_known(input, options); !ok) return ok.problem();
  if (input.stretched)
    return problem_in(*input.stretched,
                      "the grid is stretched: its cells are not computed here; import it as "
                      "written, without --snap, or the .smv of its results, which has the nodes");
  const uint64_t boxes = input.obstructions.size() + input.holes.size() + input.openings.size();
  uint64_t pairs = input.meshes.size() * boxes;
  if (pairs > limits::fds_input_pairs) return too_much_to_compare(input);
  fds::Case out;
  out.file = input.file;
  out.default_surface = input.default_surface;
  for (const FdsInputSurface& s : input.surfaces)
    out.surfaces.push_back({s.name, s.rgb, s.opacity});
  ReadingPart done(options.reading, input.meshes.size() * input.obstructions.size());
  for (size_t m = 0; m < input.meshes.size(); ++m) {
    const MeshSnapper snapper(input.meshes, m);
    fds::Mesh& mesh = out.meshes.emplace_back();
    mesh.name = input.meshes[m].name;
    mesh.line = input.meshes[m].line;
    mesh.cells = input.meshes[m].cells;
    mesh.nodes = snapper.nodes();
    const std::vector<Piece> holes = holes_of(input, options, input.meshes[m], snapper);
    if (auto ok = fill_mesh(input, options, snapper, holes, pairs, m, out, done); !ok)
      return ok.problem();
    for (const FdsOpening& o : input.openings)
      if (is_there(o.title, o.course, options))
        if (const auto opening = snapper.opening(o)) mesh.openings.push_back(*opening);
  }
  std::stable_sort(out.changes.begin(), out.changes.end(),
                   [](const fds::Change& a, const fds::Change& b) { return a.time_s < b.time_s; });
  return out;
}

}  // namespace luxodus
