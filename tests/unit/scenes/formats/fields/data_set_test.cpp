#include "scenes/formats/fields/data_set.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <limits>

#include "runtime/core/base64.hpp"
#include "scenes/formats/fields/data_set_fields.hpp"
#include "tests/kit/replaced.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  std::string out(values.size() * sizeof(T), '\0');
  std::memcpy(out.data(), values.data(), out.size());
  return out;
}

/// 3 x 2 x 1 values 0, 0.5, ... 2.5.
const std::vector<float> six = {0, 0.5f, 1, 1.5f, 2, 2.5f};

const std::string nrrd_head =
    "NRRD0004\n# smoke\ntype: float\ndimension: 3\nsizes: 3 2 1\nspacings: 0.1 0.2 0.5\n"
    "encoding: raw\nendian: little\n";

/// A VTI of 3 x 2 x 1 cells around the given arrays.
std::string vti(const std::string& inside, const std::string& behind = "",
                const std::string& header_type = "UInt32") {
  return "<?xml version=\"1.0\"?>\n<!-- of a test -->\n"
         "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"" +
         header_type +
         "\">\n<ImageData WholeExtent=\"0 3 0 2 0 1\" Origin=\"1 2 3\" Spacing=\"0.1 0.2 0.5\">\n"
         "<Piece Extent=\"0 3 0 2 0 1\">\n" +
         inside + "</Piece>\n</ImageData>\n" + behind + "</VTKFile>\n";
}

std::string cell_array(const std::string& name, const std::string& type, const std::string& format,
                       const std::string& text) {
  return "<CellData Scalars=\"" + name + "\">\n<DataArray type=\"" + type + "\" Name=\"" + name +
         "\" format=\"" + format + "\">\n" + text + "\n</DataArray>\n</CellData>\n";
}

LoadedDataSet read_ok(const std::string& path, const DataSetOptions& options = {}) {
  auto result = read_data_set(path, options);
  INFO((result.ok() ? std::string() : result.problem().text()));
  REQUIRE(result.ok());
  return std::move(result.value());
}

struct Row {
  const char* about;
  std::string content;
  const char* says;
};

void check_refused(const TemporaryFolder& folder, const char* name, const Row& row) {
  INFO(row.about);
  const auto result = read_data_set(folder.write(name, row.content));
  REQUIRE_FALSE(result.ok());
  INFO(result.problem().text());
  CHECK(result.problem().where.file == folder / name);
  CHECK(result.problem().what.find(row.says) != std::string::npos);
}

}  // namespace

TEST_CASE("an attached NRRD gives its values, x fastest, and its box", "[format][nrrd]") {
  const TemporaryFolder folder;
  const auto loaded = read_ok(folder.write(
      "a.nrrd",
      nrrd_head + "space dimension: 3\nspace origin: (1.05,2.1,3.25)\n\n" + bytes_of(six)));
  CHECK(loaded.data.nx == 3);
  CHECK(loaded.data.ny == 2);
  CHECK(loaded.data.nz == 1);
  CHECK(loaded.data.extinction == six);
  CHECK(loaded.data.albedo.empty());
  CHECK(loaded.data.emission.empty());
  CHECK(glm::length(loaded.data.extent - glm::dvec3(0.3, 0.4, 0.5)) < 1e-12);
  // The origin of NRRD is the middle of the first sample.
  CHECK(glm::length(loaded.origin - glm::dvec3(1, 2, 3)) < 1e-12);
  CHECK(loaded.spacing == glm::dvec3(0.1, 0.2, 0.5));
}

TEST_CASE("a detached NRRD reads its data file, after skipped lines and bytes", "[format][nrrd]") {
  const TemporaryFolder folder;
  folder.write("a.raw", "a line\nanother\n#!" + bytes_of(six));
  for (const char* skip : {"line skip: 2\nbyte skip: 2\n", "byte skip: 17\n", "byteskip: -1\n"}) {
    const std::string path = folder.write("a.nhdr", nrrd_head + skip + "data file: a.raw\n");
    const auto loaded = read_ok(path);
    CHECK(loaded.data.extinction == six);
    REQUIRE(loaded.files_read.size() == 2);
    CHECK(loaded.files_read[1] == folder / "a.raw");
  }
}

TEST_CASE("8-bit NRRD samples are mapped to the range they state", "[format][nrrd]") {
  const TemporaryFolder folder;
  const std::string head = replaced(replaced(nrrd_head, "float", "uint8"), "endian: little\n", "");
  const std::string samples("\x00\x33\x66\x99\xcc\xff", 6);
  const auto plain = read_ok(folder.write("a.nrrd", head + "\n" + samples));
  CHECK(plain.data.extinction == std::vector<float>{0, 51, 102, 153, 204, 255});
  const auto mapped = read_ok(folder.write("b.nrrd", head + "old min: 1\noldmax: 2\n\n" + samples));
  for (size_t i = 0; i < 6; ++i) {
    CHECK(mapped.data.extinction[i] == Approx(1 + 0.2 * static_cast<double>(i)));
  }
}

TEST_CASE("an NRRD names its field, and may hold several", "[format][nrrd]") {
  const TemporaryFolder folder;
  const auto named =
      read_ok(folder.write("a.nrrd", nrrd_head + "field:=emission\n\n" + bytes_of(six)));
  CHECK(named.data.emission == six);
  CHECK(named.data.extinction.empty());
  DataSetOptions options;
  options.field = "emission";
  const auto by_caller = read_ok(folder.write("b.nrrd", nrrd_head + "\n" + bytes_of(six)), options);
  CHECK(by_caller.data.emission == six);

  std::vector<float> interlaced;
  for (const float v : six) interlaced.insert(interlaced.end(), {v, v / 10});
  const std::string head = replaced(
      replaced(replaced(nrrd_head, "dimension: 3", "dimension: 4"), "sizes: 3", "sizes: 2 3"),
      "spacings: ", "spacings: nan ");
  const auto both = read_ok(
      folder.write("c.nrrd", head + "fields:=extinction albedo\n\n" + bytes_of(interlaced)));
  CHECK(both.data.extinction == six);
  for (size_t i = 0; i < 6; ++i) CHECK(both.data.albedo[i] == six[i] / 10);
}

TEST_CASE("NRRD origins, directions and units are converted to metres", "[format][nrrd]") {
  const TemporaryFolder folder;
  const std::string head =
      replaced(nrrd_head, "spacings: 0.1 0.2 0.5\n",
               "space: right-anterior-superior\nspace directions: (100,0,0) (0,200,0) (0,0,500)\n"
               "space origin: (50,100,250)\nspace units: \"mm\" \"mm\" \"mm\"\n");
  const auto loaded = read_ok(folder.write("a.nrrd", head + "\n" + bytes_of(six)));
  CHECK(glm::length(loaded.origin) < 1e-12);
  CHECK(glm::length(loaded.spacing - glm::dvec3(0.1, 0.2, 0.5)) < 1e-12);
}

TEST_CASE("soot density becomes extinction by the mass extinction", "[format][data_set]") {
  const TemporaryFolder folder;
  // FDS issue 5118: 95.236e-6 kg/m3 at 8700 m2/kg is 0.82855 1/m.
  const std::vector<float> soot(6, 95.236e-6f);
  const std::string path =
      folder.write("a.nrrd", nrrd_head + "field:=soot_density\n\n" + bytes_of(soot));
  CHECK(read_ok(path).data.extinction[3] == Approx(0.82855).epsilon(1e-5));
  DataSetOptions smouldering;
  smouldering.mass_extinction_m2_per_kg = 4350;
  CHECK(read_ok(path, smouldering).data.extinction[3] == Approx(0.82855 / 2).epsilon(1e-5));
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    smouldering.mass_extinction_m2_per_kg = bad;
    CHECK_FALSE(read_data_set(path, smouldering).ok());
  }
}

TEST_CASE("an NRRD with more samples than its header states is refused", "[format][nrrd]") {
  const TemporaryFolder folder;
  const std::vector<float> nine(9, 1);
  check_refused(folder, "a.nrrd",
                {"a row too many", nrrd_head + "\n" + bytes_of(nine), "sizes are not those"});
  // A line end behind the samples is none.
  CHECK(read_ok(folder.write("b.nrrd", nrrd_head + "\n" + bytes_of(six) + "\n")).data.nx == 3);
}

TEST_CASE("a large NRRD is read completely, in blocks", "[format][nrrd]") {
  const TemporaryFolder folder;
  std::vector<float> many(100 * 90 * 80);
  for (size_t i = 0; i < many.size(); ++i) many[i] = static_cast<float>(i);
  const std::string head = replaced(nrrd_head, "sizes: 3 2 1", "sizes: 100 90 80");
  CHECK(read_ok(folder.write("a.nrrd", head + "\n" + bytes_of(many))).data.extinction == many);
}

TEST_CASE("malformed NRRD files are rejected with the line and a remedy", "[format][nrrd]") {
  const TemporaryFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const std::string data = bytes_of(six);
  const auto head = [&](const std::string& from, const std::string& to) {
    return replaced(nrrd_head, from, to) + "\n" + data;
  };
  const Row rows[] = {
      {"empty", "", "not an NRRD"},
      {"another kind", "PNG it is not\n\n", "not an NRRD"},
      {"version", head("NRRD0004", "NRRD0009"), "not an NRRD"},
      {"no colon", head("# smoke", "smoke"), "field: value"},
      {"unknown field", head("# smoke", "colour: red"), "knows no field"},
      {"twice", head("# smoke", "type: float"), "twice"},
      {"two dimensions", head("dimension: 3", "dimension: 2"), "dimension"},
      {"no dimension", head("dimension: 3\n", ""), "missing"},
      {"no sizes", head("sizes: 3 2 1\n", ""), "sizes"},
      {"negative size", head("sizes: 3 2 1", "sizes: 3 -2 1"), "sizes"},
      {"zero size", head("sizes: 3 2 1", "sizes: 3 0 1"), "no cells"},
      {"long side", head("sizes: 3 2 1", "sizes: 3 2 9999999"), "the most are"},
      {"too many cells", head("sizes: 3 2 1", "sizes: 1048576 1048576 1048576"), "the most are"},
      {"overflowing size", head("sizes: 3 2 1", "sizes: 3 2 99999999999999999999999"), "sizes"},
      {"claims a gigabyte", head("sizes: 3 2 1", "sizes: 1000 1000 1000"), "are there"},
      {"one sample short", nrrd_head + "\n" + data.substr(0, 20), "are there"},
      {"type", head("type: float", "type: short"), "float, double or uint8"},
      {"encoding", head("encoding: raw", "encoding: gzip"), "raw"},
      {"big endian", head("endian: little", "endian: big"), "little"},
      {"no endian", head("endian: little\n", ""), "endian"},
      {"no spacing", head("spacings: 0.1 0.2 0.5\n", ""), "spacings"},
      {"zero spacing", head("spacings: 0.1", "spacings: 0"), "above 0"},
      {"nan spacing", head("spacings: 0.1", "spacings: nan"), "above 0"},
      {"turned", head("spacings: 0.1 0.2 0.5", "space directions: (1,1,0) (0,1,0) (0,0,1)"),
       "turn"},
      {"mirrored", head("spacings: 0.1 0.2 0.5", "space directions: (-1,0,0) (0,1,0) (0,0,1)"),
       "turn"},
      {"left-handed", head("# smoke", "space: left-posterior-superior"), "mirrored"},
      {"axis mins", head("# smoke", "axis mins: 0 0 0"), "space origin"},
      {"origin", head("# smoke", "space origin: 1,2,3"), "vector"},
      {"unit", head("# smoke", "units: \"yd\" \"yd\" \"yd\""), "unit"},
      {"mixed units", head("# smoke", "units: \"m\" \"m\" \"mm\""), "one unit"},
      {"data list", head("# smoke", "data file: LIST"), "single file"},
      {"data pattern", head("# smoke", "data file: a%02d.raw 1 9 1"), "single file"},
      {"data missing", head("# smoke", "data file: nowhere.raw"), "exists"},
      {"byte skip", head("# smoke", "byte skip: 999999"), "are there"},
      {"line skip", head("# smoke", "line skip: 500"), "line skip"},
      {"unknown quantity", head("# smoke", "field:=smell"), "unknown field"},
      {"old min of floats", head("# smoke", "old min: 0\nold max: 1"), "uint8"},
      {"nan", nrrd_head + "\n" + bytes_of<float>({0, 0, 0, 0, nan, 0}), "cell (1, 1, 0), index 4"},
      {"inf", nrrd_head + "\n" + bytes_of<float>({0, inf, 0, 0, 0, 0}), "index 1"},
      {"negative", nrrd_head + "\n" + bytes_of<float>({0, 0, 0, 0, 0, -1e-9f}), "cell (2, 1, 0)"},
      {"albedo above 1", head("# smoke", "field:=albedo"), "0 to 1"},
      {"endless header", "NRRD0004\n" + std::string(100'000, '#'), "no end"},
  };
  for (const Row& row : rows) check_refused(folder, "a.nrrd", row);
  // The line is that of the field.
  const auto result = read_data_set(folder.write("b.nrrd", head("encoding: raw", "encoding: hex")));
  CHECK(result.problem().where.line == 7);
}

TEST_CASE("a VTI gives cell values from text", "[format][vti]") {
  const TemporaryFolder folder;
  const auto loaded = read_ok(folder.write(
      "a.vti", vti(cell_array("extinction", "Float32", "ascii", "0 .5 1\n1.5 2e0 2.5"))));
  CHECK(loaded.data.nx == 3);
  CHECK(loaded.data.ny == 2);
  CHECK(loaded.data.nz == 1);
  CHECK(loaded.data.extinction == six);
  CHECK(loaded.origin == glm::dvec3(1, 2, 3));
  CHECK(glm::length(loaded.data.extent - glm::dvec3(0.3, 0.4, 0.5)) < 1e-12);
}

TEST_CASE("a VTI gives the same from base64, whether header and values are one stream or two",
          "[format][vti]") {
  const TemporaryFolder folder;
  const std::string values = bytes_of(six);
  const std::string header = bytes_of<uint32_t>({24});
  const std::string header64 = bytes_of<uint64_t>({24});
  const std::string one = base64(header + values), two = base64(header) + base64(values);
  for (const std::string& text :
       {one, two, "  " + one.substr(0, 11) + "\n" + one.substr(11) + " "}) {
    const auto loaded =
        read_ok(folder.write("a.vti", vti(cell_array("extinction", "Float32", "binary", text))));
    CHECK(loaded.data.extinction == six);
  }
  const auto wide = read_ok(folder.write(
      "b.vti",
      vti(cell_array("extinction", "Float32", "binary", base64(header64 + values)), "", "UInt64")));
  CHECK(wide.data.extinction == six);
}

TEST_CASE("a VTI gives several fields from appended bytes, raw or base64", "[format][vti]") {
  const TemporaryFolder folder;
  const std::vector<double> albedo = {0, 0.2, 0.4, 0.6, 0.8, 1};
  const std::string first = bytes_of<uint32_t>({24}) + bytes_of(six);
  const std::string second = bytes_of<uint32_t>({48}) + bytes_of(albedo);
  for (const bool raw : {true, false}) {
    const std::string block1 = raw ? first : base64(first);
    const std::string block2 = raw ? second : base64(second);
    const std::string arrays =
        "<CellData>\n<DataArray type=\"Float32\" Name=\"extinction\" format=\"appended\" "
        "offset=\"0\"/>\n"
        "<DataArray type=\"Float64\" Name=\"albedo\" NumberOfComponents=\"1\" format=\"appended\" "
        "offset=\"" +
        std::to_string(block1.size()) +
        "\">\n<InformationKey name=\"L2_NORM_RANGE\" length=\"2\">\n<Value "
        "index=\"0\">\n0\n</Value>\n"
        "</InformationKey>\n</DataArray>\n</CellData>\n";
    const std::string behind = std::string("<AppendedData encoding=\"") + (raw ? "raw" : "base64") +
                               "\">\n  _" + block1 + block2 + "\n</AppendedData>\n";
    const auto loaded = read_ok(folder.write("a.vti", vti(arrays, behind)));
    CHECK(loaded.data.extinction == six);
    REQUIRE(loaded.data.albedo.size() == 6);
    for (size_t i = 0; i < 6; ++i) CHECK(loaded.data.albedo[i] == Approx(albedo[i]));
  }
}

TEST_CASE("VTI point values become the mean of each cell's corners", "[format][vti]") {
  const TemporaryFolder folder;
  // A linear field f = x + 10 y + 100 z on 4 x 3 x 2 points: the mean is the value at the cell's
  // centre.
  std::string text;
  for (int z = 0; z < 2; ++z) {
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 4; ++x) text += std::to_string(x + 10 * y + 100 * z) + " ";
    }
  }
  std::string content = vti(cell_array("emission", "Float64", "ascii", text));
  content = replaced(replaced(content, "<CellData", "<PointData"), "</CellData", "</PointData");
  const auto loaded = read_ok(folder.write("a.vti", content));
  REQUIRE(loaded.data.emission.size() == 6);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) {
      CHECK(loaded.data.emission[static_cast<size_t>(3 * y + x)] ==
            Approx(x + 0.5 + 10 * (y + 0.5) + 100 * 0.5));
    }
  }
  // Averaging does not hide a negative point.
  const std::string negative = replaced(content, "12 ", "-12 ");
  const auto refused = read_data_set(folder.write("b.vti", negative));
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.problem().what.find("point") != std::string::npos);
}

TEST_CASE("a VTI whose extent does not start at 0 is placed where its cells are", "[format][vti]") {
  const TemporaryFolder folder;
  std::string content = vti(cell_array("extinction", "Float32", "ascii", "1 1 1 1 1 1"));
  content =
      replaced(replaced(content, "WholeExtent=\"0 3 0 2 0 1\"", "WholeExtent=\"10 13 -5 -3 0 1\""),
               "Piece Extent=\"0 3 0 2 0 1\"", "Piece Extent=\"10 13 -5 -3 0 1\"");
  const auto loaded = read_ok(folder.write("a.vti", content));
  CHECK(glm::length(loaded.origin - glm::dvec3(2, 1, 3)) < 1e-12);
}

TEST_CASE("arrays with unknown names are ignored, even those of FieldData", "[format][vti]") {
  const TemporaryFolder folder;
  const std::string time =
      "<FieldData><DataArray type=\"Float64\" Name=\"extinction\" NumberOfTuples=\"1\" "
      "format=\"ascii\">"
      "7</DataArray></FieldData>\n";
  std::string content = vti(cell_array("temperature", "Float32", "ascii", "20 20") +
                            cell_array("soot_density", "Float32", "ascii", "0 1e-4 0 0 0 0"));
  content = replaced(content, "<Piece", time + "<Piece");
  const auto loaded = read_ok(folder.write("a.vti", content));
  CHECK(loaded.data.extinction[1] == Approx(0.87));
}

TEST_CASE("malformed VTI files are rejected with the line and a remedy", "[format][vti]") {
  const TemporaryFolder folder;
  const std::string good = vti(cell_array("extinction", "Float32", "ascii", "0 1 2 3 4 5"));
  const std::string header = bytes_of<uint32_t>({24});
  const auto binary = [&](const std::string& text) {
    return vti(cell_array("extinction", "Float32", "binary", text));
  };
  const std::string appended_array =
      "<CellData><DataArray type=\"Float32\" Name=\"extinction\" format=\"appended\" offset=\"0\"/>"
      "</CellData>\n";
  const auto appended = [&](const std::string& bytes) {
    return vti(appended_array, "<AppendedData encoding=\"raw\">_" + bytes + "</AppendedData>");
  };
  const Row rows[] = {
      {"empty", "", "ImageData"},
      {"text", "no tags at all", "ImageData"},
      {"another root", "<html></html>", "VTKFile"},
      {"another type", replaced(good, "\"ImageData\"", "\"RectilinearGrid\""), "RectilinearGrid"},
      {"big endian", replaced(good, "LittleEndian", "BigEndian"), "LittleEndian"},
      {"compressed",
       replaced(good, "byte_order=", "compressor=\"vtkZLibDataCompressor\" byte_order="),
       "compress"},
      {"header type", replaced(good, "UInt32", "UInt16"), "header_type"},
      {"cut", good.substr(0, good.find("</Piece>")), "ends within"},
      {"cut in a tag", good.substr(0, 100), "quote"},
      {"cut in an array", good.substr(0, good.find("3 4 5")), "closing tag"},
      {"interlaced", replaced(good, "</DataArray>\n</CellData>", "</CellData>\n</DataArray>"),
       "interlaced"},
      {"stray end", replaced(good, "</Piece>", "</Piece></Piece>"), "closes nothing"},
      {"no equals", replaced(good, "Origin=", "Origin "), "not well formed"},
      {"entity", replaced(good, "Name=\"extinction\"", "Name=\"&quot;\""), "entities"},
      {"declaration", replaced(good, "<VTKFile", "<!DOCTYPE x>\n<VTKFile"), "begins no tag"},
      {"endless comment", replaced(good, "-->", "--"), "no end"},
      {"turned", replaced(good, "Origin=", "Direction=\"0 1 0 -1 0 0 0 0 1\" Origin="), "turn"},
      {"extent", replaced(good, "WholeExtent=\"0 3 0 2 0 1\"", "WholeExtent=\"0 3 0 2\""),
       "WholeExtent"},
      {"descending", replaced(good, "WholeExtent=\"0 3", "WholeExtent=\"3 0"), "ascend"},
      {"flat", replaced(good, "WholeExtent=\"0 3 0 2 0 1\"", "WholeExtent=\"0 3 0 2 0 0\""),
       "no cells"},
      {"huge extent",
       replaced(good, "WholeExtent=\"0 3",
                "WholeExtent=\"-9223372036854775808 9223372036854775807"),
       "ascend"},
      {"too many cells",
       replaced(good, "WholeExtent=\"0 3 0 2 0 1\"", "WholeExtent=\"0 99999 0 99999 0 9\""),
       "the most"},
      {"pieces", replaced(good, "</Piece>", "</Piece><Piece Extent=\"0 3 0 2 0 1\"></Piece>"),
       "2 pieces"},
      {"part of a grid", replaced(good, "Piece Extent=\"0 3", "Piece Extent=\"0 2"), "one piece"},
      {"origin", replaced(good, "Origin=\"1 2 3\"", "Origin=\"1 2\""), "Origin"},
      {"nan origin", replaced(good, "Origin=\"1 2 3\"", "Origin=\"1 nan 3\""), "origin"},
      {"zero spacing", replaced(good, "Spacing=\"0.1", "Spacing=\"0"), "spacing"},
      {"negative spacing", replaced(good, "Spacing=\"0.1", "Spacing=\"-0.1"), "spacing"},
      {"no field", replaced(good, "Name=\"extinction\"", "Name=\"smell\""), "smell"},
      {"vectors", replaced(good, "format=\"ascii\"", "NumberOfComponents=\"3\" format=\"ascii\""),
       "component"},
      {"type", replaced(good, "Float32", "Int32"), "Int32"},
      {"format", replaced(good, "\"ascii\"", "\"morse\""), "format"},
      {"few values", replaced(good, "0 1 2 3 4 5", "0 1 2 3 4"), "6 values"},
      {"many values", replaced(good, "0 1 2 3 4 5", "0 1 2 3 4 5 6"), "6 values"},
      {"a word", replaced(good, "3 4 5", "3 4 x"), "not a number"},
      {"nan", replaced(good, "3 4 5", "3 nan 5"), "index 4"},
      {"inf", replaced(good, "3 4 5", "inf 4 5"), "index 3"},
      {"beyond float", replaced(good, "3 4 5", "3 4 1e60"), "index 5"},
      {"negative", replaced(good, "0 1 2", "0 -1 2"), "cell (1, 0, 0)"},
      {"albedo", replaced(good, "Name=\"extinction\"", "Name=\"albedo\""), "0 to 1"},
      {"twice",
       vti(cell_array("extinction", "Float32", "ascii", "0 1 2 3 4 5") +
           cell_array("soot_density", "Float32", "ascii", "0 1 2 3 4 5")),
       "twice"},
      {"the same field twice",
       vti(cell_array("extinction", "Float32", "ascii", "0 1 2 3 4 5") +
           cell_array("extinction", "Float32", "ascii", "0 1 2 3 4 5")),
       "twice"},
      {"one offset for two",
       replaced(appended(header + bytes_of(six)), "</CellData>",
                "<DataArray type=\"Float32\" Name=\"albedo\" format=\"appended\" "
                "offset=\"0\"/></CellData>"),
       "the same offset"},
      {"no base64", binary("?" + base64(header + bytes_of(six))), "values"},
      {"base64 breaks", binary(base64(header + bytes_of(six)).replace(20, 1, "?")), "base64"},
      {"base64 is short", binary(base64(header + bytes_of(six)).substr(0, 20)), "6 values"},
      {"base64 goes on", binary(base64(header + bytes_of(six) + "abcd")), "6 values"},
      {"header lies", binary(base64(bytes_of<uint32_t>({99}) + bytes_of(six))), "6 values"},
      {"appended is short", appended(header + "ab"), "6 values"},
      {"appended header lies", appended(bytes_of<uint32_t>({23}) + bytes_of(six)), "6 values"},
      {"appended offset",
       replaced(appended(header + bytes_of(six)), "offset=\"0\"", "offset=\"9999999\""), "offset"},
      {"appended overflow",
       replaced(appended(header + bytes_of(six)), "offset=\"0\"",
                "offset=\"18446744073709551615\""),
       "offset"},
      {"appended missing", vti(appended_array), "there are none"},
      {"no mark", replaced(appended(header), ">_", ">"), "\"_\""},
      {"deep",
       "<VTKFile type=\"ImageData\" byte_order=\"LittleEndian\">" +
           [] {
             std::string deep;
             for (int i = 0; i < 1000; ++i) deep += "<a>";
             return deep;
           }(),
       "deep"},
  };
  for (const Row& row : rows) check_refused(folder, "a.vti", row);
  const auto result =
      read_data_set(folder.write("b.vti", replaced(good, "Origin=\"1 2 3\"", "Origin=\"\"")));
  CHECK(result.problem().where.line == 4);
}

TEST_CASE("an impossible extinction is rejected with its cell", "[format][data_set]") {
  const TemporaryFolder folder;
  const auto ascii = [](const std::string& name, const std::string& first) {
    return vti(cell_array(name, "Float64", "ascii", first + " 0 0 0 0 0"));
  };
  CHECK(read_data_set(folder.write("a.vti", ascii("extinction", "1e9"))).ok());
  CHECK(read_data_set(folder.write("a.vti", ascii("emission", "1e30"))).ok());
  for (const char* name : {"extinction", "soot_density"}) {
    check_refused(folder, "a.vti", {name, ascii(name, "2e9"), "cell (0, 0, 0)"});
  }
  const std::string nrrd = nrrd_head + "\n" + bytes_of<float>({0, 2e9f, 0, 0, 0, 0});
  check_refused(folder, "a.nrrd", {"nrrd", nrrd, "cell (1, 0, 0)"});
}

TEST_CASE("a data set of another kind, or a missing one, is rejected", "[format][data_set]") {
  const TemporaryFolder folder;
  CHECK_FALSE(read_data_set(folder.write("a.vdb", "x")).ok());
  CHECK_FALSE(read_data_set(folder / "absent.nrrd").ok());
  CHECK_FALSE(read_data_set(folder / "absent.vti").ok());
  std::filesystem::create_directories(folder / "folder.nrrd");
  CHECK_FALSE(read_data_set(folder / "folder.nrrd").ok());
}

TEST_CASE("a damaged data set is rejected or read, and never beyond its end",
          "[format][data_set]") {
  // Every byte of the text is changed in turn; under the sanitizers this finds reads past the end.
  const TemporaryFolder folder;
  const std::string values = bytes_of<uint32_t>({24}) + bytes_of(six);
  const std::string appended =
      vti("<CellData><DataArray type=\"Float32\" Name=\"extinction\" format=\"appended\" "
          "offset=\"0\"/></CellData>\n",
          "<AppendedData encoding=\"raw\">_" + values + "</AppendedData>");
  const std::string inline_base64 =
      vti(cell_array("extinction", "Float32", "binary", base64(values)));
  const std::string nrrd = nrrd_head + "\n" + bytes_of(six);
  int read = 0;
  for (const auto& [name, content] :
       {std::pair{"a.vti", appended}, {"b.vti", inline_base64}, {"c.nrrd", nrrd}}) {
    for (size_t at = 0; at < content.size(); ++at) {
      for (const char change : {'\x01', '\x10', '\x7f'}) {
        std::string damaged = content;
        damaged[at] = static_cast<char>(damaged[at] ^ change);
        const auto result = read_data_set(folder.write(name, damaged));
        if (!result.ok()) continue;
        ++read;
        const DataSet& data = result->data;
        const size_t cells = static_cast<size_t>(data.nx) * static_cast<size_t>(data.ny) *
                             static_cast<size_t>(data.nz);
        REQUIRE(data.extinction.size() + data.albedo.size() + data.emission.size() == cells);
      }
    }
  }
  CHECK(read > 0);
}

TEST_CASE("256 arrays that share their bytes are rejected before any is decoded",
          "[format][vti][hostile]") {
  const TemporaryFolder folder;
  std::string arrays = "<CellData>";
  for (int i = 0; i < 256; ++i)
    arrays += "<DataArray type=\"UInt8\" Name=\"extinction\" format=\"appended\" offset=\"0\"/>";
  const std::string text =
      vti(arrays + "</CellData>\n",
          "<AppendedData encoding=\"raw\">_" + bytes_of<uint32_t>({6}) + "abcdef</AppendedData>");
  const auto read = read_data_set(folder.write("many.vti", text), {});
  REQUIRE_FALSE(read.ok());
  CHECK(read.problem().what.find("\"extinction\" would be given twice") != std::string::npos);
}

TEST_CASE("a sparse file that declares more memory than the machine has is rejected unread",
          "[format][nrrd][hostile]") {
  CHECK(data_set::check_memory(1000, 8));
  const auto fits = data_set::check_memory(uint64_t{1} << 45, 2);
  REQUIRE_FALSE(fits);
  CHECK(fits.problem().kind == ProblemKind::no_room);
  CHECK(fits.problem().what.find("GiB of memory, this machine has") != std::string::npos);
}

TEST_CASE("messages do not show samples of a file that a header names", "[format][nrrd][hostile]") {
  const TemporaryFolder folder;
  const std::string secret = folder.write("secret", "root:x:0:0:abcdefgh");
  const std::string header =
      "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nspacings: 1 1 1\nencoding: raw\n"
      "content: albedo\nfield:=albedo\ndata file: secret\n\n";
  const auto read = read_data_set(folder.write("a.nhdr", header), {});
  REQUIRE_FALSE(read.ok());
  INFO(read.problem().what);
  CHECK(read.problem().what.find("114") == std::string::npos);  // the letter r
}

TEST_CASE("text of a data set is quoted short and without control characters",
          "[format][data_set][hostile]") {
  const TemporaryFolder folder;
  const std::string word = "\x1b[2J\xFF" + std::string(500, 'x');
  const std::string quoted = "\\x1B[2J\\xFFxxx";
  for (const Row& row : {Row{"a.nrrd", replaced(nrrd_head, "type: float", word + ": float"), ""},
                         Row{"a.nrrd", replaced(nrrd_head, "float", word), ""},
                         Row{"a.nrrd", nrrd_head + "field:=" + word + "\n\n", ""},
                         Row{"a.vti", replaced(vti(""), "\"ImageData\"", "\"" + word + "\""), ""},
                         Row{"a.vti", vti(cell_array("extinction", word, "ascii", "1")), ""},
                         Row{"a.vti", vti(cell_array("extinction", "Float32", word, "1")), ""},
                         Row{"a.vti", vti(cell_array(word, "Float32", "ascii", "1")), ""}}) {
    const auto read = read_data_set(folder.write(row.about, row.content));
    REQUIRE_FALSE(read.ok());
    INFO(read.problem().what);
    CHECK(read.problem().what.find(quoted) != std::string::npos);
    CHECK(read.problem().what.size() < 250);
  }
}
