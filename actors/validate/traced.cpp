#include "actors/validate/traced.hpp"

#include "runtime/core/check.hpp"
#include "scenes/transport/compile.hpp"

namespace luxodus::light {

BinSum every_side() {
  return {&TallyBlocks::escape, {0, 1, 2, 3, 4, 5}};
}

std::shared_ptr<const CompiledScene> compile(SceneDescription scene, int cells) {
  const auto description = std::make_shared<const SceneDescription>(std::move(scene));
  const auto scenario = find_scenario(*description, "");
  LUX_CHECK(scenario.ok(), "a scene has no scenario");
  auto compiled = compile_scene(description, scenario.value(), {cells});
  LUX_CHECK(compiled.ok(), compiled.problem().text().c_str());
  return compiled.value();
}

namespace {

/// The scene with one more block for each sum, and the blocks' numbers.
std::shared_ptr<const CompiledScene> with_sums(const CompiledScene& scene,
                                               const std::vector<BinSum>& sums,
                                               std::vector<uint32_t>& numbers) {
  const auto out = std::make_shared<CompiledScene>(scene);
  for (const BinSum& sum : sums) {
    const uint32_t from = scene.blocks.*sum.block;
    TallyBlock block = scene.layout.block(from);
    block.name = "sum";
    block.bins = 1;
    numbers.push_back(out->layout.add_block(std::move(block)));
    for (const uint32_t bin : sum.bins)
      out->layout.add_aggregate({from, bin, 1, numbers.back(), 0});
  }
  return out;
}

}  // namespace

Traced::Traced(std::shared_ptr<const CompiledScene> scene, uint64_t seed, int threads,
               const std::vector<BinSum>& sums)
    : run_(std::make_unique<LocalRun>(
          sums.empty() ? std::move(scene) : with_sums(*scene, sums, sum_blocks_), seed, threads)) {}

double Traced::emitted_w() const {
  double sum = 0;
  for (const Group& g : scene().groups) {
    for (const double p : g.power_w) sum += p;
  }
  return sum;
}

Estimate Traced::watts(uint32_t block, uint32_t bin, uint32_t quantity) const {
  LUX_CHECK(scene().bands.count() == 1, "watts of a scene of many bands");
  return Readout(scene(), run_->totals()).watts(block, bin, 0, quantity);
}

Estimate Traced::value(uint32_t block, uint32_t bin, uint32_t quantity) const {
  return Readout(scene(), run_->totals()).value(block, bin, quantity);
}

uint32_t Traced::surface_index(const std::string& name) const {
  for (uint32_t i = 0; i < scene().surfaces.size(); ++i) {
    if (scene().surfaces[i].name == name) return i;
  }
  end_by_mistake(__FILE__, __LINE__, ("no surface " + name).c_str());
}

Estimate Traced::into(const std::string& surface) const {
  return watts(blocks().surfaces, surface_index(surface), 0);
}
Estimate Traced::absorbed_by(const std::string& surface) const {
  return watts(blocks().surfaces, surface_index(surface), 2);
}
Estimate Traced::into_patch(const std::string& surface, uint32_t patch) const {
  return watts(blocks().patches, scene().surfaces[surface_index(surface)].first_patch + patch, 0);
}
Estimate Traced::into_group(uint32_t group) const {
  return watts(blocks().surface_groups, group, 0);
}
Estimate Traced::escaped(uint32_t side) const {
  return watts(blocks().escape, side);
}
Estimate Traced::track_length(uint32_t group) const {
  return watts(blocks().volume_length, group);
}
Estimate Traced::absorbed_in(uint32_t group) const {
  return watts(blocks().volume_power, group, 0);
}
Estimate Traced::absorbed_by_medium(uint32_t medium) const {
  return watts(blocks().media_power, medium, 0);
}

Estimate Traced::sum(uint32_t number, uint32_t quantity) const {
  const uint32_t block = sum_blocks_[number];
  return scene().layout.block(block).unit == ScoreUnit::value ? value(block, 0, quantity)
                                                              : watts(block, 0, quantity);
}

double Traced::direct_lx(const glm::dvec3& point, const glm::dvec3& normal) const {
  const glm::vec3 local(point - scene().local_origin);
  return direct_light_at(scene(), GeometryAccess::resident(run_->index()), local, glm::vec3(normal),
                         {})
      .total_lx();
}

}  // namespace luxodus::light
