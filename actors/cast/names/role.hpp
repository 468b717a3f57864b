// The roles of a run's actors: the bytes by which messages name them, and their names for people,
// metrics and fault plans. Constants; any thread.
#pragma once

#include <array>
#include <string>

#include "proto/messages.hpp"

namespace luxodus {

/// The numbers are part of the protocol (proto/PROTOCOL.md).
namespace role {
inline constexpr ActorName coordinator{1};  // leases batches, counts flushes
inline constexpr ActorName tracer{2};       // traces them
inline constexpr ActorName tally_shard{3};  // holds a range of the totals' bins
// fetches parts of the scene, and gives them to others
inline constexpr ActorName part_server = ActorName::part_server;
inline constexpr ActorName display{5};  // shows what is counted, and writes the results
inline constexpr ActorName journal{6};  // of its node's coordinator; no message is for it
}  // namespace role

/// By number.
inline constexpr std::array<const char*, 7> role_names{
    "none", "coordinator", "tracer", "tally_shard", "part_server", "display", "journal"};

/// "tally_shard". Requires: a role, or none.
const char* role_name(ActorName role);
/// The name for people: "tally shard".
std::string spoken_name(ActorName role);

}  // namespace luxodus
