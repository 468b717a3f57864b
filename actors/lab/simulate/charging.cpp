#include "actors/lab/simulate/charging.hpp"

namespace luxodus {

namespace {

/// Measures what a fiber has computed since it was last charged, by the batch's energy balance.
/// Other fibers count there too, but only while this one is suspended.
class TracingMeter {
 public:
  TracingMeter(SimClock& clock, const SimCosts& costs)
      : meter_(clock, Spent::tracing), costs_(costs) {}

  void begin(const BatchScores& scores) {
    ledger_ = &scores.balance;
    look_up();
  }
  /// Charges for what was counted since the last call.
  void settle() {
    const EnergyBalance& now = *ledger_;
    meter_.charge(costs_.ray_ns * static_cast<double>(now.rays - rays_) +
                  costs_.collision_ns * static_cast<double>(now.collisions - collisions_));
    look_up();
  }
  void look_up() {
    rays_ = ledger_->rays;
    collisions_ = ledger_->collisions;
  }
  void reference() { meter_.charge(costs_.reference_ns); }
  void particles(int64_t count) { meter_.charge(costs_.particle_ns * static_cast<double>(count)); }
  void look() { meter_.charge(costs_.look_ns); }

 private:
  Meter meter_;
  const SimCosts costs_;
  const EnergyBalance* ledger_ = nullptr;
  uint64_t rays_ = 0;
  uint64_t collisions_ = 0;
};

class ChargedSource final : public ObjectSource {
 public:
  ChargedSource(ObjectSource& real, TracingMeter& meter) : real_(real), meter_(meter) {}

  template <class Ask>
  auto charged(Ask&& ask) {
    meter_.settle();
    const auto* const object = ask();  // other fibers may have run meanwhile
    meter_.look_up();
    meter_.reference();
    return object;
  }

  const CellScene* cell(uint32_t cell, std::span<const Candidate> next) override {
    return charged([&] { return real_.cell(cell, next); });
  }
  const Brick* brick(int medium, int brick) override {
    return charged([&] { return real_.brick(medium, brick); });
  }
  const ImageTile* tile(uint32_t image, uint32_t tile) override {
    return charged([&] { return real_.tile(image, tile); });
  }
  bool spoilt() override { return real_.spoilt(); }

 private:
  ObjectSource& real_;
  TracingMeter& meter_;
};

class ChargedTracer final : public BatchTracer {
 public:
  ChargedTracer(const CompiledScene& scene, const GeometryAccess& access, uint64_t seed,
                SimClock& clock, const SimCosts& costs)
      : meter_(clock, costs) {
    GeometryAccess charged = access;
    if (access.source != nullptr) charged.source = &source_.emplace(*access.source, meter_);
    real_ = make_batch_tracer(scene, charged, seed);
  }

  void trace(int group, uint64_t first, int64_t count, BatchScores& scores) override {
    meter_.begin(scores);
    real_->trace(group, first, count, scores);
    meter_.settle();
    meter_.particles(count);
  }
  uint32_t look_units() const override { return real_->look_units(); }
  void look(int64_t batch, uint32_t unit, BatchScores& scores) override {
    meter_.begin(scores);
    real_->look(batch, unit, scores);
    meter_.settle();
    meter_.look();
  }
  void rest_between_paths(std::function<void()> rest) override {
    real_->rest_between_paths([this, rest = std::move(rest)] {
      meter_.settle();
      rest();
      meter_.look_up();  // others have traced meanwhile
    });
  }

 private:
  TracingMeter meter_;
  std::optional<ChargedSource> source_;
  std::unique_ptr<BatchTracer> real_;
};

/// A builder works on its node's own thread, so a build delays everything else there.
class ChargedBuilder final : public ObjectBuilder {
 public:
  ChargedBuilder(std::unique_ptr<ObjectBuilder> real, SimClock& clock, const SimCosts& costs)
      : real_(std::move(real)), meter_(clock, Spent::building), costs_(costs) {}

  void build(uint32_t object, SharedBytes bytes, Client& client) override {
    meter_.charge(costs_.build_ns + costs_.build_byte_ns * static_cast<double>(bytes.bytes.size()));
    real_->build(object, std::move(bytes), client);
  }

 private:
  const std::unique_ptr<ObjectBuilder> real_;
  Meter meter_;
  const SimCosts costs_;
};

}  // namespace

TracerMaker charged_tracers(SimClock& clock, const SimCosts& costs) {
  return [&clock, costs](const CompiledScene& scene, const GeometryAccess& access, uint64_t seed) {
    return std::make_unique<ChargedTracer>(scene, access, seed, clock, costs);
  };
}

BuilderMaker charged_builders(SimClock& clock, const SimCosts& costs, const BuilderMaker& make) {
  return [&clock, costs, make](const CompiledScene& scene, const SceneParts& parts) {
    return std::make_unique<ChargedBuilder>(make(scene, parts), clock, costs);
  };
}

}  // namespace luxodus
