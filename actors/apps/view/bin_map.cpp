#include "actors/apps/view/bin_map.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace luxodus {

namespace {

bool same_bands(const Bands& a, const Bands& b) {
  if (a.count() != b.count()) return false;
  for (int i = 0; i < a.count(); ++i)
    if (a[i].low_nm != b[i].low_nm || a[i].high_nm != b[i].high_nm ||
        a[i].lm_per_w != b[i].lm_per_w || a[i].x_per_w != b[i].x_per_w ||
        a[i].z_per_w != b[i].z_per_w)
      return false;
  return true;
}

bool same_units(const CompiledScene& a, const CompiledScene& b) {
  return a.local_origin == b.local_origin && a.length_unit_m == b.length_unit_m &&
         a.batch_particles == b.batch_particles && a.voxels.low == b.voxels.low &&
         a.voxels.edge == b.voxels.edge && a.voxels.count() == b.voxels.count() &&
         same_bands(a.bands, b.bands);
}

/// The owner of a surface: an object by its number, which no viewer changes; a sign's face or a
/// luminaire's body by name.
using Owner = std::tuple<uint32_t, std::string, bool>;

Owner owner_of(const CompiledScene& scene, uint32_t surface) {
  const CompiledSurface& s = scene.surfaces[surface];
  if (s.sign != none_index) {
    const CompiledSign& face = scene.signs[s.sign];
    return {none_index, "sign " + scene.description->signs[face.sign].name, face.back};
  }
  if (s.body_emitter != none_index)
    return {none_index, "body " + scene.description->emitters[s.body_emitter].name, false};
  return {surface, "", false};
}

/// All blocks except those of patches and surfaces have the same bins wherever units are the same.
bool same_blocks(const CompiledScene& a, const CompiledScene& b) {
  const auto& of_a = a.layout.blocks();
  const auto& of_b = b.layout.blocks();
  if (of_a.size() != of_b.size()) return false;
  for (uint32_t i = 0; i < of_a.size(); ++i) {
    const bool by_surface = i == a.blocks.patches || i == a.blocks.surfaces;
    if (of_a[i].name != of_b[i].name || of_a[i].quantities != of_b[i].quantities) return false;
    if (!by_surface && of_a[i].bins != of_b[i].bins) return false;
  }
  return true;
}

}  // namespace

std::optional<BinMap> BinMap::between(const CompiledScene& before, const CompiledScene& now) {
  if (!same_units(before, now) || !same_blocks(before, now)) return std::nullopt;
  BinMap out;
  out.size_ = now.layout.totals();
  std::map<Owner, uint32_t> old;
  for (uint32_t s = 0; s < before.surfaces.size(); ++s) old[owner_of(before, s)] = s;
  std::vector<Run> surfaces;
  const auto add = [](std::vector<Run>& runs, const Run& run) {
    if (run.count == 0) return;
    const bool goes_on = !runs.empty() && runs.back().from + runs.back().count == run.from &&
                         runs.back().to + runs.back().count == run.to;
    if (goes_on)
      runs.back().count += run.count;
    else
      runs.push_back(run);
  };
  for (uint32_t s = 0; s < now.surfaces.size(); ++s) {
    const auto at = old.find(owner_of(now, s));
    if (at == old.end()) continue;
    const CompiledSurface& was = before.surfaces[at->second];
    const CompiledSurface& is = now.surfaces[s];
    if (was.patches != is.patches) continue;
    add(surfaces, {at->second, s, 1});
    add(out.patches_, {was.first_patch, is.first_patch, is.patches});
  }
  for (uint32_t i = 0; i < now.layout.blocks().size(); ++i) {
    const TallyBlock& from = before.layout.block(i);
    const TallyBlock& to = now.layout.block(i);
    const int64_t width = now.layout.total_index(i, 1, 0, 0) - to.first_total;
    const std::vector<Run> whole{{0, 0, to.bins}};
    const auto& runs = i == now.blocks.patches    ? out.patches_
                       : i == now.blocks.surfaces ? surfaces
                                                  : whole;
    for (const Run& run : runs)
      add(out.totals_, {from.first_total + run.from * width, to.first_total + run.to * width,
                        run.count * width});
  }
  const auto is_all = [](const std::vector<Run>& runs, int64_t count) {
    return count == 0 ||
           (runs.size() == 1 && runs[0].from == 0 && runs[0].to == 0 && runs[0].count == count);
  };
  out.same_ = before.layout.totals() == out.size_ && is_all(out.totals_, out.size_);
  return out;
}

Totals::GroupState BinMap::moved(const Totals::GroupState& before) const {
  if (same_) return before;
  Totals::GroupState out{SparseArray<Total>(size_), before.batches};
  for (const Run& run : totals_)
    before.totals.for_each_touched(run.from, run.from + run.count, [&](int64_t first, int64_t end) {
      std::copy_n(before.totals.data() + first, end - first,
                  out.totals.touch(run.to + first - run.from, end - first));
    });
  return out;
}

uint32_t BinMap::patch_before(uint32_t patch) const {
  const auto behind = std::upper_bound(patches_.begin(), patches_.end(), int64_t{patch},
                                       [](int64_t p, const Run& run) { return p < run.to; });
  if (behind == patches_.begin()) return none_index;
  const Run& run = *std::prev(behind);
  const int64_t in_run = patch - run.to;
  return in_run < run.count ? static_cast<uint32_t>(run.from + in_run) : none_index;
}

}  // namespace luxodus
