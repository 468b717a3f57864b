#include "actors/judge/validate/traced.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/core/check.hpp"
#include "scenes/light/transport/compile.hpp"

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

/// The scene with an additional block for each sum, and the numbers of these blocks.
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

/// Divides the weights of each sum by the largest, so that scores of batches stay within 63 bits.
std::vector<double> take_scales(std::vector<WeightedSum>& sums) {
  std::vector<double> scales;
  for (WeightedSum& sum : sums) {
    double most = 0;
    for (const WeightedSum::Term& t : sum.terms) most = std::max(most, std::abs(t.weight));
    LUX_CHECK(most > 0, "a sum without weights");
    for (WeightedSum::Term& t : sum.terms) t.weight /= most;
    scales.push_back(most);
  }
  return scales;
}

std::shared_ptr<const CompiledScene> with_weighted_sums(const CompiledScene& scene,
                                                        const std::vector<WeightedSum>& sums,
                                                        std::vector<uint32_t>& numbers) {
  const auto out = std::make_shared<CompiledScene>(scene);
  for (const WeightedSum& sum : sums) {
    TallyBlock block = scene.layout.block(scene.blocks.*sum.block);
    LUX_CHECK(scene.layout.bands() == 1, "weighted sums of a scene of many bands");
    block.name = "weighted sum";
    block.bins = block.quantities = 1;
    numbers.push_back(out->layout.add_block(std::move(block)));
  }
  return out;
}

/// Wraps another tracer, and keeps the weighted sums of a batch's scores.
class SummingTracer final : public BatchTracer {
 public:
  SummingTracer(std::unique_ptr<BatchTracer> tracer, const CompiledScene& scene,
                const std::vector<WeightedSum>& sums, const std::vector<uint32_t>& blocks)
      : tracer_(std::move(tracer)), scene_(scene), sums_(sums), blocks_(blocks) {}

  void trace(int group, uint64_t first, int64_t count, BatchScores& scores) override {
    tracer_->trace(group, first, count, scores);
    const TallyLayout& layout = scene_.layout;
    int64_t* const all = scores.scores.data();
    for (size_t i = 0; i < sums_.size(); ++i) {
      double sum = 0;
      for (const WeightedSum::Term& t : sums_[i].terms) {
        const auto score =
            all[layout.score_index(scene_.blocks.*sums_[i].block, t.bin, 0, t.quantity)];
        sum += t.weight * static_cast<double>(score);
      }
      // A batch comes in portions; the scores are those of all so far.
      all[layout.score_index(blocks_[i], 0, 0, 0)] = std::llround(sum);
    }
  }
  uint32_t look_units() const override { return tracer_->look_units(); }
  void look(int64_t batch, uint32_t unit, BatchScores& scores) override {
    tracer_->look(batch, unit, scores);
  }

 private:
  std::unique_ptr<BatchTracer> tracer_;
  const CompiledScene& scene_;
  const std::vector<WeightedSum>& sums_;
  const std::vector<uint32_t>& blocks_;
};

}  // namespace

Traced::Traced(std::shared_ptr<const CompiledScene> scene, uint64_t seed, int threads,
               const std::vector<BinSum>& sums, const std::vector<WeightedSum>& weighted)
    : weighted_(weighted), scales_(take_scales(weighted_)) {
  if (!sums.empty()) scene = with_sums(*scene, sums, sum_blocks_);
  if (!weighted_.empty()) scene = with_weighted_sums(*scene, weighted_, weighted_blocks_);
  run_ = std::make_unique<LocalRun>(std::move(scene), seed, threads);
  if (!weighted_.empty()) trace_with(make_batch_tracer);
}

void Traced::trace_with(const LocalRun::MakeTracer& make) {
  if (weighted_.empty()) return run_->trace_with(make);
  run_->trace_with([this, make](const CompiledScene& scene, const GeometryAccess& access,
                                uint64_t seed) -> std::unique_ptr<BatchTracer> {
    return std::make_unique<SummingTracer>(make(scene, access, seed), scene, weighted_,
                                           weighted_blocks_);
  });
}

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

Estimate Traced::weighted_sum(uint32_t number) const {
  return watts(weighted_blocks_[number], 0) * scales_[number];
}

double Traced::direct_lx(const glm::dvec3& point, const glm::dvec3& normal,
                         const DirectLightAt& direct_light) const {
  const glm::vec3 local(point - scene().local_origin);
  return direct_light(scene(), GeometryAccess::resident(run_->index()), local, glm::vec3(normal),
                      {})
      .total_lx();
}

std::shared_ptr<const Traced> lit(SceneDescription scene) {
  return std::make_shared<const Traced>(compile(std::move(scene)), 1, 1);
}

}  // namespace luxodus::light
