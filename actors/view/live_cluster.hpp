// A live view's way to the nodes that trace for it: lends batches to workers that say they are
// there, merges what they give, lends again what was with one that is gone. It is the controller of
// their graph, on a thread of its own. What a lease gave is merged once or never, so the light is
// that of threads of this process, to the bit. Thread rule: start(), enter(), trace() and the end
// on the thread of whoever traces; the node's own thread does the rest.
#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "actors/supervise/node_setup.hpp"
#include "actors/supervise/node_shell.hpp"
#include "actors/view/live_work.hpp"
#include "runtime/messaging/node_actor.hpp"

namespace luxodus {

class LiveCluster final : public LiveTracers {
 public:
  /// Listens, and waits for workers from now on. Requires: all outlive this.
  /// Errors: as join_links.
  static Result<std::unique_ptr<LiveCluster>> start(const RunSetup& run, const Machine& machine,
                                                    const NodeSetup& node);
  /// Tells the workers that it ends.
  ~LiveCluster() override;
  LiveCluster(const LiveCluster&) = delete;
  LiveCluster& operator=(const LiveCluster&) = delete;

  /// Has workers compile it.
  void foresee(const SceneEdits& edits) override;
  void enter(const SceneEdits& edits) override;
  /// Why none of its workers will ever come: they work for another run. Any thread.
  std::optional<Problem> fault() const;
  /// Waits for workers where none is there; see LiveTracers.
  void trace(LiveWork& work) override;

  struct Counters {
    uint64_t leases = 0;
    uint64_t fenced = 0;
    uint64_t dropped = 0;  // answers to leases that did not stand
    size_t workers = 0;    // that are there
  };
  Counters counters() const;

 private:
  struct Lease {
    NodeId node;
    LiveBatches batches;
    Nanoseconds lent = 0;
  };
  struct Peer {
    bool here = false;
    Incarnation life;
    int64_t batches = 1;  // of its next lease
  };

  LiveCluster(const RunSetup& run, const NodeSetup& node) : run_(run), node_(node) {}
  void work(const Machine& machine);
  void look();
  class LiveCoordinator;
  void meet(const Letter<RequestLease>& request);
  void take(const Letter<BatchesTraced>& traced);
  void lend(NodeId worker, Peer& peer);
  void lend_all();
  SendOutcome send(NodeId worker, const TraceBatches& order,
                   const std::shared_ptr<const std::string>& edits);
  void tell_foreseen();
  void note_refusal();
  template <class Which>
  void fence(Which&& which, const char* why);
  int64_t fair_share() const;
  size_t lent_to(NodeId worker) const;
  void say_end();

  const RunSetup& run_;
  const NodeSetup& node_;
  // Guards all below; taken before whatever a LiveWork locks.
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  LiveWork* work_ = nullptr;  // of the trace() under way
  bool all_given_ = false;    // it has no more
  std::shared_ptr<const std::string> edits_;
  std::shared_ptr<const std::string> foreseen_;  // workers have not been told of it yet
  std::map<uint64_t, Lease> leases_;             // that stand
  uint64_t last_lease_ = 0;
  std::map<NodeId, Peer> peers_;
  Counters counters_;
  bool ends_ = false;
  bool started_ = false;
  std::optional<Problem> fault_;
  // Of the node's thread.
  NodeShell* shell_ = nullptr;
  LiveCoordinator* coordinator_ = nullptr;
  std::thread thread_;
};

}  // namespace luxodus
