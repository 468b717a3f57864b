// Every struct's fields are listed once, for both directions; their order is the format, and a
// change of it needs a new pack_version. Shared things (photometric webs, pictures) are written
// once and referenced by their index in a list.
#include "scenes/formats/pack/skeleton.hpp"

#include <algorithm>

#include "scenes/formats/pack/archive.hpp"
#include "scenes/formats/pack/check_skeleton.hpp"

namespace luxodus {

// ---- fields ------------------------------------------------------------------------------------

template <class A>
void serialize(A& a, SourcePlace& x) {
  a(x.file, x.line);
}
template <class A>
void serialize(A& a, Problem& x) {
  a(x.where, x.what);
}
template <class A>
void serialize(A& a, ObjectId& x) {
  a(x.value);
}
template <class A>
void serialize(A& a, Frame& x) {
  a(x.origin, x.axes);
}
template <class A>
void serialize(A& a, Bounds& x) {
  a(x.low, x.high);
}
template <class A>
void serialize(A& a, Mesh& x) {
  a(x.positions, x.triangles, x.texture_uv);
}
template <class A>
void serialize(A& a, Spectrum& x) {
  a(x.value);
}
/// Without its texels.
template <class A>
void serialize(A& a, Image& x) {
  a(x.width, x.height, x.channels);
}
template <class A>
void serialize(A& a, Material& x) {
  a(x.name, x.place, choice(x.kind, MaterialKind::open), x.reflectance, x.specular, x.roughness,
    x.ior, x.internal_transmittance);
}
template <class A>
void serialize(A& a, Door& x) {
  a(x.open, x.hinge, x.axis, x.open_angle_deg);
}
/// Without its triangles.
template <class A>
void serialize(A& a, Object& x) {
  a(x.name, x.place, x.material, x.back_material, x.patch_edge_m, x.one_patch, x.tags, x.group,
    x.door);
}
template <class A>
void serialize(A& a, Emitter& x) {
  a(x.name, x.place, x.circuit, x.group, choice(x.shape, EmitterShape::mesh), x.frame, x.size,
    x.mesh, choice(x.distribution, Distribution::web), x.cosine_power, x.spot_inner_deg,
    x.spot_outer_deg, x.spectrum, x.radiometric, x.mains_flux, x.emergency_flux, x.emergency_ageing,
    x.onset, x.duration_s, x.body_material, x.body);
}
template <class A>
void serialize(A& a, SignFace& x) {
  uint64_t texels = x.colour.size();
  a(x.width, x.height, texels);
  if constexpr (A::is_loading::value) {
    if (texels > a.left()) throw DamagedArchive("it holds a list longer than itself");
    x.colour.resize(texels);
  }
  for (ColourIndex& colour : x.colour) a(colour);
  a(x.relative_luminance, x.legend, x.ground);
}
template <class A>
void serialize(A& a, FaceColour& x) {
  a(x.name, x.drawn[0], x.drawn[1], x.drawn[2], x.mains_cd_m2, x.emergency_cd_m2, x.shape,
    x.reflectance);
}
template <class A>
void serialize(A& a, SignLetters& x) {
  a(x.height_m, x.stroke_m);
}
template <class A>
void serialize(A& a, Sign& x) {
  a(x.name, x.place, x.circuit, x.group, x.frame, x.width_m, x.height_m, x.smallest_detail_m,
    x.letters, x.double_sided, x.thickness_m, x.colours, x.face,
    choice(x.lighting, SignLighting::photoluminescent), x.duration_s, x.angular_exponent, x.decay);
}
template <class A>
void serialize(A& a, PlaneMeasure& x) {
  a(x.name, x.place, x.corner, x.edge_u, x.edge_v, x.cells_u, x.cells_v);
}
template <class A>
void serialize(A& a, ProbeMeasure& x) {
  a(x.name, x.place, x.position, x.normal);
}
template <class A>
void serialize(A& a, SurfaceGroupMeasure& x) {
  a(x.name, x.place, x.objects);
}
template <class A>
void serialize(A& a, VolumeGroupMeasure& x) {
  a(x.name, x.place, choice(x.shape, VolumeGroupMeasure::Shape::layer), x.low, x.high, x.centre,
    x.radius, x.inner_radius);
}
template <class A>
void serialize(A& a, CountingPlaneMeasure& x) {
  a(x.name, x.place, x.corner, x.edge_u, x.edge_v);
}
template <class A>
void serialize(A& a, Observer& x) {
  a(x.name, x.place, x.eye, x.gaze, x.signs);
}
template <class A>
void serialize(A& a, EscapeRoute& x) {
  a(x.name, x.place, x.path, x.width_m);
}
template <class A>
void serialize(A& a, AssessedArea& x) {
  a(x.name, x.place, x.outline, x.z_m, x.mains_lx);
}
template <class A>
void serialize(A& a, EmphasisPoint& x) {
  a(x.name, x.place, choice(x.kind, EmphasisKind::refuge), x.position, x.facing);
}
template <class A>
void serialize(A& a, AssessmentSettings& x) {
  a(x.age_years, x.eye_heights_m, x.spacing_m, x.luminance_before_cd_m2, x.smoke_expected,
    x.irritant_smoke);
}
template <class A>
void serialize(A& a, ProjectSettings& x) {
  a(x.name, x.client, x.address, x.document, x.revision, x.date, x.author, x.checker, x.logo,
    x.north_deg, x.place);
}
template <class A>
void serialize(A& a, Camera& x) {
  a(x.name, x.place, x.eye, x.target, x.up, x.vertical_fov_deg, x.width, x.height, x.cut_m);
}
template <class A>
void serialize(A& a, Scenario::Factor& x) {
  a(x.name, x.factor);
}
template <class A>
void serialize(A& a, Scenario& x) {
  a(x.name, x.place, choice(x.operation, Operation::dark), x.seconds_after_failure, x.says_seconds,
    x.circuits, x.media, x.smoke_factor, x.emission_factor, x.doors_open, x.doors_closed);
}
template <class A>
void serialize(A& a, RunSettings& x) {
  a(x.seed, x.max_bands, x.band_edges_nm, x.band_tolerance, x.batch_particles, x.voxel_edge_m,
    x.voxels, x.analogue, x.stratified, choice(x.groups, GroupRule::by_emitter), x.eye_path_factor,
    x.error_of);
}
template <class A>
void serialize(A& a, Phase& x) {
  a(choice(x.kind, PhaseKind::tabulated), x.g, x.table_cos, x.table_value);
}
template <class A>
void serialize(A& a, Extinction& x) {
  a(x.sigma_t, x.wavelength_nm, x.angstrom, x.table);
}
template <class A>
void serialize(A& a, SmokeOptics& x) {
  a(x.extinction, x.albedo, x.phase);
}
template <class A>
void serialize(A& a, Footprint& x) {
  a(x.polygon, x.z_low, x.z_high);
}
template <class A>
void serialize(A& a, Layer& x) {
  a(x.z_low, x.z_high, x.optics);
}
template <class A>
void serialize(A& a, Quadric::Clip& x) {
  a(x.normal, x.offset);
}
template <class A>
void serialize(A& a, Quadric& x) {
  a(x.a, x.b, x.c, x.clips);
}
/// Without its arrays.
template <class A>
void serialize(A& a, DataSet& x) {
  a(x.nx, x.ny, x.nz, x.extent, x.interpolate_emission);
}
template <class A>
void serialize(A& a, MediumEmission& x) {
  a(x.power_w, x.visible_fraction, x.spectrum, x.group, x.circuit);
}
template <class A>
void serialize(A& a, FireSimulation& x) {
  a(x.file, x.time_s, x.source, x.glows, x.frame, x.meshes);
}
template <class A>
void serialize(A& a, Medium& x) {
  a(x.name, x.place, choice(x.kind, MediumKind::data_set), x.optics, x.layers, x.footprint, x.frame,
    x.quadric, x.local_bounds, x.data, x.emission, x.simulation);
}
template <class A>
void serialize_sides(A& a, std::vector<Side>& x) {
  uint64_t count = x.size();
  a(count);
  if constexpr (A::is_loading::value) {
    if (count > a.left()) throw DamagedArchive("it holds a list longer than itself");
    x.resize(count);
  }
  for (Side& side : x) a(choice(side, Side::top));
}
template <class A>
void serialize(A& a, SceneDescription& x) {
  a(x.name, x.title, x.file, x.run, x.materials, x.objects, x.emitters, x.media, x.signs);
  a(x.planes, x.probes, x.surface_groups, x.volume_groups, x.counting_planes, x.observers,
    x.cameras, x.routes, x.open_areas, x.task_areas, x.emphasis, x.assessment, x.project,
    x.scenarios, x.content_hash, x.degenerate_triangles, x.warnings);
  serialize_sides(a, x.open_sides);
}
template <class A>
void serialize(A& a, CompiledSurface& x) {
  a(x.name, x.material[0], x.material[1], x.sign, x.body_emitter, x.body, x.first_patch, x.patches,
    x.area_m2, x.one_patch);
}
template <class A>
void serialize(A& a, BrickSummary& x) {
  a(x.smokes, x.emission);
}
template <class A>
void serialize(A& a, BrickTable& x) {
  a(x.has_extinction, x.has_albedo, x.has_emission, x.bricks);
}
template <class A>
void serialize(A& a, PackedScene::Cell& x) {
  a(x.low, x.high, x.triangles);
}
template <class A>
void serialize(A& a, PackedScene::Object& x) {
  a(x.id, x.wire_bytes);
}
template <class A>
void serialize(A& a, PackedScene& x) {
  a(x.partition, x.open_doors, x.bounds, x.surfaces, x.triangles, x.patch_count, x.total_area_m2,
    x.cells, x.tables, x.flame_points, x.objects, x.warnings);
}

namespace {

// ---- what is shared ----------------------------------------------------------------------------

/// The tables of a photometric web, from which it is constructed again.
struct WebTables {
  std::vector<double> azimuth_deg, polar_deg, candela;
  glm::dmat3 to_luminaire{1.0};

  template <class A>
  void serialize(A& a) {
    a(azimuth_deg, polar_deg, candela, to_luminaire);
  }
};

/// Things that several values share, by their index in a list.
struct Shared {
  std::vector<WebTables> webs;
  std::vector<uint32_t> web_of_emitter;  // none_index: none
  std::vector<Image> images;
  std::vector<uint32_t> image_of_material;

  template <class A>
  void serialize(A& a) {
    a(webs, web_of_emitter, images, image_of_material);
  }
};

/// The index of a pointer among those seen, none_index for null. Sets `is_new` the first time.
template <class T>
uint32_t place_among(std::vector<const T*>& seen, const T* thing, bool& is_new) {
  is_new = false;
  if (thing == nullptr) return none_index;
  const auto at = std::find(seen.begin(), seen.end(), thing);
  is_new = at == seen.end();
  const auto place = static_cast<uint32_t>(at - seen.begin());
  if (is_new) seen.push_back(thing);
  return place;
}

Shared shared_of(const SceneDescription& description) {
  Shared out;
  bool is_new = false;
  std::vector<const PhotometricWeb*> webs;
  for (const Emitter& emitter : description.emitters) {
    out.web_of_emitter.push_back(place_among(webs, emitter.web.get(), is_new));
    if (!is_new) continue;
    const PhotometricWeb& web = *emitter.web;
    out.webs.push_back({web.azimuth_deg(), web.polar_deg(), web.candela(), web.to_luminaire()});
  }
  std::vector<const Image*> images;
  for (const Material& material : description.materials) {
    const Image* image = material.reflectance_image.get();
    out.image_of_material.push_back(place_among(images, image, is_new));
    if (is_new) out.images.push_back({image->width, image->height, image->channels, {}});
  }
  return out;
}

bool sound(const Image& image) {
  constexpr int max_side = 1 << 16;  // the limit of the PNG reader
  return image.width > 0 && image.width <= max_side && image.height > 0 &&
         image.height <= max_side && image.channels > 0 && image.channels <= 4;
}

/// The things a list names by place, each `none_index` or within it.
void check_places(const std::vector<uint32_t>& places, size_t wanted, size_t count) {
  if (places.size() != wanted) throw DamagedArchive("a list of places has another length");
  for (const uint32_t place : places)
    if (place != none_index && place >= count) throw DamagedArchive("a place lies beyond its list");
}

void give_shared(Shared& shared, SceneDescription& description) {
  check_places(shared.web_of_emitter, description.emitters.size(), shared.webs.size());
  check_places(shared.image_of_material, description.materials.size(), shared.images.size());
  std::vector<std::shared_ptr<const PhotometricWeb>> webs;
  for (WebTables& t : shared.webs) {
    auto web = PhotometricWeb::make(std::move(t.azimuth_deg), std::move(t.polar_deg),
                                    std::move(t.candela), t.to_luminaire);
    if (!web) throw DamagedArchive(web.problem().what);
    webs.push_back(std::make_shared<const PhotometricWeb>(std::move(web).value()));
  }
  std::vector<std::shared_ptr<const Image>> images;
  for (Image& image : shared.images) {
    if (!sound(image)) throw DamagedArchive("a picture has not the size that it says");
    images.push_back(std::make_shared<const Image>(std::move(image)));
  }
  for (size_t i = 0; i < description.emitters.size(); ++i) {
    const uint32_t web = shared.web_of_emitter[i];
    if (web != none_index) description.emitters[i].web = webs[web];
  }
  for (size_t i = 0; i < description.materials.size(); ++i) {
    const uint32_t image = shared.image_of_material[i];
    if (image != none_index) description.materials[i].reflectance_image = images[image];
  }
}

}  // namespace

std::vector<std::byte> encode_skeleton(const SceneDescription& description,
                                       const PackedScene& packed) {
  BytesOut out;
  out(description, shared_of(description), packed);
  return out.take();
}

Result<Skeleton> decode_skeleton(std::span<const std::byte> bytes) {
  try {
    Skeleton skeleton;
    Shared shared;
    BytesIn in(bytes);
    in(skeleton.description, shared, skeleton.packed);
    if (in.left() != 0) throw DamagedArchive("there is more behind its end");
    give_shared(shared, skeleton.description);
    check_skeleton(skeleton);
    return skeleton;
  } catch (const DamagedArchive& damage) {
    return problem(std::string("the skeleton of this pack is damaged: ") + damage.what());
  } catch (const cereal::Exception& damage) {
    return problem(std::string("the skeleton of this pack is damaged: ") + damage.what());
  }
}

}  // namespace luxodus
