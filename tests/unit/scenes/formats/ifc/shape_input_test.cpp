// The model as the library that computes shapes reads it: which representations remain, what is
// written in another way, and solids that are cut here. Volumes are those of the drawn solids.
#include "scenes/formats/ifc/shape_input.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "runtime/core/random.hpp"
#include "scenes/formats/ifc/profiles.hpp"
#include "scenes/formats/ifc/step_solids.hpp"
#include "scenes/light/geometry/closed_mesh.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"
#include "scenes/light/geometry/polygon.hpp"
#include "tests/kit/environment_number.hpp"
#include "tests/kit/small_ifc.hpp"
#include "tests/kit/step_text.hpp"
#include "tests/kit/test_length.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

struct Prepared {
  IfcModel model;
  StepFile file;
  std::vector<std::string> notes;
};

Prepared prepared(const std::string& text) {
  auto step = StepFile::of(text, "t.ifc");
  REQUIRE(step.ok());
  auto model = ifc_model_of(step.value(), "t.ifc");
  REQUIRE(model.ok());
  auto input = ifc_shape_input(step.value(), model.value());
  REQUIRE(input.ok());
  return {std::move(model).value(), std::move(input->file), std::move(input->notes)};
}

uint64_t id_of(const std::string& reference) {
  return std::stoull(reference.substr(1));
}

StepNode node_in(const StepFile& file, StepGraph& graph, const std::string& reference) {
  REQUIRE(file.find(id_of(reference)) != nullptr);
  return graph.node(id_of(reference));
}

/// Volume [m3] of a solid of a model in millimetres, which must be closed.
double solid_m3(StepText& text, const std::string& item) {
  const auto step = StepFile::of(text.text(), "t.ifc");
  REQUIRE(step.ok());
  StepGraph graph(step.value());
  auto mesh = step_solid(graph, graph.node(id_of(item)), 1e-3);
  REQUIRE(mesh);
  for (glm::dvec3& p : mesh->positions) p /= 1000;
  CHECK(open_edges(*mesh).closed());
  return signed_volume_of(*mesh);
}

double profile_m2(const std::string& definition) {
  StepText text;
  const std::string at = text.add("IFCAXIS2PLACEMENT2D(" + text.point(glm::dvec2(100, 50)) + ",$)");
  std::string whole = definition;
  whole.replace(whole.find("AT"), 2, at);
  const std::string profile = text.add(whole);
  const auto step = StepFile::of(text.text(), "t.ifc");
  REQUIRE(step.ok());
  StepGraph graph(step.value());
  const auto found = ifc_profile(graph, graph.node(id_of(profile)));
  REQUIRE(found);
  double area = signed_area(found->outline);
  CHECK(area > 0);
  for (const Outline& hole : found->holes) {
    CHECK(signed_area(hole) < 0);
    area += signed_area(hole);
  }
  return area / 1e6;
}

}  // namespace

TEST_CASE("profiles have the area of their measures", "[ifc]") {
  constexpr double pi = std::numbers::pi;
  CHECK(profile_m2("IFCRECTANGLEPROFILEDEF(.AREA.,$,AT,2000.,500.)") == Approx(1));
  CHECK(profile_m2("IFCTRAPEZIUMPROFILEDEF(.AREA.,$,AT,2000.,1000.,1000.,500.)") == Approx(1.5));
  CHECK(profile_m2("IFCRECTANGLEHOLLOWPROFILEDEF(.AREA.,$,AT,1000.,500.,50.,$,$)") ==
        Approx(0.5 - 0.9 * 0.4));
  CHECK(profile_m2("IFCCIRCLEPROFILEDEF(.AREA.,$,AT,500.)") == Approx(pi / 4).epsilon(0.002));
  CHECK(profile_m2("IFCCIRCLEHOLLOWPROFILEDEF(.AREA.,$,AT,500.,100.)") ==
        Approx(pi * (0.25 - 0.16)).epsilon(0.002));
  CHECK(profile_m2("IFCELLIPSEPROFILEDEF(.AREA.,$,AT,1000.,500.)") ==
        Approx(pi / 2).epsilon(0.002));
}

TEST_CASE("a centre line has the area of its length times its thickness", "[ifc]") {
  StepText text;
  const std::string line =
      text.add("IFCPOLYLINE((" + text.point(glm::dvec2(0, 0)) + "," +
               text.point(glm::dvec2(2000, 0)) + "," + text.point(glm::dvec2(2000, 1000)) + "))");
  const std::string profile = text.add("IFCCENTERLINEPROFILEDEF(.AREA.,$," + line + ",100.)");
  CHECK(solid_m3(text, text.extruded(profile, 1000)) == Approx(0.3));
}

TEST_CASE("an outline of lines and arcs has its area", "[ifc]") {
  // A square of 1 m with half a circle on one side.
  StepText text;
  const std::string points = text.add(
      "IFCCARTESIANPOINTLIST2D(((0.,0.),(1000.,0.),(1500.,500.),(1000.,1000.),(0.,1000.)))");
  const std::string curve = text.add("IFCINDEXEDPOLYCURVE(" + points +
                                     ",(IFCLINEINDEX((1,2)),IFCARCINDEX((2,3,4)),"
                                     "IFCLINEINDEX((4,5,1))),.F.)");
  const std::string profile = text.add("IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$," + curve + ")");
  CHECK(solid_m3(text, text.extruded(profile, 1000)) ==
        Approx(1 + std::numbers::pi / 8).epsilon(0.002));
}

TEST_CASE("solids have the volume of their measures", "[ifc]") {
  constexpr double pi = std::numbers::pi;
  const auto volume = [](const std::string& definition) {
    StepText text;
    std::string whole = definition;
    whole.replace(whole.find("AT"), 2, text.axes({1000, 2000, 3000}, {1, 2, 3}));
    return solid_m3(text, text.add(whole));
  };
  CHECK(volume("IFCBLOCK(AT,1000.,500.,250.)") == Approx(0.125));
  CHECK(volume("IFCRECTANGULARPYRAMID(AT,1000.,500.,750.)") == Approx(0.125));
  CHECK(volume("IFCRIGHTCIRCULARCYLINDER(AT,3000.,500.)") == Approx(3 * pi / 4).epsilon(0.002));
  CHECK(volume("IFCRIGHTCIRCULARCONE(AT,3000.,500.)") == Approx(pi / 4).epsilon(0.002));
}

TEST_CASE("half spaces through edges of a wall leave it closed", "[ifc]") {
  const auto wall = [](StepText& text) { return text.box({0, 0, 0}, {4000, 200, 3000}); };
  {
    StepText text;
    CHECK(solid_m3(text, text.without(wall(text), text.above({0, 0, 3000}, {3, 0, 4}))) ==
          Approx(1.2));
  }
  {
    StepText text;
    const std::string mitred = text.without(wall(text), text.above({4000, 0, 0}, {1, 1, 0}));
    CHECK(solid_m3(text, text.without(mitred, text.above({0, 0, 0}, {-1, 1, 0}))) ==
          Approx((4 * 0.2 - 0.04) * 3));
  }
  {
    StepText text;  // what is below the plane, by an intersection
    const std::string half = text.above({0, 0, 3000}, {3, 0, 4});
    CHECK(solid_m3(text, text.add("IFCBOOLEANRESULT(.INTERSECTION.," + wall(text) + "," + half +
                                  ")")) == Approx(1.2));
  }
  {
    StepText text;  // a roof of two bounded half spaces
    const auto side = [&](double from, double to, const glm::dvec3& normal) {
      const std::string plane = text.add("IFCPLANE(" + text.axes({2000, 0, 3000}, normal) + ")");
      const std::string outline = text.polyline({{from, -100}, {to, -100}, {to, 300}, {from, 300}});
      return text.add("IFCPOLYGONALBOUNDEDHALFSPACE(" + plane + ",.F.," + text.axes({0, 0, 0}) +
                      "," + outline + ")");
    };
    const std::string left = text.without(wall(text), side(-10, 2000, {-1, 0, 1}));
    CHECK(solid_m3(text, text.without(left, side(2000, 4010, {1, 0, 1}))) ==
          Approx(0.2 * (4 * 3 - 2 * 2 * 2 / 2.0)));
  }
}

TEST_CASE("convex bodies cut others, and non-convex ones do not", "[ifc]") {
  const auto result = [](const char* what, const glm::dvec3& low, const glm::dvec3& size) {
    StepText text;
    const std::string wall = text.box({0, 0, 0}, {4000, 200, 3000});
    const std::string other = text.box(low, size);
    return solid_m3(
        text, text.add(std::string("IFCBOOLEANRESULT(.") + what + ".," + wall + "," + other + ")"));
  };
  CHECK(result("DIFFERENCE", {1000, -100, 900}, {1000, 400, 1200}) == Approx(2.4 - 0.24));
  CHECK(result("DIFFERENCE", {1000, 50, 900}, {1000, 100, 1200}) == Approx(2.4 - 0.12));
  CHECK(result("DIFFERENCE", {5000, 0, 0}, {1000, 100, 1200}) == Approx(2.4));
  CHECK(result("INTERSECTION", {1000, -100, 900}, {1000, 400, 1200}) == Approx(0.24));
  StepText text;
  const std::string bent = text.extruded(
      text.add("IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$," +
               text.polyline({{0, 0}, {2000, 0}, {2000, 100}, {100, 100}, {100, 900}, {0, 900}}) +
               ")"),
      1000);
  const std::string wall = text.box({0, 0, 0}, {4000, 200, 3000});
  const std::string both = text.add("IFCBOOLEANRESULT(.DIFFERENCE.," + wall + "," + bent + ")");
  const auto step = StepFile::of(text.text(), "t.ifc");
  REQUIRE(step.ok());
  StepGraph graph(step.value());
  CHECK_FALSE(step_solid(graph, graph.node(id_of(both)), 1e-3));
}

TEST_CASE("an operand that occurs many times in a solid is computed once", "[ifc]") {
  StepText text;
  std::string item = text.box({0, 0, 0}, {4000, 200, 3000});
  for (int level = 0; level < limits::solid_depth; ++level)
    item = text.add("IFCBOOLEANRESULT(.INTERSECTION.," + item + "," + item + ")");
  CHECK(solid_m3(text, item) == Approx(2.4));
}

TEST_CASE("an item that is mapped many times is computed once", "[ifc]") {
  StepText text;
  std::string items = text.box({0, 0, 0}, {1000, 1000, 1000});
  const std::string origin = text.axes({0, 0, 0});
  const std::string target =
      text.add("IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$," + text.point({0, 0, 0}) + ",$,$)");
  constexpr int levels = 4, times = 1000;
  for (int level = 0; level < levels; ++level) {
    const std::string map = text.add("IFCREPRESENTATIONMAP(" + origin + "," +
                                     text.representation(text.body, "Body", items) + ")");
    const std::string mapped = text.add("IFCMAPPEDITEM(" + map + "," + target + ")");
    items = mapped;
    for (int i = 1; i < times; ++i) items += "," + mapped;
  }
  const std::string wall = text.wall(items);
  const Prepared p = prepared(text.text());
  CHECK(ifc_solid_volumes(p.file, p.model).known.at(id_of(wall)).m3 ==
        Approx(std::pow(times, levels)));
}

TEST_CASE("solids beyond the limit of work are left out and counted", "[ifc]") {
  StepText text;
  for (int i = 0; i < 10; ++i) text.wall(text.box({0, 0, 0}, {4000, 200, 3000}));
  const Prepared p = prepared(text.text());
  constexpr uint64_t triangles_of_a_box = 12;
  const IfcSolidVolumes some = ifc_solid_volumes(p.file, p.model, 4 * triangles_of_a_box);
  CHECK(some.known.size() == 4);
  CHECK(some.beyond_budget == 6);
  CHECK(ifc_solid_volumes(p.file, p.model).beyond_budget == 0);
}

TEST_CASE("a shape whose items are listed many times is searched for a point once", "[ifc]") {
  StepText text;
  std::string item = text.direction({0, 0, 1});
  for (int level = 0; level < 20; ++level) {
    std::string all = item;
    for (int i = 1; i < 20; ++i) all += "," + item;
    item = text.add("IFCGEOMETRICSET((" + all + "))");
  }
  text.wall(item);
  CHECK(prepared(text.text()).notes.empty());
}

TEST_CASE("only the body of a model view remains", "[ifc]") {
  StepText text;
  const std::string item = text.box({0, 0, 0}, {1000, 100, 2000});
  const std::string body = text.representation(text.body, "Body", item);
  std::string all = body;
  for (const char* other : {"Clearance", "Lighting", "Reference", "CoG", "Body-FallBack", "Box"})
    all += "," + text.representation(text.view(other, "MODEL_VIEW"), other, item);
  all += "," + text.representation(text.view("Body", "SKETCH_VIEW"), "Body", item);
  const std::string shape = text.shape(all);
  const std::string place = text.local(text.storey_place, {0, 0, 0});
  text.product("IFCFURNITURE", "table", place, shape);
  const std::string clear =
      text.representation(text.view("Clearance", "MODEL_VIEW"), "Clearance", item);
  text.product("IFCFURNITURE", "none", place, text.shape(clear));
  const std::string fallback =
      text.representation(text.view("Body-FallBack", "MODEL_VIEW"), "Body-FallBack", item);
  text.product("IFCFURNITURE", "coarse", place, text.shape(fallback));
  const Prepared p = prepared(text.text());
  StepGraph graph(p.file);
  CHECK(node_in(p.file, graph, shape).references(2) == std::vector<uint64_t>{id_of(body)});
  const auto named = [&](const std::string& name) {
    for (const IfcProduct& product : p.model.products)
      if (product.name == name) return product;
    return IfcProduct{};
  };
  CHECK(named("table").has_shape);
  CHECK(named("table").is_solid);
  CHECK_FALSE(named("none").has_shape);
  CHECK(named("none").other_shapes == "Clearance");
  CHECK(named("coarse").has_shape);
  CHECK(named("coarse").taken_as == "Body-FallBack");
}

TEST_CASE("a product representation of IFC2x3 is a shape", "[ifc]") {
  StepText text("IFC2X3");
  const std::string body =
      text.representation(text.body, "Body", text.box({0, 0, 0}, {4000, 200, 3000}));
  const std::string shape = text.add("IFCPRODUCTREPRESENTATION($,$,(" + body + "))");
  const std::string place = text.local(text.storey_place, {0, 0, 0});
  text.product("IFCWALL", "W", place, shape, "");
  const Prepared p = prepared(text.text());
  StepGraph graph(p.file);
  CHECK(node_in(p.file, graph, shape).is("IFCPRODUCTDEFINITIONSHAPE"));
  CHECK(p.model.products.back().has_shape);
}

TEST_CASE("indices of faces lead to points over PnIndex", "[ifc]") {
  StepText text;
  const std::string list = text.add(
      "IFCCARTESIANPOINTLIST3D(((9000.,9000.,9000.),(0.,0.,0.),(1000.,0.,0.),(0.,1000.,0.),"
      "(0.,0.,1000.)))");
  const std::string item = text.add("IFCTRIANGULATEDFACESET(" + list +
                                    ",$,.T.,((1,3,2),(1,2,4),(2,3,4),(3,1,4)),(2,3,4,5))");
  text.wall(item);
  const Prepared p = prepared(text.text());
  StepGraph graph(p.file);
  const auto mesh = step_solid(graph, node_in(p.file, graph, item), 1e-3);
  REQUIRE(mesh);
  CHECK(signed_volume_of(*mesh) == Approx(1e9 / 6));
  CHECK(node_in(p.file, graph, item).numbers(4).empty());
}

TEST_CASE("what the library does not read is written in another way", "[ifc]") {
  StepText text;
  const std::string at = text.axes({0, 0, 0});
  const auto type_of = [](const Prepared& p, const std::string& id) {
    return std::string(p.file.find(id_of(id))->type);
  };
  const std::string cylinder = text.add("IFCRIGHTCIRCULARCYLINDER(" + at + ",3000.,500.)");
  const std::string cone = text.add("IFCRIGHTCIRCULARCONE(" + at + ",3000.,500.)");
  const std::string flat = text.add("IFCAXIS2PLACEMENT2D(" + text.point(glm::dvec2(0, 0)) + ",$)");
  const std::string ellipse = text.add("IFCELLIPSEPROFILEDEF(.AREA.,$," + flat + ",1000.,500.)");
  const std::string line =
      text.add("IFCPOLYLINE((" + text.point({0, 0, 0}) + "," + text.point({1000, 0, 0}) + "))");
  const std::string disc = text.add("IFCSWEPTDISKSOLIDPOLYGONAL(" + line + ",50.,$,$,$,20.)");
  const std::string spine = text.add("IFCSECTIONEDSPINE($,(),())");
  text.wall(text.add("IFCCSGSOLID(" + cylinder + ")"));
  text.wall(spine);
  const Prepared p = prepared(text.text());
  CHECK(type_of(p, cylinder) == "IFCEXTRUDEDAREASOLID");
  CHECK(type_of(p, cone) == "IFCFACETEDBREP");
  CHECK(type_of(p, ellipse) == "IFCARBITRARYCLOSEDPROFILEDEF");
  CHECK(type_of(p, disc) == "IFCSWEPTDISKSOLID");
  StepGraph graph(p.file);
  const auto volume = [&](const std::string& id) {
    const auto mesh = step_solid(graph, graph.node(id_of(id)), 1e-3);
    REQUIRE(mesh);
    return signed_volume_of(*mesh) / 1e9;
  };
  CHECK(volume(cylinder) == Approx(3 * std::numbers::pi / 4).epsilon(0.002));
  CHECK(volume(cone) == Approx(std::numbers::pi / 4).epsilon(0.002));
  // What has no shape at all is told with its product.
  REQUIRE(p.notes.size() == 2);
  CHECK(p.notes[0].find("IFCSECTIONEDSPINE") != std::string::npos);
  CHECK(p.notes[0].find("\"W\"") != std::string::npos);
  CHECK(p.notes[1].find("rounded corners") != std::string::npos);
}

TEST_CASE("points far from their product are moved near it, and the product back", "[ifc]") {
  const glm::dvec3 far(500'000'000.25, 5'000'000'000.5, 100'000);
  StepText text;
  // In the profile, in the placement of the sweep, in points of faces, and in a target.
  const std::string profile = text.rectangle({far.x, far.y}, {4000, 200});
  const std::string in_profile = text.wall(text.extruded(profile, 3000, {0, 0, far.z}));
  const std::string in_sweep =
      text.wall(text.extruded(text.rectangle({0, 0}, {4000, 200}), 3000, far));
  const std::string rows = StepText::numbers(far) + "," +
                           StepText::numbers(far + glm::dvec3(1, 0, 0)) + "," +
                           StepText::numbers(far + glm::dvec3(0, 1, 0)) + "," +
                           StepText::numbers(far + glm::dvec3(0, 0, 1));
  const std::string list = text.add("IFCCARTESIANPOINTLIST3D((" + rows + "))");
  const std::string in_points = text.wall(
      text.add("IFCTRIANGULATEDFACESET(" + list + ",$,.T.,((1,3,2),(1,2,4),(2,3,4),(3,1,4)),$)"));
  const std::string near = text.wall(text.box({0, 0, 0}, {4000, 200, 3000}));
  const Prepared p = prepared(text.text());
  const auto moved = ifc_model_of(p.file, "t.ifc");
  REQUIRE(moved.ok());
  StepGraph graph(p.file);
  for (const std::string& id : {in_profile, in_sweep, in_points, near}) {
    INFO(id);
    const StepNode shape = graph.follow(node_in(p.file, graph, id), 6);
    const StepNode item = graph.node(graph.node(shape.references(2).at(0)).references(3).at(0));
    const auto mesh = step_solid(graph, item, 1e-3);
    REQUIRE(mesh);
    const Bounds bounds = bounds_of(*mesh);
    CHECK(glm::length(bounds.low) < 1e7);
    const bool is_near = id == near, is_faces = id == in_points;
    CHECK(signed_volume_of(*mesh) == Approx(is_faces ? 1 / 6.0 : 2.4e9));
    for (const IfcProduct& product : moved->products)
      if (product.id == id_of(id)) {
        const glm::dvec3 at = product.placement.offset * 1000.0 + bounds.low;
        CHECK(glm::length(at - (is_near ? glm::dvec3(0) : far)) < 1e-4);
      }
  }
}

TEST_CASE("swept surfaces are moved by their placement, not by their profile", "[ifc]") {
  const glm::dvec3 far(500'000'000, 5'000'000'000, 0);
  StepText text;
  const std::string line = text.add("IFCPOLYLINE((" + text.point(glm::dvec2(1000, 0)) + "," +
                                    text.point(glm::dvec2(1000, 500)) + "))");
  const std::string profile = text.add("IFCARBITRARYOPENPROFILEDEF(.CURVE.,$," + line + ")");
  const std::string place = text.axes(far), up = text.direction({0, 0, 1});
  const std::string axis = text.add("IFCAXIS1PLACEMENT(" + text.point({0, 0, 0}) + "," + up + ")");
  const std::vector<std::string> walls{
      text.wall(
          text.add("IFCSURFACEOFLINEAREXTRUSION(" + profile + "," + place + "," + up + ",3000.)")),
      text.wall(text.add("IFCSURFACEOFREVOLUTION(" + profile + "," + place + "," + axis + ")"))};
  const Prepared p = prepared(text.text());
  StepGraph graph(p.file);
  for (const std::string& wall : walls) {
    const StepNode shape = graph.follow(node_in(p.file, graph, wall), 6);
    const StepNode item = graph.node(graph.node(shape.references(2).at(0)).references(3).at(0));
    INFO(item.type());
    CHECK(item.reference(0) == id_of(profile));
    // The first point of the profile is the origin to which the shape is moved.
    CHECK(graph.follow(graph.follow(item, 1), 0).numbers(0) == std::vector<double>{-1000, 0, 0});
  }
}

TEST_CASE("mutated models give an input for shapes, or are rejected", "[ifc]") {
  const uint64_t seed = environment_number("LUXODUS_SEED", 1);
  const uint64_t tries = environment_number("LUXODUS_MUTATIONS", in_full() ? 100'000 : 2'000);
  INFO("seed " << seed);
  StepText text;
  const std::string roof =
      text.without(text.box({0, 0, 0}, {4000, 200, 3000}), text.above({0, 0, 3000}, {3, 0, 4}));
  text.wall(roof);
  text.wall(text.add("IFCBOOLEANRESULT(.INTERSECTION.," + roof + "," + roof + ")"));
  text.wall(text.extruded(text.rectangle({5e8, 5e9}, {4000, 200}), 3000));
  text.wall(text.add("IFCCSGSOLID(" +
                     text.add("IFCRIGHTCIRCULARCONE(" + text.axes({0, 0, 0}) + ",3000.,500.)") +
                     ")"));
  const std::string whole = text.text();
  Random random(seed, RandomStream::test);
  random.start(0);
  const size_t begin = whole.find("DATA;");
  constexpr std::string_view marks = "0123456789#().,$*'-EIFC";
  uint64_t read = 0, measured = 0, mended = 0;
  for (uint64_t i = 0; i < tries; ++i) {
    std::string harmed = whole;
    for (uint64_t k = 0; k < 1 + random.bits() % 3; ++k)
      harmed[begin + random.bits() % (harmed.size() - begin)] = marks[random.bits() % marks.size()];
    const auto step = StepFile::of(harmed, "harmed.ifc");
    if (!step) continue;
    const auto model = ifc_model_of(step.value(), "harmed.ifc");
    if (!model) continue;
    const auto input = ifc_shape_input(step.value(), model.value());
    if (!input) {
      REQUIRE_FALSE(input.problem().what.empty());
      continue;
    }
    ++read;
    for (const auto& [id, volume] : ifc_solid_volumes(input->file, model.value()).known) {
      REQUIRE(volume.m3 >= 0);
      ++measured;
    }
    std::set<uint64_t> all;
    for (const IfcProduct& product : model->products) all.insert(product.id);
    if (const auto again = ifc_mended_input(input->file, model.value(), all)) {
      ++mended;
      REQUIRE_FALSE(again->products.empty());
    }
  }
  CHECK(read > tries / 10);
  CHECK(measured > tries / 10);
  CHECK(mended > tries / 100);
}
