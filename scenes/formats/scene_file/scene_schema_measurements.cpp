// Keys of planes, probes, groups, observers and cameras.
#include "scenes/formats/scene_file/scene_schema.hpp"

namespace luxodus {

std::vector<TableSpec> measurement_schema() {
  return {
      {"plane",
       "`[[plane]]`: a grid of illuminance values",
       {
           {"name", "name", "", "required", "", "name of the plane"},
           {"corner", "point", "m", "required", "[-1e7, 1e7]", "corner where the cells begin"},
           {"edge_u", "point", "m", "required", "[-1e7, 1e7]", "first edge, from the corner"},
           {"edge_v", "point", "m", "required", "[-1e7, 1e7]",
            "second edge; light is counted on the side that cross(edge_u, edge_v) looks to"},
           {"cells", "pair", "", "", "[1, 10000]",
            "number of cells along the two edges, whole numbers; instead of `cell_m`"},
           {"cell_m", "number", "m", "", "[1e-3, 1e5]",
            "largest edge of a cell; instead of `cells`"},
       }},
      {"probe",
       "`[[probe]]`: illuminance at a point",
       {
           {"name", "name", "", "required", "", "name of the probe"},
           {"position", "point", "m", "required", "[-1e7, 1e7]", "where it is"},
           {"normal", "direction", "", "[0, 0, 1]", "[-1e7, 1e7]", "where it looks"},
       }},
      {"surface_group",
       "`[[surface_group]]`: flux of several surfaces as one number with its own error",
       {
           {"name", "name", "", "required", "", "name of the group"},
           {"objects", "texts", "", "required", "", "names or tags of objects"},
       }},
      {"volume_group",
       "`[[volume_group]]`: fluence of a region as one number with its own error",
       {
           {"name", "name", "", "required", "", "name of the group"},
           {"shape", "choice", "", "required", "box, sphere, shell, layer", "shape of the region"},
       }},
      {"volume_group.box",
       "`[[volume_group]]` with `shape = \"box\"`",
       {
           {"low", "point", "m", "required", "[-1e7, 1e7]", "lower corner"},
           {"high", "point", "m", "required", "[-1e7, 1e7]", "upper corner"},
       }},
      {"volume_group.sphere",
       "`[[volume_group]]` with `shape = \"sphere\"`",
       {
           {"centre", "point", "m", "required", "[-1e7, 1e7]", "centre"},
           {"radius", "number", "m", "required", "[1e-6, 1e7]", "radius"},
       }},
      {"volume_group.shell",
       "`[[volume_group]]` with `shape = \"shell\"`",
       {
           {"centre", "point", "m", "required", "[-1e7, 1e7]", "centre"},
           {"radius", "number", "m", "required", "[1e-6, 1e7]", "outer radius"},
           {"inner_radius", "number", "m", "required", "[0, 1e7]", "inner radius, below the outer"},
       }},
      {"volume_group.layer",
       "`[[volume_group]]` with `shape = \"layer\"`",
       {
           {"z_low", "number", "m", "required", "[-1e7, 1e7]", "lower height"},
           {"z_high", "number", "m", "required", "[-1e7, 1e7]", "upper height"},
       }},
      {"counting_plane",
       "`[[counting_plane]]`: particles that cross a parallelogram, both ways",
       {
           {"name", "name", "", "required", "", "name of the plane"},
           {"corner", "point", "m", "required", "[-1e7, 1e7]", "corner"},
           {"edge_u", "point", "m", "required", "[-1e7, 1e7]", "first edge, from the corner"},
           {"edge_v", "point", "m", "required", "[-1e7, 1e7]",
            "second edge; forward is along cross(edge_u, edge_v)"},
       }},
      {"observer",
       "`[[observer]]`: an eye that looks for signs",
       {
           {"name", "name", "", "required", "", "name of the observer"},
           {"eye", "point", "m", "required", "[-1e7, 1e7]", "where the eye is"},
           {"gaze", "direction", "", "", "[-1e7, 1e7]", "where it looks; instead of `target`"},
           {"target", "point", "m", "", "[-1e7, 1e7]", "a point it looks at; instead of `gaze`"},
       }},
      {"camera",
       "`[[camera]]`: a picture",
       {
           {"name", "name", "", "required", "", "name of the camera"},
           {"eye", "point", "m", "required", "[-1e7, 1e7]", "where it stands"},
           {"target", "point", "m", "required", "[-1e7, 1e7]", "the point in the middle"},
           {"up", "direction", "", "[0, 0, 1]", "[-1e7, 1e7]", "what is up in the picture"},
           {"vertical_fov_deg", "number", "deg", "60", "[0.1, 170]", "angle from bottom to top"},
           {"width", "integer", "px", "640", "[1, 16384]", "pixels across"},
           {"height", "integer", "px", "360", "[1, 16384]", "pixels down"},
           {"cut", "number", "m", "", "[-1e7, 1e7]",
            "height, below `eye`, above which nothing is shown: a building without its ceilings"},
       }},
  };
}

}  // namespace luxodus
