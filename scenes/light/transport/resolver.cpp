#include "scenes/light/transport/resolver.hpp"

#include <stdexcept>

#include "scenes/light/transport/packed_scene.hpp"

namespace luxodus {

SceneIndex::SceneIndex(const EmbreeDevice& device, const CompiledScene& scene) {
  const bool packed = scene.description->packed != nullptr;
  loaded_.reserve(packed ? scene.cell_boxes.size() : 0);
  for (uint32_t i = 0; i < scene.cell_boxes.size(); ++i) {
    if (packed) {
      auto cell = load_cell(scene, i);
      if (!cell) throw std::runtime_error(cell.problem().text());
      loaded_.push_back(std::move(cell).value());
    }
    cells_.push_back(std::make_unique<CellScene>(device, packed ? loaded_[i] : scene.cells[i]));
  }
  auto bricks = load_bricks(scene);
  if (!bricks) throw std::runtime_error(bricks.problem().text());
  bricks_ = std::move(bricks).value();
  auto images = load_images(scene);
  if (!images) throw std::runtime_error(images.problem().text());
  images_ = std::move(images).value();
  if (cells_.size() > 1) proxies_ = std::make_unique<ProxyScene>(device, scene.cell_boxes);
}

}  // namespace luxodus
