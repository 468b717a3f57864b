#include "actors/results/formats/write_vtk.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>

#include "runtime/core/regular_file.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using Catch::Matchers::Contains;

namespace {

/// One DataArray element with the bytes it points to.
struct FoundArray {
  std::string type;
  int components = 0;
  std::string bytes;

  template <class T>
  std::vector<T> as() const {
    std::vector<T> out(bytes.size() / sizeof(T));
    std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
    return out;
  }
};

std::string attribute(const std::string& element, const std::string& name) {
  const size_t at = element.find(" " + name + "=\"");
  REQUIRE(at != std::string::npos);
  const size_t from = at + name.size() + 3;
  return element.substr(from, element.find('"', from) - from);
}

/// Reads a VTK XML file independently: head, then arrays by offset.
struct FoundFile {
  std::string head;
  std::map<std::string, FoundArray> arrays;

  explicit FoundFile(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = read_whole_file(path, 1 << 24).value();
    const std::string all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::string opening = "<AppendedData encoding=\"raw\">\n_";
    const size_t split = all.find(opening);
    REQUIRE(split != std::string::npos);
    head = all.substr(0, split);
    const size_t data = split + opening.size();
    const std::string ending = "\n  </AppendedData>\n</VTKFile>\n";
    REQUIRE(all.substr(all.size() - ending.size()) == ending);
    size_t end = data;
    for (size_t at = head.find("<DataArray"); at != std::string::npos;
         at = head.find("<DataArray", at + 1)) {
      const std::string element = head.substr(at, head.find("/>", at) - at);
      CHECK(attribute(element, "format") == "appended");
      const size_t offset = data + std::stoul(attribute(element, "offset"));
      CHECK(offset == end);  // arrays follow each other without gaps
      uint64_t size = 0;
      std::memcpy(&size, all.data() + offset, 8);
      REQUIRE(offset + 8 + size <= all.size());
      arrays[attribute(element, "Name")] = {attribute(element, "type"),
                                            std::stoi(attribute(element, "NumberOfComponents")),
                                            all.substr(offset + 8, size)};
      end = offset + 8 + size;
    }
    CHECK(end == all.size() - ending.size());
  }
};

VtkSurface surface_example() {
  VtkSurface surface;
  surface.comment = "box -- a test ---";
  surface.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1e6 + 0.001, 1, 1}};
  surface.triangles = {{0, 1, 2}, {0, 2, 3}};
  surface.cell_data = {
      {"illuminance_lx", 1, std::vector<float>{1.5f, std::nanf("")}},
      {"<odd>&\"name\"ä", 3, std::vector<double>{1, 2, 3, 4, 5, 6}},
      {"material", 1, std::vector<int32_t>{7, -8}},
      {"object", 1, std::vector<int64_t>{int64_t{1} << 40, 0}},
  };
  return surface;
}

VtkVolume volume_example() {
  VtkVolume volume;
  volume.origin = {-1, 0.1, 2};
  volume.spacing = {0.5, 0.25, 1};
  volume.cells = {3, 2, 4};
  std::vector<float> values(24);
  for (size_t i = 0; i < 24; ++i) values[i] = static_cast<float>(i);
  volume.cell_data = {{"fluence_lx", 1, values}};
  return volume;
}

/// Whether Python's XML parser accepts the head, completed by closing tags; true without Python.
bool python_parses(const test::TemporaryFolder& folder, const std::string& head) {
  if (std::system("command -v python3 > /dev/null 2>&1") != 0) return true;
  REQUIRE(write_file_atomically(folder / "head.xml", std::string_view(head + "</VTKFile>")).ok());
  const std::string command =
      "python3 -c 'import sys, xml.etree.ElementTree as e; r = e.parse(sys.argv[1]).getroot(); "
      "p = r[0][0]; sys.exit(0 if r.tag == \"VTKFile\" and p.tag == \"Piece\" and "
      "p.find(\"CellData\") is not None else 1)' '" +
      (folder / "head.xml").string() + "'";
  return std::system(command.c_str()) == 0;
}

}  // namespace

TEST_CASE("a surface written for VTK is read back array by array", "[format][vtk]") {
  const test::TemporaryFolder folder;
  REQUIRE(write_vtp(folder / "patches.vtp", surface_example()).ok());
  const FoundFile file(folder / "patches.vtp");
  CHECK_THAT(file.head,
             Contains("<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
                      "header_type=\"UInt64\">"));
  CHECK_THAT(file.head, Contains("NumberOfPoints=\"4\"") && Contains("NumberOfPolys=\"2\""));
  CHECK(file.arrays.size() == 7);
  CHECK(file.arrays.at("Points").as<double>() ==
        std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 1e6 + 0.001, 1, 1});
  CHECK(file.arrays.at("Points").components == 3);
  CHECK(file.arrays.at("connectivity").as<int64_t>() == std::vector<int64_t>{0, 1, 2, 0, 2, 3});
  CHECK(file.arrays.at("offsets").as<int64_t>() == std::vector<int64_t>{3, 6});
  const FoundArray& lux = file.arrays.at("illuminance_lx");
  CHECK(lux.type == "Float32");
  CHECK(lux.as<float>()[0] == 1.5f);
  CHECK(std::isnan(lux.as<float>()[1]));
  const FoundArray& odd = file.arrays.at("&lt;odd&gt;&amp;&quot;name&quot;ä");
  CHECK(odd.type == "Float64");
  CHECK(odd.components == 3);
  CHECK(odd.as<double>() == std::vector<double>{1, 2, 3, 4, 5, 6});
  CHECK(file.arrays.at("material").type == "Int32");
  CHECK(file.arrays.at("material").as<int32_t>() == std::vector<int32_t>{7, -8});
  CHECK(file.arrays.at("object").as<int64_t>()[0] == int64_t{1} << 40);
  CHECK(python_parses(folder, file.head));
}

TEST_CASE("a volume written for VTK has its extent, its place and its voxels", "[format][vtk]") {
  const test::TemporaryFolder folder;
  REQUIRE(write_vti(folder / "volume.vti", volume_example()).ok());
  const FoundFile file(folder / "volume.vti");
  CHECK_THAT(file.head, Contains("<VTKFile type=\"ImageData\""));
  CHECK_THAT(file.head, Contains("WholeExtent=\"0 3 0 2 0 4\" Origin=\"-1 0.1 2\" "
                                 "Spacing=\"0.5 0.25 1\""));
  const std::vector<float> values = file.arrays.at("fluence_lx").as<float>();
  REQUIRE(values.size() == 24);
  CHECK(values[23] == 23.0f);
  CHECK(python_parses(folder, file.head));
}

TEST_CASE("names of surfaces are texts of the whole file, not of cells", "[format][vtk]") {
  const test::TemporaryFolder folder;
  VtkSurface surface = surface_example();
  surface.surface_names = {"a b", "ü"};
  REQUIRE(write_vtp(folder / "named.vtp", surface).ok());
  std::ifstream in(folder / "named.vtp", std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto names = text.find(
      "<DataArray type=\"String\" Name=\"surface_names\" "
      "NumberOfTuples=\"2\" format=\"ascii\">");
  REQUIRE(names != std::string::npos);
  CHECK(text.rfind("<FieldData>", names) != std::string::npos);
  CHECK(names < text.find("<Piece"));
  CHECK(text.find("97 32 98 0\n", names) < text.find("195 188 0\n", names));
  CHECK(text.find("195 188 0\n", names) < text.find("</FieldData>", names));
}

TEST_CASE("a surface without triangles and a name without a file are handled", "[format][vtk]") {
  const test::TemporaryFolder folder;
  REQUIRE(write_vtp(folder / "empty.vtp", VtkSurface{}).ok());
  CHECK(FoundFile(folder / "empty.vtp").arrays.at("Points").bytes.empty());
  CHECK_THAT(write_vtp(folder / "none" / "a.vtp", surface_example()).problem().text(),
             Contains("none/a.vtp") && Contains("No such file"));
  CHECK_THAT(write_vti(folder / "none" / "a.vti", volume_example()).problem().text(),
             Contains("none/a.vti") && Contains("No such file"));
}

TEST_CASE("data that VTK could not read are not written", "[format][vtk]") {
  const test::TemporaryFolder folder;
  const auto surface_refusal = [&](auto change) {
    VtkSurface surface = surface_example();
    change(surface);
    const Result<void> done = write_vtp(folder / "a.vtp", surface);
    REQUIRE_FALSE(done.ok());
    return done.problem().what;
  };
  CHECK_THAT(surface_refusal([](VtkSurface& s) { s.triangles[1].z = 4; }),
             Contains("a point that is not there"));
  CHECK_THAT(surface_refusal([](VtkSurface& s) { s.points[1].y = INFINITY; }),
             Contains("not a number"));
  CHECK_THAT(surface_refusal([](VtkSurface& s) { s.cell_data[0].name = "material"; }),
             Contains("'material' is there twice"));
  CHECK_THAT(surface_refusal([](VtkSurface& s) { s.cell_data[0].name = ""; }),
             Contains("needs a name"));
  CHECK_THAT(surface_refusal([](VtkSurface& s) { s.cell_data[0].name = "illuminance [lx]"; }),
             Contains("blanks or brackets"));
  CHECK_THAT(surface_refusal([](VtkSurface& s) { s.cell_data[0].components = 2; }),
             Contains("has 2 values"));
  CHECK_THAT(surface_refusal([](VtkSurface& s) { s.cell_data[0].components = 0; }),
             Contains("0 components"));
  const auto volume_refusal = [&](auto change) {
    VtkVolume volume = volume_example();
    change(volume);
    const Result<void> done = write_vti(folder / "a.vti", volume);
    REQUIRE_FALSE(done.ok());
    return done.problem().what;
  };
  CHECK_THAT(volume_refusal([](VtkVolume& v) { v.cells[1] = 0; }), Contains("at least one voxel"));
  CHECK_THAT(volume_refusal([](VtkVolume& v) {
               v.cells = {1 << 20, 1 << 20, 1 << 20};
             }),
             Contains("at most"));
  CHECK_THAT(volume_refusal([](VtkVolume& v) { v.spacing.z = 0; }), Contains("larger than zero"));
  CHECK_THAT(volume_refusal([](VtkVolume& v) { v.origin.x = NAN; }), Contains("finite"));
  CHECK_THAT(volume_refusal([](VtkVolume& v) { v.cells[0] = 2; }), Contains("has 24 values"));
  CHECK(folder.entries() == 0);
}
