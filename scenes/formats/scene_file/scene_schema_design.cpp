// Keys of what `luxodus design` places.
#include "scenes/formats/scene_file/scene_schema.hpp"

namespace luxodus {

std::vector<TableSpec> design_schema() {
  return {
      {"design",
       "`[design]`: where `luxodus design` may place emergency luminaires, and what it seeks",
       {
           {"type", "tables", "", "", "",
            "luminaires that may be placed; none: the emergency luminaires of the scene that look "
            "down, and where it has none a generic one of 200 lm"},
           {"over", "texts", "", "[]", "",
            "names of the routes, open areas and task areas over which luminaires are placed; "
            "none: all of them"},
           {"spacing_m", "number", "m", "1", "[0.1, 20]", "between candidate places"},
           {"wall_clearance_m", "number", "m", "0.3", "[0, 10]",
            "nearest that a place may be to a wall or another body beside it"},
           {"sign_clearance_m", "number", "m", "0.3", "[0, 10]",
            "nearest that a place may be to a sign, seen from above"},
           {"drop_m", "number", "m", "0.03", "[0, 20]",
            "of the luminous opening below the ceiling that is met above the floor"},
           {"mounting_height_m", "number", "m", "", "[0.1, 100]",
            "of luminous openings above the floor, where they do not hang by `drop_m`"},
           {"wall_height_m", "number", "m", "2.3", "[0.1, 50]",
            "of luminaires on walls above the floor, for types that hang there"},
           {"places", "points", "m", "", "[-1e7, 1e7]",
            "candidate places, listed instead of the grid"},
           {"keep_out", "tables", "", "", "", "where nothing is mounted"},
           {"existing", "choice", "", "\"fixed\"", "fixed, removable, removed, movable",
            "what becomes of the emergency luminaires of the scene: they stay, they may go, they "
            "go, they stay or are moved"},
           {"fixed", "texts", "", "[]", "", "names of luminaires that stay, whatever `existing`"},
           {"movable", "texts", "", "[]", "",
            "names of those that stay where they are or are moved to a place of a new one on their "
            "storey, likewise"},
           {"move_cost", "number", "", "", "(0, 1e9]",
            "of moving one luminaire, in the unit of `objective`; without it a quarter of the "
            "least that a new luminaire adds"},
           {"removable", "texts", "", "[]", "", "names of those that may go, likewise"},
           {"removed", "texts", "", "[]", "", "names of those that go, likewise"},
           {"place_signs", "flag", "", "", "",
            "whether signs are placed, too; unless said they are where the scene has no sign or a "
            "`[[design.sign]]` is stated"},
           {"sign", "tables", "", "", "",
            "signs that may be placed; none: the upright signs of the scene, each kind once, and "
            "where it has none a generic one, lit from within, of 0.5 x 0.2 m"},
           {"sign_height_m", "number", "m", "2.2", "[0.1, 50]",
            "of the lower edge of signs above the floor; lower where a ceiling asks for it"},
           {"sign_spacing_m", "number", "m", "5", "[0.5, 100]",
            "between places along routes where signs may hang under ceilings"},
           {"existing_signs", "choice", "", "\"fixed\"", "fixed, removable, removed",
            "what becomes of the signs of the scene, where signs are placed"},
           {"failure", "choice", "", "\"two\"", "none, two, full",
            "what holds when any one luminaire has failed: nothing; two luminaires over each route "
            "and area, and no place below 0.1 lx; the minima of the rules"},
           {"margin", "number", "", "1.25", "[1, 10]",
            "planned minima of illuminance over those of the rules"},
           {"place_tolerance_m", "number", "m", "0.25", "[0, 2]",
            "how far off new luminaires may be mounted, all of them and each in its worst "
            "direction, while the minima of the rules hold, without `margin`"},
           {"refine", "flag", "", "false", "",
            "moves what was placed by up to half of `spacing_m`, where minima are kept with more "
            "to "
            "spare then"},
           {"objective", "choice", "", "\"number\"", "number, cost, watts, weighted",
            "what is made as small as can be"},
           {"weight_number", "number", "", "1", "[0, 1e6]",
            "of one luminaire in the objective `weighted`"},
           {"weight_cost", "number", "", "0", "[0, 1e6]", "of one unit of `cost`, likewise"},
           {"weight_watts", "number", "", "0", "[0, 1e6]", "of one watt, likewise"},
           {"in_smoke", "texts", "", "[]", "",
            "scenarios with smoke in which the best layout and others that pass the rules are "
            "judged by what people on the routes read of the signs; none: nothing is judged in "
            "smoke"},
           {"alternatives", "integer", "", "8", "[0, 24]",
            "other layouts that are judged in smoke, up to 30 % above the objective of the best"},
       }},
      {"design.type", "`[[design.type]]`: a luminaire that may be placed",
       joined({{"name", "name", "", "required", "", "name of the type"},
               {"like", "text", "", "", "",
                "luminaire or emitter of the scene whose light it has, instead of `file` and all "
                "that goes with it"},
               {"cost", "number", "", "1", "[0, 1e9]",
                "of one, installed, with what it costs over its life"},
               {"watts", "number", "W", "0", "[0, 1e6]", "that one takes"},
               {"turns_deg", "numbers", "deg", "", "[-360, 360]",
                "turns about its aim that are tried, from the direction of the route below (over "
                "areas from +x); without it 0 and 90 of those whose light has a direction, else 0"},
               {"battery", "choice", "", "", "self-contained, central",
                "what supplies it when the mains fail, for its class in schedules (EN 60598-2-22: "
                "`X 0 60`); a type whose `duration_h` is shorter than the rules ask for is not "
                "placed"},
               {"mount", "choice", "", "\"ceiling\"", "ceiling, wall, both",
                "where it hangs: under ceilings, or on walls beside routes and around areas"},
               {"aim_deg", "number", "deg", "90", "[0, 90]",
                "where its -z looks on a wall: 0 straight down, 90 away from the wall"}},
              joined(joined(photometric_file_keys(""), operation_keys()),
                     {{"body_material", "text", "", "", "",
                       "material of its body; without it returning light "
                       "passes"}}))},
      {"design.sign", "`[[design.sign]]`: a sign that may be placed",
       joined({{"name", "name", "", "required", "", "name of the type"},
               {"like", "text", "", "", "",
                "sign of the scene that it is like, instead of the keys of its face and its light"},
               {"type", "text", "", "", "",
                "name of a `[[sign_type]]`, whose keys it has but for those that it says itself"},
               {"cost", "number", "", "1", "[0, 1e9]",
                "of one, installed, with what it costs over its life"},
               {"watts", "number", "W", "0", "[0, 1e6]", "that one takes"},
               {"arrow", "choice", "", "", "left, right, ahead",
                "arrow that its drawing shows, as its reader sees it; without it the sign is made "
                "with any"}},
              sign_body_keys())},
      {"design.keep_out",
       "`[[design.keep_out]]`: a vertical cylinder in which nothing is mounted",
       {
           {"name", "name", "", "required", "", "what is there: a smoke detector"},
           {"position", "point", "m", "required", "[-1e7, 1e7]",
            "where it is; it holds on its storey, 2 m up and down"},
           {"radius", "number", "m", "0.5", "(0, 1e3]", "of the cylinder"},
       }},
  };
}

}  // namespace luxodus
