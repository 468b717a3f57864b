// Exchange files of ISO 10303-21: values, texts, and damaged files. The seed is LUXODUS_SEED, or 1;
// LUXODUS_MUTATIONS sets how many models are mutated.
#include "scenes/formats/ifc/step_file.hpp"

#include <catch2/catch.hpp>

#include "scenes/formats/ifc/ifc_model.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/kit/environment_number.hpp"
#include "tests/kit/small_ifc.hpp"
#include "tests/kit/test_length.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

StepFile step_of(const std::string& data) {
  auto file = StepFile::of("ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('Ifc4'));\nENDSEC;\nDATA;\n" +
                               data + "\nENDSEC;\nEND-ISO-10303-21;\n",
                           "test.ifc");
  if (!file) FAIL(file.problem().text());
  return std::move(file).value();
}

std::vector<StepValue> values(const std::string& brackets) {
  const StepFile file = step_of("#1=IFCX(" + brackets + ");");
  return file.parameters(*file.find(1));
}

}  // namespace

TEST_CASE("parameters of every kind are recognised", "[ifc]") {
  const auto all = values("$,*,-1.5E2,7,'it''s',.MILLI.,#12,(1,(2.,'a')),IFCLABEL('b'),\"0F\"");
  REQUIRE(all.size() == 10);
  CHECK(all[0].kind == StepValue::Kind::omitted);
  CHECK(all[1].kind == StepValue::Kind::derived);
  CHECK(all[2].number == -150);
  CHECK(all[3].number == 7);
  CHECK(all[4].text == "it's");
  CHECK((all[5].kind == StepValue::Kind::word && all[5].text == "MILLI"));
  CHECK((all[6].kind == StepValue::Kind::reference && all[6].id == 12));
  REQUIRE(all[7].items.size() == 2);
  CHECK(all[7].items[1].items.at(1).text == "a");
  CHECK((all[8].text == "IFCLABEL" && all[8].items.at(0).text == "b"));
  CHECK(all[9].kind == StepValue::Kind::derived);
}

TEST_CASE("texts are decoded to UTF-8 from every encoding of the format", "[ifc]") {
  CHECK(step_text("T\\X2\\00FC\\X0\\r") == "T\xc3\xbcr");
  CHECK(step_text("T\\X\\FCr") == "T\xc3\xbcr");
  CHECK(step_text("T\\S\\|r") == "T\xc3\xbcr");
  CHECK(step_text("\\X4\\0001F6AA\\X0\\") == "\xf0\x9f\x9a\xaa");
  CHECK(step_text("\\X2\\D83DDEAA\\X0\\") == "\xf0\x9f\x9a\xaa");
  CHECK(step_text("T\xfcr") == "T\xc3\xbcr");
  CHECK(step_text("a\\\\b") == "a\\b");
  CHECK(step_text("\\X2\\00FC") == "\xc3\xbc");  // never ended
}

TEST_CASE("comments, line ends and semicolons within texts do not end a statement", "[ifc]") {
  const StepFile file =
      step_of("/* #9=IFCX(); */ #1 = IFCX ( 'a;b' ,\n #2 ) ;#2=IFCY('/* '' */');");
  REQUIRE(file.instances().size() == 2);
  CHECK(file.schema() == "IFC4");
  CHECK(file.parameters(*file.find(1)).at(0).text == "a;b");
  CHECK(file.parameters(*file.find(1)).at(1).id == 2);
  CHECK(file.parameters(*file.find(2)).at(0).text == "/* ' */");
  CHECK(file.find(9) == nullptr);
}

TEST_CASE("damage is a fault with its line, and reading goes on", "[ifc]") {
  const StepFile file = step_of("#1=IFCX(1);\n#x=IFCX(2);\n#3=IFCX;\n#1=IFCX(4);\n#5=IFCX(5);");
  CHECK(file.instances().size() == 2);
  REQUIRE(file.faults().size() == 3);
  CHECK(file.faults()[0].where.line == 7);
  CHECK(file.faults()[1].where.line == 8);
  CHECK(file.faults()[2].what.find("#1 stands twice") != std::string::npos);
  CHECK(file.parameters(*file.find(1)).at(0).number == 1);
  CHECK(values("1,.never").size() == 1);
  CHECK(values(std::string(1000, '(')).empty());
}

TEST_CASE("a file that is not an exchange file is rejected with a message", "[ifc]") {
  const auto refusal = [](const std::string& bytes) {
    const auto file = StepFile::of(bytes, "x.ifc");
    return file ? std::string("read") : file.problem().text();
  };
  CHECK(refusal("PK\x03\x04").find("ZIP") != std::string::npos);
  CHECK(refusal("hello").find("does not begin with ISO-10303-21") != std::string::npos);
  CHECK(refusal("ISO-10303-21;DATA;ENDSEC;").find("nothing in this model") != std::string::npos);
}

TEST_CASE("mutated models are read or rejected with one sentence", "[ifc]") {
  const uint64_t seed = environment_number("LUXODUS_SEED", 1);
  const uint64_t tries = environment_number("LUXODUS_MUTATIONS", in_full() ? 100'000 : 3'000);
  INFO("seed " << seed);
  Random random(seed, RandomStream::test);
  random.start(0);
  SmallIfc small;
  small.wall_volume_m3 = 1;
  const auto bytes_of = [](const std::string& text) {
    const auto* from = reinterpret_cast<const std::byte*>(text.data());
    return Bytes(from, from + text.size());
  };
  const Bytes one = bytes_of(small.text());
  small.feet = true;
  const Bytes other = bytes_of(small.text());
  uint64_t read = 0;
  for (uint64_t i = 0; i < tries; ++i) {
    const Bytes harmed = mutated(one, other, random);
    const auto model = ifc_model_of(
        std::string(reinterpret_cast<const char*>(harmed.data()), harmed.size()), "harmed.ifc");
    if (!model) {
      REQUIRE_FALSE(model.problem().what.empty());
      continue;
    }
    ++read;
    for (const IfcProduct& product : model->products) REQUIRE(is_finite(product.placement.offset));
  }
  CHECK(read > tries / 10);
  CHECK(read < tries);
}
