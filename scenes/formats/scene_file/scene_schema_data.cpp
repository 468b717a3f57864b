// Keys of media that are given as arrays.
#include "scenes/formats/scene_file/scene_schema.hpp"

namespace luxodus {

namespace {

TableSpec fire_keys() {
  return {
      "medium.fds",
      "`[[medium]]` with `kind = \"fds\"`: smoke and flames of a fire simulation by FDS (NIST)",
      {
          {"file", "path", "", "required", "",
           "index of the case (.smv); its results lie in the same folder or below it"},
          {"at_s", "number", "s", "", "[-1e6, 1e9]",
           "time; between two frames smoke is linear, and for verdicts that of the nearer. `--at` "
           "overrides it. Mandatory unless the scene has "
           "`[time]`, which says the time itself"},
          {"source", "choice", "", "\"best\"", "best, cells, nodes, plot3d, smoke3d",
           "what extinction is taken from; `best`: for verdicts the first of these with a frame "
           "within 1 s, for light the first with both frames around the time within 1 s or with a "
           "frame at the time itself; else the one nearest in time"},
          {"mass_extinction", "number", "m2/kg", "", "(0, 1e6]",
           "of soot, at `wavelength_nm`; as FDS has it unless said"},
          {"wavelength_nm", "number", "nm", "633", "[200, 5000]",
           "at which the extinction is said"},
          {"angstrom", "number", "", "required", "[-2, 6]",
           "extinction ~ wavelength^-angstrom; FDS does not know it. Soot of flaming fires has 1"},
          {"albedo", "reflectance", "", "required", "[0, 1]",
           "share of the extinction that scatters; FDS does not know it. Soot of flaming fires has "
           "0.15 to 0.3"},
          {"g", "number", "", "required", "[-0.9999, 0.9999]",
           "mean cosine of scattering (Henyey-Greenstein); FDS does not know it. Smoke has 0.5 to "
           "0.8"},
          {"position", "point", "m", "[0, 0, 0]", "[-1e7, 1e7]",
           "where the origin of the simulation is in the scene"},
          {"rotate_deg", "point", "deg", "[0, 0, 0]", "[-360, 360]",
           "turned about the scene's x, then y, then z axis through the simulation's origin"},
          {"flames", "table", "", "", "", "light of its flames; none unless said"},
      },
  };
}

TableSpec fire_flame_keys() {
  return {
      "medium.flames",
      "`[medium.flames]` of a fire simulation: where HRRPUV says that it burns",
      {
          {"radiant_fraction", "number", "", "required", "(0, 1]",
           "share of the heat release (CASE_hrr.csv) that leaves the flames as radiation; 0.2 to "
           "0.45 for most fuels"},
          {"soot_temperature_k", "number", "K", "required", "[600, 6000]",
           "temperature of the glowing soot, which gives the spectrum; never that of a cell, which "
           "is a mean of flame and air"},
          {"circuit", "name", "", "", "", "circuit that scenarios may scale it by"},
          {"group", "name", "", "", "", "source group with tallies of its own"},
      },
  };
}

}  // namespace

std::vector<TableSpec> data_set_schema() {
  TableSpec data_set = {
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
  };
  return {std::move(data_set), fire_keys(), fire_flame_keys()};
}

}  // namespace luxodus
