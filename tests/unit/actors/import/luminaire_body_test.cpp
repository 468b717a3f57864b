// Bodies of luminaires from their models, and their placement at the luminous opening.
#include "actors/import/luminaire_body.hpp"

#include <catch2/catch.hpp>

#include "runtime/core/reading_share.hpp"
#include "scenes/light/geometry/import.hpp"
#include "scenes/light/geometry/mesh_tools.hpp"
#include "tests/kit/small_l3d.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
using namespace luxodus::test;
using Catch::Contains;

namespace {

L3dModel l3d_model(const SmallL3d& small) {
  auto model = l3d_of(small.bytes(), "test.l3d", limits::l3d_all_bytes);
  if (!model) FAIL(model.problem().text());
  return std::move(model).value();
}

Mesh body_of(const L3dModel& model) {
  auto body = luminaire_body(model);
  if (!body) FAIL(body.problem().text());
  return std::move(body).value().mesh;
}

/// A model with a box that is half red and half white, and a box without any colour.
L3dModel partly_coloured() {
  SmallL3d small;
  small.joints = joint_with("");
  L3dModel model = l3d_model(small);
  model.shapes.push_back(model.shapes[0]);
  model.parts.at(1).shape = 1;
  model.shapes[0].obj = coloured_box_obj(l3d_library);
  model.shapes[0].colours = "newmtl red\nKd 1 0.1 0.05\nnewmtl white\nKd 0.8 0.8 0.8\n";
  return model;
}

}  // namespace

TEST_CASE("a body has the volume of its parts, in metres, and is read back from its file",
          "[import][l3d]") {
  SmallL3d small;
  small.joints = joint_with("");
  const auto body = luminaire_body(l3d_model(small));
  REQUIRE(body.ok());
  CHECK(body->mesh.triangles.size() == 24);
  CHECK(signed_volume_of(body->mesh) == Approx(2 * 0.2 * 0.1 * 0.04).epsilon(1e-6));
  CHECK_FALSE(body->is_coloured());
  const TemporaryFolder folder;
  REQUIRE(write_body(body.value(), folder / "body.obj").ok());
  const auto back = import_mesh((folder / "body.obj").string(), 1, UpAxis::z);
  REQUIRE(back.ok());
  REQUIRE(back->size() == 1);
  CHECK(folder.entries() == 1);
  CHECK(signed_volume_of(back->front().mesh) == Approx(2 * 0.2 * 0.1 * 0.04).epsilon(1e-5));
}

TEST_CASE("colours of a model are read back from the files of its body, none brighter than paint",
          "[import][l3d]") {
  const auto body = luminaire_body(partly_coloured());
  if (!body) FAIL(body.problem().text());
  CHECK(body->is_coloured());
  const TemporaryFolder folder;
  REQUIRE(write_body(body.value(), folder / "body.obj").ok());
  CHECK(folder.entries() == 2);
  const auto back = import_mesh((folder / "body.obj").string(), 1, UpAxis::z);
  if (!back) FAIL(back.problem().text());
  const auto triangles_of = [&](const glm::dvec3& colour) {
    size_t out = 0;
    for (const ImportedPart& part : back.value())
      if (part.base_colour && glm::length(*part.base_colour - colour) < 1e-6)
        out += part.mesh.triangles.size();
    return out;
  };
  CHECK(triangles_of({0.9, 0.1, 0.05}) == 6);
  CHECK(triangles_of(glm::dvec3(0.8)) == 6);
  CHECK(triangles_of(glm::dvec3(0.7)) == 12);
}

TEST_CASE("a body is a millimetre above its opening, centred on the opening", "[import][l3d]") {
  const L3dModel model = l3d_model({});
  const Mesh body = body_of(model);
  const BodyPlace place = body_place(model, body, "leo");
  CHECK(place.below_m == 0);
  CHECK(place.down == glm::dvec3(0, 0, -1));
  Bounds bounds = bounds_of(body);
  CHECK(bounds.low.z + place.offset_m.z == Approx(0.001));
  CHECK(bounds.low.x + place.offset_m.x == Approx(-0.1));
  CHECK(bounds.high.y + place.offset_m.y == Approx(0.05));
}

TEST_CASE("a body that extends far below its opening keeps the model's place, and that is reported",
          "[import][l3d]") {
  L3dModel model = l3d_model({});
  const Mesh body = body_of(model);
  model.openings[0].centre_m.z += 3;  // on a mast
  const BodyPlace place = body_place(model, body, "leo");
  CHECK(place.below_m == Approx(3));
  CHECK(bounds_of(body).low.z + place.offset_m.z == Approx(-3 + 0.001));
}

TEST_CASE("a body whose opening shines up stays behind it", "[import][l3d]") {
  L3dModel model = l3d_model({});
  const Mesh body = body_of(model);
  const double high = bounds_of(body).high.z;
  model.openings[0].down = {0, 0, 1};
  model.openings[0].centre_m.z = high;  // in the upper face
  const BodyPlace up = body_place(model, body, "leo");
  CHECK(high + up.offset_m.z == Approx(-0.001));
  CHECK(up.below_m == Approx(0.04));
  model.openings[0].down = {1, 0, 0};
  model.openings[0].centre_m = {bounds_of(body).high.x, 0, bounds_of(body).low.z};
  const BodyPlace aside = body_place(model, body, "leo");
  CHECK(bounds_of(body).high.x + aside.offset_m.x == Approx(-0.001));
  CHECK(aside.below_m == Approx(0).margin(1e-12));
}

TEST_CASE("a body above its opening is not lowered to it", "[import][l3d]") {
  L3dModel model = l3d_model({});
  const Mesh body = body_of(model);
  model.openings[0].centre_m.z = bounds_of(body).low.z - 0.05;
  const BodyPlace place = body_place(model, body, "leo");
  CHECK(bounds_of(body).low.z + place.offset_m.z == Approx(0.05));
  CHECK(place.below_m == 0);
}

TEST_CASE("a model without openings is placed by its own origin", "[import][l3d]") {
  L3dModel model = l3d_model({});
  model.openings.clear();
  const Mesh body = body_of(model);
  const BodyPlace place = body_place(model, body, "leo");
  CHECK((place.offset_m.x == 0 && place.offset_m.y == 0));
  CHECK(bounds_of(body).low.z + place.offset_m.z == Approx(0.001));
}

TEST_CASE("shapes of bodies are read as announced, also after one that is not a mesh",
          "[import][l3d]") {
  L3dModel model = l3d_model({});
  model.shapes.push_back(model.shapes.front());
  model.shapes[0].obj = "hello\n";
  const L3dModel sound = l3d_model({});
  ReadingShare share;
  foresee_body(model, share);
  foresee_body(sound, share);
  CHECK(share.share() == std::optional(0.0));
  CHECK_FALSE(luminaire_body(model, &share).ok());
  const auto first = static_cast<double>(model.shapes[0].obj.size() + model.shapes[1].obj.size());
  const auto second = static_cast<double>(sound.shapes[0].obj.size());
  CHECK(share.share() == std::optional(first / (first + second)));
  CHECK(luminaire_body(sound, &share).ok());
  CHECK(share.share() == std::optional(1.0));
}

TEST_CASE("a shape that is not a mesh is reported by name, and too many triangles are rejected",
          "[import][l3d]") {
  L3dModel model = l3d_model({});
  model.parts.resize(20'000, model.parts.front());
  const auto many = luminaire_body(model);
  REQUIRE_FALSE(many.ok());
  CHECK_THAT(many.problem().what, Contains("more than 200000 triangles"));
  model.parts.resize(1);
  model.shapes[0].obj = "hello\n";
  const auto wrong = luminaire_body(model);
  REQUIRE_FALSE(wrong.ok());
  CHECK_THAT(wrong.problem().what, Contains("the shape \"box/box.obj\" of its model"));
}
