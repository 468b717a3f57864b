#include "actors/cast/node/controller_node.hpp"

#include "actors/cast/node/graph_routes.hpp"
#include "actors/cast/node/node_plan.hpp"
#include "actors/cast/supervision/supervision.hpp"

namespace luxodus {

namespace {

CoordinatorConfig lead_config(const RunSetup& setup, const NodeSetup& node) {
  CoordinatorConfig config = coordinator_config(setup, node);
  // A coordinator of others leases onwards to any of them, so ranks are not used.
  if (!setup.tree->has_levels()) config.group_ranks = node.group_ranks;
  return config;
}

}  // namespace

ControllerNode::ControllerNode(const RunSetup& setup, const NodeSetup& node, ControlledRun lead,
                               const NodeSeams& seams)
    : setup_(setup),
      node_(node),
      self_(node.net.self),
      shell_({controller_net(setup, node), controller_limits(node), ShellConfig{}.max_payload_bytes,
              node.shutdown_phase},
             reroute_on(setup.graph, setup.routes, node.net.self), seams.clock, seams.transport),
      calls_(seams.make_calls(shell_.scheduler())),
      coordinator_(lead_config(setup, node),
                   {lead.run, lead.stop, lead.interrupt, std::move(lead.report), setup.shards,
                    *calls_, make_journal(lead.keeper, seams), setup.display},
                   shell_.scheduler(), shell_.network(), shell_.actors()) {
  if (node.display == nullptr) return;
  display_calls_ = seams.make_calls(shell_.scheduler());
  display_.emplace(display_config(node), *node.display, *display_calls_, shell_.scheduler(),
                   shell_.network(), shell_.actors());
}

/// Makes the coordinator end the run with this error. If the coordinator itself has failed, tells
/// its workers in its place; then this node leaves.
bool ControllerNode::end_run(const Verdict& verdict) {
  if (verdict.actor != role::coordinator) {
    verdict.actor == role::display ? coordinator_.lose_display(verdict.text)
                                   : coordinator_.fail(verdict.text);
    return true;
  }
  const std::string text = verdict.text.substr(0, limits::text_bytes);
  ActorSystem& actors = shell_.actors();
  for (uint16_t i = 0; i < setup_.graph.workers(); ++i) {
    const Address worker{{i}, role::tracer};  // some workers may have joined this coordinator
    actors.send(coordinator_.address(), worker, actors.next_id(), RunEnded{0, text});
    actors.send(coordinator_.address(), worker, actors.next_id(), EnterPhase{EndPhase::leave, 0});
  }
  return false;
}

/// Null without a journal.
JournalActor* ControllerNode::make_journal(FlushKeeper* keeper, const NodeSeams& seams) {
  if (keeper == nullptr) return nullptr;
  disk_calls_ = seams.make_calls(shell_.scheduler());
  return &journal_.emplace(shell_.scheduler(), *keeper, *disk_calls_);
}

void ControllerNode::start(std::function<bool()> broken) {
  if (display_) {
    add_to(shell_, role::display, *display_);
    display_->begin();
  }
  add_to(shell_, role::coordinator, coordinator_);
  coordinator_.start();
  if (journal_) {
    watch(shell_.supervisor(), role::journal, *journal_);
    journal_->start();
  }
  shell_.supervisor().end_runs_by([this](const Verdict& verdict) { return end_run(verdict); });
  shell_.supervisor().rehearse(node_.faults);
  if (setup_.observation != nullptr) {
    metrics_.emplace(setup_.names, self_, "controller", shell_);
    coordinator_.add_metrics(metrics_->registry());
    if (display_) display_->add_metrics(metrics_->registry());
    metrics_->add_rate({"particles_per_second", "", "Particles counted in a second.", ""},
                       coordinator_.counters().particles);
    metrics_->start(*setup_.observation);
  }
  shell_.begin([this, broken = std::move(broken)] {
    return (coordinator_.ended() && is_shown()) || broken();
  });
}

}  // namespace luxodus
