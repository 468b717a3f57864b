// Checks in the order of the description. Decoding has checked that numbers are finite.
#include "scenes/formats/pack/check_skeleton.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/formats/pack/archive.hpp"
#include "scenes/light/transport/flame_points.hpp"

namespace luxodus {

namespace {

/// Coordinates at which float squares of differences are still finite.
constexpr double farthest_m = 1e9;
/// Lumens, watts or candelas per square metre: the sun has 4e26 W, a building less.
constexpr double brightest = 1e15;
constexpr double max_extinction_per_m = 1e9;
/// The largest factor that the schema of scene files allows.
constexpr double any_factor = 1e6;
constexpr int64_t max_cells = 1 << 28;  // of all planes
constexpr int64_t max_pixels = int64_t{1} << 28;
constexpr uint32_t max_patches = 200'000'000;  // the limit of compiling

void need(bool sound, const char* what) {
  if (!sound) throw DamagedArchive(what);
}

bool within(double v, double low, double high) {
  return v >= low && v <= high;  // NaN fails
}

template <class Vector>
bool near(const Vector& p) {
  for (glm::length_t i = 0; i < p.length(); ++i)
    if (!within(static_cast<double>(p[i]), -farthest_m, farthest_m)) return false;
  return true;
}

bool is_direction(const glm::dvec3& v) {
  return std::abs(glm::length(v) - 1) < 1e-6;
}

bool ordered(const glm::dvec3& low, const glm::dvec3& high) {
  return near(low) && near(high) && glm::all(glm::lessThanEqual(low, high));
}

void need_spectrum(const Spectrum& s, double most, const char* what) {
  need(std::all_of(s.value.begin(), s.value.end(), [&](double v) { return within(v, 0, most); }),
       what);
}

/// Checks a spectrum's integral, by which light is divided, where there is any.
void need_shape(const Spectrum& s, bool shines) {
  need_spectrum(s, 1e6, "a spectrum has values that cannot be");
  const double efficacy = shines ? efficacy_lm_per_w(s) : 1;
  need(std::isfinite(efficacy) && efficacy > 1e-9, "a lamp's spectrum gives no light");
}

void need_frame(const Frame& f) {
  const glm::dmat3 square = glm::transpose(f.axes) * f.axes;
  for (glm::length_t i = 0; i < 3; ++i)
    for (glm::length_t j = 0; j < 3; ++j)
      need(std::abs(square[i][j] - (i == j ? 1 : 0)) < 1e-6, "a frame is not at right angles");
  need(near(f.origin), "something lies too far away");
}

template <class Points>
void need_near(const Points& points) {
  for (const auto& p : points) need(near(p), "something lies too far away");
}

void check(const Material& m) {
  need_spectrum(m.reflectance, 1, "a material reflects more than 1");
  need_spectrum(m.specular, 1, "a material reflects more than 1");
  for (size_t i = 0; i < m.reflectance.value.size(); ++i)
    need(m.reflectance.value[i] + m.specular.value[i] <= 1 + 1e-6,
         "a material reflects more than 1");
  need_spectrum(m.internal_transmittance, 1, "a material transmits more than 1");
  need(m.roughness > 0 && m.roughness <= 1, "a material's roughness is not in (0, 1]");
  need(within(m.ior, 1, 4), "a material's refractive index is not in [1, 4]");
}

void check(const Object& o, size_t materials) {
  const auto known = [&](int m) { return m >= 0 && static_cast<size_t>(m) < materials; };
  need(known(o.material) && known(o.back_material), "an object has no material");
  need(within(o.patch_edge_m, 0, farthest_m), "an object's patches have no size");
  if (o.door)
    need(near(o.door->hinge) && near(o.door->axis) && glm::length(o.door->axis) > 0,
         "a door has no hinge");
}

void check_size(const Emitter& e) {
  const auto length = [](double v) { return v > 0 && v <= farthest_m; };
  switch (e.shape) {
    case EmitterShape::point:
      break;
    case EmitterShape::disc:
    case EmitterShape::sphere:
      need(length(e.size.x), "an emitter has no size");
      break;
    case EmitterShape::rectangle:
    case EmitterShape::tube:
      need(length(e.size.x) && length(e.size.y), "an emitter has no size");
      break;
    case EmitterShape::mesh:
      need(!e.mesh.triangles.empty(), "an emitter has no triangles");
      break;
  }
  need(near(e.size) && glm::all(glm::greaterThanEqual(e.size, glm::dvec3(0))),
       "an emitter has no size");
}

void check(const Emitter& e) {
  need_frame(e.frame);
  check_size(e);
  need_near(e.mesh.positions);
  for (const glm::uvec3& t : e.mesh.triangles)
    need(std::max({t.x, t.y, t.z}) < e.mesh.positions.size(),
         "an emitter's triangle has no corner");
  need((e.distribution == Distribution::web) == (e.web != nullptr),
       "a luminaire has no photometric web");
  const bool flat = e.shape == EmitterShape::point || e.shape == EmitterShape::rectangle ||
                    e.shape == EmitterShape::disc;
  need(flat || (e.distribution != Distribution::spot && e.distribution != Distribution::collimated),
       "a body shines as a beam");
  need(within(e.cosine_power, 0, 1e6), "an emitter's power of the cosine cannot be");
  need(within(e.spot_inner_deg, 0, e.spot_outer_deg) && e.spot_outer_deg <= 90 &&
           (e.distribution != Distribution::spot || e.spot_outer_deg > 0),
       "a spot has no cone");
  need(within(e.mains_flux, 0, brightest) && within(e.emergency_flux, 0, brightest),
       "an emitter's flux cannot be");
  need_shape(e.spectrum, e.mains_flux > 0 || e.emergency_flux > 0);
  need(within(e.duration_s.value_or(1), 0, 1e12), "an emitter's duration cannot be");
  glm::dvec2 last(0, 0);
  for (const glm::dvec2& at : e.onset) {
    need(at.x >= last.x && at.y >= last.y && at.y <= any_factor, "an onset does not ascend");
    last = at;
  }
}

void check_face(const Sign& s) {
  const SignFace& face = s.face;
  need(face.width > 0 && face.height > 0 && face.width <= (1 << 16) && face.height <= (1 << 16),
       "a sign's face has not the size that it says");
  const auto texels = static_cast<size_t>(face.width) * static_cast<size_t>(face.height);
  need(face.colour.size() == texels &&
           (face.relative_luminance.empty() || face.relative_luminance.size() == texels),
       "a sign's face has not the size that it says");
  const auto known = [&](ColourIndex c) { return c == other_colour || c < s.colours.size(); };
  need(std::all_of(face.colour.begin(), face.colour.end(), known) && known(face.legend) &&
           known(face.ground) && face.legend != face.ground && face.legend != other_colour,
       "a sign's face has a colour that its sign has not");
  // The sums by which texels of a colour are chosen.
  std::array<double, limits::max_face_colours> sum{};
  std::array<bool, limits::max_face_colours> there{};
  for (size_t i = 0; i < texels; ++i) {
    const double v = face.relative_luminance.empty() ? 1 : double{face.relative_luminance[i]};
    need(within(v, 0, 1e6), "a sign's texel has a luminance that cannot be");
    if (face.colour[i] == other_colour) continue;
    sum[face.colour[i]] += v;
    there[face.colour[i]] = true;
  }
  for (size_t i = 0; i < sum.size(); ++i)
    need(!there[i] || sum[i] > 0, "a colour of a sign is wholly dark");
}

void check(const Sign& s) {
  need_frame(s.frame);
  need(!s.colours.empty() && s.colours.size() <= limits::max_face_colours,
       "a sign has no colours or too many");
  check_face(s);
  need(within(s.width_m, 1e-4, 1e4) && within(s.height_m, 1e-4, 1e4) &&
           within(s.thickness_m, 0, 1e4) && within(s.smallest_detail_m, 0, 1e4),
       "a sign has no size");
  for (const FaceColour& colour : s.colours) {
    need(within(colour.mains_cd_m2, 0, brightest) && within(colour.emergency_cd_m2, 0, brightest),
         "a sign's luminance cannot be");
    need_shape(colour.shape, true);
    need_spectrum(colour.reflectance, 1, "a sign reflects more than 1");
  }
  need(within(s.duration_s.value_or(1), 0, 1e12), "a sign's duration cannot be");
  need(within(s.angular_exponent, 0, 1e3), "a sign's luminance falls off in no way that can be");
  for (size_t i = 0; i < s.decay.size(); ++i)
    need(within(s.decay[i].y, 0, any_factor) && (i == 0 || s.decay[i].x > s.decay[i - 1].x),
         "a sign's decay does not go on in time");
}

void check(const SmokeOptics& o) {
  need(within(o.extinction.sigma_t, 0, max_extinction_per_m) &&
           within(o.extinction.wavelength_nm, 100, 1e5) && within(o.extinction.angstrom, -10, 10),
       "a medium's extinction cannot be");
  if (o.extinction.table)
    need_spectrum(*o.extinction.table, max_extinction_per_m, "a medium's extinction cannot be");
  need_spectrum(o.albedo, 1, "a medium scatters more than it takes");
}

void check(const Medium& m) {
  check(m.optics);
  need(m.kind != MediumKind::layered || !m.layers.empty(), "a medium has no layers");
  for (size_t i = 0; i < m.layers.size(); ++i) {
    const Layer& l = m.layers[i];
    check(l.optics);
    need(l.z_low < l.z_high && (i == 0 || l.z_low >= m.layers[i - 1].z_high),
         "the layers of a medium do not ascend");
  }
  need(m.footprint.polygon.empty() || m.footprint.polygon.size() >= 3, "a footprint has no area");
  need_near(m.footprint.polygon);
  need(m.footprint.z_low < m.footprint.z_high, "a medium has no height");
  need_frame(m.frame);
  if (m.kind == MediumKind::bounded)
    need(ordered(m.local_bounds.low, m.local_bounds.high), "a body of smoke has no size");
  if (m.kind == MediumKind::data_set)
    need(near(m.data.extent) && glm::all(glm::greaterThan(m.data.extent, glm::dvec3(0))),
         "a data set has no size");
  if (m.simulation) {
    need(m.kind == MediumKind::data_set && std::isfinite(m.simulation->time_s),
         "a simulated fire has no cells or no time");
    need_frame(m.simulation->frame);
    for (const Bounds& mesh : m.simulation->meshes)
      need(near(mesh.low) && near(mesh.high) && ordered(mesh.low, mesh.high),
           "a mesh of a simulated fire has no size");
  }
  if (!m.emission) return;
  need(m.kind == MediumKind::bounded || m.kind == MediumKind::data_set, "a flame has no place");
  need(within(m.emission->power_w, 0, brightest) && within(m.emission->visible_fraction, 0, 1),
       "a flame's power cannot be");
  need_shape(m.emission->spectrum, true);
}

void need_span(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
  need(near(corner) && near(u) && near(v), "something lies too far away");
  const double area = glm::length(glm::cross(u, v));
  need(area >= 1e-12 && area > 1e-10 * glm::length(u) * glm::length(v), "a plane has no area");
}

void check_planes(const SceneDescription& d) {
  int64_t cells = 0;
  for (const PlaneMeasure& p : d.planes) {
    need_span(p.corner, p.edge_u, p.edge_v);
    need(p.cells_u >= 1 && p.cells_v >= 1 && p.cells_u <= max_cells && p.cells_v <= max_cells,
         "a plane has no cells");
    need(int64_t{p.cells_u} * p.cells_v <= max_cells - cells, "planes have too many cells");
    cells += int64_t{p.cells_u} * p.cells_v;
  }
  for (const CountingPlaneMeasure& p : d.counting_planes) need_span(p.corner, p.edge_u, p.edge_v);
}

void check(const VolumeGroupMeasure& g) {
  using Shape = VolumeGroupMeasure::Shape;
  need(near(g.low) && near(g.high) && near(g.centre), "something lies too far away");
  if (g.shape == Shape::box) need(ordered(g.low, g.high), "a volume has no size");
  if (g.shape == Shape::layer) need(g.low.z < g.high.z, "a volume has no size");
  need(within(g.radius, 0, farthest_m) && within(g.inner_radius, 0, std::max(g.radius, 0.0)),
       "a volume has no size");
  if (g.shape == Shape::sphere || g.shape == Shape::shell)
    need(g.radius > 0, "a volume has no size");
}

void check_eyes(const SceneDescription& d) {
  for (const ProbeMeasure& p : d.probes)
    need(near(p.position) && is_direction(p.normal), "a probe looks nowhere");
  for (const Observer& o : d.observers) {
    need(near(o.eye) && is_direction(o.gaze), "an observer looks nowhere");
    for (const uint32_t sign : o.signs.value_or(std::vector<uint32_t>{}))
      need(sign < d.signs.size(), "an observer looks at a sign that there is not");
  }
  for (const Camera& c : d.cameras) {
    need(near(c.eye) && near(c.target) && is_direction(c.up), "a camera looks nowhere");
    const glm::dvec3 way = c.target - c.eye;
    need(glm::length(way) >= 1e-6 && glm::length(glm::cross(glm::normalize(way), c.up)) >= 1e-6,
         "a camera looks nowhere");
    need(!c.cut_m || (std::isfinite(*c.cut_m) && *c.cut_m < c.eye.z),
         "a camera is cut above its eye");
    need(c.vertical_fov_deg > 0 && c.vertical_fov_deg < 180, "a camera sees no angle");
    need(c.width >= 1 && c.height >= 1 && int64_t{c.width} * c.height <= max_pixels,
         "a camera has no pixels");
  }
}

void check_assessment(const SceneDescription& d) {
  for (const EscapeRoute& r : d.routes) {
    need_near(r.path);
    need(r.path.size() >= 2 && r.width_m > 0 && r.width_m <= farthest_m, "a route has no way");
  }
  for (const auto* areas : {&d.open_areas, &d.task_areas}) {
    for (const AssessedArea& a : *areas) {
      need_near(a.outline);
      need(a.outline.size() >= 3 && within(a.z_m, -farthest_m, farthest_m) &&
               within(a.mains_lx, 0, brightest),
           "an area has no outline");
    }
  }
  for (const EmphasisPoint& e : d.emphasis)
    need(near(e.position) && (!e.facing || near(*e.facing)), "something lies too far away");
  need(within(d.assessment.age_years, 0, 200) && d.assessment.spacing_m > 0 &&
           d.assessment.spacing_m <= farthest_m &&
           within(d.assessment.luminance_before_cd_m2, 0, brightest),
       "an assessment's settings cannot be");
}

void check(const Scenario& s) {
  need(within(s.seconds_after_failure, 0, 1e12), "a scenario's time cannot be");
  for (const auto* factors : {&s.circuits, &s.media})
    for (const Scenario::Factor& f : *factors)
      need(within(f.factor, 0, any_factor), "a scenario's factor cannot be");
  need(within(s.smoke_factor, 0, any_factor) && within(s.emission_factor, 0, any_factor),
       "a scenario's factor cannot be");
}

void check(const RunSettings& r) {
  need(r.max_bands >= 1 && r.max_bands <= 64, "a run has no bands");
  const std::vector<double>& edges = r.band_edges_nm;
  need(edges.empty() || (edges.size() >= 2 && edges.size() <= 65 &&
                         edges.front() == spectrum_first_nm && edges.back() == spectrum_last_nm),
       "a run's bands do not span the spectrum");
  for (size_t i = 1; i < edges.size(); ++i)
    need(edges[i] > edges[i - 1], "a run's bands do not ascend");
  need(within(r.band_tolerance, 0, 1e3) && r.batch_particles >= 0 &&
           r.batch_particles <= 1'000'000 && within(r.voxel_edge_m, 0, 1e4) &&
           within(r.eye_path_factor, 0, 1e3),
       "a run's settings cannot be");
}

/// Every face of a sign has a surface of its own, in the order of the description.
void check_faces(const SceneDescription& d, const PackedScene& g) {
  size_t faces = 0;
  for (const Sign& s : d.signs) faces += s.double_sided ? 2 : 1;
  std::vector<bool> has_surface(faces, false);
  for (const CompiledSurface& s : g.surfaces) {
    if (s.sign == none_index) continue;
    need(s.sign < faces && !has_surface[s.sign], "a surface refers to what there is not");
    has_surface[s.sign] = true;
  }
  need(std::find(has_surface.begin(), has_surface.end(), false) == has_surface.end(),
       "a sign's face has no surface");
}

void check_surfaces(const SceneDescription& d, const PackedScene& g) {
  need(g.patch_count <= max_patches, "it has too many patches");
  uint64_t next = 0;
  for (const CompiledSurface& s : g.surfaces) {
    // One more material than described: the dark back of signs.
    need(std::max(s.material[0], s.material[1]) <= d.materials.size() &&
             (s.body_emitter == none_index || s.body_emitter < d.emitters.size()),
         "a surface refers to what there is not");
    need(s.first_patch == next && s.patches % 2 == 0 && (!s.one_patch || s.patches <= 2) &&
             uint64_t{s.first_patch} + s.patches <= g.patch_count,
         "the patches of surfaces do not follow one another");
    need(within(s.area_m2, 0, farthest_m * farthest_m), "a surface has no area");
    next += s.patches;
  }
  need(next == g.patch_count, "the patches of surfaces do not follow one another");
  need(g.surfaces.size() >= d.objects.size(), "its geometry is not whole");
}

void check_geometry(const PackedScene& g) {
  need(g.partition >= 1 && !g.cells.empty(), "its geometry is not whole");
  need(ordered(g.bounds.low, g.bounds.high), "it has no size");
  need(within(g.total_area_m2, 0, farthest_m * farthest_m), "it has no surfaces");
  uint64_t triangles = 0;
  for (const PackedScene::Cell& cell : g.cells) {
    need(ordered(glm::dvec3(cell.low), glm::dvec3(cell.high)), "a cell has no size");
    triangles += cell.triangles;
  }
  need(triangles == g.triangles && triangles > 0, "its cells have not all its triangles");
}

/// Checks the brick tables of data sets, and the objects, one for each part of the scene.
void check_parts(const std::vector<Medium>& media, const Skeleton& skeleton) {
  const PackedScene& packed = skeleton.packed;
  need(packed.tables.size() == media.size() && packed.flame_points.size() == media.size(),
       "its tables are not those of its media");
  for (size_t m = 0; m < media.size(); ++m) {
    const DataSet& data = media[m].data;
    const bool is_grid = media[m].kind == MediumKind::data_set;
    for (const int side : {data.nx, data.ny, data.nz})
      need(!is_grid || (side >= 1 && side <= limits::max_grid_side), "a data set has no size");
    const BrickTable& table = packed.tables[m];
    need(table.bricks.size() == (is_grid ? brick_count(data) : 0),
         "a table is not that of its data set");
    const bool glows = is_grid && media[m].emission.has_value();
    double emission = 0;
    for (const BrickSummary& brick : table.bricks) {
      need(within(brick.emission, 0, 1e40), "a table has a strength that cannot be");
      emission += brick.emission;
    }
    need(!glows || !table.has_emission || emission > 0, "a flame has no place");
    need(packed.flame_points[m].size() == (glows ? size_t{limits::flame_points} : 0),
         "a flame has not the points that it should have");
    need_near(packed.flame_points[m]);
  }
  need(SceneParts::count_of(skeleton.description, packed.cells.size(), packed.tables) ==
           packed.objects.size(),
       "it has not an object for each of its parts");
}

}  // namespace

void check_skeleton(const Skeleton& skeleton) {
  const SceneDescription& d = skeleton.description;
  for (const Material& m : d.materials) check(m);
  for (const Object& o : d.objects) check(o, d.materials.size());
  for (const Emitter& e : d.emitters) check(e);
  for (const Sign& s : d.signs) check(s);
  for (const Medium& m : d.media) check(m);
  check_planes(d);
  for (const VolumeGroupMeasure& g : d.volume_groups) check(g);
  check_eyes(d);
  check_assessment(d);
  for (const Scenario& s : d.scenarios) check(s);
  check(d.run);
  check_geometry(skeleton.packed);
  check_surfaces(d, skeleton.packed);
  check_faces(d, skeleton.packed);
  check_parts(d.media, skeleton);
}

}  // namespace luxodus
