// GLDF containers: fluxes by operation, rejected files, and mutated files. The seed is
// LUXODUS_SEED, or 1; LUXODUS_MUTATIONS sets how many files are mutated.
#include "scenes/formats/photometry/gldf.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <set>

#include "runtime/core/reading_share.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/kit/replaced.hpp"
#include "tests/kit/temporary_folder.hpp"
#include "tests/kit/zip_kit.hpp"
#include "tests/unit/scenes/formats/photometry/photometric_kit.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

/// 300, 200 and 0 cd at 0, 45 and 90 degrees.
const std::string gldf_lamp =
    "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n1 -1 1 3 1 1 2 -0.2 -0.2 0\n1 1 10\n0 45 90\n0\n"
    "300 200 0\n";

/// A product with one variant "v" and the emitter "e", with the properties that tests vary.
struct Product {
  std::string version = R"(<FormatVersion major="1" minor="0" pre-release="3"/>)";
  std::string file = R"(<File id="f" contentType="ldc/ies" type="localFileName">lamp.ies</File>)";
  std::string light = R"(<RatedLuminousFlux>1000</RatedLuminousFlux>)";
  std::string behaviour = "Combined";
  std::string kind = "FixedLightEmitter";
  std::string attributes;
  std::string emitters, sources, equipment;  // more of them; of the equipment "q"
  std::string geometry = R"(<SimpleGeometryReference geometryId="g" emitterId="e"/>)";
  std::string width = "100";
  std::string lamp = gldf_lamp;
  std::string before = R"(<?xml version="1.0" encoding="utf-8"?>)";

  std::string xml() const {
    return before + "<Root><Header><Manufacturer>Maker</Manufacturer>" + version +
           "</Header><GeneralDefinitions><Files>" + file +
           R"(</Files><Photometries><Photometry id="p"><PhotometryFileReference fileId="f"/>)"
           "</Photometry></Photometries><LightSources>" +
           sources + R"(</LightSources><Equipments><Equipment id="q">)" + equipment +
           R"(</Equipment></Equipments><Emitters><Emitter id="e"><)" + kind +
           (behaviour.empty() ? "" : " emergencyBehaviour=\"" + behaviour + "\"") +
           R"(><PhotometryReference photometryId="p"/>)" + light + "</" + kind + "></Emitter>" +
           emitters + R"(</Emitters><Geometries><SimpleGeometry id="g"><Cuboid><Width>)" + width +
           "</Width><Length>200</Length><Height>40</Height></Cuboid></SimpleGeometry>"
           "</Geometries></GeneralDefinitions><ProductDefinitions><ProductMetaData>"
           R"(<ProductNumber><Locale language="en">N-7</Locale></ProductNumber>)"
           R"(<Name><Locale language="de">Leuchte</Locale><Locale language="en">Lamp</Locale>)"
           R"(</Name></ProductMetaData><Variants><Variant id="v"><Geometry>)" +
           geometry + "</Geometry>" + attributes +
           "</Variant></Variants></ProductDefinitions></Root>";
  }
  std::string container() const { return zip_of({{"product.xml", xml()}, {"ldc/lamp.ies", lamp}}); }
  GldfLuminaire luminaire(std::optional<double> duration_h = {}) const {
    const auto product = gldf_of(container(), "test.gldf");
    if (!product) FAIL(product.problem().text());
    auto out = luminaire_of(product.value(), {"", "", duration_h, {}});
    if (!out) FAIL(out.problem().text());
    return std::move(out).value();
  }
};

/// All properties of a luminaire, as text.
std::string words_of(const GldfProduct& product, const GldfVariant& variant,
                     const GldfLight& light) {
  const auto number = [](const std::optional<double>& v) { return v ? std::to_string(*v) : "-"; };
  std::string out = product.manufacturer + "\n" + product.name + "\n" + product.number + "\n" +
                    variant.id + "\n" + light.emitter + "\n" + light.behaviour + "\n" +
                    light.photometry + "\n" + light.fault + "\n" + number(light.rated_lm) +
                    number(light.lamp_lm) + number(light.emergency_lm) +
                    number(light.ballast_factor) + "\n";
  for (const GldfDuration& d : variant.durations) out += number(d.hours) + number(d.flux_lm);
  for (const GldfFile& file : product.photometry) out += "\n" + file.name + "\n" + file.bytes;
  return out;
}

std::string gldf_refusal(const std::string& bytes) {
  const auto product = gldf_of(bytes, "test.gldf");
  return product ? "read" : product.problem().what;
}

/// Why the only luminaire of a container is not available.
std::string missing(const Product& product) {
  const auto read = gldf_of(product.container(), "test.gldf");
  if (!read) return read.problem().what;
  const auto luminaire = luminaire_of(read.value(), {});
  return luminaire ? "there" : luminaire.problem().what;
}

bool says(const std::string& text, const std::string& words) {
  INFO(text);
  const bool there = text.find(words) != std::string::npos;
  CHECK(there);
  return there;
}

const std::string durations =
    R"(<DescriptiveAttributes><Emergency><DurationTimeAndFlux><Flux hours="1">250</Flux>)"
    R"(<Flux hours="3">150</Flux></DurationTimeAndFlux></Emergency></DescriptiveAttributes>)";

}  // namespace

TEST_CASE("a container gives the product, its rated flux and its housing", "[photometry][gldf]") {
  const GldfLuminaire luminaire = Product{}.luminaire();
  CHECK(luminaire.photometry.luminaire == "Lamp, N-7");
  CHECK(luminaire.photometry.manufacturer == "Maker");
  CHECK(luminaire.rated_lm == 1000);
  CHECK(luminaire.photometry.web->flux_lm() == Approx(1000).epsilon(1e-12));
  // The photometric file determines the distribution.
  const auto& web = *luminaire.photometry.web;
  CHECK(web.intensity(toward(0, 45)) / web.intensity(toward(0, 0)) == Approx(200.0 / 300));
  const auto product = gldf_of(Product{}.container(), "test.gldf");
  REQUIRE(product.ok());
  REQUIRE(product->variants.at(0).housing);
  const glm::dvec3 size = product->variants[0].housing->size_m;
  CHECK((size.x == Approx(0.1) && size.y == Approx(0.2) && size.z == Approx(0.04)));
}

TEST_CASE(
    "the emergency flux is rated, or by the ballast, or the rated flux of an emergency-only "
    "emitter, else unknown",
    "[photometry][gldf]") {
  const std::string rated = "<RatedLuminousFlux>1000</RatedLuminousFlux>";
  Product product;
  product.light = rated +
                  "<EmergencyRatedLuminousFlux>240</EmergencyRatedLuminousFlux>"
                  "<EmergencyBallastLumenFactor>0.5</EmergencyBallastLumenFactor>";
  CHECK(product.luminaire().emergency_lm.value() == 240);
  product.light = rated + "<EmergencyBallastLumenFactor>0.25</EmergencyBallastLumenFactor>";
  CHECK(product.luminaire().emergency_lm.value() == 250);
  product.light = rated;
  const GldfLuminaire silent = product.luminaire();
  REQUIRE_FALSE(silent.emergency_lm.ok());
  says(silent.emergency_lm.problem().what, "states no emergency flux");
  product.behaviour = "EmergencyOnly";
  CHECK(product.luminaire().emergency_lm.value() == 1000);
  CHECK(product.luminaire().emergency_only);
}

TEST_CASE(
    "an emitter for normal lighting has no emergency flux, and one that says nothing needs one",
    "[photometry][gldf]") {
  Product product;
  product.attributes = durations;
  product.behaviour = "None";
  for (const std::optional<double> hours : {std::optional<double>(), std::optional(1.0)}) {
    const GldfLuminaire normal = product.luminaire(hours);
    CHECK(normal.normal_only);
    REQUIRE_FALSE(normal.emergency_lm.ok());
    says(normal.emergency_lm.problem().what,
         "for normal lighting only (emergencyBehaviour \"None\")");
  }
  product.behaviour = "";
  REQUIRE_FALSE(product.luminaire(1).emergency_lm.ok());
  says(product.luminaire(1).emergency_lm.problem().what, "no emergencyBehaviour");
  product.light += "<EmergencyBallastLumenFactor>0.25</EmergencyBallastLumenFactor>";
  CHECK(product.luminaire().emergency_lm.value() == 250);
  CHECK(product.luminaire(3).emergency_lm.value() == 150);
  product.behaviour = "Emergency";
  says(missing(product), "must be None, Combined or EmergencyOnly, not \"Emergency\"");
}

TEST_CASE("a stated duration selects its row of the table, and no other", "[photometry][gldf]") {
  Product product;
  product.attributes = durations;
  CHECK(product.luminaire(1).emergency_lm.value() == 250);
  CHECK(product.luminaire(3).emergency_lm.value() == 150);
  const GldfLuminaire other = product.luminaire(2);
  REQUIRE_FALSE(other.emergency_lm.ok());
  says(other.emergency_lm.problem().what, "\"1\", \"3\" h");
}

TEST_CASE("the lights of a product that are lit in an emergency share its flux by duration",
          "[photometry][gldf]") {
  // "e" of 1000 lm; "d" of 400 lm, or 600 lm in its stead; "n" for normal lighting; "c" of two
  // channels, 100 and 200 lm.
  const auto fixed = [](const std::string& behaviour, const std::string& lumens) {
    return "<FixedLightEmitter emergencyBehaviour=\"" + behaviour +
           "\"><PhotometryReference photometryId=\"p\"/><RatedLuminousFlux>" + lumens +
           "</RatedLuminousFlux></FixedLightEmitter>";
  };
  Product product;
  product.attributes = durations;
  product.emitters = "<Emitter id=\"d\">" + fixed("Combined", "400") + fixed("Combined", "600") +
                     "</Emitter><Emitter id=\"n\">" + fixed("None", "5000") +
                     "</Emitter><Emitter id=\"c\"><MultiChannelLightEmitter "
                     "emergencyBehaviour=\"EmergencyOnly\"><LightSourceReference "
                     "multiChannelLightSourceId=\"m\"/></MultiChannelLightEmitter></Emitter>";
  product.sources = "<MultiChannelLightSource id=\"m\"><Channels>";
  for (const std::string lumens : {"100", "200"})
    product.sources += "<Channel><PhotometryReference photometryId=\"p\"/><RatedLuminousFlux>" +
                       lumens + "</RatedLuminousFlux></Channel>";
  product.sources += "</Channels></MultiChannelLightSource>";
  product.geometry =
      "<EmitterReference emitterId=\"e\"/><EmitterReference emitterId=\"d\"/>"
      "<EmitterReference emitterId=\"n\"/><EmitterReference emitterId=\"c\"/>";
  const auto read = gldf_of(product.container(), "test.gldf");
  if (!read) FAIL(read.problem().text());
  std::vector<std::string> names;
  for (const GldfReference& light : read->variants.at(0).lights) names.push_back(light.name);
  CHECK(names == std::vector<std::string>{"e", "d", "d#2", "n", "c:1", "c:2"});
  const auto lumens = [&](const char* emitter) {
    const auto luminaire = luminaire_of(read.value(), {"v", emitter, 1.0, {}});
    if (!luminaire) FAIL(luminaire.problem().text());
    if (!luminaire->emergency_lm) FAIL(luminaire->emergency_lm.problem().text());
    return luminaire->emergency_lm.value();
  };
  // 250 lm among 1000 + 600 + 300 lm: of the alternatives left open the brightest counts.
  CHECK(lumens("e") == Approx(250 * 1000 / 1900.0));
  CHECK(lumens("c:1") == Approx(250 * 100 / 1900.0));
  CHECK(lumens("c:2") == Approx(250 * 200 / 1900.0));
  CHECK(lumens("d#2") == Approx(250 * 600 / 1900.0));
  CHECK(lumens("d") == Approx(250 * 400 / 1700.0));
}

TEST_CASE("a light whose flux the container states has its share without a photometric file",
          "[photometry][gldf]") {
  Product product;
  product.attributes = durations;
  product.emitters =
      "<Emitter id=\"d\"><FixedLightEmitter emergencyBehaviour=\"Combined\"><PhotometryReference "
      "photometryId=\"none\"/><RatedLuminousFlux>1500</RatedLuminousFlux></FixedLightEmitter>"
      "</Emitter>";
  product.geometry = "<EmitterReference emitterId=\"e\"/><EmitterReference emitterId=\"d\"/>";
  const auto read = gldf_of(product.container(), "test.gldf");
  if (!read) FAIL(read.problem().text());
  const auto luminaire = luminaire_of(read.value(), {"v", "e", 1.0, {}});
  if (!luminaire) FAIL(luminaire.problem().text());
  if (!luminaire->emergency_lm) FAIL(luminaire->emergency_lm.problem().text());
  CHECK(luminaire->emergency_lm.value() == Approx(250 * 1000 / 2500.0));
}

TEST_CASE("an emitter that a variant refers to several times is several lights",
          "[photometry][gldf]") {
  Product product;
  product.geometry =
      "<GeometryReferences><SimpleGeometryReference geometryId=\"g\" emitterId=\"e\"/>"
      "<ModelGeometryReference geometryId=\"m\">"
      "<EmitterReference emitterId=\"e\"><EmitterObjectExternalName> left "
      "</EmitterObjectExternalName>"
      "</EmitterReference><EmitterReference emitterId=\"e\"><EmitterObjectExternalName>right"
      "</EmitterObjectExternalName></EmitterReference>"
      "<EmitterReference emitterId=\"e\" targetModelType=\"r3d\"><EmitterObjectExternalName>other"
      "</EmitterObjectExternalName></EmitterReference>"
      "</ModelGeometryReference></GeometryReferences>";
  product.attributes = durations;
  const auto read = gldf_of(product.container(), "test.gldf");
  if (!read) FAIL(read.problem().text());
  const auto& lights = read->variants.at(0).lights;
  REQUIRE(lights.size() == 2);
  CHECK((lights[0].name == "e" && lights[1].name == "e@2"));
  CHECK((lights[0].opening == "left" && lights[1].opening == "right"));
  CHECK(lights[0].light == lights[1].light);
  says(luminaire_of(read.value(), {}).problem().what, "say 'emitter': \"e\", \"e@2\"");
  // Both are lit, and the table is the product's.
  CHECK(luminaire_of(read.value(), {"", "e@2", 1.0, {}})->emergency_lm.value() == Approx(125));
  product.geometry = "<EmitterReference emitterId=\"unknown\"/>";
  says(missing(product), "the container does not define this emitter");
}

TEST_CASE("blanks and line ends around values do not count, nor do comments within them",
          "[photometry][gldf]") {
  Product product;
  product.file =
      "<File id=\" f \" contentType=\" ldc/ies\" type=\"localFileName \">\n  lamp.ies\n</File>";
  product.light =
      "<RatedLuminousFlux>\n  4<!-- four hundred -->00\n</RatedLuminousFlux>"
      "<EmergencyRatedLuminousFlux><![CDATA[ 40 ]]></EmergencyRatedLuminousFlux>";
  CHECK(product.luminaire().rated_lm == 400);
  CHECK(product.luminaire().emergency_lm.value() == 40);
}

TEST_CASE("a number that cannot be read is an error with its line", "[photometry][gldf]") {
  const auto with = [](const std::string& light) {
    Product product;
    product.before += "\n\n";
    product.light = "\n" + light;
    return missing(product);
  };
  for (const char* number : {"100,0", "100 lm", "-250", "nan", "inf", "0x3E8", "1e99", ""}) {
    INFO(number);
    const std::string said =
        with("<RatedLuminousFlux>" + std::string(number) + "</RatedLuminousFlux>");
    says(said,
         "line 4 of 'product.xml': RatedLuminousFlux must be a number from 0 to 1e+08, not \"" +
             std::string(number) + "\"");
  }
  const std::string rated = "<RatedLuminousFlux>1000</RatedLuminousFlux>";
  says(with(rated + "<EmergencyRatedLuminousFlux>a</EmergencyRatedLuminousFlux>"),
       "EmergencyRatedLuminousFlux must be");
  says(with(rated + "<EmergencyBallastLumenFactor>15</EmergencyBallastLumenFactor>"),
       "EmergencyBallastLumenFactor must be a number from 0 to 1, not \"15\"");
  says(with("<Rotation><X>up</X></Rotation>" + rated), "X must be a number from -360 to 360");
  Product product;
  product.attributes = replaced(durations, "hours=\"3\"", "hours=\"three\"");
  says(missing(product), "hours of DurationTimeAndFlux must be a number");
  product.attributes = replaced(durations, ">150<", "> <");
  says(missing(product), "Flux of DurationTimeAndFlux must be a number");
  product.attributes.clear();
  product.width = "10 cm";
  says(missing(product), "Width must be a number from 0 to 100000, not \"10 cm\"");
}

TEST_CASE("the turn of an emitter within its luminaire is applied", "[photometry][gldf]") {
  const auto down = [](const std::string& turn, const glm::dvec3& direction = {0, 0, -1}) {
    Product product;
    product.light = "<Rotation>" + turn + "</Rotation>" + product.light;
    const GldfLuminaire luminaire = product.luminaire();
    CHECK(luminaire.photometry.warnings.empty() == (turn.find("<Y>") == std::string::npos));
    return luminaire.turn * direction;
  };
  const auto check = [](const glm::dvec3& is, const glm::dvec3& wanted) {
    INFO(is.x << " " << is.y << " " << is.z);
    CHECK(glm::length(is - wanted) < 1e-12);
  };
  check(Product{}.luminaire().turn * glm::dvec3(1, 2, 3), {1, 2, 3});
  check(down("<X>90</X>"), {0, 1, 0});
  check(down("<Z>90</Z><G0>0</G0>", {1, 0, 0}), {0, 1, 0});
  // About its own gamma 0 first, then with the luminaire's axes.
  check(down("<X>90</X><G0>90</G0>", {1, 0, 0}), {0, 0, 1});
  check(down("<X>90</X><G0>90</G0>"), {0, 1, 0});
  // Several axes: z, then x, then y, about the part's own axes, and a warning.
  check(down("<X>90</X><Y>90</Y>"), {-1, 0, 0});
}

TEST_CASE("the flux of a changeable lamp is multiplied by the luminaire's light output ratio",
          "[photometry][gldf]") {
  Product product;
  product.kind = "ChangeableLightEmitter";
  product.light = R"(<EquipmentReference equipmentId="q"/>)";
  product.sources = R"(<ChangeableLightSource id="l"><RatedLuminousFlux>700</RatedLuminousFlux>)"
                    "</ChangeableLightSource>";
  product.equipment = R"(<LightSourceReference changeableLightSourceId="l" lightSourceCount="2"/>)"
                      "<EmergencyBallastLumenFactor>0.1</EmergencyBallastLumenFactor>";
  const auto read = gldf_of(product.container(), "test.gldf");
  REQUIRE(read.ok());
  CHECK(read->lights.at(0).lamp_lm == std::optional<double>(1400));
  const GldfLuminaire luminaire = product.luminaire();
  CHECK(luminaire.rated_lm == Approx(1400 * luminaire.photometry.light_output_ratio));
  CHECK(luminaire.emergency_lm.value() == Approx(luminaire.rated_lm / 10));
}

TEST_CASE("the emergency flux of an equipment is that of its lamps", "[photometry][gldf]") {
  Product product;
  product.kind = "ChangeableLightEmitter";
  product.light = "<EquipmentReference equipmentId=\"q\"/>";
  product.sources =
      "<ChangeableLightSource id=\"l\"><RatedLuminousFlux>1000</RatedLuminousFlux>"
      "</ChangeableLightSource>";
  product.equipment =
      "<LightSourceReference changeableLightSourceId=\"l\"/>"
      "<EmergencyRatedLuminousFlux>100</EmergencyRatedLuminousFlux>";
  // 1000 lm per lamp, of which the intensities hold the share of the luminaire.
  product.lamp = replaced(gldf_lamp, "1 -1 1 3", "1 1000 1 3");
  const GldfLuminaire luminaire = product.luminaire();
  const double ratio = luminaire.photometry.light_output_ratio;
  CHECK((ratio > 0.5 && ratio < 0.9));
  CHECK(luminaire.emergency_lm.value() == Approx(100 * ratio));
  product.equipment = replaced(product.equipment, "</EmergencyRated", "x</EmergencyRated");
  says(missing(product), "EmergencyRatedLuminousFlux must be a number");
  product.equipment =
      "<LightSourceReference changeableLightSourceId=\"l\" lightSourceCount=\"two\"/>";
  says(missing(product), "lightSourceCount must be a number from 1 to 10000, not \"two\"");
}

TEST_CASE("what the container does not hold is reported, and nothing is downloaded",
          "[photometry][gldf]") {
  Product product;
  product.file = R"(<File id="f" contentType="ldc/ies" type="url">https://a.example/x</File>)";
  says(missing(product), "nothing is fetched");
  product.file = R"(<File id="f" contentType="ldc/ies" type="localFileName">other.ies</File>)";
  says(missing(product), "\"other.ies\" is not in the container");
  product.file = R"(<File id="f" contentType="ldc/iesxml" type="localFileName">l.xml</File>)";
  says(missing(product), "\"ldc/ies\" are read");
  product.file = R"(<File id="f" contentType="ldc/ies" type="localFileName">../lamp.ies</File>)";
  says(missing(product), "is not in the container");
}

TEST_CASE("a file whose name the packer encoded differently is found if it is the only one",
          "[photometry][gldf]") {
  Product product;
  product.file = R"(<File id="f" contentType="ldc/ies" type="localFileName">LAMP.IES</File>)";
  CHECK(missing(product) == "there");
  product.file =
      "<File id=\"f\" contentType=\"ldc/ies\" type=\"localFileName\">l\xc3\xa4mp.ies</File>";
  CHECK(missing(product) == "there");
}

TEST_CASE("a variant and an emitter must be named if there are several", "[photometry][gldf]") {
  std::string xml = Product{}.xml();
  const std::string end = "</Variant>";
  const std::string second =
      R"(<Variant id="w"><Geometry><EmitterReference emitterId="e"/></Geometry></Variant>)";
  xml.insert(xml.find(end) + end.size(), second);
  const auto product =
      gldf_of(zip_of({{"product.xml", xml}, {"ldc/lamp.ies", gldf_lamp}}), "test.gldf");
  REQUIRE(product.ok());
  says(luminaire_of(product.value(), {}).problem().what, "say 'variant': \"v\", \"w\"");
  says(luminaire_of(product.value(), {"x", "", {}, {}}).problem().what, "there are \"v\", \"w\"");
  says(luminaire_of(product.value(), {"w", "x", {}, {}}).problem().what, "no emitter \"x\"");
  CHECK(luminaire_of(product.value(), {"w", "", {}, {}}).ok());
}

TEST_CASE("a file that is not a container, another version and hidden entities are rejected",
          "[photometry][gldf]") {
  says(gldf_refusal("hello"), "no GLDF container");
  says(gldf_refusal(zip_of({{"ldc/lamp.ies", gldf_lamp}})), "no 'product.xml'");
  says(gldf_refusal(zip_of({{"product.xml", "<Root"}})), "is no XML");
  Product product;
  product.version = "<FormatVersion>0.9-beta.3</FormatVersion>";
  says(gldf_refusal(product.container()), "version \"0.9");
  product.version = "<FormatVersion>1.0.0-rc.1</FormatVersion>";
  CHECK(gldf_refusal(product.container()) == "read");
  product.before = R"(<!DOCTYPE Root [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;">]>)";
  says(gldf_refusal(product.container()), "DOCTYPE");
}

TEST_CASE("names that lead out of the archive, and entries that expand too far, are rejected",
          "[photometry][gldf]") {
  const std::string xml = Product{}.xml();
  for (const char* name : {"../evil.ldt", "ldc/../../evil.ldt", "/etc/evil", "c:/evil", "a\\b"})
    says(gldf_refusal(zip_of({{"product.xml", xml}, {name, gldf_lamp}})), "leads out of it");
  // 13 bits hold 258 bytes: 53 kB hold 8.4 MB.
  const ZipEntry bomb = swelling_entry("product.xml", 32'600);
  CHECK(bomb.data.size() < 60'000);
  says(gldf_refusal(zip_of({bomb})), "larger than 8388608 bytes when unpacked");
  ZipEntry lying = bomb;
  lying.plain_bytes = 100;
  const std::string refused = gldf_refusal(zip_of({lying}));
  CHECK(refused != "read");
  std::vector<ZipEntry> many(5000);
  for (size_t i = 0; i < many.size(); ++i) many[i].name = std::to_string(i);
  says(gldf_refusal(zip_of(many)), "the most are 4096");
}

TEST_CASE("progress of a container is reported after each unpacked file", "[photometry][gldf]") {
  // Two more emitters in the variant's geometry, each with a file of its own.
  std::string xml = Product{}.xml(), lights;
  for (const std::string id : {"g", "h"}) {
    const auto before = [&](const std::string& end, const std::string& what) {
      xml = replaced(xml, end, what + end);
    };
    before("</Files>", "<File id=\"" + id + "\" contentType=\"ldc/ies\" type=\"localFileName\">" +
                           id + ".ies</File>");
    before("</Photometries>", "<Photometry id=\"" + id + "\"><PhotometryFileReference fileId=\"" +
                                  id + "\"/></Photometry>");
    before("</Emitters>", "<Emitter id=\"" + id + "\"><FixedLightEmitter>" +
                              "<PhotometryReference photometryId=\"" + id +
                              "\"/></FixedLightEmitter></Emitter>");
    lights += "<EmitterReference emitterId=\"" + id + "\"/>";
  }
  xml = replaced(xml, "</Geometry>", lights + "</Geometry>");
  const std::string container = zip_of({{"product.xml", xml},
                                        {"ldc/lamp.ies", gldf_lamp},
                                        {"ldc/g.ies", gldf_lamp},
                                        {"ldc/h.ies", gldf_lamp}});
  std::vector<double> heard;
  const auto product = gldf_of(container, "test.gldf", GldfModels::left,
                               [&](double share) { heard.push_back(share); });
  INFO((product ? std::string() : product.problem().text()));
  REQUIRE(product);
  REQUIRE(product->photometry.size() == 3);
  REQUIRE(heard.size() == 3);
  for (size_t i = 0; i < 3; ++i) CHECK(heard[i] == Approx(static_cast<double>(i + 1) / 3));
}

TEST_CASE("another process reads a container from the disk with the same result",
          "[photometry][gldf]") {
  const TemporaryFolder folder;
  Product product;
  product.attributes = durations;
  const auto path = folder.write("a.gldf", product.container());
  const auto read = read_gldf(path);
  REQUIRE(read.ok());
  CHECK(read->file == path.string());
  CHECK(read->name == "Lamp");
  REQUIRE(read->variants.size() == 1);
  CHECK(read->variants[0].durations.size() == 2);
  REQUIRE(read->photometry.size() == 1);
  CHECK(read->photometry[0].bytes == gldf_lamp);
  ReadingShare share;
  CHECK(read_gldf(path, GldfModels::read, &share).ok());
  CHECK(share.share() == std::optional(1.0));
  const auto refused = read_gldf(folder.write("b.gldf", "hello"));
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.problem().where.file == (folder / "b.gldf").string());
  says(refused.problem().what, "no GLDF container");
  says(read_gldf(folder / "absent.gldf").problem().text(), "absent.gldf");
}

TEST_CASE("containers of other programs are read or rejected with a message",
          "[photometry][gldf]") {
  if (!data_is_there("gldf")) return;
  const auto folder = shared_data / "gldf";
  const auto own = read_gldf(folder / "emergency_own.gldf");
  REQUIRE(own.ok());
  const auto flux = [&](const char* variant, std::optional<double> hours = {}) {
    const auto luminaire = luminaire_of(own.value(), {variant, "", hours, {}});
    REQUIRE(luminaire.ok());
    return luminaire->emergency_lm.ok() ? luminaire->emergency_lm.value() : -1;
  };
  CHECK(flux("v-factor") == 250);
  CHECK(flux("v-flux") == 240);
  CHECK(flux("v-flux", 3) == 150);
  CHECK(flux("v-only") == 250);
  CHECK(flux("v-unknown") == -1);
  says(luminaire_of(own.value(), {"v-remote", "", {}, {}}).problem().what, "nothing is fetched");
  for (const char* name : {"GldfWithCodepage850", "GldfWithEncodingUtf8", "GldfWithFilesComplete",
                           "GldfWithMissingFiles", "GldfWithNoFiles", "GldfWithOrphanedFiles"}) {
    INFO(name);
    CHECK(read_gldf(folder / (std::string(name) + ".gldf")).ok());
  }
  says(read_gldf(folder / "GldfWithMissingProduct.gldf").problem().what, "no 'product.xml'");
}

TEST_CASE("mutated containers are read or rejected with one sentence", "[photometry][gldf]") {
  const char* seed_text = std::getenv("LUXODUS_SEED");
  const uint64_t seed = seed_text != nullptr ? std::strtoull(seed_text, nullptr, 0) : 1;
  const char* count_text = std::getenv("LUXODUS_MUTATIONS");
  const int tries = count_text != nullptr ? std::atoi(count_text) : 5000;
  INFO("seed " << seed);
  Random random(seed, RandomStream::test);
  random.start(0);
  Product product;
  product.attributes = durations;
  const auto bytes_of = [](const std::string& text) {
    const auto* from = reinterpret_cast<const std::byte*>(text.data());
    return Bytes(from, from + text.size());
  };
  const auto text_of = [](const Bytes& bytes) {
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  const Bytes whole = bytes_of(product.container()), xml = bytes_of(product.xml());
  int read = 0;
  std::set<std::string> made;  // luminaires: making one takes longer than reading a container
  for (int i = 0; i < tries; ++i) {
    // The container itself, or its XML within a sound container.
    const bool packed = random.bits() % 2 == 0;
    const std::string harmed = text_of(mutated(packed ? whole : xml, packed ? xml : whole, random));
    const std::string container =
        packed ? harmed : zip_of({{"product.xml", harmed}, {"ldc/lamp.ies", gldf_lamp}});
    const auto answer = gldf_of(container, "harmed.gldf");
    if (!answer) {
      REQUIRE_FALSE(answer.problem().what.empty());
      continue;
    }
    ++read;
    for (const GldfVariant& variant : answer->variants)
      for (const GldfReference& reference : variant.lights) {
        const GldfLight& light = answer->lights.at(reference.light);
        if (!made.insert(reference.name + words_of(answer.value(), variant, light)).second)
          continue;
        const auto luminaire = luminaire_of(answer.value(), {variant.id, reference.name, {}, {}});
        if (luminaire) REQUIRE(luminaire->photometry.web->flux_lm() > 0);
      }
  }
  CHECK(read > tries / 50);  // mutations that reach deep
  CHECK(read < tries);
}
