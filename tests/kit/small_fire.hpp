// Small FDS results for tests, written from a description: an index, slices, Smoke3D and PLOT3D.
// Values are functions of (i, j, k) of cells or nodes. Any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "tests/kit/temporary_folder.hpp"

namespace luxodus::test {

using ValueAt = std::function<float(int i, int j, int k)>;

template <class T>
std::string bytes_of_values(const std::vector<T>& values) {
  std::string out(values.size() * sizeof(T), '\0');
  if (!values.empty()) std::memcpy(out.data(), values.data(), out.size());
  return out;
}

/// A Fortran record: length, payload, length.
inline std::string fortran_record(const std::string& payload) {
  const std::string mark = bytes_of_values<uint32_t>({static_cast<uint32_t>(payload.size())});
  return mark + payload + mark;
}

inline std::string padded(std::string text, size_t width) {
  text.resize(width, ' ');
  return text;
}

struct SmallMesh {
  std::array<std::vector<double>, 3> nodes;
  std::vector<std::array<int, 6>> obstructions;  // I1 I2 J1 J2 K1 K2
  std::vector<std::array<double, 6>> openings;   // x0 x1 y0 y1 z0 z1

  int cells(int axis) const {
    return static_cast<int>(nodes[static_cast<size_t>(axis)].size()) - 1;
  }
  size_t node_count() const { return nodes[0].size() * nodes[1].size() * nodes[2].size(); }
};

/// Equally spaced nodes from `low` on.
inline SmallMesh even_mesh(const glm::dvec3& low, const glm::dvec3& cell, const glm::ivec3& cells) {
  SmallMesh out;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i <= cells[axis]; ++i)
      out.nodes[static_cast<size_t>(axis)].push_back(low[axis] + cell[axis] * i);
  return out;
}

/// All nodes of a mesh, x fastest.
inline std::vector<float> node_values(const SmallMesh& mesh, const ValueAt& at) {
  std::vector<float> out;
  for (int k = 0; k <= mesh.cells(2); ++k)
    for (int j = 0; j <= mesh.cells(1); ++j)
      for (int i = 0; i <= mesh.cells(0); ++i) out.push_back(at(i, j, k));
  return out;
}

/// A cell-centred slice: values of cells behind a plane of ghost cells on every axis, which hold
/// 99.
inline std::vector<float> cell_values(const SmallMesh& mesh, const ValueAt& at) {
  return node_values(mesh, [&](int i, int j, int k) {
    return i == 0 || j == 0 || k == 0 ? 99.0F : at(i - 1, j - 1, k - 1);
  });
}

struct SmallFrame {
  float time_s;
  std::vector<float> values;
};

inline std::string slice_file(const SmallMesh& mesh, const std::string& label,
                              const std::vector<SmallFrame>& frames) {
  std::string out = fortran_record(padded(label, 30)) + fortran_record(padded("short", 30)) +
                    fortran_record(padded("unit", 30)) +
                    fortran_record(bytes_of_values<int32_t>(
                        {0, mesh.cells(0), 0, mesh.cells(1), 0, mesh.cells(2)}));
  for (const SmallFrame& frame : frames)
    out += fortran_record(bytes_of_values<float>({frame.time_s})) +
           fortran_record(bytes_of_values(frame.values));
  return out;
}

/// A slice of nodes low to high, x0 x1 y0 y1 z0 z1; flat if two are equal.
inline std::string part_slice_file(const std::array<int32_t, 6>& nodes, const std::string& label,
                                   const std::vector<SmallFrame>& frames) {
  std::string out = fortran_record(padded(label, 30)) + fortran_record(padded("short", 30)) +
                    fortran_record(padded("unit", 30)) +
                    fortran_record(bytes_of_values<int32_t>({nodes.begin(), nodes.end()}));
  for (const SmallFrame& frame : frames)
    out += fortran_record(bytes_of_values<float>({frame.time_s})) +
           fortran_record(bytes_of_values(frame.values));
  return out;
}

/// Run-length encoding as in FDS: from four equal bytes on.
inline std::string run_lengths(const std::vector<uint8_t>& bytes) {
  std::string out;
  for (size_t i = 0; i < bytes.size();) {
    size_t n = 1;
    while (i + n < bytes.size() && bytes[i + n] == bytes[i] && n < 254) ++n;
    if (n >= 4) {
      out += {'\xff', static_cast<char>(bytes[i]), static_cast<char>(n)};
    } else {
      out.append(n, static_cast<char>(bytes[i]));
    }
    i += n;
  }
  return out;
}

/// `format`: 0 of bytes of opacity, 1 of shares of the highest density, as FDS 6.11 writes.
inline std::string smoke3d_file(const SmallMesh& mesh, const std::vector<SmallFrame>& frames,
                                int32_t format = 0) {
  std::string out = fortran_record(
      bytes_of_values<int32_t>({1, format, 0, mesh.cells(0), 0, mesh.cells(1), 0, mesh.cells(2)}));
  for (const SmallFrame& frame : frames) {
    std::vector<uint8_t> bytes;
    for (const float v : frame.values) bytes.push_back(static_cast<uint8_t>(v));
    const std::string packed = run_lengths(bytes);
    out += fortran_record(bytes_of_values<float>({frame.time_s})) +
           fortran_record(bytes_of_values<int32_t>(
               {static_cast<int32_t>(bytes.size()), static_cast<int32_t>(packed.size())})) +
           fortran_record(packed);
  }
  return out;
}

/// A file of Smoke3D as FDS 6.11 writes it, and its file of sizes: values are densities.
struct DensityFiles {
  std::string smoke, sizes;
};
inline DensityFiles density_files(const SmallMesh& mesh, const std::vector<SmallFrame>& frames) {
  DensityFiles out;
  out.sizes = "           1\n";
  std::vector<SmallFrame> shares;
  for (const SmallFrame& frame : frames) {
    const float highest = *std::max_element(frame.values.begin(), frame.values.end());
    SmallFrame& one = shares.emplace_back(SmallFrame{frame.time_s, {}});
    std::vector<uint8_t> bytes;
    for (const float v : frame.values) {
      one.values.push_back(highest > 0 ? std::round(254 * v / highest) : 0);
      bytes.push_back(static_cast<uint8_t>(one.values.back()));
    }
    char line[128];
    std::snprintf(line, sizeof line, " %.9g %zu %zu %.9g    \n", static_cast<double>(frame.time_s),
                  bytes.size(), run_lengths(bytes).size(), static_cast<double>(highest));
    out.sizes += line;
  }
  out.smoke = smoke3d_file(mesh, shares, 1);
  return out;
}

/// The quantities in sequence.
inline std::string plot3d_file(const SmallMesh& mesh,
                               const std::array<std::vector<float>, 5>& quantities) {
  std::vector<float> all;
  for (const auto& q : quantities) all.insert(all.end(), q.begin(), q.end());
  return fortran_record(
             bytes_of_values<int32_t>({mesh.cells(0) + 1, mesh.cells(1) + 1, mesh.cells(2) + 1})) +
         fortran_record(bytes_of_values<float>({0, 0, 0, 0})) +
         fortran_record(bytes_of_values(all));
}

/// Numbers of an index, with five decimals.
inline std::string index_numbers(const std::vector<double>& values) {
  std::string out;
  char text[64];
  for (const double v : values) {
    std::snprintf(text, sizeof text, " %13.5f", v);
    out += text;
  }
  return out + "\n";
}

/// The meshes of an index, after the common head. Surface 0 is INERT, 1 is OPEN.
inline std::string index_of_meshes(const std::vector<SmallMesh>& meshes) {
  std::string out =
      "TITLE\n small fire\n\nFDSVERSION\nFDS-6.9.1-0-g0-test\n\nCSVF\n hrr\n small_hrr.csv\n\n"
      "SURFACE\n INERT\n 5000.00 1.00\n 0 1 1 1 0.8 0.4 1\n null\n\n"
      "SURFACE\n OPEN\n 5000.00 1.00\n 2 1 1 1 0 1 1\n null\n\n";
  for (size_t m = 0; m < meshes.size(); ++m) {
    const SmallMesh& mesh = meshes[m];
    out += "OFFSET\n 0 0 0\n\nGRID  mesh " + std::to_string(m + 1) + "\n " +
           std::to_string(mesh.cells(0)) + " " + std::to_string(mesh.cells(1)) + " " +
           std::to_string(mesh.cells(2)) + " 0\n\nPDIM\n" +
           index_numbers({mesh.nodes[0].front(), mesh.nodes[0].back(), mesh.nodes[1].front(),
                          mesh.nodes[1].back(), mesh.nodes[2].front(), mesh.nodes[2].back()});
    for (size_t axis = 0; axis < 3; ++axis) {
      out += std::string("\nTRN") + "XYZ"[axis] + "\n 1\n -1 0.0 0.0\n";
      for (size_t i = 0; i < mesh.nodes[axis].size(); ++i)
        out += " " + std::to_string(i) + index_numbers({mesh.nodes[axis][i]});
    }
    out += "\nOBST\n " + std::to_string(mesh.obstructions.size()) + "\n";
    for (size_t i = 0; i < mesh.obstructions.size(); ++i)
      out += " 0 0 0 0 0 0 " + std::to_string(i + 1) + " 0 0 0 0 0 0 ! wall\n";
    for (const auto& box : mesh.obstructions) {
      for (const int node : box) out += " " + std::to_string(node);
      out += " -1 -1 ! F\n";
    }
    out += "\nVENT\n " + std::to_string(mesh.openings.size()) + " 0\n";
    for (const auto& box : mesh.openings) {
      std::string line = index_numbers({box.begin(), box.end()});
      line.pop_back();
      out += line + " 1 1\n";
    }
    for (size_t i = 0; i < mesh.openings.size(); ++i) out += " 0 0 0 0 0 0 0 0\n";
  }
  return out;
}

/// The unit of FDS for a label.
inline std::string unit_of_label(const std::string& label) {
  const auto ends = [&](const char* end) { return label.ends_with(end); };
  return ends("COEFFICIENT") || ends("OPTICAL DENSITY") ? "1/m"
         : ends("DENSITY")                              ? "kg/m3"
         : ends("HRRPUV")                               ? "kW/m3"
         : ends("VISIBILITY")                           ? "m"
                                                        : "unit";
}
inline std::string label_lines(const std::string& label) {
  return " " + label + "\n short\n " + unit_of_label(label) + "\n";
}

/// Entries of an index for result files.
inline std::string slice_entry(size_t mesh, bool of_cells, const SmallMesh& of,
                               const std::string& file, const std::string& label) {
  return std::string(of_cells ? "SLCC " : "SLCF ") + std::to_string(mesh) + " # STRUCTURED & 0 " +
         std::to_string(of.cells(0)) + " 0 " + std::to_string(of.cells(1)) + " 0 " +
         std::to_string(of.cells(2)) + " ! 1 0 0\n " + file + "\n" + label_lines(label);
}
inline std::string part_slice_entry(size_t mesh, bool of_cells, const std::array<int32_t, 6>& nodes,
                                    const std::string& file, const std::string& label) {
  std::string out =
      std::string(of_cells ? "SLCC " : "SLCF ") + std::to_string(mesh) + " # STRUCTURED &";
  for (const int32_t node : nodes) out += " " + std::to_string(node);
  return out + " ! 1 0 0\n " + file + "\n" + label_lines(label);
}
inline std::string smoke_entry(size_t mesh, const std::string& file, const std::string& label,
                               const std::string& mass_extinction = "8700.000") {
  return "SMOKF3D " + std::to_string(mesh) + " " + mass_extinction + "\n " + file + "\n" +
         label_lines(label);
}

}  // namespace luxodus::test
