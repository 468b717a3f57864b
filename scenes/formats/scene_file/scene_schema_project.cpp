// Keys of a report's project.
#include "scenes/formats/scene_file/scene_schema.hpp"

namespace luxodus {

std::vector<TableSpec> project_schema() {
  return {
      {"project",
       "`[project]`: what reports say of the project",
       {
           {"name", "text", "", "", "", "of the project: the title of the report"},
           {"client", "text", "", "", "", "who ordered it"},
           {"address", "text", "", "", "", "of the building"},
           {"document", "text", "", "", "", "number of the document, also in the footer"},
           {"revision", "text", "", "", "", "of the document, also in the footer"},
           {"date", "text", "", "", "", "of the document; quoted, or a TOML date"},
           {"author", "text", "", "", "", "who made the calculation"},
           {"checker", "text", "", "", "", "who checked it"},
           {"logo", "path", "", "", "",
            "PNG picture of at most 4 MiB and 2000 pixels a side, relative to the scene file"},
           {"north_deg", "number", "deg", "0", "[-360, 360]",
            "direction of north on plans, from +y towards +x, seen from above"},
       }},
      {"backdrop",
       "`[[backdrop]]`: a drawing that lies faintly under plans, in reports and in the live view; "
       "light knows nothing of it",
       {
           {"file", "path", "", "required", "",
            "PNG picture of at most 4 MiB and 3000 pixels a side, or DXF drawing in text, relative "
            "to the scene file"},
           {"origin", "pair", "m", "[0, 0]", "[-1e7, 1e7]",
            "where the picture's lower left corner, or the drawing's origin, is in the scene"},
           {"metres_per_pixel", "number", "m", "", "(0, 100]",
            "length of a pixel; required for a picture"},
           {"units", "choice", "", "", "m, cm, mm, km, in, ft",
            "unit of length of a drawing; that of its header unless said"},
           {"rotation_deg", "number", "deg", "0", "[-360, 360]",
            "turn about `origin`, counter-clockwise seen from above"},
           {"floors", "pair", "m", "", "[-1e7, 1e7]",
            "lowest and highest floor under whose plan it lies; all unless said"},
       }},
  };
}

}  // namespace luxodus
