// Models of luminaires: placement of parts, rejected and mutated files. The seed is LUXODUS_SEED,
// or 1; LUXODUS_MUTATIONS sets how many files are mutated.
#include "scenes/formats/photometry/l3d.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>

#include "scenes/formats/photometry/gldf.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/kit/small_l3d.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/unit/scenes/formats/photometry/photometric_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;
using Catch::Contains;

namespace {

Result<L3dModel> model_of(const std::string& bytes) {
  return l3d_of(bytes, "test.l3d", limits::l3d_all_bytes);
}

L3dModel read_model(const SmallL3d& small) {
  auto model = model_of(small.bytes());
  if (!model) FAIL(model.problem().text());
  return std::move(model).value();
}

std::string l3d_refusal(const std::string& bytes) {
  const auto model = model_of(bytes);
  return model ? "read" : model.problem().what;
}

void check_point(const glm::dvec3& is, const glm::dvec3& wanted) {
  INFO(is.x << " " << is.y << " " << is.z);
  CHECK(glm::length(is - wanted) < 1e-12);
}

/// A container with one product whose variant has the geometry `model`, and a box.
std::string container_with(const std::string& model, const std::string& kind = "geo/l3d",
                           const std::string& type = "localFileName") {
  const std::string xml =
      R"(<Root><Header><FormatVersion major="1" minor="0"/></Header><GeneralDefinitions><Files>)"
      R"(<File id="f" contentType="ldc/ies" type="localFileName">lamp.ies</File>)"
      R"(<File id="g" contentType=")" +
      kind + R"(" type=")" + type +
      R"(">body.l3d</File></Files><Emitters><Emitter id="e"><FixedLightEmitter/></Emitter>)"
      R"(</Emitters><Geometries><SimpleGeometry id="s"><Cuboid><Width>100</Width>)"
      R"(<Length>200</Length><Height>40</Height></Cuboid></SimpleGeometry><ModelGeometry id="m">)"
      R"(<GeometryFileReference fileId="g"/></ModelGeometry></Geometries></GeneralDefinitions>)"
      R"(<ProductDefinitions><Variants><Variant id="v"><Geometry><GeometryReferences>)"
      R"(<SimpleGeometryReference geometryId="s" emitterId="e"/><ModelGeometryReference )"
      R"(geometryId="m"><EmitterReference emitterId="e"><EmitterObjectExternalName>leo)"
      R"(</EmitterObjectExternalName></EmitterReference></ModelGeometryReference>)"
      R"(</GeometryReferences></Geometry></Variant></Variants></ProductDefinitions></Root>)";
  return zip_of({{"product.xml", xml}, {"geo/body.l3d", model}});
}

}  // namespace

TEST_CASE("a part is placed as its model states, in its unit", "[photometry][l3d]") {
  const L3dModel model = read_model({});
  REQUIRE(model.shapes.size() == 1);
  CHECK(model.shapes[0].obj == box_obj);
  CHECK(model.shapes[0].metres_per_unit == 0.001);
  REQUIRE(model.parts.size() == 1);
  check_point(model.parts[0].place.point({0.2, 0, 0}), {0.1, -0.05, 0.5});
  REQUIRE(model.openings.size() == 1);
  CHECK(model.openings[0].name == "leo");
  check_point(model.openings[0].centre_m, {0, 0, 0.5});
  check_point(model.openings[0].down, {0, 0, -1});
}

TEST_CASE("a part turns about its own axes, z first, then x, then y", "[photometry][l3d]") {
  SmallL3d small;
  small.position = R"(<Position x="0" y="0" z="0"/>)";
  small.rotation = R"(<Rotation x="90" y="0" z="90"/>)";
  // Rotated about x, y points up; then about z, up stays and x becomes y.
  const L3dModel two = read_model(small);
  check_point(two.parts[0].place.point({0, 1, 0}), {0, 0, 1});
  check_point(two.parts[0].place.point({1, 0, 0}), {0, 1, 0});
  // The part's y axis, about which the rotation does not matter, follows those about x and z.
  small.rotation = R"(<Rotation x="30" y="77" z="0"/>)";
  const double half = 0.5, rest = std::sqrt(0.75);
  check_point(read_model(small).parts[0].place.point({0, 1, 0}), {0, rest, half});
}

TEST_CASE("parts were measured with the light unless the model denies it", "[photometry][l3d]") {
  SmallL3d small;
  CHECK(read_model(small).parts.at(0).measured);
  for (const char* word : {"true", "1", " true "}) {
    small.measured = word;
    CHECK(read_model(small).parts.at(0).measured);
  }
  for (const char* word : {"false", "0"}) {
    small.measured = word;
    CHECK_FALSE(read_model(small).parts.at(0).measured);
  }
  small.measured = "maybe";
  CHECK_THAT(l3d_refusal(small.bytes()),
             Contains("includedInMeasurement = \"maybe\"; it is true or false"));
}

TEST_CASE("a part below a joint is placed as the joint is", "[photometry][l3d]") {
  SmallL3d small;
  small.joints = joint_with("");
  const L3dModel model = read_model(small);
  REQUIRE(model.parts.size() == 2);
  CHECK(model.parts[1].name == "head");
  CHECK(model.parts[1].shape == model.parts[0].shape);
  CHECK(model.shapes.size() == 1);
  check_point(model.parts[1].place.point({0, 0, 0}), {-0.1, 0.95, 0.6});
}

TEST_CASE("a model without placement of its parts is rejected", "[photometry][l3d]") {
  SmallL3d small;
  small.units = "km";
  CHECK_THAT(l3d_refusal(small.bytes()), Contains("the unit \"km\"; m, dm, cm, mm, yard"));
  small = {};
  small.reference = "none";
  CHECK_THAT(l3d_refusal(small.bytes()), Contains("the shape \"none\", which is not defined"));
  small = {};
  for (const char* wrong :
       {"", R"(<Position x="a" y="0" z="0"/>)", R"(<Position x="0" y="nan" z="0"/>)",
        R"(<Position x="0" y="0" z="1e9"/>)"}) {
    small.position = wrong;
    CHECK_THAT(l3d_refusal(small.bytes()),
               Contains("Geometry \"housing\"") && Contains("no 'Position' of three numbers"));
  }
  small = {};
  small.rotation = R"(<Rotation x="0" y="0"/>)";
  CHECK_THAT(l3d_refusal(small.bytes()), Contains("no rotation of three numbers"));
  CHECK_THAT(l3d_refusal(zip_of({{"structure.xml", SmallL3d{}.xml()}})),
             Contains("the shape \"box/box.obj\" is not in it"));
  CHECK_THAT(l3d_refusal(zip_of({{"structure.xml", "<Luminaire/>"}})), Contains("places no part"));
}

TEST_CASE("models that expand too far, lead out, hide entities or have too many parts are rejected",
          "[photometry][l3d]") {
  CHECK_THAT(l3d_refusal("hello"), Contains("no L3D model"));
  CHECK_THAT(l3d_refusal(zip_of({{"a.obj", box_obj}})), Contains("no 'structure.xml'"));
  CHECK_THAT(l3d_refusal(zip_of({{"structure.xml", SmallL3d{}.xml()}, {"../x", ""}})),
             Contains("leads out of it"));
  SmallL3d small;
  small.before = R"(<!DOCTYPE Luminaire [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;">]>)";
  CHECK_THAT(l3d_refusal(small.bytes()), Contains("DOCTYPE"));
  CHECK_THAT(l3d_refusal(zip_of({swelling_entry("structure.xml", 5000)})),
             Contains("larger than 1048576 bytes when unpacked"));
  const std::string swollen =
      zip_of({{"structure.xml", SmallL3d{}.xml()}, swelling_entry("box/box.obj", 400)});
  const auto refused = l3d_of(swollen, "test.l3d", 100'000);
  REQUIRE_FALSE(refused.ok());
  CHECK_THAT(refused.problem().what, Contains("larger than 100000 bytes when unpacked"));
  small = {};
  std::string nested;
  for (int i = 0; i < limits::l3d_depth; ++i) nested = joint_with(nested);
  small.joints = nested;
  CHECK_THAT(l3d_refusal(small.bytes()), Contains("more than 32 parts hang on each other"));
  small = {};
  std::string wide = "<Joints>";
  for (size_t i = 0; i < limits::l3d_parts; ++i) {
    const std::string one = joint_with("");
    wide += one.substr(8, one.size() - 17);  // without <Joints> and </Joints>
  }
  small.joints = wide + "</Joints>";
  CHECK_THAT(l3d_refusal(small.bytes()), Contains("more than 1000 parts"));
}

TEST_CASE(
    "a container gives its model on request, and a fault of the model does not affect the light",
    "[photometry][l3d]") {
  const TemporaryFolder folder;
  const auto path = folder.write("a.gldf", container_with(SmallL3d{}.bytes()));
  const auto left = read_gldf(path);
  REQUIRE(left.ok());
  REQUIRE(left->models.size() == 1);
  CHECK(left->models[0].shape.parts.empty());
  const auto read = read_gldf(path, GldfModels::read);
  REQUIRE(read.ok());
  const GldfVariant& variant = read->variants.at(0);
  REQUIRE(variant.model == std::optional<size_t>(0));
  REQUIRE(variant.lights.size() == 1);
  CHECK(variant.lights[0].opening == "leo");
  CHECK(variant.housing.has_value());
  const GldfModel& model = read->models.at(0);
  CHECK(model.fault.empty());
  REQUIRE(model.shape.parts.size() == 1);
  CHECK(model.shape.shapes.at(0).obj == box_obj);
  check_point(model.shape.openings.at(0).centre_m, {0, 0, 0.5});

  const auto fault = [](const std::string& container) {
    const auto product = gldf_of(container, "a.gldf", GldfModels::read);
    if (!product) FAIL(product.problem().text());
    CHECK(product->variants.at(0).lights.size() == 1);
    return product->models.at(0).fault;
  };
  CHECK_THAT(fault(container_with("hello")), Contains("no L3D model"));
  CHECK_THAT(fault(container_with("", "geo/r3d")), Contains("\"geo/r3d\"; \"geo/l3d\" is read"));
  CHECK_THAT(fault(container_with("", "geo/l3d", "url")), Contains("nothing is fetched"));
}

TEST_CASE("a container with too many models is rejected", "[photometry][l3d]") {
  std::string files, geometries, variants;
  for (size_t i = 0; i <= limits::gldf_models; ++i) {
    const std::string n = std::to_string(i);
    files +=
        "<File id=\"f" + n + R"(" contentType="geo/l3d" type="localFileName">)" + n + ".l3d</File>";
    geometries += "<ModelGeometry id=\"m" + n + R"("><GeometryFileReference fileId="f)" + n +
                  "\"/></ModelGeometry>";
    variants += "<Variant id=\"v" + n + R"("><Geometry><ModelGeometryReference geometryId="m)" + n +
                "\"/></Geometry></Variant>";
  }
  const auto many = gldf_of(
      zip_of(
          {{"product.xml", R"(<Root><Header><FormatVersion major="1" minor="0"/></Header>)"
                           "<GeneralDefinitions><Files>" +
                               files + "</Files><Geometries>" + geometries +
                               "</Geometries></GeneralDefinitions><ProductDefinitions><Variants>" +
                               variants + "</Variants></ProductDefinitions></Root>"}}),
      "many.gldf", GldfModels::read);
  REQUIRE_FALSE(many.ok());
  CHECK_THAT(many.problem().what, Contains("more than 1024 models"));
}

TEST_CASE("a model of another program is read", "[photometry][l3d]") {
  if (!data_is_there("gldf")) return;
  const auto read =
      read_gldf(shared_data / "gldf" / "GldfWithFilesComplete.gldf", GldfModels::read);
  REQUIRE(read.ok());
  REQUIRE(read->variants.size() == 2);
  CHECK_FALSE(read->variants[0].model);
  REQUIRE(read->variants[1].model);
  const GldfModel& model = read->models.at(*read->variants[1].model);
  CHECK(model.fault.empty());
  REQUIRE(model.shape.parts.size() == 1);
  REQUIRE(model.shape.openings.size() == 1);
  CHECK(model.shape.openings[0].name == "LEO");
  check_point(model.shape.openings[0].centre_m, {-0.006, 0.003, -0.038});
  CHECK(model.shape.shapes.at(0).metres_per_unit == 0.001);
}

TEST_CASE("only names and diffuse colours of a material library are kept", "[photometry][l3d]") {
  SmallL3d small;
  small.obj = coloured_box_obj("paint box.mtl");
  small.library =
      "# paint\nKd 1 1 1\nnewmtl red\r\n  Kd 1 0.1 0.05\nKs 1 1 1\nmap_Kd /etc/passwd\n"
      "newmtl odd\nKd 2 0 0\nKd 0 nan 0\nKd 1 1\nKd 1 1 1 1\nnewmtl\nmtllib other.mtl\n"
      "newmtl late\rKd 9 9 9\rKd 0 0 1\n";
  const L3dModel model = read_model(small);
  CHECK(model.shapes[0].colours ==
        "newmtl red\nKd 1 0.1 0.05\nnewmtl odd\nKd 0.7 0.7 0.7\nnewmtl late\nKd 0 0 1\n");
  CHECK(model.shapes[0].obj == coloured_box_obj(l3d_library));
  CHECK_THAT(model.shapes[0].odd_colour,
             Contains("material \"odd\" is \"2 0 0\", and not three numbers from 0 to 1"));
}

TEST_CASE("a library without a colour is dropped", "[photometry][l3d]") {
  SmallL3d small;
  small.obj = coloured_box_obj("paint box.mtl");
  small.library = "newmtl red\nmap_Kd red.png\nnewmtl odd\nKd 2 0 0\n";
  const L3dModel model = read_model(small);
  CHECK(model.shapes[0].colours.empty());
  CHECK(model.shapes[0].obj == small.obj);
}

TEST_CASE("a library that is missing, lies elsewhere or is too large is left out",
          "[photometry][l3d]") {
  SmallL3d small;
  small.library = "newmtl red\nKd 1 0.1 0.05\n";
  for (const std::string name : {"absent.mtl", "../box/paint box.mtl", "box.obj", ""}) {
    small.obj = coloured_box_obj(name);
    const L3dModel model = read_model(small);
    CHECK(model.shapes[0].colours.empty());
    CHECK(model.shapes[0].obj == small.obj);
  }
  small.obj = coloured_box_obj("paint box.mtl");
  small.library.resize(limits::l3d_library_bytes + 1, ' ');
  CHECK(read_model(small).shapes[0].colours.empty());
}

TEST_CASE("mutated models are read or rejected with one sentence", "[photometry][l3d]") {
  const char* seed_text = std::getenv("LUXODUS_SEED");
  const uint64_t seed = seed_text != nullptr ? std::strtoull(seed_text, nullptr, 0) : 1;
  const char* count_text = std::getenv("LUXODUS_MUTATIONS");
  const int tries = count_text != nullptr ? std::atoi(count_text) : 5000;
  INFO("seed " << seed);
  Random random(seed, RandomStream::test);
  random.start(1);
  SmallL3d small;
  small.joints = joint_with("");
  small.obj = coloured_box_obj("paint box.mtl");
  small.library = "newmtl red\nKd 1 0.1 0.05\nmap_Kd red.png\n";
  const auto bytes_of = [](const std::string& text) {
    const auto* from = reinterpret_cast<const std::byte*>(text.data());
    return Bytes(from, from + text.size());
  };
  const Bytes whole = bytes_of(small.bytes()), xml = bytes_of(small.xml());
  int read = 0;
  for (int i = 0; i < tries; ++i) {
    // The model itself, or its XML within a sound model.
    const bool packed = random.bits() % 2 == 0;
    const Bytes bytes = mutated(packed ? whole : xml, packed ? xml : whole, random);
    const std::string harmed(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto model =
        model_of(packed ? harmed : zip_of({{"structure.xml", harmed}, {"box/box.obj", box_obj}}));
    if (!model) {
      REQUIRE_FALSE(model.problem().what.empty());
      continue;
    }
    ++read;
    REQUIRE_FALSE(model->parts.empty());
    for (const L3dPart& part : model->parts) {
      REQUIRE(part.shape < model->shapes.size());
      REQUIRE(part.place.usable());
    }
    for (const L3dOpening& opening : model->openings) REQUIRE(is_finite(opening.centre_m));
  }
  CHECK(read > tries / 50);  // mutations that reach deep
  CHECK(read < tries);
}
