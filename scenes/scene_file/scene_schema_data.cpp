// Keys of media that come as arrays.
#include "scenes/scene_file/scene_schema.hpp"

namespace luxodus {

std::vector<TableSpec> data_set_schema() {
  return {{
      "medium.data_set",
      "`[[medium]]` with `kind = \"data_set\"`: cells in a box, from a file",
      {
          {"file", "path", "", "required", "", "NRRD (.nrrd, .nhdr) or VTK image data (.vti)"},
          {"quantity", "choice", "", "required", "extinction, soot_density",
           "what its main array is: extinction [1/m] or soot [kg/m3]"},
          {"mass_extinction", "number", "m2/kg", "", "(0, 1e6]",
           "of soot; 8700 with `smoke = \"flaming\"`, else mandatory with `soot_density`"},
          {"smoke", "choice", "", "", "flaming, smouldering",
           "kind of smoke; chooses defaults of `mass_extinction` and `angstrom`"},
          {"wavelength_nm", "number", "nm", "633", "[200, 5000]",
           "at which the extinction is said"},
          {"angstrom", "number", "", "", "[-2, 6]",
           "extinction ~ wavelength^-angstrom; 1 with `smoke = \"flaming\"`, else 0"},
          {"albedo", "reflectance", "", "", "[0, 1]",
           "share of the extinction that scatters; mandatory unless the file has an `albedo` "
           "array"},
          {"phase", "choice", "", "\"isotropic\"", "isotropic, hg, rayleigh, table",
           "phase function; `hg`: Henyey-Greenstein"},
          {"g", "number", "", "", "[-0.9999, 0.9999]", "mean cosine; mandatory with `hg`"},
          {"phase_table", "pairs", "", "", "[0, 1e9]",
           "rows [cosine, relative density per solid angle], from -1 to 1; mandatory with `table`"},
          {"position", "point", "m", "[0, 0, 0]", "[-1e7, 1e7]",
           "where the file's own origin is in the scene"},
          {"rotate_deg", "point", "deg", "[0, 0, 0]", "[-360, 360]",
           "turned about the scene's x, then y, then z axis through the file's origin"},
          {"interpolate_emission", "flag", "", "false", "",
           "emission varies linearly between the centres of cells"},
          {"emission", "table", "", "", "",
           "light of flames, distributed as the file's `emission` array says, evenly without one"},
      },
  }};
}

}  // namespace luxodus
