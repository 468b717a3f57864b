// Keys of scenarios, and of the changes of a variant.
#include "scenes/formats/scene_file/scene_schema.hpp"

namespace luxodus {

std::vector<TableSpec> scenario_schema() {
  return {
      {"time",
       "`[time]`: the states that are assessed one after another, and the clock of all of them",
       {
           {"from", "number", "s", "0", "[-1e6, 1e6]",
            "first state; without `--at` the scene is taken at this time"},
           {"to", "number", "s", "required", "[-1e6, 1e6]", "last state"},
           {"step", "number", "s", "required", "(0, 1e6]", "from one state to the next"},
           {"mains_fail_at", "number", "s", "", "[-1e6, 1e6]",
            "when the mains fail: scenarios in emergency and dark operation are in mains operation "
            "until then, and `seconds_after_failure` counts from then; they never fail unless "
            "said"},
           {"walking_speed", "number", "m/s", "", "(0, 5]",
            "of people who set out on the routes at the time of each state; nobody walks unless "
            "said"},
       }},
      {"scenario",
       "`[[scenario]]`: one state of the building",
       {
           {"name", "name", "", "required", "", "name of the scenario"},
           {"operation", "choice", "", "\"mains\"", "mains, emergency, dark",
            "which flux the luminaires give; `dark`: flames alone"},
           {"seconds_after_failure", "number", "s", "0", "[0, 1e6]",
            "since the mains failed: photoluminescent signs fade, and where it is given luminaires "
            "come on by their `onset`"},
           {"circuits", "factors", "", "", "[0, 1000]",
            "flux factor by name of the circuit; others 1"},
           {"media", "factors", "", "", "[0, 1e6]",
            "extinction factor by name of the medium; 0 removes it"},
           {"smoke_factor", "number", "", "1", "[0, 1e6]",
            "extinction factor of every medium not named in `media`"},
           {"emission_factor", "number", "", "1", "[0, 1e6]", "factor for the power of all flames"},
           {"doors_open", "texts", "", "", "", "names of doors that stand open"},
           {"doors_closed", "texts", "", "", "", "names of doors that are closed"},
           {"doors_open_at", "factors", "s", "", "[-1e6, 1e6]",
            "times from which doors stand open, by name"},
           {"doors_close_at", "factors", "s", "", "[-1e6, 1e6]",
            "times from which doors are closed, by name"},
       }},
      {"change",
       "`[[change]]`: what a variant has otherwise than the files that it includes",
       {
           {"kind", "choice", "", "required", "sign, luminaire, medium, design_type, design_sign",
            "what is changed; emitters are luminaires, too, and a `design_type` is a "
            "`[[design.type]]`, a `design_sign` a `[[design.sign]]`, or what stands for one, to "
            "be copied"},
           {"of", "text", "", "required", "", "its name"},
           {"copy", "name", "", "", "",
            "name of a copy that is added instead, the one in `of` staying as it is; of signs and "
            "luminaires, with `position`; later changes may name it"},
           {"position", "point", "m", "", "[-1e7, 1e7]", "where it is, of signs and luminaires"},
           {"facing", "direction", "", "", "[-1e7, 1e7]",
            "where a sign's face looks, or a luminaire aims; with `position`"},
           {"rotation_deg", "number", "deg", "0", "[-360, 360]",
            "further turn of a luminaire about its aim, as `rotation_deg` of `[[luminaire]]`"},
           {"leads_to", "tables", "", "", "",
            "routes that a `design_sign` belongs to, as `[[sign.leads_to]]`"},
           {"remove", "flag", "", "false", "", "takes a luminaire or a sign out of the scene"},
           {"factor", "number", "", "1", "[0, 1000]",
            "of its light in every operation; of a medium's extinction in every scenario"},
       }},
  };
}

}  // namespace luxodus
