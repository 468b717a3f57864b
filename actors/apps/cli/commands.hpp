// The commands of the program, one function each, in the order of its help. Each makes a table; one
// thread.
#pragma once

#include "actors/apps/cli/options.hpp"

namespace luxodus::cli {

// scenes
Command check_command();
Command pack_command();
Command import_command();
Command import_gldf_command();
Command import_vdb_command();
Command import_ifc_command();
Command import_dxf_command();
// results
Command run_command();
Command render_command();
Command export_command();
Command converge_command();
// assessment
Command assess_command();
Command compare_command();
Command report_command();
Command design_command();
Command spacing_command();
Command walk_command();
Command people_command();
// live view
Command view_command();
// clusters
Command cluster_command();
Command node_command();
Command status_command();
Command topology_command();
Command keygen_command();
Command profile_command();
Command deploy_command();
// simulated nodes
Command sim_command();
Command study_command();
// tools
Command validate_command();
Command keys_command();
Command info_command();
/// For commands about the whole program, which they do not hold: `program` is called when they run.
Command completion_command(std::function<Command()> program);

/// The table of the whole program.
Command luxodus_command();

}  // namespace luxodus::cli
