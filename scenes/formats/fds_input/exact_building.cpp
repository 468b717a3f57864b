#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/core/reading_share.hpp"
#include "scenes/formats/fds_input/input_building.hpp"
#include "scenes/formats/fds_input/input_states.hpp"

namespace luxodus {

namespace {

using fds_input::Box;
using fds_input::input_look;
using fds_input::is_there;
using fds_input::too_many_objects;
using fds_input::too_much_to_compare;

constexpr double touching_m = 1e-5;
/// A door begins at most this far above the floor of its mesh [m].
constexpr double highest_threshold_m = 0.05;
constexpr double lamp_below_ceiling_m = 0.1;
constexpr const char* side_names[] = {"west", "east", "south", "north", "bottom", "top"};

bool touch(const Box& a, const Box& b, double gap_m) {
  return glm::all(glm::lessThanEqual(a.low, b.high + gap_m)) &&
         glm::all(glm::greaterThanEqual(a.high, b.low - gap_m));
}

/// A face of a box, as a box without thickness. `face`, 0 to 5: low x, high x, low y...
Box face_of(const Box& box, int face) {
  Box out = box;
  const int axis = face / 2;
  (face % 2 == 0 ? out.high : out.low)[axis] = face % 2 == 0 ? box.low[axis] : box.high[axis];
  return out;
}

class ExactBuilding {
 public:
  ExactBuilding(const FdsInput& input, const FdsInputOptions& options)
      : input_(input), options_(options) {}

  Result<FireBuilding> make() {
    const uint64_t meshes = input_.meshes.size();
    pairs_.made = meshes * (input_.obstructions.size() + 6 * input_.openings.size() + 6 * meshes);
    if (pairs_.too_many()) return too_much_to_compare(input_);
    if (auto ok = obstructions(); !ok) return ok.problem();
    for (const FdsInputMesh& mesh : input_.meshes) {
      out_.bounds.extend(mesh.box.low);
      out_.bounds.extend(mesh.box.high);
      for (int face = 0; face < 6; ++face)
        if (auto ok = closed_face(mesh, face); !ok) return ok.problem();
    }
    const Box& first = input_.meshes.front().box;
    out_.lamp = (first.low + first.high) / 2.0;
    out_.lamp.z = first.high.z - lamp_below_ceiling_m;
    fds_input::add_bodies_and_notes(input_, options_, out_);
    if (outside_ > 0)
      out_.notes.push_back(fmt::format("{} obstructions touch no mesh and are left out", outside_));
    return std::move(out_);
  }

 private:
  Result<void> obstructions() {
    std::vector<Box> holes;
    for (const FdsHole& hole : input_.holes)
      if (is_there(hole.title, hole.course, options_)) holes.push_back(hole.box);
    ReadingPart done(options_.reading, input_.obstructions.size());
    uint64_t number = 0;
    for (const FdsObstruction& o : input_.obstructions) {
      done.at(number++);
      if (!fds_input::is_ever_there(o, options_)) continue;
      const bool in_a_mesh =
          std::any_of(input_.meshes.begin(), input_.meshes.end(),
                      [&](const FdsInputMesh& m) { return touch(o.box, m.box, touching_m); });
      if (!in_a_mesh) {
        ++outside_;
        continue;
      }
      const auto left = o.permit_hole
                            ? fds_input::without_all(o.box, holes, limits::fire_objects, pairs_)
                            : std::vector<Box>{o.box};
      if (!left) return pairs_.too_many() ? too_much_to_compare(input_) : too_many_objects(input_);
      for (const Box& box : *left) obstruction(o, box);
      if (out_.tables.objects() > limits::fire_objects) return too_many_objects(input_);
    }
    return {};
  }

  void obstruction(const FdsObstruction& o, const Box& box) {
    int flat = 0, across = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (box.low[axis] < box.high[axis]) continue;
      ++flat;
      across = axis;
    }
    if (flat > 1) return;
    const std::string name = fds::scene_name(o.title.name, "obstruction");
    const fds::FireLook look = input_look(input_, o.surface, o.rgb, o.opacity);
    if (flat == 0) {
      ++out_.solids;
      out_.tables.box(name, box.low, box.high, look, fds_input::times_of(o.course));
    } else {
      ++out_.plates;
      out_.tables.plate(name, box.low, box.high, across, look, fds_input::times_of(o.course));
    }
  }

  /// Adds the part of a mesh's face that is closed: no other mesh behind it, and no opening in it.
  Result<void> closed_face(const FdsInputMesh& mesh, int number) {
    const int axis = number / 2;
    const Box face = face_of(mesh.box, number);
    const double outward = number % 2 == 0 ? -touching_m : touching_m;
    std::vector<Box> gaps;
    for (const FdsInputMesh& other : input_.meshes) {
      // Another mesh lies behind this face if it holds the point just outside.
      const double behind = face.low[axis] + outward;
      if (&other == &mesh || other.box.low[axis] > behind || other.box.high[axis] < behind)
        continue;
      gaps.push_back(thickened(other.box, face, axis));
    }
    for (const FdsOpening& o : input_.openings) {
      if (!is_there(o.title, o.course, options_)) continue;
      if (o.mesh_face ? *o.mesh_face != number : !in_face(o.box, mesh, face, axis)) continue;
      const Box gap = o.mesh_face ? face : o.box;
      const bool exposed = is_exposed(gap, face, axis, gaps);
      if (pairs_.too_many()) return too_much_to_compare(input_);
      if (!exposed) continue;
      note_opening(gap, mesh, number);
      gaps.push_back(thickened(gap, face, axis));
    }
    const auto left = fds_input::without_all(face, gaps, limits::fire_objects, pairs_);
    if (!left) return pairs_.too_many() ? too_much_to_compare(input_) : too_many_objects(input_);
    const fds::FireLook look = input_look(input_, input_.default_surface, std::nullopt,
                                          input_.surfaces[input_.default_surface].opacity);
    for (const Box& box : *left) {
      ++out_.faces;
      out_.tables.face(number, box.low, box.high, look);
    }
    return out_.tables.objects() > limits::fire_objects ? Result<void>(too_many_objects(input_))
                                                        : Result<void>();
  }

  /// Makes an opening thick, so that it cuts the face; its sides extend over edges that they touch.
  static Box thickened(const Box& gap, const Box& face, int axis) {
    Box out = gap;
    out.low -= touching_m;
    out.high += touching_m;
    out.low[axis] = face.low[axis] - 1;
    out.high[axis] = face.low[axis] + 1;
    for (int other = 0; other < 3; ++other) {
      if (other == axis) continue;
      // Sides within the face stay as written.
      if (gap.low[other] > face.low[other] + touching_m) out.low[other] = gap.low[other];
      if (gap.high[other] < face.high[other] - touching_m) out.high[other] = gap.high[other];
    }
    return out;
  }

  /// Whether an opening is in a face, as FDS decides: nearer to it than half a cell.
  static bool in_face(const Box& opening, const FdsInputMesh& mesh, const Box& face, int axis) {
    const double cell = (mesh.box.high[axis] - mesh.box.low[axis]) / mesh.cells[axis];
    if (opening.low[axis] != opening.high[axis] ||
        std::abs(opening.low[axis] - face.low[axis]) >= cell / 2)
      return false;
    for (int other = 0; other < 3; ++other)
      if (other != axis &&
          (opening.low[other] >= face.high[other] || opening.high[other] <= face.low[other]))
        return false;
    return true;
  }

  /// Whether part of an opening is not behind other meshes.
  bool is_exposed(const Box& gap, const Box& face, int axis, const std::vector<Box>& gaps) {
    Box within = face;
    for (int other = 0; other < 3; ++other) {
      if (other == axis) continue;
      within.low[other] = std::max(face.low[other], gap.low[other]);
      within.high[other] = std::min(face.high[other], gap.high[other]);
    }
    const auto left = fds_input::without_all(within, gaps, limits::fire_objects, pairs_);
    return !left || !left->empty();
  }

  void note_opening(const Box& opening, const FdsInputMesh& mesh, int number) {
    const std::string side = side_names[number];
    if (std::find(out_.open_sides.begin(), out_.open_sides.end(), side) == out_.open_sides.end())
      out_.open_sides.push_back(side);
    const glm::dvec3 low = glm::max(opening.low, mesh.box.low);
    const glm::dvec3 high = glm::min(opening.high, mesh.box.high);
    if (number < 4 && low.z <= mesh.box.low.z + highest_threshold_m)
      out_.exits.emplace_back((low.x + high.x) / 2, (low.y + high.y) / 2, low.z);
  }

  const FdsInput& input_;
  const FdsInputOptions& options_;
  FireBuilding out_;
  size_t outside_ = 0;
  fds_input::Comparisons pairs_{0, limits::fds_input_pairs};
};

}  // namespace

Result<FireBuilding> exact_building(const FdsInput& input, const FdsInputOptions& options) {
  if (auto ok = fds_input::names_known(input, options); !ok) return ok.problem();
  return ExactBuilding(input, options).make();
}

Result<FireBuilding> snapped_building(const FdsInput& input, const FdsInputOptions& options) {
  auto fire = snapped_case(input, options);
  if (!fire) return fire.problem();
  auto out = fire_building_of(std::move(fire).value(), options.at_s);
  if (!out) return out.problem();
  fds_input::add_bodies_and_notes(input, options, out.value());
  return out;
}

}  // namespace luxodus
