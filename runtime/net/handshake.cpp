#include "runtime/net/handshake.hpp"

#include <fmt/format.h>

namespace luxodus {

std::optional<Refuse> refusal(const Identity& mine, const Identity& theirs, NodeId expected) {
  const auto differs = [&](RefusalReason reason, const char* what, const auto& ours,
                           const auto& other, const char* advice) {
    return Refuse{reason, fmt::format("node {} has {} {}, node {} has {}: {}", mine.node.value,
                                      what, ours, theirs.node.value, other, advice)};
  };
  const auto hash = [](uint64_t value) { return fmt::format("{:016x}", value); };

  if (mine.protocol != theirs.protocol)
    return differs(RefusalReason::protocol, "protocol version", mine.protocol, theirs.protocol,
                   "start the same program everywhere");
  if (theirs.node != expected)
    return Refuse{RefusalReason::wrong_node,
                  fmt::format("node {} expected node {} at this link and found node {}: check the "
                              "endpoints and names",
                              mine.node.value, expected.value, theirs.node.value)};
  if (mine.run_id != theirs.run_id)
    return differs(RefusalReason::run, "run", hash(mine.run_id), hash(theirs.run_id),
                   "one of them is left from another run");
  if (mine.level != theirs.level)
    return differs(RefusalReason::level, "level", static_cast<int>(mine.level),
                   static_cast<int>(theirs.level), "give one configuration to all");
  if (mine.scene_hash != theirs.scene_hash)
    return differs(RefusalReason::scene, "scene", hash(mine.scene_hash), hash(theirs.scene_hash),
                   "pack the scene once and give that pack to all");
  if (mine.topology_hash != theirs.topology_hash)
    return differs(RefusalReason::topology, "topology", hash(mine.topology_hash),
                   hash(theirs.topology_hash), "give one topology file to all");
  if (mine.level == Level::statistical) return std::nullopt;
  if (mine.isa != theirs.isa)
    return differs(RefusalReason::isa, "instruction set", mine.isa, theirs.isa,
                   "set one for all, or the level to statistical");
  if (mine.build != theirs.build)
    return differs(RefusalReason::build, "build", mine.build, theirs.build,
                   "start the same program everywhere");
  if (mine.fingerprint != theirs.fingerprint)
    return differs(RefusalReason::fingerprint, "numeric fingerprint", hash(mine.fingerprint),
                   hash(theirs.fingerprint), "their results would differ in bits; see isa");
  return std::nullopt;
}

}  // namespace luxodus
