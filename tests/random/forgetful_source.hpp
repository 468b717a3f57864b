// Scene parts that are evicted at random: a cell's search structure is destroyed and rebuilt, and
// bricks and tiles are cut anew for each request. Earlier references become invalid, as the rule of
// sources allows. Thread rule: one thread.
#pragma once

#include <memory>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"
#include "scenes/light/transport/image_tile.hpp"
#include "scenes/light/transport/object_source.hpp"
#include "tests/random/dice.hpp"

namespace luxodus::test {

class ForgetfulSource final : public ObjectSource {
 public:
  /// Requires: both outlive this.
  ForgetfulSource(const EmbreeDevice& device, const CompiledScene& scene, uint64_t number)
      : device_(device), scene_(scene), dice_(number, 1), cells_(scene.cells.size()) {}

  const CellScene* cell(uint32_t cell, std::span<const Candidate>) override {
    if (dice_.below(64) == 0) cells_[static_cast<size_t>(dice_.below(count()))].reset();
    auto& built = cells_[cell];
    if (!built) built = std::make_unique<CellScene>(device_, scene_.cells[cell]);
    return built.get();
  }
  const Brick* brick(int medium, int brick) override {
    brick_ = std::make_unique<Brick>(scene_.media.brick(medium, brick));
    return brick_.get();
  }
  const ImageTile* tile(uint32_t image, uint32_t tile) override {
    tile_ = std::make_unique<ImageTile>(cut_tile(*scene_.images[image], tile));
    return tile_.get();
  }
  bool spoilt() override { return false; }

 private:
  int count() const { return static_cast<int>(cells_.size()); }

  const EmbreeDevice& device_;
  const CompiledScene& scene_;
  Dice dice_;
  std::vector<std::unique_ptr<CellScene>> cells_;
  std::unique_ptr<Brick> brick_;
  std::unique_ptr<ImageTile> tile_;
};

}  // namespace luxodus::test
