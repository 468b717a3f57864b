// Materials, an optional room, and objects.
#include <algorithm>
#include <memory>

#include "scenes/light/geometry/building_parts.hpp"
#include "scenes/light/geometry/polygon.hpp"
#include "scenes/light/geometry/transform.hpp"
#include "tests/random/draw.hpp"

namespace luxodus::test {

Spectrum draw_property(Draw& draw, double most) {
  Dice& dice = draw.dice;
  const double share = most * draw_share(draw);
  const int kind = dice.below(8);
  if (kind < 5) return Spectrum::constant(share);
  Spectrum s;
  if (kind == 5) {
    const double r = dice.between(0, 1);
    const double g = dice.between(0, 1);
    const double b = dice.chance(0.3) ? 0 : dice.between(0, 1);
    s = reflectance_from_linear_srgb(r, g, b) * most;
  } else if (kind == 6) {  // a step, from 0 to a positive value
    const int step = dice.below(spectrum_samples);
    for (int i = step; i < spectrum_samples; ++i) s.value[static_cast<size_t>(i)] = share;
  } else {
    for (double& v : s.value) v = share * dice.between(0, 1);
  }
  return s;
}

namespace {

std::shared_ptr<const Image> draw_image(Draw& draw) {
  auto image = std::make_shared<Image>();
  image->width = draw.dice.chance(0.1) ? 70 : draw.dice.whole(1, 9);  // 70: two tiles
  image->height = draw.dice.whole(1, 9);
  image->channels = draw.dice.one_of({1, 3, 4});
  for (int i = 0; i < image->width * image->height * image->channels; ++i)
    image->texels.push_back(static_cast<float>(draw.dice.between(0, 1)));
  return image;
}

Material draw_material(Draw& draw, MaterialKind kind) {
  Dice& dice = draw.dice;
  Material m;
  m.name = "material " + std::to_string(draw.scene.materials.size());
  m.kind = kind;
  m.reflectance = m.specular = Spectrum::constant(0);
  const bool diffuse = kind == MaterialKind::lambertian || kind == MaterialKind::glossy;
  const double part = kind == MaterialKind::glossy ? dice.between(0, 1) : 1;
  if (diffuse) m.reflectance = draw_property(draw, part);
  if (kind == MaterialKind::glossy) m.specular = draw_property(draw, 1 - part);
  if (kind == MaterialKind::mirror) m.specular = draw_property(draw);
  if (draw.extreme)
    m.roughness = dice.one_of({1e-9, 1e-4, 1e-3, 0.9, 1.0});
  else
    m.roughness = dice.between(0.01, 1);
  m.ior = draw.extreme ? dice.one_of({1.0, 1 + 1e-9, 1.0001, 3.9, 4.0}) : dice.between(1, 2.5);
  if (kind == MaterialKind::glass_pane && dice.chance(0.7))
    m.internal_transmittance = draw_property(draw);
  if (diffuse && dice.chance(0.25)) m.reflectance_image = draw_image(draw);
  return m;
}

bool is_opaque(const Material& m) {
  return m.kind == MaterialKind::lambertian || m.kind == MaterialKind::glossy ||
         m.kind == MaterialKind::mirror;
}

/// A material that light cannot pass; the first one always is.
int draw_opaque(Draw& draw) {
  const int i = draw.dice.below(static_cast<int>(draw.scene.materials.size()));
  return is_opaque(draw.scene.materials[static_cast<size_t>(i)]) ? i : 0;
}

Object& add_object(Draw& draw, Mesh mesh, const std::string& name, int material) {
  Dice& dice = draw.dice;
  Object o;
  o.name = name;
  o.mesh = std::move(mesh);
  o.material = o.back_material = material;
  if (dice.chance(0.2)) o.back_material = draw_opaque(draw);
  const int patches = dice.below(4);
  if (patches == 0) o.one_patch = true;
  const Bounds bounds = bounds_of(o.mesh);
  if (patches == 1 && !bounds.empty())
    o.patch_edge_m = glm::length(bounds.high - bounds.low) * dice.between(0.1, 1.2);
  if (dice.chance(0.3)) o.tags.emplace_back("tagged");
  if (dice.chance(0.2)) o.group = "group of surfaces";
  draw.scene.objects.push_back(std::move(o));
  return draw.scene.objects.back();
}

using Outline = std::vector<glm::dvec2>;

Outline draw_outline(Draw& draw, double size) {
  if (draw.dice.chance(0.5)) {  // an L
    const double notch = draw.dice.between(0.1, 0.9) * size;
    return {{0, 0}, {size, 0}, {size, notch}, {notch, notch}, {notch, size}, {0, size}};
  }
  const double tip = draw.dice.between(-0.5, 1.5) * size;
  return {{0, 0}, {size, 0}, {tip, size}};
}

/// Triangles at random places, including slivers and degenerate ones.
Mesh draw_soup(Draw& draw, double size) {
  Mesh mesh;
  const int count = draw.dice.whole(1, 12);
  for (int i = 0; i < count; ++i) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (int k = 0; k < 3; ++k)
      mesh.positions.push_back(draw.dice.point(glm::dvec3(0), glm::dvec3(size)));
    glm::dvec3* corner = &mesh.positions[first];
    if (draw.dice.chance(0.2)) corner[2] = corner[1] + 1e-6 * (corner[2] - corner[1]);
    if (draw.dice.chance(0.05)) corner[2] = 0.5 * (corner[0] + corner[1]);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

Result<Shape> draw_wall(Draw& draw, double size) {
  std::vector<shapes::WallOpening> openings;
  const int count = draw.dice.below(4);
  for (int i = 0; i < count; ++i) {
    shapes::WallOpening hole;
    hole.x = draw.dice.between(0, 0.6) * size;
    hole.z = draw.dice.chance(0.5) ? 0 : draw.dice.between(0, 0.4) * size;
    hole.width = draw.dice.between(0.05, 0.4) * size;
    hole.height = draw.dice.between(0.05, 0.5) * size;
    openings.push_back(hole);
  }
  const double thickness = draw.dice.magnitude(1e-3, 0.3) * size;
  return shapes::wall(size, 0.9 * size, thickness, openings);
}

Result<Shape> draw_round(Draw& draw, int kind, double size) {
  const int segments = draw.dice.whole(3, 12);
  const double slim = draw.dice.magnitude(1e-3, 1) * size;
  const bool caps = draw.dice.chance(0.5);
  const double share = draw.dice.between(0.1, 0.99);
  if (kind == 0)
    return shapes::cylinder(slim / 2, size, segments,
                            caps ? shapes::Caps::both : shapes::Caps::none);
  if (kind == 1) return shapes::disc(size / 2, segments);
  if (kind == 2) return shapes::tube(slim / 2, share * slim / 2, size, segments);
  return shapes::sphere(size / 2, share * size / 4);
}

/// A shape about the origin, no larger than a few times `size`.
Result<Shape> draw_shape(Draw& draw, double size) {
  Dice& dice = draw.dice;
  const int kind = dice.below(13);
  const int parts = dice.whole(1, 3);
  const double slim = dice.magnitude(1e-4, 1) * size;
  switch (kind) {
    case 0: {
      const glm::dvec3 u = size * dice.direction();
      const glm::dvec3 v = slim * dice.direction();
      return shapes::quad({0, 0, 0}, u, v, parts, parts);
    }
    case 1:
      return shapes::box({size, slim, size});
    case 2:
      return shapes::polygon(draw_outline(draw, size));
    case 3:
      return shapes::extrude(draw_outline(draw, size), slim);
    case 4:
      return draw_wall(draw, size);
    case 5:
      return shapes::stairs(
          parts, size / 4, size / 4, slim,
          dice.one_of({shapes::StairUnderside::none, shapes::StairUnderside::solid,
                       shapes::StairUnderside::soffit}));
    case 6:
      return shapes::ramp(size, slim, size / 3,
                          dice.one_of({shapes::RampUnderside::none, shapes::RampUnderside::solid}));
    case 7:
      return Shape{draw_soup(draw, size), 0};
    case 8: {
      auto room = shapes::room({size, slim, size});
      if (!room.ok()) return room.problem();
      return Shape{room->all(), 0};
    }
    default:
      return draw_round(draw, kind - 9, size);
  }
}

void place(Draw& draw, Mesh& mesh) {
  Dice& dice = draw.dice;
  if (dice.chance(0.4)) {
    const glm::dvec3 axis = dice.direction();
    const double angle = dice.chance(0.3) ? 90 : dice.between(-360, 360);
    apply(rotation(axis, angle).value(), mesh);
  }
  if (dice.chance(0.15)) {
    glm::dvec3 factors = dice.point(glm::dvec3(0.2), glm::dvec3(1));
    if (dice.chance(0.5)) factors.x = -factors.x;
    if (draw.extreme) factors.y *= 1e-4;
    apply(scaling(factors), mesh);
  }
  apply(translation(draw.place()), mesh);
}

/// In an enclosed scene nothing may touch the walls.
void keep_inside(Draw& draw, Mesh& mesh) {
  if (!draw.enclosed) return;
  const Bounds bounds = bounds_of(mesh);
  const glm::dvec3 margin = 0.02 * draw.size();
  if (glm::all(glm::greaterThan(bounds.low, draw.low + margin)) &&
      glm::all(glm::lessThan(bounds.high, draw.high - margin)))
    return;
  const glm::dvec3 extent = glm::max(bounds.high - bounds.low, glm::dvec3(1e-300));
  const glm::dvec3 room = 0.9 * draw.size() / extent;
  const double shrink = std::min({room.x, room.y, room.z, 1.0});
  const glm::dvec3 from = 0.5 * (bounds.low + bounds.high), to = 0.5 * (draw.low + draw.high);
  for (glm::dvec3& p : mesh.positions) p = to + shrink * (p - from);
}

}  // namespace

void draw_materials(Draw& draw) {
  using enum MaterialKind;
  const int count = draw.dice.whole(1, 4);
  for (int i = 0; i < count; ++i) {
    const bool plain = i == 0 || draw.dice.chance(0.4);
    MaterialKind kind =
        plain ? lambertian : draw.dice.one_of({glossy, mirror, glass_pane, dielectric, open});
    if (i == 0 && draw.dice.chance(0.2)) kind = draw.dice.one_of({glossy, mirror});
    draw.scene.materials.push_back(draw_material(draw, kind));
  }
}

/// The walls, floor and ceiling of a room over an outline, seen from inside; none if the outline is
/// not a polygon.
std::vector<Mesh> room_over(std::span<const glm::dvec2> outline, double height) {
  const auto flat = shapes::polygon(outline);
  if (!flat.ok()) return {};
  std::vector<Mesh> parts;
  const bool counter_clockwise = signed_area(outline) > 0;
  for (size_t i = 0; i < outline.size(); ++i) {
    glm::dvec2 from = outline[i], to = outline[(i + 1) % outline.size()];
    // From inside a counter-clockwise outline, edges run to the left: u starts at their end.
    if (counter_clockwise) std::swap(from, to);
    Mesh wall;
    wall.positions = {{from, 0}, {to, 0}, {to, height}, {from, height}};
    wall.texture_uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    wall.triangles = {{0, 1, 2}, {0, 2, 3}};
    parts.push_back(std::move(wall));
  }
  parts.push_back(flat->mesh);
  Mesh ceiling = flat->mesh;
  apply(translation({0, 0, height}), ceiling);
  flip(ceiling);
  parts.push_back(std::move(ceiling));
  return parts;
}

void draw_room(Draw& draw) {
  Dice& dice = draw.dice;
  const int kind = dice.below(8);
  if (kind < 2 || draw.bare) return;  // in the open
  if (kind == 2) {
    std::vector<Mesh> parts = room_over(draw_outline(draw, draw.size_m), draw.size().z);
    for (size_t i = 0; i < parts.size(); ++i) {
      apply(translation(draw.low), parts[i]);
      add_object(draw, parts[i], "part " + std::to_string(i), draw_opaque(draw));
    }
    return;
  }
  auto room = shapes::room(draw.size());
  if (!room.ok()) return;
  const int left_out = kind == 3 ? dice.below(6) : -1;
  const int wall = draw_opaque(draw);
  int i = 0;
  for (Mesh* face : {&room->floor, &room->ceiling, &room->x0, &room->x1, &room->y0, &room->y1}) {
    if (i++ == left_out) continue;
    apply(translation(draw.low), *face);
    const int material = dice.chance(0.6) ? wall : draw_opaque(draw);
    add_object(draw, std::move(*face), "face " + std::to_string(i), material);
  }
  draw.enclosed = left_out < 0;
}

void draw_objects(Draw& draw) {
  Dice& dice = draw.dice;
  if (draw.bare) return;
  const int least = draw.scene.objects.empty() && dice.chance(0.95) ? 1 : 0;
  const int count = least + dice.below(4);
  for (int i = 0; i < count; ++i) {
    auto shape = draw_shape(draw, draw.size_m * dice.magnitude(0.05, 0.8));
    if (!shape.ok()) continue;
    Mesh mesh = std::move(shape.value().mesh);
    place(draw, mesh);
    keep_inside(draw, mesh);
    const glm::dvec3 hinge = mesh.positions.empty() ? draw.low : mesh.positions.front();
    const int material = dice.below(static_cast<int>(draw.scene.materials.size()));
    Object& o = add_object(draw, std::move(mesh), "object " + std::to_string(i), material);
    if (!draw.enclosed && dice.chance(0.15)) {
      o.door = Door{dice.chance(0.5), hinge, dice.direction(), dice.between(-360, 360)};
    }
    if (dice.chance(0.1)) {  // a duplicate at the same place
      Mesh same = o.mesh;
      add_object(draw, std::move(same), "copy " + std::to_string(i), draw_opaque(draw));
    }
  }
}

}  // namespace luxodus::test
