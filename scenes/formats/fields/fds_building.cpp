#include "scenes/formats/fields/fds_building.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "scenes/formats/fields/fds_case.hpp"
#include "scenes/formats/fields/fds_cells.hpp"

namespace luxodus {

namespace fds {
namespace {

constexpr double seam_m = 1e-5;
/// A door begins at most this far above the floor of its mesh [m].
constexpr double threshold_m = 0.05;
constexpr double below_ceiling_m = 0.1;

/// Key of a plate: plates of one place and time are the same; at other times another may stand
/// there.
std::string plate_text(const glm::dvec3& low, const glm::dvec3& high, const FireTimes& times) {
  return fmt::format("{:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g} | {} | {}", low.x, low.y, low.z,
                     high.x, high.y, high.z, fmt::join(times.appears, " "),
                     fmt::join(times.vanishes, " "));
}

/// A rectangle of cells on a face of a mesh.
struct Patch {
  int u0, u1, v0, v1;
};

/// Covers set cells with few rectangles: runs of a row grow while the next row has the same run.
std::vector<Patch> patches_of(const std::vector<uint8_t>& set, int nu, int nv) {
  std::vector<Patch> done, open;
  for (int v = 0; v <= nv; ++v) {
    std::vector<Patch> runs;
    for (int u = 0; v < nv && u < nu; ++u) {
      const auto at = [&](int x) {
        return set[static_cast<size_t>(v) * static_cast<size_t>(nu) + static_cast<size_t>(x)] != 0;
      };
      if (!at(u)) continue;
      const int first = u;
      while (u < nu && at(u)) ++u;
      runs.push_back({first, u, v, v + 1});
    }
    std::vector<Patch> next;
    for (Patch& run : runs) {
      const auto same = std::find_if(open.begin(), open.end(), [&](const Patch& p) {
        return p.u0 == run.u0 && p.u1 == run.u1;
      });
      if (same != open.end()) {
        run.v0 = same->v0;
        open.erase(same);
      }
      next.push_back(run);
    }
    done.insert(done.end(), open.begin(), open.end());
    open = std::move(next);
  }
  return done;
}

class BuildingWriter {
 public:
  BuildingWriter(Case fire, double at_s) : fire_(std::move(fire)), at_s_(at_s) {}

  Result<FireBuilding> write() {
    out_.notes = fire_.notes;
    out_.notes.insert(out_.notes.end(), fire_.building_notes.begin(), fire_.building_notes.end());
    for (const Mesh& mesh : fire_.meshes) {
      out_.bounds.extend(mesh.low());
      out_.bounds.extend(mesh.high());
    }
    for (size_t m = 0; m < fire_.meshes.size(); ++m) {
      obstructions(m);
      for (int axis = 0; axis < 3; ++axis)
        for (const bool high : {false, true}) face(m, axis, high);
      openings(fire_.meshes[m]);
      if (out_.tables.objects() > luxodus::limits::fire_objects)
        return problem_in(fire_.file, fmt::format("its building has more than {} objects",
                                                  luxodus::limits::fire_objects));
    }
    const Mesh& first = fire_.meshes.front();
    out_.lamp = 0.5 * (first.low() + first.high());
    out_.lamp.z = first.high().z - below_ceiling_m;
    return std::move(out_);
  }

 private:
  FireLook look_of(size_t surface) const {
    if (surface >= fire_.surfaces.size())
      return {.surface = "surface " + std::to_string(surface), .rgb = std::nullopt};
    const Surface& s = fire_.surfaces[surface];
    return {s.name, s.rgb, std::nullopt, s.opacity};
  }
  FireLook look_of(const ObstructionLabel& label) const {
    FireLook look = look_of(label.surface);
    look.rgb = label.rgb;
    look.opacity = label.opacity.value_or(look.opacity);
    return look;
  }

  void obstructions(size_t m) {
    const Mesh& mesh = fire_.meshes[m];
    const auto there = obstructions_at(fire_, m, at_s_);
    const std::vector<FireTimes> times = times_of_obstructions(m);
    for (size_t i = 0; i < mesh.obstructions.size(); ++i) {
      const std::string name = scene_name(mesh.labels[i].name, "obstruction");
      if (there[i] == 0) out_.absent.push_back(name);
      const auto& [a, b] = mesh.obstructions[i];
      glm::dvec3 low, high;
      int flat = 0, across = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const std::vector<double>& nodes = mesh.nodes[static_cast<size_t>(axis)];
        low[axis] = nodes[static_cast<size_t>(a[axis])];
        high[axis] = nodes[static_cast<size_t>(b[axis])];
        if (a[axis] < b[axis]) continue;
        ++flat;
        across = axis;
      }
      if (flat > 1) continue;
      if (flat == 0) {
        ++out_.solids;
        out_.tables.box(name, low, high, look_of(mesh.labels[i]), times[i]);
        continue;
      }
      plate(mesh, mesh.labels[i], low, high, across, times[i]);
    }
  }

  std::vector<FireTimes> times_of_obstructions(size_t m) const {
    std::vector<std::vector<FireTurn>> turns(fire_.meshes[m].obstructions.size());
    for (const Change& change : fire_.changes)
      if (change.mesh == m) turns[change.obstruction].push_back({change.time_s, change.appears});
    std::vector<FireTimes> out;
    for (std::vector<FireTurn>& of_one : turns) out.push_back(times_of_turns(std::move(of_one)));
    return out;
  }

  /// Adds an obstruction without thickness. Not on an outer face, which exists already, and only
  /// once where two meshes name it with the same times.
  void plate(const Mesh& mesh, const ObstructionLabel& label, const glm::dvec3& low,
             const glm::dvec3& high, int across, const FireTimes& times) {
    const bool outer = std::abs(low[across] - out_.bounds.low[across]) < seam_m ||
                       std::abs(low[across] - out_.bounds.high[across]) < seam_m;
    if (outer || !plates_.insert(plate_text(low, high, times)).second) return;
    const bool below = std::abs(low[across] - mesh.low()[across]) < seam_m;
    if (below || std::abs(low[across] - mesh.high()[across]) < seam_m) {
      // Where two meshes meet, the wall itself is often an obstruction of the mesh behind.
      glm::dvec3 behind = 0.5 * (low + high);
      behind[across] += below ? -seam_m : seam_m;
      if (is_solid(behind)) return;
    }
    ++out_.plates;
    out_.tables.plate(scene_name(label.name, "obstruction"), low, high, across, look_of(label),
                      times);
  }

  bool is_solid(const glm::dvec3& place) {
    for (size_t m = 0; m < fire_.meshes.size(); ++m) {
      const int64_t cell = cell_at(fire_.meshes[m], place);
      if (cell >= 0) return gas(m)[static_cast<size_t>(cell)] == 0;
    }
    return false;
  }

  const std::vector<uint8_t>& gas(size_t m) {
    if (gas_.empty()) gas_.resize(fire_.meshes.size());
    if (gas_[m].empty()) gas_[m] = gas_cells_ever(fire_, m);
    return gas_[m];
  }

  /// Adds the part of a mesh's face that is closed, next to gas: no opening, and no other mesh
  /// behind.
  void face(size_t m, int axis, bool high) {
    const Mesh& mesh = fire_.meshes[m];
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const std::vector<double>& along = mesh.nodes[static_cast<size_t>(axis)];
    const double plane = high ? along.back() : along.front();
    std::vector<const Mesh*> touching;
    for (const Mesh& other : fire_.meshes)
      if (&other != &mesh && other.nodes[static_cast<size_t>(axis)].front() <= plane + seam_m &&
          other.nodes[static_cast<size_t>(axis)].back() >= plane - seam_m &&
          glm::all(glm::lessThanEqual(other.low(), mesh.high() + seam_m)) &&
          glm::all(glm::greaterThanEqual(other.high(), mesh.low() - seam_m)))
        touching.push_back(&other);
    std::vector<uint8_t> closed;
    for (int j = 0; j < mesh.cells[v]; ++j)
      for (int i = 0; i < mesh.cells[u]; ++i) {
        glm::dvec3 at;
        at[axis] = plane;
        at[u] = middle_of(mesh, u, i);
        at[v] = middle_of(mesh, v, j);
        glm::dvec3 outside = at, inside = at;
        outside[axis] += high ? seam_m : -seam_m;
        inside[axis] += high ? -seam_m : seam_m;
        const auto cell = static_cast<size_t>(cell_at(mesh, inside));
        const bool behind = std::any_of(touching.begin(), touching.end(), [&](const Mesh* other) {
          return cell_at(*other, outside) >= 0;
        });
        closed.push_back(!behind && !is_open(mesh, at) && gas(m)[cell] != 0 ? 1 : 0);
      }
    const std::vector<double>&nu = mesh.nodes[static_cast<size_t>(u)],
          &nv = mesh.nodes[static_cast<size_t>(v)];
    for (const Patch& p : patches_of(closed, mesh.cells[u], mesh.cells[v])) {
      glm::dvec3 low, far;
      low[axis] = far[axis] = plane;
      low[u] = nu[static_cast<size_t>(p.u0)];
      low[v] = nv[static_cast<size_t>(p.v0)];
      far[u] = nu[static_cast<size_t>(p.u1)];
      far[v] = nv[static_cast<size_t>(p.v1)];
      ++out_.faces;
      out_.tables.face(2 * axis + (high ? 1 : 0), low, far, look_of(fire_.default_surface));
    }
  }

  static double middle_of(const Mesh& mesh, int axis, int cell) {
    const std::vector<double>& nodes = mesh.nodes[static_cast<size_t>(axis)];
    const auto i = static_cast<size_t>(cell);
    return 0.5 * (nodes[i] + nodes[i + 1]);
  }

  static bool is_open(const Mesh& mesh, const glm::dvec3& at) {
    return std::any_of(mesh.openings.begin(), mesh.openings.end(), [&](const Opening& o) {
      return glm::all(glm::greaterThanEqual(at, o.low - seam_m)) &&
             glm::all(glm::lessThanEqual(at, o.high + seam_m));
    });
  }

  void openings(const Mesh& mesh) {
    constexpr const char* sides[] = {"west", "east", "south", "north", "bottom", "top"};
    for (const Opening& o : mesh.openings)
      for (int axis = 0; axis < 3; ++axis) {
        if (o.high[axis] - o.low[axis] > seam_m) continue;
        const bool high = o.low[axis] > 0.5 * (mesh.low()[axis] + mesh.high()[axis]);
        const std::string side = sides[2 * axis + (high ? 1 : 0)];
        if (std::count(out_.open_sides.begin(), out_.open_sides.end(), side) == 0)
          out_.open_sides.push_back(side);
        if (axis < 2 && o.low.z <= mesh.low().z + threshold_m)
          out_.exits.push_back({0.5 * (o.low.x + o.high.x), 0.5 * (o.low.y + o.high.y), o.low.z});
      }
  }

  Case fire_;
  double at_s_;
  FireBuilding out_;
  GasMasks gas_;
  std::set<std::string> plates_;
};

}  // namespace
}  // namespace fds

Result<FireBuilding> read_fire_building(const std::filesystem::path& index, double at_s) {
  auto fire = fds::read_case(index);
  if (!fire) return fire.problem();
  return fire_building_of(std::move(fire).value(), at_s);
}

Result<FireBuilding> fire_building_of(fds::Case fire, double at_s) {
  return fds::BuildingWriter(std::move(fire), at_s).write();
}

}  // namespace luxodus
