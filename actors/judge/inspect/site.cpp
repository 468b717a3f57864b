#include "actors/judge/inspect/site.hpp"

#include <algorithm>
#include <limits>

#include "scenes/light/geometry/mesh_tools.hpp"

namespace luxodus {

namespace {

/// Beyond this multiple of the building's height nothing belongs to it.
constexpr double heights_away = 10;
/// Below this ratio of height to longer side a thing has no height of its own: a single floor.
constexpr double flat_share = 0.01;
constexpr double min_size_m = 0.02;
constexpr double max_size_m = 1000;

double distance_to(const Bounds& box, const glm::dvec3& place) {
  return glm::length(place - glm::clamp(place, box.low, box.high));
}

}  // namespace

std::string length_text(double length_m) {
  if (length_m >= 1000) return fmt::format("{:.3g} km", length_m / 1000);
  if (length_m >= 0.1) return fmt::format("{:.3g} m", length_m);
  return fmt::format("{:.2g} mm", length_m * 1000);
}

std::string place_text(const glm::dvec3& p) {
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", p.x, p.y, p.z);
}

std::string percent_text(double share) {
  if (share < 1 && share > 0.99) return "over 99 %";
  if (share > 0 && share < 0.01) return "under 1 %";
  return fmt::format("{:.0f} %", 100 * share);
}

std::string object_text(const Object& object) {
  const SourcePlace& place = object.place;
  return fmt::format("\"{}\"{}", object.name,
                     place.line > 0 ? fmt::format(" ({}:{})", place.file, place.line) : "");
}

double luminous_mean(const Spectrum& spectrum) {
  return spectrum.integral_with(cie_y()) / cie_y().integral();
}

Finding sign_finding(Severity severity, const char* kind, const Sign& sign,
                     const std::string& what) {
  return {severity, kind, {sign.place, "sign \"" + sign.name + "\" " + what}};
}

bool no_buildings_size(const glm::dvec3& size) {
  const double largest = std::max({size.x, size.y, size.z});
  return largest < min_size_m || largest > max_size_m;
}

bool is_furniture(const Object& object) {
  return std::count(object.tags.begin(), object.tags.end(), "furniture") > 0;
}

std::vector<char> furniture_of(const Site& site) {
  std::vector<char> out;
  for (const Object& object : site.scene.objects) out.push_back(is_furniture(object) ? 1 : 0);
  return out;
}

std::optional<FacedSurface> solid_ahead(const Site& site, const GeometryAccess& access,
                                        const glm::dvec3& from, const glm::dvec3& direction,
                                        double length_m, bool furniture, int own_body) {
  return first_stop(site.building.scene(), access, site.building.local(from), Vec3(direction),
                    static_cast<Real>(length_m), [&](const FacedSurface& f) {
                      return f.surface >= site.scene.objects.size() || lets_light_through(f.kind) ||
                             (own_body != 0 && site.scene.objects[f.surface].body == own_body) ||
                             (!furniture && is_furniture(site.scene.objects[f.surface]));
                    });
}

Remoteness::Remoteness(const SceneDescription& scene) {
  Bounds all;
  for (const Object& object : scene.objects) {
    objects_.push_back(bounds_of(object.mesh));
    if (objects_.back().empty())
      objects_.pop_back();
    else
      all.extend(objects_.back());
  }
  if (all.empty()) return;
  const glm::dvec3 size = all.high - all.low;
  const double across = std::max(size.x, size.y);
  height_m_ = size.z > flat_share * across ? size.z : across;
}

std::optional<std::string> Remoteness::told(const std::string& subject,
                                            const glm::dvec3& place) const {
  if (objects_.empty()) return std::nullopt;
  const double most = heights_away * height_m_;
  double least = std::numeric_limits<double>::infinity();
  for (const Bounds& box : objects_) {
    least = std::min(least, distance_to(box, place));
    if (least <= most) return std::nullopt;
  }
  return fmt::format(
      "{} is {} from everything solid, more than ten times the building's height of {}: positions "
      "are in metres; is this one in millimetres, or the building in another unit?",
      subject, length_text(least), length_text(height_m_));
}

}  // namespace luxodus
