#include "scenes/formats/fields/fds_cells.hpp"

#include <algorithm>
#include <cmath>

namespace luxodus::fds {

namespace {

/// The highest byte stands for "more than"; half a step below it the value is finite.
constexpr double byte_scale = 254, highest_byte = 253.5;
/// Faces of vents and meshes are written with five decimals [m].
constexpr double face_tolerance_m = 1e-5;
/// Rounds of the iteration that removes the blur of node values. Against the cells of the reference
/// cases the largest error of a line is 20 % with none, 11 % with 3, 9 % with 5, 7 % with 10; more
/// rounds raise the noise of Smoke3D's bytes.
constexpr int sharpening_rounds = 5;

size_t place_of(const glm::ivec3& n, int x, int y, int z) {
  return (static_cast<size_t>(z) * static_cast<size_t>(n.y) + static_cast<size_t>(y)) *
             static_cast<size_t>(n.x) +
         static_cast<size_t>(x);
}

double middle(const std::vector<double>& nodes, int cell) {
  const auto i = static_cast<size_t>(cell);
  return 0.5 * (nodes[i] + nodes[i + 1]);
}

/// The cell of a coordinate along an axis, -1 outside.
int cell_of(const std::vector<double>& nodes, double at) {
  if (!(at >= nodes.front() && at <= nodes.back())) return -1;
  const auto next = std::upper_bound(nodes.begin(), nodes.end(), at);
  return std::min(static_cast<int>(next - nodes.begin()), static_cast<int>(nodes.size()) - 1) - 1;
}

/// 1 in cells that no obstruction covers. `there`: for each obstruction, whether it exists. Corners
/// of boxes are summed up along the three axes, so that the time is linear in cells, not in
/// obstructions times cells.
std::vector<uint8_t> cells_outside(const Mesh& m, const std::vector<uint8_t>& there) {
  const glm::ivec3 n = m.node_counts();
  std::vector<int32_t> covers(m.node_count(), 0);
  for (size_t i = 0; i < m.obstructions.size(); ++i) {
    const auto& [low, high] = m.obstructions[i];
    if (there[i] == 0 || glm::any(glm::greaterThanEqual(low, high))) continue;
    for (int corner = 0; corner < 8; ++corner) {
      const bool x = (corner & 1) != 0, y = (corner & 2) != 0, z = (corner & 4) != 0;
      covers[place_of(n, x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z)] +=
          x ^ y ^ z ? -1 : 1;
    }
  }
  const auto plane = static_cast<size_t>(n.x) * static_cast<size_t>(n.y);
  const size_t steps[] = {1, static_cast<size_t>(n.x), plane};
  for (int axis = 0; axis < 3; ++axis) {
    size_t at = 0;
    glm::ivec3 node;
    for (node.z = 0; node.z < n.z; ++node.z)
      for (node.y = 0; node.y < n.y; ++node.y)
        for (node.x = 0; node.x < n.x; ++node.x, ++at)
          if (node[axis] > 0) covers[at] += covers[at - steps[axis]];
  }
  std::vector<uint8_t> gas(m.cell_count(), 0);
  size_t cell = 0;
  for (int z = 0; z < m.cells.z; ++z)
    for (int y = 0; y < m.cells.y; ++y)
      for (int x = 0; x < m.cells.x; ++x, ++cell)
        gas[cell] = covers[place_of(n, x, y, z)] == 0 ? 1 : 0;
  return gas;
}

/// Finds gas behind the faces of a mesh.
class Behind {
 public:
  Behind(const Case& fire, const GasMasks& gas, size_t mesh)
      : fire_(fire), gas_(gas), mesh_(fire.meshes[mesh]) {
    const glm::dvec3 low = mesh_.low() - face_tolerance_m, high = mesh_.high() + face_tolerance_m;
    for (size_t other = 0; other < fire.meshes.size(); ++other) {
      const Mesh& m = fire.meshes[other];
      if (glm::all(glm::lessThanEqual(m.low(), high)) &&
          glm::all(glm::greaterThanEqual(m.high(), low)))
        near_.push_back(other);
    }
  }

  /// Whether the place behind a face holds gas. `cell`: outside the mesh along one axis.
  bool is_gas(const glm::ivec3& cell) const {
    glm::dvec3 place, face;
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<double>& nodes = mesh_.nodes[static_cast<size_t>(axis)];
      const int n = mesh_.cells[axis];
      const bool below = cell[axis] < 0, above = cell[axis] >= n;
      const double inner = middle(nodes, std::clamp(cell[axis], 0, n - 1));
      face[axis] = below ? nodes.front() : above ? nodes.back() : inner;
      place[axis] = below || above ? 2 * face[axis] - inner : inner;
    }
    for (const size_t other : near_) {
      const Mesh& m = fire_.meshes[other];
      if (const int64_t there = cell_at(m, place); there >= 0)
        return gas_[other][static_cast<size_t>(there)] != 0;
    }
    return std::any_of(mesh_.openings.begin(), mesh_.openings.end(), [&](const Opening& opening) {
      return glm::all(glm::greaterThanEqual(face, opening.low - face_tolerance_m)) &&
             glm::all(glm::lessThanEqual(face, opening.high + face_tolerance_m));
    });
  }

 private:
  const Case& fire_;
  const GasMasks& gas_;
  const Mesh& mesh_;
  std::vector<size_t> near_;  // meshes that touch it, including itself, in their order
};

}  // namespace

std::vector<uint8_t> obstructions_at(const Case& fire, size_t mesh, double time_s) {
  const Mesh& m = fire.meshes[mesh];
  std::vector<uint8_t> there(m.obstructions.size(), 1), told(m.obstructions.size(), 0);
  for (const Change& change : fire.changes) {
    if (change.mesh != mesh) continue;
    // An obstruction whose first change is to appear was absent before.
    if (told[change.obstruction] == 0 && change.appears) there[change.obstruction] = 0;
    told[change.obstruction] = 1;
    // Times have the digits of a float in one file and of a text in the other.
    if (change.time_s <= time_s + 1e-5 * std::max(1.0, std::abs(time_s)))
      there[change.obstruction] = change.appears ? 1 : 0;
  }
  return there;
}

std::vector<uint8_t> gas_cells(const Case& fire, size_t mesh, double time_s) {
  return cells_outside(fire.meshes[mesh], obstructions_at(fire, mesh, time_s));
}

std::vector<uint8_t> gas_cells_ever(const Case& fire, size_t mesh) {
  std::vector<uint8_t> always(fire.meshes[mesh].obstructions.size(), 1);
  for (const Change& change : fire.changes)
    if (change.mesh == mesh) always[change.obstruction] = 0;
  return cells_outside(fire.meshes[mesh], always);
}

int64_t cell_at(const Mesh& mesh, const glm::dvec3& place) {
  const glm::ivec3 cell(cell_of(mesh.nodes[0], place.x), cell_of(mesh.nodes[1], place.y),
                        cell_of(mesh.nodes[2], place.z));
  if (cell.x < 0 || cell.y < 0 || cell.z < 0) return -1;
  return static_cast<int64_t>(place_of(mesh.cells, cell.x, cell.y, cell.z));
}

std::vector<uint8_t> filled_around_nodes(const Case& fire, const GasMasks& gas, size_t mesh,
                                         SmokeFormat format) {
  const Mesh& m = fire.meshes[mesh];
  const glm::ivec3 n = m.node_counts();
  std::vector<uint8_t> count(m.node_count(), 0);
  const auto add = [&](const glm::ivec3& cell) {
    for (int corner = 0; corner < 8; ++corner) {
      const glm::ivec3 node = cell + glm::ivec3(corner & 1, (corner >> 1) & 1, corner >> 2);
      if (glm::any(glm::lessThan(node, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(node, n)))
        continue;
      ++count[place_of(n, node.x, node.y, node.z)];
    }
  };
  for (int z = 0; z < m.cells.z; ++z)
    for (int y = 0; y < m.cells.y; ++y)
      for (int x = 0; x < m.cells.x; ++x)
        if (gas[mesh][place_of(m.cells, x, y, z)] != 0) add({x, y, z});
  const Behind behind(fire, gas, mesh);
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const int end : {-1, m.cells[axis]}) {
      glm::ivec3 cell, before;
      cell[axis] = end;
      for (cell[u] = 0; cell[u] < m.cells[u]; ++cell[u])
        for (cell[v] = 0; cell[v] < m.cells[v]; ++cell[v]) {
          before = cell;
          before[axis] = std::clamp(end, 0, m.cells[axis] - 1);
          const bool from_wall = format == SmokeFormat::density &&
                                 gas[mesh][place_of(m.cells, before.x, before.y, before.z)] != 0;
          if (from_wall || behind.is_gas(cell)) add(cell);
        }
    }
  }
  return count;
}

namespace {

/// Mean of the eight nodes of each gas cell; 0 in solids.
std::vector<float> cell_means(const Mesh& mesh, const std::vector<float>& nodes,
                              const std::vector<uint8_t>& gas) {
  const glm::ivec3 n = mesh.node_counts();
  std::vector<float> out(mesh.cell_count(), 0.0F);
  size_t cell = 0;
  for (int z = 0; z < mesh.cells.z; ++z)
    for (int y = 0; y < mesh.cells.y; ++y)
      for (int x = 0; x < mesh.cells.x; ++x, ++cell) {
        if (gas[cell] == 0) continue;
        double sum = 0;
        for (int corner = 0; corner < 8; ++corner)
          sum += static_cast<double>(
              nodes[place_of(n, x + (corner & 1), y + ((corner >> 1) & 1), z + (corner >> 2))]);
        out[cell] = static_cast<float>(sum / 8);
      }
  return out;
}

/// Takes from each node the mean of the gas cells around it; 0 where there are none.
void take_means(const Mesh& mesh, const std::vector<float>& cells, const std::vector<uint8_t>& gas,
                std::vector<float>& nodes) {
  const glm::ivec3 n = mesh.node_counts();
  size_t node = 0;
  for (int z = 0; z < n.z; ++z)
    for (int y = 0; y < n.y; ++y)
      for (int x = 0; x < n.x; ++x, ++node) {
        double sum = 0;
        int count = 0;
        for (int corner = 0; corner < 8; ++corner) {
          const int i = x - (corner & 1), j = y - ((corner >> 1) & 1), k = z - (corner >> 2);
          if (i < 0 || j < 0 || k < 0 || i >= mesh.cells.x || j >= mesh.cells.y ||
              k >= mesh.cells.z)
            continue;
          const size_t cell = place_of(mesh.cells, i, j, k);
          if (gas[cell] == 0) continue;
          sum += static_cast<double>(cells[cell]);
          ++count;
        }
        nodes[node] = count > 0 ? nodes[node] - static_cast<float>(sum / count) : 0;
      }
}

}  // namespace

std::vector<float> cells_of_nodes(const Mesh& mesh, const std::vector<float>& nodes,
                                  const std::vector<uint8_t>& gas) {
  // Most of a large building is clear and needs no solving.
  if (std::all_of(nodes.begin(), nodes.end(), [](float v) { return v == 0; }))
    return std::vector<float>(mesh.cell_count(), 0.0F);
  std::vector<float> cells = cell_means(mesh, nodes, gas);
  for (int round = 0; round < sharpening_rounds; ++round) {
    std::vector<float> rest = nodes;
    take_means(mesh, cells, gas, rest);
    const std::vector<float> more = cell_means(mesh, rest, gas);
    for (size_t i = 0; i < cells.size(); ++i) cells[i] = std::max(0.0F, cells[i] + more[i]);
  }
  return cells;
}

std::vector<float> cells_of_slice(const Mesh& mesh, const std::vector<float>& values,
                                  const std::vector<uint8_t>& gas) {
  const glm::ivec3 n = mesh.node_counts();
  std::vector<float> out(mesh.cell_count(), 0.0F);
  size_t cell = 0;
  for (int z = 0; z < mesh.cells.z; ++z)
    for (int y = 0; y < mesh.cells.y; ++y)
      for (int x = 0; x < mesh.cells.x; ++x, ++cell)
        if (gas[cell] != 0) out[cell] = values[place_of(n, x + 1, y + 1, z + 1)];
  return out;
}

std::vector<float> extinction_of_opacities(const Mesh& mesh, const std::vector<uint8_t>& bytes) {
  const double first_m = mesh.nodes[0][1] - mesh.nodes[0][0];
  std::array<float, 256> of_byte{};
  for (size_t b = 0; b < of_byte.size(); ++b)
    of_byte[b] = static_cast<float>(
        -std::log1p(-std::min(static_cast<double>(b), highest_byte) / byte_scale) / first_m);
  std::vector<float> out(bytes.size());
  std::transform(bytes.begin(), bytes.end(), out.begin(), [&](uint8_t b) { return of_byte[b]; });
  return out;
}

std::vector<float> values_of_shares(const std::vector<uint8_t>& bytes, double highest) {
  std::vector<float> out(bytes.size());
  std::transform(bytes.begin(), bytes.end(), out.begin(), [&](uint8_t b) {
    return static_cast<float>(highest * static_cast<double>(b) / byte_scale);
  });
  return out;
}

bool walls_hold_smoke(const Mesh& mesh, const std::vector<uint8_t>& bytes,
                      const std::vector<float>& nodes, const std::vector<uint8_t>& filled_around,
                      SmokeFormat format) {
  // Below, a step of a byte is too coarse; above, opacities are cut off.
  const uint8_t least = 8, most = format == SmokeFormat::opacity ? 240 : 255;
  constexpr float same = 0.95F;
  const glm::ivec3 n = mesh.node_counts();
  size_t full = 0, fraction = 0, node = 0;
  for (int z = 0; z < n.z; ++z)
    for (int y = 0; y < n.y; ++y)
      for (int x = 0; x < n.x; ++x, ++node) {
        if (filled_around[node] == 0 || filled_around[node] == 8) continue;
        for (int side = 0; side < 6; ++side) {
          glm::ivec3 at(x, y, z);
          at[side / 2] += side % 2 == 0 ? -1 : 1;
          if (glm::any(glm::lessThan(at, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(at, n)))
            continue;
          const size_t inner = place_of(n, at.x, at.y, at.z);
          if (filled_around[inner] != 8 || bytes[inner] < least || bytes[inner] > most) continue;
          ++(nodes[node] >= same * nodes[inner] ? full : fraction);
        }
      }
  return full > fraction;
}

void correct_at_walls(std::vector<float>& nodes, const std::vector<uint8_t>& filled_around,
                      const std::vector<float>& at_start) {
  for (size_t i = 0; i < nodes.size(); ++i) {
    const auto filled = static_cast<float>(filled_around[i]);
    const float in_walls = at_start.empty() ? 0 : (8 - filled) * at_start[i];
    nodes[i] = filled > 0 ? std::max(0.0F, 8 * nodes[i] - in_walls) / filled : 0;
  }
}

}  // namespace luxodus::fds
