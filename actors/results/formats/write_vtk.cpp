// The file is an XML head whose DataArray elements give offsets into one appended section: each
// array there is a UInt64 byte count followed by its bytes. The head is made while the arrays are
// appended.
#include "actors/results/formats/write_vtk.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <set>

#include "runtime/core/output_text.hpp"

namespace luxodus {
namespace {

static_assert(std::endian::native == std::endian::little,
              "arrays are appended as they lie in memory");

template <class T>
constexpr const char* vtk_type() {
  if constexpr (std::is_same_v<T, float>) return "Float32";
  if constexpr (std::is_same_v<T, double>) return "Float64";
  if constexpr (std::is_same_v<T, int32_t>) return "Int32";
  if constexpr (std::is_same_v<T, int64_t>) return "Int64";
}

/// Collects the appended section and returns the elements that refer to it.
class Appended {
 public:
  template <class T>
  std::string element(const std::string& name, int components, const std::vector<T>& values) {
    const std::string offset = std::to_string(bytes_.size());
    const uint64_t size = values.size() * sizeof(T);
    append(&size, sizeof size);
    append(values.data(), static_cast<size_t>(size));
    return std::string("        <DataArray type=\"") + vtk_type<T>() + "\" Name=\"" +
           xml_escape(name) + "\" NumberOfComponents=\"" + std::to_string(components) +
           "\" format=\"appended\" offset=\"" + offset + "\"/>\n";
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void append(const void* data, size_t size) {
    if (size > 0) bytes_.append(static_cast<const char*>(data), size);
  }

  std::string bytes_;
};

std::string number_triple(const glm::dvec3& v) {
  return shortest_number(v.x) + " " + shortest_number(v.y) + " " + shortest_number(v.z);
}

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// A comment cannot hold two hyphens in a row, nor end with one (XML 1.0, 2.5).
std::string xml_comment(const std::string& comment) {
  if (comment.empty()) return "";
  std::string out;
  for (const char c : clean_utf8(comment)) {
    if (c == '-' && !out.empty() && out.back() == '-') out += ' ';
    out += c;
  }
  return "<!-- " + out + " -->\n";
}

Result<void> check_arrays(const std::vector<VtkArray>& arrays, uint64_t cells,
                          const SourcePlace& place) {
  std::set<std::string_view> names;
  for (const VtkArray& array : arrays) {
    if (array.name.empty())
      return problem_in(place, "an array of a VTK file needs a name", ProblemKind::bug);
    if (array.name.find_first_of(" []") != std::string::npos)
      return problem_in(place,
                        "the name of array '" + clean_utf8(array.name) +
                            "' has blanks or brackets, which other programs' formulas do not take",
                        ProblemKind::bug);
    if (!names.insert(array.name).second) {
      return problem_in(place,
                        "array '" + clean_utf8(array.name) + "' is there twice; names must differ",
                        ProblemKind::bug);
    }
    const size_t size = std::visit([](const auto& values) { return values.size(); }, array.values);
    if (array.components < 1 || size != cells * static_cast<uint64_t>(array.components)) {
      return problem_in(place,
                        "array '" + clean_utf8(array.name) + "' has " + std::to_string(size) +
                            " values; " + std::to_string(cells) + " cells with " +
                            std::to_string(array.components) + " components were expected",
                        ProblemKind::bug);
    }
  }
  return {};
}

std::string cell_data_elements(const std::vector<VtkArray>& arrays, Appended& appended) {
  std::string out = "      <CellData>\n";
  for (const VtkArray& array : arrays) {
    out += std::visit(
        [&](const auto& values) { return appended.element(array.name, array.components, values); },
        array.values);
  }
  return out + "      </CellData>\n";
}

/// An array of texts that belong to no cell: each as its bytes and a zero.
std::string field_data_element(const std::string& name, const std::vector<std::string>& texts) {
  if (texts.empty()) return "";
  std::string out = "    <FieldData>\n      <DataArray type=\"String\" Name=\"" + name +
                    "\" NumberOfTuples=\"" + std::to_string(texts.size()) +
                    "\" format=\"ascii\">\n";
  for (const std::string& text : texts) {
    out += "        ";
    for (const char c : clean_utf8(text))
      out += std::to_string(static_cast<unsigned>(static_cast<unsigned char>(c))) + " ";
    out += "0\n";
  }
  return out + "      </DataArray>\n    </FieldData>\n";
}

std::string file_start(const char* type, const std::string& comment) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + xml_comment(comment) +
         "<VTKFile type=\"" + type +
         "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n";
}

std::string file_end(const Appended& appended) {
  return "  <AppendedData encoding=\"raw\">\n_" + appended.bytes() +
         "\n  </AppendedData>\n</VTKFile>\n";
}

Result<void> check_surface(const VtkSurface& surface, const SourcePlace& place) {
  if (surface.points.size() > limits::max_vtk_cells ||
      surface.triangles.size() > limits::max_vtk_cells) {
    return problem_in(place, "too many triangles for one VTK file; use larger patches");
  }
  for (const glm::dvec3& point : surface.points) {
    if (!finite(point))
      return problem_in(place, "a point has a coordinate that is not a number", ProblemKind::bug);
  }
  for (const glm::uvec3& t : surface.triangles) {
    if (std::max({t.x, t.y, t.z}) >= surface.points.size()) {
      return problem_in(place, "a triangle names a point that is not there", ProblemKind::bug);
    }
  }
  return check_arrays(surface.cell_data, surface.triangles.size(), place);
}

}  // namespace

Result<void> write_vtp(const std::filesystem::path& path, const VtkSurface& surface) {
  if (auto good = check_surface(surface, {path.string(), 0}); !good) return good.problem();
  std::vector<double> points;
  points.reserve(surface.points.size() * 3);
  for (const glm::dvec3& p : surface.points) points.insert(points.end(), {p.x, p.y, p.z});
  std::vector<int64_t> connectivity;
  std::vector<int64_t> offsets;
  connectivity.reserve(surface.triangles.size() * 3);
  offsets.reserve(surface.triangles.size());
  for (const glm::uvec3& t : surface.triangles) {
    connectivity.insert(connectivity.end(), {int64_t{t.x}, int64_t{t.y}, int64_t{t.z}});
    offsets.push_back(static_cast<int64_t>(connectivity.size()));
  }

  Appended appended;
  std::string head = file_start("PolyData", surface.comment) + "  <PolyData>\n";
  head += field_data_element("surface_names", surface.surface_names);
  head += "    <Piece NumberOfPoints=\"" + std::to_string(surface.points.size()) +
          "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
          std::to_string(surface.triangles.size()) + "\">\n";
  head += cell_data_elements(surface.cell_data, appended);
  // Separate statements, because the evaluation order of operands of + is not defined.
  head += "      <Points>\n";
  head += appended.element("Points", 3, points);
  head += "      </Points>\n      <Polys>\n";
  head += appended.element("connectivity", 1, connectivity);
  head += appended.element("offsets", 1, offsets);
  head += "      </Polys>\n";
  head += "    </Piece>\n  </PolyData>\n";
  return write_file_atomically(path, std::string_view(head + file_end(appended)));
}

Result<void> write_vti(const std::filesystem::path& path, const VtkVolume& volume) {
  const SourcePlace place{path.string(), 0};
  uint64_t cells = 1;
  for (const int n : volume.cells) {
    if (n < 1 || static_cast<uint64_t>(n) > limits::max_vtk_cells / cells) {
      return problem_in(place, "a volume needs at least one voxel each way and at most " +
                                   std::to_string(limits::max_vtk_cells) + " in all");
    }
    cells *= static_cast<uint64_t>(n);
  }
  const glm::dvec3& spacing = volume.spacing;
  if (!finite(volume.origin) || !finite(spacing) ||
      std::min({spacing.x, spacing.y, spacing.z}) <= 0) {
    return problem_in(place,
                      "the origin of a volume must be finite and its voxels larger than zero");
  }
  if (auto good = check_arrays(volume.cell_data, cells, place); !good) return good.problem();

  const std::string extent = "0 " + std::to_string(volume.cells[0]) + " 0 " +
                             std::to_string(volume.cells[1]) + " 0 " +
                             std::to_string(volume.cells[2]);
  Appended appended;
  std::string head = file_start("ImageData", volume.comment);
  head += "  <ImageData WholeExtent=\"" + extent + "\" Origin=\"" + number_triple(volume.origin) +
          "\" Spacing=\"" + number_triple(spacing) + "\">\n    <Piece Extent=\"" + extent + "\">\n";
  head += cell_data_elements(volume.cell_data, appended);
  head += "    </Piece>\n  </ImageData>\n";
  return write_file_atomically(path, std::string_view(head + file_end(appended)));
}

}  // namespace luxodus
