// Reads the bodies and data sets of media.
#include "scenes/formats/fields/data_set.hpp"
#include "scenes/formats/scene_file/read_files.hpp"
#include "scenes/formats/scene_file/read_media.hpp"
#include "scenes/formats/scene_file/read_spectrum.hpp"
#include "scenes/light/optics/quadric_body.hpp"
#include "scenes/light/optics/quadric_shapes.hpp"

namespace luxodus {

namespace {

void read_quadric(KeyReader& keys, Medium& m) {
  const auto a = keys.numbers("a");
  if (keys.clean() && a.size() != 6) {
    keys.problem("a", "'a' must be the six numbers [xx, yy, zz, xy, xz, yz]");
  }
  m.quadric.b = keys.point("b");
  m.quadric.c = keys.number("c");
  m.local_bounds.low = keys.point("low");
  m.local_bounds.high = keys.point("high");
  for (const toml::Table* t : keys.tables("clip")) {
    KeyReader clip(*t, {"medium.clip"}, keys.reading());
    m.quadric.clips.push_back({clip.direction("normal"), clip.number("offset")});
  }
  if (!keys.clean()) return;
  if (!glm::all(glm::lessThan(m.local_bounds.low, m.local_bounds.high))) {
    keys.problem("high", "'high' must lie above 'low' in x, y and z");
    return;
  }
  glm::dmat3& q = m.quadric.a;
  for (int i = 0; i < 3; ++i) q[i][i] = a[static_cast<size_t>(i)];
  q[0][1] = q[1][0] = a[3];
  q[0][2] = q[2][0] = a[4];
  q[1][2] = q[2][1] = a[5];
}

}  // namespace

void read_body(KeyReader& keys, const std::string& body, Medium& m) {
  if (body == "quadric") {
    const size_t before = keys.reading().findings.problem_count();
    read_quadric(keys, m);
    if (keys.reading().findings.problem_count() > before || !keys.clean()) return;
    // Only an explicit quadric can turn out to be empty.
    const auto made = QuadricBody::make(m, m.frame.origin);
    if (!made) keys.problem(made.problem().what);
    return;
  }
  QuadricShape shape;
  if (body == "ellipsoid") {
    shape = ellipsoid(keys.point("radii"));
  } else {
    const double radius = keys.number("radius"), height = keys.number("height");
    shape = body == "cylinder" ? cylinder(radius, height)
            : body == "cone"   ? cone(radius, height)
                               : paraboloid(radius, height);
  }
  m.quadric = std::move(shape.quadric);
  m.local_bounds = shape.bounds;
}

void read_data_set(KeyReader& keys, Medium& m) {
  const std::string quantity = keys.choice("quantity");
  const std::string smoke = keys.maybe_choice("smoke").value_or("");
  auto mass = keys.maybe_number("mass_extinction");
  if (!mass && smoke == "flaming") mass = 8700;  // m2/kg at 633 nm, mean of 29 fuels
  m.optics.extinction.wavelength_nm = keys.number("wavelength_nm");
  m.optics.extinction.angstrom = keys.maybe_number("angstrom").value_or(smoke == "flaming" ? 1 : 0);
  const auto albedo = maybe_property(keys, "albedo");
  m.optics.albedo = albedo.value_or(Spectrum::constant(0));
  if (quantity == "soot_density" && !mass && !keys.has("mass_extinction")) {
    keys.problem(
        "'mass_extinction' [m2/kg] is needed with soot; only smoke = \"flaming\" has a default "
        "(8700)");
  }
  if (keys.clean()) warn_of_mass_extinction(keys);
  const bool interpolate = keys.flag("interpolate_emission");
  const auto path = keys.file("file");
  if (!path || !keys.clean() || !take_hash(*path, keys.place("file"), keys.reading())) return;
  DataSetOptions options;
  options.mass_extinction_m2_per_kg = mass;
  options.field = quantity;
  auto loaded = read_data_set(path->string(), options);
  if (!loaded) return take_problem(loaded.problem(), keys.place("file"), keys.reading());
  for (const auto& file : loaded->files_read) take_hash(file, keys.place("file"), keys.reading());
  m.data = std::move(loaded->data);
  m.data.interpolate_emission = interpolate;
  m.frame.origin += m.frame.axes * loaded->origin;
  if (loaded->lacks_mass_extinction)
    keys.problem("quantity",
                 "this file holds soot density; say quantity = \"soot_density\" and its "
                 "'mass_extinction'");
  if (!albedo && m.data.albedo.empty()) {
    keys.problem("the key 'albedo' is missing: the file has no array of that name");
  }
  if (!m.emission && !m.data.emission.empty()) {
    keys.reading().warning(keys.place("file"),
                           "the file has an array of emission, but the medium no "
                           "[medium.emission] that says its power");
  }
}

}  // namespace luxodus
