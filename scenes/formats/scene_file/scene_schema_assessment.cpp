// Keys of what `luxodus assess` assesses: routes, areas, points of emphasis, people.
#include "scenes/formats/scene_file/scene_schema.hpp"

namespace luxodus {

std::vector<TableSpec> assessment_schema() {
  return {
      {"assessment",
       "`[assessment]`: how people and smoke are taken to be",
       {
           {"age_years", "number", "years", "65", "[23, 75]", "of the eyes that look for signs"},
           {"other_eyes", "texts", "", "", "",
            "eyes that signs are judged for beside those: an age such as \"75\", \"protan\" (no "
            "cones for long wavelengths: red is darker), \"protan 75\""},
           {"eye_heights_m", "numbers", "m", "[1.65, 1.2, 0.6]", "[0.1, 2.5]",
            "above the floor: walking, stooping, crawling"},
           {"spacing_m", "number", "m", "2", "[0.1, 100]", "between observers along a route"},
           {"luminance_before", "number", "cd/m2", "100", "[0, 1000]",
            "of what eyes were adapted to before the mains failed; 100 is that of a room lit with "
            "500 lx. 0: eyes are adapted to the dark. It counts where a scenario states "
            "seconds_after_failure"},
           {"smoke_expected", "flag", "", "true", "",
            "smoke may occur where signs are: EN 1838 then asks for brighter ones"},
           {"irritant_smoke", "flag", "", "", "",
            "the smoke stings: from 0.25/m people see less than their eyes could (Jin and Yamada "
            "1985); needed where signs are judged in smoke"},
           {"rules", "texts", "", "", "",
            "rule sets that are judged by: en1838-2013, en1838-2024, nfpa101; none is assumed"},
           {"deviations", "texts", "", "", "",
            "national deviations from them: duration-3h, de-asr-a3.4-3, de-din4844-1, "
            "uk-bs5266-1, us-ibc, us-ibc-group-i2"},
       }},
      {"route",
       "`[[route]]`: an escape route",
       {
           {"name", "name", "", "required", "", "name of the route"},
           {"path", "points", "m", "required", "[-1e7, 1e7]",
            "its centre line on the floor, in the direction of escape; two points at least"},
           {"width", "number", "m", "required", "[0.3, 100]", "its width"},
       }},
      {"open_area",
       "`[[open_area]]`: a floor that people cross on no defined route",
       {
           {"name", "name", "", "required", "", "name of the area"},
           {"outline", "corners", "m", "required", "[-1e7, 1e7]", "corners [x, y] in order"},
           {"z", "number", "m", "0", "[-1e7, 1e7]", "height of the floor"},
           ifc_guid_key(),
       }},
      {"task_area",
       "`[[task_area]]`: a plane on which people work at a risk that outlasts the lights",
       {
           {"name", "name", "", "required", "", "name of the area"},
           {"outline", "corners", "m", "required", "[-1e7, 1e7]", "corners [x, y] in order"},
           {"z", "number", "m", "required", "[-1e7, 1e7]", "height of the task plane"},
           ifc_guid_key(),
           {"mains_lx", "number", "lx", "required", "(0, 1e6]",
            "illuminance that the task needs, maintained in mains operation"},
       }},
      {"room",
       "`[[room]]`: a room, by whose name reports list what it holds",
       {
           {"name", "name", "", "required", "", "name of the room"},
           {"outline", "corners", "m", "required", "[-1e7, 1e7]",
            "corners [x, y] in order; rooms of one storey do not overlap"},
           {"z", "number", "m", "0", "[-1e7, 1e7]", "height of the floor"},
           ifc_guid_key(),
       }},
      {"emphasis",
       "`[[emphasis]]`: a place that an emergency luminaire must be near to",
       {
           {"name", "name", "", "required", "", "name of the place"},
           {"kind", "choice", "", "required",
            "exit_door, final_exit, stairs, level_change, direction_change, intersection, "
            "first_aid, fire_equipment, call_point, alarm_panel, refuge",
            "what is there"},
           {"position", "point", "m", "required", "[-1e7, 1e7]", "where it is"},
           {"facing", "direction", "", "", "[-1e7, 1e7]",
            "where the front of equipment looks; without it its vertical illuminance is not "
            "assessed"},
           ifc_guid_key(),
       }},
  };
}

}  // namespace luxodus
