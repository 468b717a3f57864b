// Writes objects of a fire simulation's building as tables of a scene file: boxes and quads with
// unique names, and the materials that they name, by surface and colour. Each FireTables is used by
// one thread; the free functions are pure.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace luxodus {

/// How Smokeview shows a surface of a fire simulation; for display only.
struct FireMaterial {
  std::string name;     // in the scene
  glm::dvec3 rgb{0.5};  // encoded sRGB, 0 to 1
  double opacity = 1;   // for display; FDS calls it TRANSPARENCY
};

/// Its `[[material]]` table, with the colour as reflectance.
std::string material_table(const FireMaterial& material);

namespace fds {

/// The surface of an object, and its own colour if it has one.
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
/// The changes as a scene may state them: each once, none beyond a scene's range of times. Of
/// several at one time the last counts. `turns`: those at one time in the order in which they
/// happen.
FireTimes times_of_turns(std::vector<FireTurn> turns);

/// Makes a name that scenes accept: no quotes, slashes, control characters, outer blanks or leading
/// dot.
std::string scene_name(const std::string& name, const std::string& otherwise);

class FireTables {
 public:
  /// Name of the material with this look.
  const std::string& material(const FireLook& look);
  /// `base`, with a number appended if it is taken.
  std::string name(const std::string& base);

  void box(const std::string& base, const glm::dvec3& low, const glm::dvec3& high,
           const FireLook& look, const FireTimes& times = {});
  void quad(const std::string& base, const glm::dvec3& corner, const glm::dvec3& edge_u,
            const glm::dvec3& edge_v, const FireLook& look, const FireTimes& times = {});
  /// Adds a box without thickness across an axis.
  void plate(const std::string& base, const glm::dvec3& low, const glm::dvec3& high, int across,
             const FireLook& look, const FireTimes& times = {});
  /// Adds a rectangle on a face of a mesh, which faces into the mesh: 0 to 5, low x, high x, low
  /// y...
  void face(int face, const glm::dvec3& low, const glm::dvec3& high, const FireLook& look);

  /// The number of objects, their [[object]] tables, and the materials that they name.
  size_t objects() const { return objects_; }
  const std::string& text() const { return text_; }
  const std::vector<FireMaterial>& materials() const { return materials_; }

 private:
  void object(const std::string& base, const std::string& shape, const FireLook& look,
              const FireTimes& times);

  std::string text_;
  size_t objects_ = 0;
  std::vector<FireMaterial> materials_;
  std::map<std::string, size_t> places_;  // index in materials_, by look
  std::set<std::string> material_names_{"open"}, object_names_;
  std::map<std::string, size_t> numbers_;
};

}  // namespace fds
}  // namespace luxodus
