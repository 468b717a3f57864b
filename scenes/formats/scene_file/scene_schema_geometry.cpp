// Top-level keys, and keys of materials, objects and imported files.
#include "scenes/formats/scene_file/scene_schema.hpp"

namespace luxodus {

namespace {

TableSpec scene_keys() {
  return {
      "scene",
      "Top of the file",
      {
          {"name", "name", "", "", "",
           "name of the scene; the file's name without `.toml` unless said"},
          {"title", "text", "", "\"\"", "", "a line for people"},
          {"include", "paths", "", "", "",
           "scene files read before this one, relative to it; what this file says at its top and "
           "in "
           "`[run]` wins, lists of tables add up"},
          {"patch_edge_m", "number", "m", "0.5", "[0, 1e4]",
           "longest edge of a flux patch where an object does not say its own; 0: one patch per "
           "triangle"},
          {"open_sides", "texts", "", "[]", "west, east, south, north, bottom, top",
           "sides of the bounding box (-x, +x, -y, +y, -z, +z) through which light is meant to "
           "leave: no warning that rooms are not closed there"},
          {"people_as_bodies", "flag", "", "false", "",
           "people of `[[people]]` stand as bodies where they are at the time of the state, for "
           "pictures and films; needs `[time]` or `--at`"},
          {"run", "table", "", "", "", "settings of a run"},
          {"material", "tables", "", "", "", "materials"},
          {"object", "tables", "", "", "", "surfaces written in the file"},
          {"import", "tables", "", "", "", "OBJ and glTF files"},
          {"luminaire_type", "tables", "", "", "", "what several luminaires have in common"},
          {"luminaire", "tables", "", "", "", "luminaires of photometric files"},
          {"emitter", "tables", "", "", "", "light sources of simple shape"},
          {"sign_type", "tables", "", "", "", "what several signs have in common"},
          {"sign", "tables", "", "", "", "safety signs"},
          {"medium", "tables", "", "", "", "smoke and flames"},
          {"plane", "tables", "", "", "", "grids of illuminance"},
          {"probe", "tables", "", "", "", "illuminance at points"},
          {"surface_group", "tables", "", "", "", "several surfaces as one number"},
          {"volume_group", "tables", "", "", "", "regions as one number"},
          {"counting_plane", "tables", "", "", "", "particles that cross"},
          {"observer", "tables", "", "", "", "eyes"},
          {"camera", "tables", "", "", "", "pictures"},
          {"assessment", "table", "", "", "", "how people and smoke are taken to be"},
          {"project", "table", "", "", "", "what reports say of the project"},
          {"backdrop", "tables", "", "", "", "drawings that lie under plans"},
          {"people", "tables", "", "", "", "people who walk, for `luxodus walk`"},
          {"route", "tables", "", "", "", "escape routes"},
          {"open_area", "tables", "", "", "", "floors without a defined route"},
          {"task_area", "tables", "", "", "", "places of high-risk work"},
          {"emphasis", "tables", "", "", "", "what emergency luminaires must be near to"},
          {"room", "tables", "", "", "", "names of rooms, for lists and plans"},
          {"design", "table", "", "", "", "where emergency luminaires may be placed"},
          {"time", "table", "", "", "",
           "states that are assessed one after another, and the clock"},
          {"scenario", "tables", "", "", "", "states of the building; none: mains, as written"},
          {"change", "tables", "", "", "", "what a variant changes in the files it includes"},
      }};
}

std::vector<TableSpec> material_keys() {
  const KeySpec reflectance = {"reflectance", "reflectance", "",
                               "required",    "[0, 1]",      "diffuse reflectance"};
  const KeySpec image = {
      "image", "path", "",
      "",      "",     "PNG that multiplies the reflectance; objects need texture coordinates"};
  return {
      {"material",
       "`[[material]]`",
       {
           {"name", "name", "", "required", "", "name of the material"},
           {"kind", "choice", "", "\"lambertian\"",
            "lambertian, glossy, mirror, glass, dielectric, open", "how light leaves the surface"},
           {"back", "text", "", "", "",
            "material seen from behind; the same unless said here or by the object"},
       }},
      {"material.lambertian",
       "`[[material]]` with `kind = \"lambertian\"`: the same radiance all ways",
       {reflectance, image}},
      {"material.glossy",
       "`[[material]]` with `kind = \"glossy\"`: a diffuse part and a GGX lobe",
       {
           reflectance,
           {"specular", "reflectance", "", "required", "[0, 1]",
            "share reflected in the lobe; with `reflectance` at most 1"},
           {"roughness", "number", "", "0.3", "(0, 1]", "width of the lobe (GGX alpha)"},
           image,
       }},
      {"material.mirror",
       "`[[material]]` with `kind = \"mirror\"`",
       {{"specular", "reflectance", "", "required", "[0, 1]", "share reflected"}}},
      {"material.glass",
       "`[[material]]` with `kind = \"glass\"`: a thin pane, light goes straight on",
       {
           {"ior", "number", "", "1.52", "[1, 4]", "refractive index"},
           {"transmittance", "reflectance", "", "1", "[0, 1]",
            "internal transmittance of one pass, without the reflections at the surfaces"},
       }},
      {"material.dielectric",
       "`[[material]]` with `kind = \"dielectric\"`: the refracting surface of a solid",
       {{"ior", "number", "", "1.52", "[1, 4]", "refractive index behind the front side"}}},
      {"material.open",
       "`[[material]]` with `kind = \"open\"`: nothing is there, fluxes are counted",
       {}},
  };
}

}  // namespace

std::vector<TableSpec> geometry_schema() {
  std::vector<TableSpec> all = {scene_keys(), run_keys()};
  for (auto& t : material_keys()) all.push_back(std::move(t));
  for (auto& t : object_schema()) all.push_back(std::move(t));
  return all;
}

}  // namespace luxodus
