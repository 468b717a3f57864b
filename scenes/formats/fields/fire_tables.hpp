// Objects of a fire simulation's building as tables of a scene file: boxes and quads with names of
// their own, and the materials that they name, by surface and colour. One thread.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace luxodus {

/// What a surface of a fire simulation looks like in Smokeview, which is for display.
struct FireMaterial {
  std::string name;     // of the scene
  glm::dvec3 rgb{0.5};  // encoded sRGB, 0 to 1
  double opacity = 1;   // of display; what FDS calls TRANSPARENCY
};

/// `[[material]]` of it, with its colour as reflectance.
std::string material_table(const FireMaterial& material);

namespace fds {

/// The surface of an object, and its own colour where it has one.
struct FireLook {
  std::string surface;
  glm::dvec3 surface_rgb{0.5};
  std::optional<glm::dvec3> rgb;
  double opacity = 1;
};

/// When an object comes and goes [s]; always there where both are empty.
struct FireTimes {
  std::vector<double> appears, vanishes;
};
/// An object comes or goes [s].
struct FireTurn {
  double at_s = 0;
  bool appears = false;
};
/// As a scene may state it: each change once, none beyond the times that scenes have. Of several at
/// one time the last counts. `turns`: in the order in which they happen at one time.
FireTimes times_of_turns(std::vector<FireTurn> turns);

/// A name that a scene takes: no quotes, slashes, control characters, outer blanks or leading dot.
std::string scene_name(const std::string& name, const std::string& otherwise);

class FireTables {
 public:
  /// The name of a material that looks so.
  const std::string& material(const FireLook& look);
  /// `base`, or with a number where that is taken.
  std::string name(const std::string& base);

  void box(const std::string& base, const glm::dvec3& low, const glm::dvec3& high,
           const FireLook& look, const FireTimes& times = {});
  void quad(const std::string& base, const glm::dvec3& corner, const glm::dvec3& edge_u,
            const glm::dvec3& edge_v, const FireLook& look, const FireTimes& times = {});
  /// A box without thickness across an axis.
  void plate(const std::string& base, const glm::dvec3& low, const glm::dvec3& high, int across,
             const FireLook& look, const FireTimes& times = {});
  /// A rectangle on a face of a mesh, which looks into the mesh: 0 to 5, low x, high x, low y...
  void face(int face, const glm::dvec3& low, const glm::dvec3& high, const FireLook& look);

  /// How many there are, their [[object]] tables, and the materials that they name.
  size_t objects() const { return objects_; }
  const std::string& text() const { return text_; }
  const std::vector<FireMaterial>& materials() const { return materials_; }

 private:
  void object(const std::string& base, const std::string& shape, const FireLook& look,
              const FireTimes& times);

  std::string text_;
  size_t objects_ = 0;
  std::vector<FireMaterial> materials_;
  std::map<std::string, size_t> places_;  // in materials_, by what they look like
  std::set<std::string> material_names_{"open"}, object_names_;
  std::map<std::string, size_t> numbers_;
};

}  // namespace fds
}  // namespace luxodus
