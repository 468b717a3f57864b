// Keys of objects written in the scene file and of imported files.
#include "scenes/formats/scene_file/scene_schema.hpp"

namespace luxodus {

namespace {

using Keys = std::vector<KeySpec>;

Keys transform_keys() {
  return {
      {"translate", "point", "m", "[0, 0, 0]", "[-1e7, 1e7]", "moved by, after the turn"},
      {"rotate_deg", "point", "deg", "[0, 0, 0]", "[-360, 360]",
       "turned about the scene's x, then y, then z axis"},
      {"scale", "scale", "", "1", "[1e-6, 1e6]", "scaled first: one number or three"},
  };
}

Keys surface_keys() {
  return {
      {"back_material", "text", "", "", "", "material seen from behind the triangles"},
      {"patch_edge_m", "number", "m", "", "[0, 1e4]",
       "longest edge of a flux patch; 0: one patch per triangle; the scene's default unless said"},
      {"one_patch", "flag", "", "false", "",
       "count flux for all of it together, a patch a side: for the many small things whose own "
       "brightness nobody asks for; instead of `patch_edge_m`"},
      {"tags", "texts", "", "", "", "words that surface groups may name, such as \"furniture\""},
      {"group", "name", "", "", "", "surface group it belongs to"},
      {"body_of", "texts", "", "", "",
       "names of the luminaires whose measured body it is a part of: their own light passes it on "
       "its way from them, since their intensities lack its shadow already; all other light meets "
       "it"},
  };
}

KeySpec round_key() {
  return {"mesh_tolerance_m",
          "number",
          "m",
          "0.002",
          "[1e-6, 10]",
          "largest distance between the mesh and the true surface",
          "bound_m"};
}

std::vector<TableSpec> flat_shapes() {
  return {
      {"object.quad",
       "`[[object]]` with `shape = \"quad\"`: a parallelogram, front towards cross(edge_u, edge_v)",
       {
           {"corner", "point", "m", "required", "[-1e7, 1e7]", "a corner"},
           {"edge_u", "point", "m", "required", "[-1e7, 1e7]", "first edge, from the corner"},
           {"edge_v", "point", "m", "required", "[-1e7, 1e7]", "second edge"},
       }},
      {"object.box",
       "`[[object]]` with `shape = \"box\"`: seen from outside",
       {
           {"low", "point", "m", "required", "[-1e7, 1e7]", "lower corner"},
           {"high", "point", "m", "required", "[-1e7, 1e7]", "upper corner"},
       }},
      {"object.room",
       "`[[object]]` with `shape = \"room\"`: seen from inside; becomes the objects NAME.floor, "
       "NAME.ceiling, NAME.x0, NAME.x1, NAME.y0, NAME.y1, which all bear the tag NAME",
       {
           {"low", "point", "m", "required", "[-1e7, 1e7]", "lower corner"},
           {"high", "point", "m", "required", "[-1e7, 1e7]", "upper corner"},
           {"floor", "text", "", "", "", "material of the floor, instead of `material`"},
           {"ceiling", "text", "", "", "", "material of the ceiling"},
           {"walls", "text", "", "", "", "material of the walls"},
           {"omit", "texts", "", "", "",
            "faces left out: floor, ceiling, x0, x1, y0, y1 (the wall at low x, high x, ...)"},
       }},
      {"object.polygon",
       "`[[object]]` with `shape = \"polygon\"`: a level area, front up",
       {
           {"outline", "corners", "m", "required", "[-1e7, 1e7]", "corners [x, y] in order"},
           {"z", "number", "m", "0", "[-1e7, 1e7]", "height"},
       }},
      {"object.prism",
       "`[[object]]` with `shape = \"prism\"`: a closed body over an outline, seen from outside",
       {
           {"outline", "corners", "m", "required", "[-1e7, 1e7]", "corners [x, y] in order"},
           {"z", "number", "m", "0", "[-1e7, 1e7]", "height of its foot"},
           {"height", "number", "m", "required", "(0, 1e7]", "height"},
       }},
      {"object.wall",
       "`[[object]]` with `shape = \"wall\"`: a solid wall to the left of the way from `from` to "
       "`to`",
       {
           {"from", "point", "m", "required", "[-1e7, 1e7]", "foot of its start"},
           {"to", "point", "m", "required", "[-1e7, 1e7]", "foot of its end, as high as `from`"},
           {"height", "number", "m", "required", "(0, 1e5]", "height"},
           {"thickness", "number", "m", "required", "(0, 20]", "thickness"},
           {"opening", "tables", "", "", "", "holes, see below"},
       }},
      {"object.opening",
       "`[[object.opening]]`: a hole through a wall",
       {
           {"at", "number", "m", "required", "[0, 1e5]", "distance from the wall's start"},
           {"sill", "number", "m", "0", "[0, 1e5]", "height above the wall's foot; 0: a door"},
           {"width", "number", "m", "required", "(0, 1e5]", "width"},
           {"height", "number", "m", "required", "(0, 1e5]", "height"},
       }},
      {"object.stairs",
       "`[[object]]` with `shape = \"stairs\"`: climbs along local +x from the origin, y from 0 to "
       "width",
       {
           {"steps", "integer", "", "required", "[1, 500]", "number of steps"},
           {"rise", "number", "m", "required", "(0, 1]", "height of a step"},
           {"going", "number", "m", "required", "(0, 5]", "depth of a step"},
           {"width", "number", "m", "required", "(0, 1e3]", "width of the flight"},
           {"underside", "choice", "", "\"solid\"", "none, solid, soffit",
            "a folded sheet, a block, or a slanted underside"},
       }},
      {"object.ramp",
       "`[[object]]` with `shape = \"ramp\"`: climbs along local +x from the origin, y from 0 to "
       "width",
       {
           {"length", "number", "m", "required", "(0, 1e5]", "horizontal length"},
           {"width", "number", "m", "required", "(0, 1e4]", "width"},
           {"rise", "number", "m", "required", "(0, 1e4]", "height at the end"},
           {"underside", "choice", "", "\"solid\"", "none, solid", "a sheet or a block"},
       }},
  };
}

std::vector<TableSpec> round_shapes() {
  return {
      {"object.cylinder",
       "`[[object]]` with `shape = \"cylinder\"`: from local z = 0 up, seen from outside",
       {
           {"radius", "number", "m", "required", "(0, 1e5]", "radius"},
           {"height", "number", "m", "required", "(0, 1e5]", "height"},
           {"caps", "flag", "", "true", "", "closed at both ends"},
           round_key(),
       }},
      {"object.disc",
       "`[[object]]` with `shape = \"disc\"`: about the local origin, front up",
       {{"radius", "number", "m", "required", "(0, 1e5]", "radius"}, round_key()}},
      {"object.tube",
       "`[[object]]` with `shape = \"tube\"`: a pipe from local z = 0 up",
       {
           {"outer_radius", "number", "m", "required", "(0, 1e5]", "outer radius"},
           {"inner_radius", "number", "m", "required", "(0, 1e5]", "inner radius"},
           {"length", "number", "m", "required", "(0, 1e5]", "length"},
           round_key(),
       }},
      {"object.sphere",
       "`[[object]]` with `shape = \"sphere\"`: about the local origin, seen from outside",
       {{"radius", "number", "m", "required", "(0, 1e5]", "radius"}, round_key()}},
  };
}

}  // namespace

std::vector<TableSpec> object_schema() {
  std::vector<TableSpec> all = {
      {"object",
       "`[[object]]`: a surface or body; its local coordinates are the scene's, then transformed",
       joined(
           joined({{"name", "name", "", "required", "", "name of the object"},
                   {"shape", "choice", "", "required",
                    "quad, box, room, polygon, prism, wall, stairs, ramp, cylinder, disc, tube, "
                    "sphere",
                    "what it is"},
                   {"material", "text", "", "required", "", "name of a material, or a named grey"}},
                  surface_keys()),
           joined(transform_keys(),
                  {repeat_key(),
                   {"door", "table", "", "", "", "makes it a leaf that turns"},
                   {"appears_at", "numbers", "s", "", "[-1e6, 1e6]",
                    "times of the scene's clock at which it comes; what first appears was not "
                    "there before"},
                   {"vanishes_at", "numbers", "s", "", "[-1e6, 1e6]",
                    "times at which it goes: a curtain that falls, a wall that breaks"}}))},
  };
  for (auto& t : flat_shapes()) all.push_back(std::move(t));
  for (auto& t : round_shapes()) all.push_back(std::move(t));
  all.push_back({"object.door",
                 "`[object.door]`, `[import.part.door]`: a door leaf, drawn closed",
                 {
                     {"hinge", "point", "m", "required", "[-1e7, 1e7]",
                      "a point of the hinge, scene coordinates"},
                     {"axis", "direction", "", "[0, 0, 1]", "[-1e7, 1e7]",
                      "of the hinge; the leaf turns right-handed about it"},
                     {"open_angle_deg", "number", "deg", "90", "[-360, 360]", "how far it opens"},
                     {"open", "flag", "", "false", "", "state unless a scenario says otherwise"},
                 }});
  all.push_back(
      {"import",
       "`[[import]]`: an OBJ or glTF 2.0 file; becomes one object NAME.PART for each of its parts, "
       "which "
       "all bear the tag NAME",
       joined(
           joined(
               {{"name", "name", "", "required", "", "name, which opens the names of its parts"},
                {"file", "path", "", "required", "",
                 "the .obj, .gltf or .glb file; the lamps of a glTF that holds nothing else become "
                 "emitters NAME.LAMP, lit by the mains"},
                {"units", "choice", "", "required", "m, cm, mm, km, in, ft",
                 "unit of length of the file (glTF: m)"},
                {"up", "choice", "", "required", "y, z",
                 "axis that points up in the file (glTF: y)"},
                {"materials", "words", "", "", "",
                 "table: material of the file = material of the scene"},
                {"material", "text", "", "", "", "material of parts that the table does not name"},
                {"file_colours", "flag", "", "false", "",
                 "parts that neither names are Lambertian in the colour of the file; a material "
                 "whose "
                 "colour it does not say, or has in a picture, is an error"}},
               surface_keys()),
           joined(
               transform_keys(),
               {repeat_key(), {"part", "tables", "", "", "", "what is said of single parts"}}))});
  all.push_back({"import.part", "`[[import.part]]`: replaces for some parts what the import says",
                 joined({{"match", "text", "", "required", "",
                          "name of a part in the file; `*` stands for any characters"},
                         {"omit", "flag", "", "false", "", "leave it out"},
                         {"material", "text", "", "", "", "material"}},
                        joined(surface_keys(),
                               {{"door", "table", "", "", "", "makes it a leaf that turns"}}))});
  all.push_back(
      {"repeat",
       "`[[object.repeat]]`, `[[import.repeat]]`, `[[luminaire.repeat]]`, `[[emitter.repeat]]`: a "
       "row of copies; each further one repeats all that the ones before have made",
       {
           {"count", "integer", "", "required", "[1, 100000]", "how many, the original included"},
           {"step", "point", "m", "required", "[-1e7, 1e7]", "from one to the next"},
       }});
  return all;
}

KeySpec repeat_key() {
  return {"repeat", "tables", "", "", "", "copies in a row, or in rows of rows; see below"};
}

}  // namespace luxodus
