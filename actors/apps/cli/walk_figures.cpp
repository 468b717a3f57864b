#include "actors/apps/cli/walk_figures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "actors/import/import_files.hpp"

namespace luxodus::cli {

namespace {

/// A body is a cylinder as wide as those that hide signs, up to the chin; the head is a ball
/// about the eyes [m]. Coarse meshes do for silhouettes.
constexpr double head_radius_m = 0.13, shoulders_below_eyes_m = 0.12;
constexpr double mesh_tolerance_m = 0.01;
/// Clothes. They have the tags "people" and "furniture": routes pass them, and the codes, which
/// judge light without what stands around, ignore them.
constexpr const char* material = "grey20";

std::string body_of(const std::string& name, const PersonAt& at, double eye_height_m) {
  const auto object = [&](const char* part, const char* shape, double radius_m, double z,
                          const std::string& more) {
    return fmt::format(
        "\n[[object]]\nname = {}\nshape = \"{}\"\nradius = {}\n{}mesh_tolerance_m = {}\n"
        "material = \"{}\"\none_patch = true\ntags = [\"people\", \"furniture\"]\ntranslate = "
        "[{:.4f}, {:.4f}, "
        "{:.4f}]\n",
        toml_text(name + " " + part), shape, radius_m, more, mesh_tolerance_m, material, at.foot.x,
        at.foot.y, z);
  };
  return object("body", "cylinder", body_radius_m, at.foot.z,
                fmt::format("height = {}\n",
                            std::max(eye_height_m - shoulders_below_eyes_m, head_radius_m))) +
         object("head", "sphere", head_radius_m, at.foot.z + eye_height_m, "");
}

}  // namespace

std::string figures_scene(const std::filesystem::path& scene,
                          const std::vector<PlacedPerson>& people, double time_s) {
  std::string out = fmt::format(
      "# People as bodies at {} s, written by luxodus walk --figures.\n"
      "include = [{}]\n",
      time_s, toml_text(std::filesystem::absolute(scene).string()));
  for (const PlacedPerson& one : people)
    if (is_present(one, time_s))
      out += body_of(fmt::format("{} {}", one.group, one.id), person_at(one, time_s),
                     one.eye_height_m);
  return out;
}

std::string figures_file(double time_s) {
  return fmt::format("figures/{}s.toml", time_s);
}

}  // namespace luxodus::cli
