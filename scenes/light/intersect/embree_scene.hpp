// Ray casting with Embree. An EmbreeDevice is one library instance; a CellScene is the search
// structure over the triangles of one geometry cell (a merged scene is a single cell); a ProxyScene
// is the structure over the boxes of many cells: it finds candidate cells and never enters one.
// This is the only room that includes Embree. Thread rule: queries are const and may run on any
// thread; scenes are built before tracing starts.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scenes/light/geometry/mesh.hpp"
#include "scenes/light/intersect/plain_intersector.hpp"
#include "scenes/light/intersect/ray.hpp"

struct RTCDeviceTy;
struct RTCSceneTy;

namespace luxodus {

/// Threads that build search structures: all of the machine, or the calling thread alone.
enum class BuildThreads { all, calling };

class EmbreeDevice {
 public:
  explicit EmbreeDevice(BuildThreads threads = BuildThreads::all);
  ~EmbreeDevice();
  EmbreeDevice(const EmbreeDevice&) = delete;
  EmbreeDevice& operator=(const EmbreeDevice&) = delete;

  /// "3.13.5" of the library that is loaded, and the instruction sets its kernels were built for.
  static std::string library_version();
  static std::string instruction_sets();

  RTCDeviceTy* get() const { return device_; }
  /// Bytes that Embree holds now, as its memory monitor reports.
  int64_t bytes() const { return bytes_.load(); }

 private:
  RTCDeviceTy* device_ = nullptr;
  std::atomic<int64_t> bytes_{0};
};

/// The content of a geometry cell: immutable, position-independent.
struct GeometryCell {
  std::vector<TriangleRecord> triangles;
  /// Texture coordinates of the few triangles that have them, ascending by triangle.
  struct TriangleUv {
    uint32_t triangle;
    glm::vec2 corner[3];
  };
  std::vector<TriangleUv> texture_uv;
  glm::vec3 low{0};
  glm::vec3 high{0};

  /// Texture coordinates of a triangle; null if it has none.
  const TriangleUv* uv_of(uint32_t triangle) const {
    const auto at = std::lower_bound(
        texture_uv.begin(), texture_uv.end(), triangle,
        [](const TriangleUv& uv, uint32_t wanted) { return uv.triangle < wanted; });
    return at != texture_uv.end() && at->triangle == triangle ? &*at : nullptr;
  }
};

class CellScene {
 public:
  /// Builds at once, on the calling thread and Embree's threads. `cell` must outlive this.
  CellScene(const EmbreeDevice& device, const GeometryCell& cell);
  ~CellScene();
  CellScene(const CellScene&) = delete;
  CellScene& operator=(const CellScene&) = delete;

  /// Nearest triangle within (0, ray.length]; both sides of a triangle count.
  Hit nearest(const Ray& ray) const;
  /// Whether any triangle lies within (0, ray.length).
  bool occluded(const Ray& ray) const;
  const GeometryCell& cell() const { return *cell_; }
  RTCSceneTy* get() const { return scene_; }

 private:
  const GeometryCell* cell_;
  RTCSceneTy* scene_ = nullptr;
  std::vector<PlainBox> boxes_;  // of groups; used by builds in double
};

/// A cell that a ray may enter, and the distance at which it enters the cell's box.
struct Candidate {
  float entry;
  uint32_t cell;
};

class ProxyScene {
 public:
  struct Box {
    glm::vec3 low, high;
  };
  ProxyScene(const EmbreeDevice& device, std::vector<Box> boxes);
  ~ProxyScene();
  ProxyScene(const ProxyScene&) = delete;
  ProxyScene& operator=(const ProxyScene&) = delete;

  /// All cells whose box the ray meets, sorted by (entry, cell). Replaces what `out` held.
  void candidates(const Ray& ray, std::vector<Candidate>& out) const;

 private:
  std::vector<Box> boxes_;
  RTCSceneTy* scene_ = nullptr;
};

/// Ties in distance go to the smaller global triangle, so that the order of visits does not matter.
inline bool is_nearer(const Hit& hit, const Hit& best) {
  if (!hit.found()) return false;
  if (hit.distance != best.distance) return hit.distance < best.distance;
  return best.found() && hit.triangle->global_triangle < best.triangle->global_triangle;
}

/// Nearest hit over cells, front to back. `enter(candidate)` returns a pointer to the CellScene and
/// may wait for it; if it returns null (the cell is not available), the result is no hit. The
/// candidate is an element of `scratch`, and the elements after it are the next candidates.
/// `keep(hit)` converts a hit to a form that stays valid after its cell is evicted. A cell is
/// entered only while it can hold a nearer hit.
template <class Enter, class Keep = std::identity>
Hit nearest_in_cells(const ProxyScene& proxies, const Ray& ray, std::vector<Candidate>& scratch,
                     Enter&& enter, Keep keep = {}) {
  proxies.candidates(ray, scratch);
  Hit best;
  for (const Candidate& c : scratch) {
    if (c.entry > best.distance) break;
    const CellScene* cell = enter(c);
    if (cell == nullptr) return {};
    const Hit hit = cell->nearest(ray);
    if (is_nearer(hit, best)) best = keep(hit);
  }
  return best;
}

/// Whether anything in the cells lies on the ray; also true if a cell is not available.
template <class Enter>
bool occluded_in_cells(const ProxyScene& proxies, const Ray& ray, std::vector<Candidate>& scratch,
                       Enter&& enter) {
  proxies.candidates(ray, scratch);
  return std::any_of(scratch.begin(), scratch.end(), [&](const Candidate& c) {
    const CellScene* cell = enter(c);
    return cell == nullptr || cell->occluded(ray);
  });
}

}  // namespace luxodus
