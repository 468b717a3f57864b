// Checks a data set and cuts it into bricks.
#include "scenes/light/optics/smoke_grid.hpp"

#include <xxhash.h>

#include <cmath>
#include <string>

#include "scenes/light/optics/quadric_body.hpp"

namespace luxodus {

namespace {

/// Errors: the first value outside [0, most].
Result<void> check_array(const char* name, const std::vector<float>& values, int64_t cells,
                         float most) {
  if (values.empty()) return {};
  if (static_cast<int64_t>(values.size()) != cells) {
    return problem(std::string("has ") + std::to_string(values.size()) + " values of " + name +
                   " for " + std::to_string(cells) + " cells");
  }
  for (size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] >= 0) || !(values[i] <= most)) {
      return problem(std::string("has ") + name + " " + std::to_string(values[i]) + " in cell " +
                     std::to_string(i) + "; it must be finite, not negative" +
                     (most <= 1 ? " and at most 1" : ""));
    }
  }
  return {};
}

Result<void> check_data(const DataSet& d) {
  int64_t cells = 1;
  for (const int n : {d.nx, d.ny, d.nz}) {
    if (n < 1 || n > limits::max_grid_side) {
      return problem("has " + std::to_string(n) + " cells along a side; 1 to " +
                     std::to_string(limits::max_grid_side) + " are allowed");
    }
    cells *= n;
  }
  if (cells > limits::max_grid_cells) return problem("has more than 2^30 cells");
  for (int k = 0; k < 3; ++k) {
    if (!(d.extent[k] > 0) || !std::isfinite(d.extent[k])) {
      return problem("has a box whose sides are not all positive and finite");
    }
  }
  constexpr float any = std::numeric_limits<float>::max();
  if (auto ok = check_array("extinction", d.extinction, cells, any); !ok) return ok.problem();
  if (auto ok = check_array("albedo", d.albedo, cells, 1); !ok) return ok.problem();
  return check_array("emission", d.emission, cells, any);
}

std::vector<float> cut_one(const DataSet& d, const std::vector<float>& values,
                           const glm::ivec3& first) {
  if (values.empty()) return {};
  std::vector<float> out(limits::brick_cells, 0.0F);
  const glm::ivec3 last =
      glm::min(first + glm::ivec3(limits::brick_side), glm::ivec3(d.nx, d.ny, d.nz));
  for (int z = first.z; z < last.z; ++z) {
    for (int y = first.y; y < last.y; ++y) {
      for (int x = first.x; x < last.x; ++x) {
        const size_t from =
            (static_cast<size_t>(z) * static_cast<size_t>(d.ny) + static_cast<size_t>(y)) *
                static_cast<size_t>(d.nx) +
            static_cast<size_t>(x);
        out[static_cast<size_t>(Brick::cell_index({x, y, z}))] = values[from];
      }
    }
  }
  return out;
}

uint64_t content_hash(const Brick& b) {
  uint64_t h = 0;
  for (const std::vector<float>* values : {&b.extinction, &b.albedo, &b.emission}) {
    h = XXH3_64bits_withSeed(values->data(), values->size() * sizeof(float), h + values->size());
  }
  return h;
}

int bricks_for(int cells) {
  return (cells + limits::brick_side - 1) / limits::brick_side;
}

}  // namespace

const Brick& clear_brick() {
  static const Brick clear = [] {
    Brick b;
    b.extinction.assign(limits::brick_cells, 0.0F);
    b.albedo = b.emission = b.extinction;
    complete(b);
    return b;
  }();
  return clear;
}

glm::ivec3 bricks_along(const DataSet& data) {
  return {bricks_for(data.nx), bricks_for(data.ny), bricks_for(data.nz)};
}

size_t brick_count(const DataSet& data) {
  const glm::ivec3 n = bricks_along(data);
  return static_cast<size_t>(n.x) * static_cast<size_t>(n.y) * static_cast<size_t>(n.z);
}

Brick cut_brick(const DataSet& data, size_t brick) {
  const glm::ivec3 n = bricks_along(data);
  const auto i = static_cast<int>(brick);
  const glm::ivec3 first = limits::brick_side * glm::ivec3(i % n.x, i / n.x % n.y, i / (n.x * n.y));
  Brick b;
  b.extinction = cut_one(data, data.extinction, first);
  b.albedo = cut_one(data, data.albedo, first);
  b.emission = cut_one(data, data.emission, first);
  complete(b);
  return b;
}

void complete(Brick& brick) {
  double sum = 0;
  brick.emission_cumulative.clear();
  brick.emission_cumulative.reserve(brick.emission.size());
  for (const float e : brick.emission) {
    sum += static_cast<double>(e);
    brick.emission_cumulative.push_back(sum);
  }
  brick.content = content_hash(brick);
}

BrickSummary summary_of(const Brick& brick) {
  return {
      std::any_of(brick.extinction.begin(), brick.extinction.end(), [](float v) { return v > 0; }),
      brick.emission.empty() ? 0 : brick.emission_cumulative.back()};
}

BrickTable brick_table(const DataSet& data) {
  BrickTable out{!data.extinction.empty(), !data.albedo.empty(), !data.emission.empty(), {}};
  for (size_t i = 0; i < brick_count(data); ++i)
    out.bricks.push_back(summary_of(cut_brick(data, i)));
  return out;
}

Result<SmokeGrid> SmokeGrid::make(const Medium& medium, int medium_index,
                                  const glm::dvec3& local_origin) {
  Result<void> ok = check_frame(medium.frame);
  if (ok) ok = check_data(medium.data);
  if (!ok) return problem_in(medium.place, "medium \"" + medium.name + "\" " + ok.problem().what);
  const DataSet& d = medium.data;
  SmokeGrid out;
  out.medium_ = medium_index;
  out.origin_ = medium.frame.origin - local_origin;
  out.axes_ = medium.frame.axes;
  out.extent_ = d.extent;
  out.cells_ = {d.nx, d.ny, d.nz};
  out.cell_ = d.extent / glm::dvec3(out.cells_);
  out.per_cell_ = glm::dvec3(out.cells_) / d.extent;
  out.bricks_ = bricks_along(d);
  out.interpolate_emission_ = d.interpolate_emission;
  return out;
}

void SmokeGrid::settle(const BrickTable& table, bool emits) {
  has_extinction_ = table.has_extinction;
  has_albedo_ = table.has_albedo;
  has_emission_ = table.has_emission;
  interpolate_emission_ = interpolate_emission_ && has_emission_;
  clear_.clear();
  for (size_t i = 0; i < table.bricks.size(); ++i)
    clear_.push_back(table.clear(i, emits, interpolate_emission_) ? 1 : 0);
}

Bounds SmokeGrid::bounds() const {
  Bounds out;
  for (int corner = 0; corner < 8; ++corner) {
    out.extend(from_local(extent_ * glm::dvec3(corner & 1, (corner >> 1) & 1, corner >> 2)));
  }
  return out;
}

}  // namespace luxodus
