#include "scenes/light/transport/scene_features.hpp"

#include <algorithm>
#include <set>

namespace luxodus {

namespace {

/// "3 planes"; "1 plane".
std::string counted(size_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

/// The first names of a list, and the number of the others.
std::string some_of(const std::vector<std::string>& names) {
  constexpr size_t shown = 3;
  std::vector<std::string> first(
      names.begin(), names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), shown)));
  const std::string rest =
      names.size() > shown ? " and " + std::to_string(names.size() - shown) + " more" : "";
  return joined(first) + rest;
}

SceneFeature bands(const CompiledScene& scene) {
  const RunSettings& run = scene.description->run;
  const auto n = static_cast<size_t>(scene.bands.count());
  if (n > 1) {
    return {"wavelength bands", true,
            counted(n, "band") + (run.band_edges_nm.empty() ? ", told apart by spectra"
                                                            : ", as [run] band_edges_nm says")};
  }
  return {"wavelength bands", false,
          run.max_bands == 1 ? "one, as [run] max_bands says"
                             : "one: no spectrum of a material or medium changes over wavelengths"};
}

SceneFeature groups(const CompiledScene& scene) {
  const size_t n = scene.groups.size();
  return {"source groups", n > 1,
          n > 1 ? counted(n, "group") + " with tallies of their own"
                : "one tally: [run] groups asks for no more, or there is one source"};
}

SceneFeature webs(const CompiledScene& scene) {
  const size_t n = scene.webs.size();
  return {"photometric webs", n > 0,
          n > 0 ? counted(n, "web") : "no active luminaire has an LDT or IES file"};
}

SceneFeature media(const CompiledScene& scene) {
  switch (scene.features.media) {
    case MediaNeed::none:
      return {"media", false,
              scene.media_names.empty() ? "the scene has none"
                                        : "none has any extinction in this scenario"};
    case MediaNeed::homogeneous:
      return {"media", true, "homogeneous: one extinction everywhere"};
    case MediaNeed::layered:
      return {"media", true, "layered: extinctions that depend on height alone"};
    case MediaNeed::general:
      break;
  }
  return {"media", true, "bounded: a footprint, a quadric or a data set"};
}

/// Without extinction nothing scatters, whatever is described.
SceneFeature phases(const CompiledScene& scene) {
  const bool on = scene.features.media != MediaNeed::none &&
                  std::any_of(scene.phases.begin(), scene.phases.end(), [](const auto& phase) {
                    return phase.kind() != PhaseKind::isotropic;
                  });
  return {"phase functions", on,
          on ? counted(scene.phases.size(), "function")
             : "no medium scatters other than evenly, in all directions"};
}

SceneFeature glow(const CompiledScene& scene) {
  std::vector<std::string> names;
  for (const CompiledEmitter& e : scene.emitters) {
    if (e.kind == EmitterKind::volume) names.push_back(e.name);
  }
  return {"emission in volumes", !names.empty(),
          names.empty() ? "no flame is lit" : some_of(names)};
}

/// Materials used by some surface, on either side.
std::vector<CompiledMaterial> used_materials(const CompiledScene& scene) {
  std::set<uint32_t> used;
  for (const CompiledSurface& s : scene.surfaces)
    used.insert(std::begin(s.material), std::end(s.material));
  std::vector<CompiledMaterial> out;
  for (const uint32_t m : used) out.push_back(scene.materials[m]);
  return out;
}

SceneFeature surfaces(const CompiledScene& scene) {
  std::vector<std::string> names;
  for (const CompiledMaterial& m : used_materials(scene)) {
    if (m.kind != MaterialKind::lambertian) names.push_back(m.name);
  }
  if (!scene.signs.empty()) names.push_back(counted(scene.signs.size(), "sign face"));
  if (scene.features.surfaces && names.empty()) names.emplace_back("textures");
  return {
      "surfaces other than Lambertian", scene.features.surfaces,
      scene.features.surfaces ? some_of(names) : "all materials are matt and of one colour each"};
}

SceneFeature bodies(const CompiledScene& scene) {
  const auto n =
      static_cast<size_t>(std::count_if(scene.emitters.begin(), scene.emitters.end(),
                                        [](const CompiledEmitter& e) { return e.body != 0; }));
  return {"bodies of luminaires", scene.features.bodies,
          scene.features.bodies ? counted(n, "active emitter") + " whose light passes its own body"
                                : "no active emitter has one (`body_of`)"};
}

SceneFeature textures(const CompiledScene& scene) {
  const auto materials = used_materials(scene);
  const auto n = static_cast<size_t>(
      std::count_if(materials.begin(), materials.end(),
                    [](const CompiledMaterial& m) { return m.image != none_index; }));
  return {"textures", n > 0,
          n > 0 ? counted(n, "material") + " with a picture" : "no surface has a picture"};
}

SceneFeature patches(const CompiledScene& scene) {
  const uint64_t least = 2 * scene.triangles;
  const bool on = scene.patch_count > least;
  return {"patches finer than triangles", on,
          on ? counted(scene.patch_count, "side") + " of patches on " +
                   counted(scene.triangles, "triangle") +
                   ", for pictures and maps: `patch_edge_m = 0` leaves one a triangle"
             : "`patch_edge_m` and `one_patch` ask for none"};
}

SceneFeature cells(const CompiledScene& scene) {
  const size_t n = scene.cell_boxes.size();
  return {"cells of geometry", n > 1,
          n > 1 ? counted(n, "cell") + " that nodes may fetch"
                : "one, resident: nothing asks for more (--cells, or a pack)"};
}

SceneFeature voxels(const CompiledScene& scene) {
  const VoxelGrid& grid = scene.voxels;
  if (grid.edge > 0) return {"voxels", true, counted(grid.count(), "voxel") + " for the media"};
  return {"voxels", false,
          scene.features.media == MediaNeed::none ? "there is no medium" : "[run] voxels is false"};
}

SceneFeature flights(const CompiledScene& scene) {
  std::vector<std::string> asked;
  if (!scene.planes.empty()) asked.push_back(counted(scene.planes.size(), "plane"));
  if (!scene.counting_planes.empty())
    asked.push_back(counted(scene.counting_planes.size(), "counting plane"));
  if (!scene.volume_groups.empty())
    asked.push_back(counted(scene.volume_groups.size(), "volume group"));
  if (scene.voxels.edge > 0) asked.emplace_back("voxels");
  return {"scores along flights", scene.features.detectors,
          asked.empty() ? "no plane, volume group or voxel asks for them" : joined(asked)};
}

/// "2 signs seen by 2 observers": each pair of them is a target of its own.
std::string sight_of_signs(const CompiledScene& scene) {
  std::set<uint32_t> signs, observers;
  for (const EyeTarget& target : scene.eye_targets) {
    signs.insert(scene.signs[target.sign].sign);
    observers.insert(target.observer);
  }
  return counted(signs.size(), "sign") + " seen by " + counted(observers.size(), "observer");
}

SceneFeature eyes(const CompiledScene& scene) {
  const size_t probes = scene.description->probes.size();
  std::vector<std::string> asked;
  if (!scene.eye_targets.empty()) asked.push_back(sight_of_signs(scene));
  if (probes > 0) asked.push_back(counted(probes, "probe"));
  return {"paths from eyes", !asked.empty(),
          asked.empty() ? "no probe, and no observer with a sign before him" : joined(asked)};
}

SceneFeature sampling(const CompiledScene& scene) {
  const bool on = scene.description->run.stratified;
  return {"low-discrepancy points", on,
          on ? "first draws of histories and eye paths" : "[run] stratified is false"};
}

}  // namespace

std::vector<SceneFeature> features_of(const CompiledScene& scene) {
  return {bands(scene),   groups(scene),   webs(scene),    media(scene),    phases(scene),
          glow(scene),    surfaces(scene), bodies(scene),  textures(scene), cells(scene),
          patches(scene), voxels(scene),   flights(scene), eyes(scene),     sampling(scene)};
}

}  // namespace luxodus
