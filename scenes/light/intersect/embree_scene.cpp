// Design: one triangle geometry per cell, ROBUST so that shared edges do not leak, vertices written
// straight from the records (welding would save memory, but the records hold the corners that a hit
// needs anyway). Corners can leak: Embree misses 4 in 1000 rays that are aimed exactly at a corner
// (measured). A random ray comes that close with a probability of some 1e-14 per corner, and is
// then counted as escaped. The proxies' callback only records candidates and never changes the ray:
// cells are entered outside Embree, where a caller may wait. Callbacks are noexcept, because Embree
// swallows exceptions.
#include "scenes/light/intersect/embree_scene.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "scenes/light/intersect/embree_ray.hpp"
#include "scenes/light/intersect/plain_intersector.hpp"

namespace luxodus {

namespace {

/// Keeps the first error of this thread's start-up; queries raise none.
void report_error(void*, RTCError code, const char* text) noexcept {
  if (code != RTC_ERROR_NONE) {
    std::fprintf(stderr, "luxodus: Embree error %d: %s\n", static_cast<int>(code), text);
  }
}

bool count_bytes(void* counter, ssize_t bytes, bool) noexcept {
  static_cast<std::atomic<int64_t>*>(counter)->fetch_add(bytes);
  return true;
}

struct CollectContext {
  RTCIntersectContext base;  // first member: Embree returns a pointer to it
  const Ray* ray;
  const std::vector<ProxyScene::Box>* boxes;
  std::vector<Candidate>* out;
};

/// Distance at which the ray enters the box, widened by a few roundings so that no hit on a face is
/// missed.
bool enters(const ProxyScene::Box& box, const Ray& ray, float& entry) {
  Real first = 0;
  Real last = ray.length;
  for (int axis = 0; axis < 3; ++axis) {
    const Real inverse = 1 / ray.direction[axis];
    Real a = (box.low[axis] - ray.origin[axis]) * inverse;
    Real b = (box.high[axis] - ray.origin[axis]) * inverse;
    if (a > b) std::swap(a, b);
    // NaN (0 * infinity: the ray lies in a face plane) must not exclude the box.
    if (a > first) first = a;
    if (b < last) last = b;
  }
  constexpr Real slack = 8 * std::numeric_limits<float>::epsilon();
  first *= 1 - slack;
  last *= 1 + slack;
  entry = static_cast<float>(first);
  return first <= last;
}

void proxy_bounds(const RTCBoundsFunctionArguments* args) noexcept {
  const auto& boxes = *static_cast<const std::vector<ProxyScene::Box>*>(args->geometryUserPtr);
  const ProxyScene::Box& box = boxes[args->primID];
  RTCBounds* out = args->bounds_o;
  out->lower_x = box.low.x;
  out->lower_y = box.low.y;
  out->lower_z = box.low.z;
  out->upper_x = box.high.x;
  out->upper_y = box.high.y;
  out->upper_z = box.high.z;
}

void proxy_intersect(const RTCIntersectFunctionNArguments* args) noexcept {
  auto* context = reinterpret_cast<CollectContext*>(args->context);
  float entry = 0;
  if (enters((*context->boxes)[args->primID], *context->ray, entry)) {
    context->out->push_back({entry, args->primID});
  }
}

}  // namespace

EmbreeDevice::EmbreeDevice(BuildThreads threads) {
  device_ = rtcNewDevice(threads == BuildThreads::calling ? "threads=1" : nullptr);
  if (device_ == nullptr) throw std::runtime_error("Embree does not start on this machine");
  rtcSetDeviceErrorFunction(device_, report_error, nullptr);
  rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, &bytes_);
}

std::string EmbreeDevice::library_version() {
  const EmbreeDevice device;
  const auto part = [&](RTCDeviceProperty p) {
    return std::to_string(rtcGetDeviceProperty(device.get(), p));
  };
  return part(RTC_DEVICE_PROPERTY_VERSION_MAJOR) + "." + part(RTC_DEVICE_PROPERTY_VERSION_MINOR) +
         "." + part(RTC_DEVICE_PROPERTY_VERSION_PATCH);
}

std::string EmbreeDevice::instruction_sets() {
  const EmbreeDevice device;
  if (rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0)
    return "up to AVX-512";
  if (rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0)
    return "up to AVX2";
  return "up to SSE4.2";
}

EmbreeDevice::~EmbreeDevice() {
  rtcReleaseDevice(device_);
}

namespace {

/// Whether the triangles of a cell are intersected without Embree: in small cells of a build that
/// computes in double. In larger cells such a build takes only the triangle from Embree.
bool asks_itself(const GeometryCell& cell) {
  return computes_in_double && cell.triangles.size() <= limits::plain_triangles;
}

}  // namespace

CellScene::CellScene(const EmbreeDevice& device, const GeometryCell& cell) : cell_(&cell) {
  if (asks_itself(cell)) boxes_ = plain_boxes(cell.triangles);
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  const size_t count = cell.triangles.size();
  auto* vertices = static_cast<glm::vec3*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              sizeof(glm::vec3), 3 * std::max<size_t>(count, 1)));
  auto* indices = static_cast<uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(uint32_t), std::max<size_t>(count, 1)));
  if (vertices == nullptr || indices == nullptr) throw std::bad_alloc();
  for (size_t i = 0; i < count; ++i) {
    for (size_t k = 0; k < 3; ++k) {
      vertices[3 * i + k] = cell.triangles[i].corner[k];
      indices[3 * i + k] = static_cast<uint32_t>(3 * i + k);
    }
  }
  if (count == 0) {  // Embree needs a buffer: one degenerate triangle that nothing can hit
    for (size_t k = 0; k < 3; ++k) {
      vertices[k] = glm::vec3(std::numeric_limits<float>::quiet_NaN());
      indices[k] = static_cast<uint32_t>(k);
    }
  }
  rtcCommitGeometry(geometry);
  scene_ = rtcNewScene(device.get());
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
}

CellScene::~CellScene() {
  rtcReleaseScene(scene_);
}

namespace {

PlainRay<Real> plain(const Ray& ray) {
  return {ray.origin, ray.direction, ray.length};
}

Hit nearest_of_all(const GeometryCell& cell, std::span<const PlainBox> boxes, const Ray& ray) {
  const PlainHit<Real> found = plain_nearest<Real>(cell.triangles, plain(ray), boxes);
  if (found.index == no_triangle) return {};
  return {found.distance, found.u, found.v, found.index, &cell.triangles[found.index], &cell};
}

/// Recomputes distance and barycentrics from the ray and the corners.
void recompute(Hit& hit, const Ray& ray) {
  const PlainRay<Real> line = plain(ray);
  const PlaneIntersection<Real> m =
      meet_plane(line, *hit.triangle, edge_volumes(line, *hit.triangle));
  const bool edge_on =
      !(m.distance >= 0 && m.distance < std::numeric_limits<Real>::infinity()) || std::isnan(m.u);
  if (edge_on) return;
  hit.distance = m.distance;
  hit.u = m.u;
  hit.v = m.v;
}

}  // namespace

Hit CellScene::nearest(const Ray& ray) const {
  if (asks_itself(*cell_)) return nearest_of_all(*cell_, boxes_, ray);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query = to_embree(ray);
  rtcIntersect1(scene_, &context, &query);
  Hit hit;
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
  hit.distance = query.ray.tfar;
  hit.u = query.hit.u;
  hit.v = query.hit.v;
  hit.index = query.hit.primID;
  hit.triangle = &cell_->triangles[hit.index];
  hit.cell = cell_;
  if constexpr (computes_in_double) recompute(hit, ray);
  return hit;
}

bool CellScene::occluded(const Ray& ray) const {
  if (asks_itself(*cell_)) return plain_occluded<Real>(cell_->triangles, plain(ray), boxes_);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query = to_embree(ray);
  rtcOccluded1(scene_, &context, &query.ray);
  return query.ray.tfar < 0;
}

ProxyScene::ProxyScene(const EmbreeDevice& device, std::vector<Box> boxes)
    : boxes_(std::move(boxes)) {
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes_.size()));
  rtcSetGeometryUserData(geometry, &boxes_);
  rtcSetGeometryBoundsFunction(geometry, proxy_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, proxy_intersect);
  rtcCommitGeometry(geometry);
  scene_ = rtcNewScene(device.get());
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
}

ProxyScene::~ProxyScene() {
  rtcReleaseScene(scene_);
}

void ProxyScene::candidates(const Ray& ray, std::vector<Candidate>& out) const {
  out.clear();
  CollectContext context{{}, &ray, &boxes_, &out};
  rtcInitIntersectContext(&context.base);
  RTCRayHit query = to_embree(ray);
  rtcIntersect1(scene_, &context.base, &query);
  std::sort(out.begin(), out.end(), [](const Candidate& a, const Candidate& b) {
    return a.entry != b.entry ? a.entry < b.entry : a.cell < b.cell;
  });
}

}  // namespace luxodus
