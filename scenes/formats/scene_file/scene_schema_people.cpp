// Keys of people who walk.
#include "scenes/formats/scene_file/scene_schema.hpp"

namespace luxodus {

std::vector<TableSpec> people_schema() {
  return {
      {"people",
       "`[[people]]`: people whose ways `luxodus walk` follows; light knows nothing of them",
       {
           {"name", "name", "", "required", "", "of the group, in tables and maps"},
           {"file", "path", "", "required", "",
            "trajectories: SQLite or HDF5 of JuPedSim, text of PeTrack, CSV or JSON of Pathfinder, "
            "told apart by content; relative to the scene file"},
           {"turn_deg", "number", "deg", "0", "[-360, 360]",
            "turn of the file's coordinates about their origin, counter-clockwise seen from above"},
           {"shift", "point", "m", "[0, 0, 0]", "[-1e7, 1e7]",
            "added to the coordinates after the turn; z only where the file has heights"},
           {"time_shift_s", "number", "s", "0", "[-1e7, 1e7]",
            "added to the file's times, to give those of the scene's clock"},
           {"floor_m", "number", "m", "0", "[-1e7, 1e7]",
            "height of the floor where the file has no heights (all but Pathfinder's, and "
            "JuPedSim's HDF5 of schema 2)"},
           {"storey", "tables", "", "", "",
            "storeys that such a file draws beside each other, instead of `floor_m`"},
           {"eye_height_m", "number", "m", "", "[0.1, 3]",
            "of the eyes above the floor; without it the first of `eye_heights_m`"},
           {"luminance_before", "number", "cd/m2", "", "[0, 1000]",
            "mean luminance of the view from which these people come; without it that of "
            "`[assessment]`"},
       }},
      {"people.storey",
       "`[[people.storey]]`: a storey in a file of trajectories without heights",
       {
           {"low", "pair", "m", "required", "[-1e7, 1e7]",
            "lower left corner of the storey's box, in the file's coordinates"},
           {"high", "pair", "m", "required", "[-1e7, 1e7]", "upper right corner"},
           {"floor_m", "number", "m", "required", "[-1e7, 1e7]",
            "height of its floor in the scene"},
           {"shift", "pair", "m", "[0, 0]", "[-1e7, 1e7]",
            "added to the file's coordinates in the box before `turn_deg`, so that storeys lie "
            "above each other"},
       }},
  };
}

}  // namespace luxodus
