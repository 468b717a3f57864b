// An upper bound of disability glare that takes no shadow rays: as if nothing, neither solids nor
// smoke, stood before the lamps. Most views are decided at both ends of it. Immutable once made;
// any thread.
#pragma once

#include <vector>

#include "actors/judge/assess/arriving_beside.hpp"
#include "actors/judge/inspect/building.hpp"
#include "scenes/light/transport/compiled_scene.hpp"

namespace luxodus {

class GlareBound {
 public:
  /// Requires: the building outlives this.
  explicit GlareBound(const Building& building);

  /// Veiling luminance by mixture, at most, of an eye of this age that looks at the centre of a
  /// sign, whose own light does not count [cd/m2]. Infinite for an eye beside or within an emitter.
  std::vector<double> at(const glm::dvec3& eye, const glm::dvec3& centre, uint32_t sign,
                         double age_years, const GroupFactors& factors) const;

 private:
  struct Source {
    glm::dvec3 centre{0}, axis{0, 0, 1};  // local
    double radius_m = 0;
    size_t group = 0;
    uint32_t sign = none_index;     // in the description
    std::vector<double> intensity;  // at most, by angle from the axis, in equal steps [cd]
  };
  static Source source_of(const CompiledScene& scene, const GeometryAccess& access,
                          uint32_t emitter);

  const Building& building_;
  std::vector<Source> sources_;
};

}  // namespace luxodus
