#include "actors/cast/node/state_node.hpp"

#include "actors/cast/node/graph_routes.hpp"
#include "actors/cast/node/node_plan.hpp"
#include "actors/cast/supervision/supervision.hpp"

namespace luxodus {

namespace {

/// Batches of one request: a worker asks for as many as take about 40 ms.
constexpr uint32_t leases_at_once = 256;

/// Does not wait for unreachable workers: others trace their batches at once.
CoordinatorConfig impatient_config(const RunSetup& run, const NodeSetup& node) {
  CoordinatorConfig config = coordinator_config(run, node);
  config.lost = 0;
  config.max_leases = leases_at_once;
  return config;
}

}  // namespace

StateNode::StateNode(const RunSetup& run, const NodeSetup& node, const NodeSeams& seams,
                     std::function<void()> done)
    : shell_({controller_net(run, node), controller_limits(node), ShellConfig{}.max_payload_bytes,
              node.shutdown_phase},
             reroute_on(run.graph, run.routes, node.net.self), seams.clock, seams.transport),
      coordinator_(impatient_config(run, node), run.scene, std::move(done), shell_.scheduler(),
                   shell_.network(), shell_.actors()) {}

void StateNode::start(std::function<void()> look) {
  add_to(shell_, role::coordinator, coordinator_);
  coordinator_.start();
  shell_.begin([this, look = std::move(look)] {
    look();
    return coordinator_.ended();
  });
}

}  // namespace luxodus
