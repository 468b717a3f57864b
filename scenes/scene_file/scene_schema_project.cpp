// Keys of what a report says of its project.
#include "scenes/scene_file/scene_schema.hpp"

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
  };
}

}  // namespace luxodus
