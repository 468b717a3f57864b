// Keys of `[run]`.
#include "scenes/formats/scene_file/scene_schema.hpp"

namespace luxodus {

TableSpec run_keys() {
  return {
      "run",
      "`[run]`",
      {
          {"seed", "integer", "", "1", "[0, 9e18]", "seed of all random numbers"},
          {"max_bands", "integer", "", "8", "[1, 64]", "most wavelength bands; 1 forces one",
           "bands_most"},
          {"band_edges_nm", "numbers", "nm", "", "[380, 780]",
           "edges of the bands, ascending, first 380, last 780; without it bands are told apart "
           "automatically"},
          {"band_tolerance", "number", "", "0.02", "(0, 1]",
           "relative difference at which two wavelengths are told apart"},
          {"batch_particles", "integer", "", "0", "[0, 1e6]",
           "particles of a batch; 0: follows from the scene"},
          {"voxel_edge_m", "number", "m", "0", "[0, 1e4]",
           "edge of a voxel, only where a medium is; 0: follows from the scene"},
          {"voxels", "flag", "", "true", "", "keep fluence by voxel"},
          {"analogue", "flag", "", "false", "", "sampled absorption instead of weighted survival"},
          {"stratified", "flag", "", "true", "",
           "low-discrepancy points, scrambled anew for each batch, for where and whither particles "
           "and eye paths start; false: independent ones"},
          {"groups", "choice", "", "\"one\"", "one, circuit, emitter",
           "what gets tallies of its own: nothing, each circuit (or `group`, where one is named), "
           "each emitter"},
          {"eye_path_factor", "number", "", "1", "[0, 1000]",
           "paths from the eye per batch, relative to the default", "eye_share"},
          {"error_of", "texts", "", "[\"all\"]", "",
           "what the error of a run is judged by, the worst of them: \"all\" (planes, probes and "
           "signs, or surfaces where there are none of these), \"planes\", \"probes\", \"signs\", "
           "\"surfaces\", \"cells\" of planes and \"patches\" (the error that 95 % of those that "
           "get light do not exceed), \"plane NAME\", \"cells NAME\" (of that plane), "
           "\"probe NAME\", \"sign NAME\". Paths go where it asks: to eyes or to bins"},
      }};
}

}  // namespace luxodus
