// luxodus assess --visibility-map: options, and the map made and written. One thread.
#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/options.hpp"
#include "actors/judge/assess/over_time.hpp"
#include "actors/judge/visibility_map/evac_signs.hpp"

namespace luxodus::cli {

struct MapWords {
  bool wanted = false;
  bool overwrite = false;  // files that no map has written
  double spacing_m = 0.25;
  std::vector<double> heights_m, facings_deg, box;
  double floor_m = std::numeric_limits<double>::quiet_NaN();  // not given
  std::vector<std::string> signs;
  int rounds = 2;
  EvacRun evac;
};

/// --visibility-map and those that go with it. Requires: `words` outlives the command.
void add_map_options(Command& command, MapWords& words);

/// Makes the map of the states, writes it into `folder`, and prints what it holds and whether
/// pyFDS-Evac will take it; if the interrupt flag is set, nothing is written. Errors: as make_map
/// and read_evac_signs; of the folder.
Result<ExitCode> map_into(const std::filesystem::path& folder, const StatesToAssess& states,
                          const AssessOptions& options, const MapWords& words);

}  // namespace luxodus::cli
