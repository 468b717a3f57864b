// The display: an actor that has a copy of the run's totals and shows it. It may be on any node.
// During the run it requests totals from the coordinator whenever something is to be shown; when
// the run is over it has the flux written to a disk, confirms that, and then writes all other
// results.
//
//   watching -> copying -> showing -> watching ...           while the run goes on
//   watching -> copying -> keeping the flux -> writing results -> done
//
// Its totals are a copy: a display that fails, or whose node restarts, requests them again. Writing
// and rendering run on a thread of their own. Thread rule: the node's thread.
#pragma once

#include <exception>
#include <memory>
#include <optional>

#include "actors/cast/display/run_output.hpp"
#include "actors/cast/display/totals_snapshot.hpp"
#include "runtime/actor/blocking_calls.hpp"
#include "runtime/messaging/node_actor.hpp"
#include "runtime/messaging/retry_timer.hpp"

namespace luxodus {

struct DisplayConfig {
  NodeId self;
  Address coordinator;
  Nanoseconds look_every = milliseconds(250);
  /// Time to the first retry, and more if answers take long: see RetryTimer.
  Nanoseconds answer_patience = seconds(2);
  Nanoseconds lost = seconds(30);  // a coordinator unreachable for this long is given up
};

class DisplayActor final
    : public NodeActor<DisplayActor,
                       ControlLane<Accepts<Letter<TotalsShown>, 8, WhenFull::reject>,
                                   Accepts<Letter<RunEnded>, 8, WhenFull::reject>>,
                       DataLane<>> {
 public:
  /// Requires: all references outlive this.
  DisplayActor(const DisplayConfig& config, RunOutput& work, BlockingCalls& calls,
               Scheduler& scheduler, Network& network, Sender& sender);
  ~DisplayActor() override { calls_.finish(); }

  /// Begins to watch the run.
  void begin();

  // From the coordinator.
  void on(const Letter<TotalsShown>& shown);
  void on(const Letter<RunEnded>& ended);

  /// Reports to the coordinator, if a message gets through, that it has failed for good.
  void tell_failure(const std::string& what);

  /// Whether everything is written, or nothing will be: the run failed, or the coordinator was
  /// lost.
  bool done() const { return state_.done || failed(); }
  /// Whether the run is over, as far as the display has heard.
  bool is_ending() const { return state_.over; }
  /// Why not everything is written.
  const std::optional<Problem>& fault() const { return state_.fault; }

  struct Counters {
    uint64_t copies = 0;  // of totals, complete ones
    uint64_t copied_bytes = 0;
    uint64_t asked_again = 0;
  };
  void add_metrics(Metrics& metrics) const;

 private:
  struct Question {
    MessageId id;
    bool left = false;  // it has left this node
  };
  /// State that a restart resets.
  struct State {
    std::optional<Question> question;
    bool retries_soon = false;  // a timer will retry what has not left
    std::optional<TotalsCopy> copy;
    std::shared_ptr<const LocalRun> last;  // of the finished run
    bool over = false;
    bool saved = false;  // the flux is on the disk
    bool done = false;
    std::optional<Problem> fault;
    std::optional<Nanoseconds> unreachable_since;
  };
  enum class Call : uint8_t { show, keep_flux, write_results };

  void reset() override;
  void set_timer();
  void look();
  void watch_coordinator();
  void ask();
  void put();
  void retry();
  void copied();
  void call(Call what);
  void returned(uint32_t life);
  void go_on(Result<void> outcome);
  void write_results();
  void end(std::optional<Problem> fault);
  void tell_saved();

  const DisplayConfig config_;
  RunOutput& work_;
  BlockingCalls& calls_;
  const Clock& clock_;
  Network& network_;  // for reachability
  State state_;
  RetryTimer timer_;   // of the question
  uint32_t show_ = 0;  // number of the last request, over all lives
  // The current call, which may belong to an earlier life.
  bool calling_ = false;
  Call called_ = Call::show;
  std::shared_ptr<const LocalRun> called_with_;
  Result<void> outcome_;
  std::exception_ptr thrown_;
  StopReason reason_ = StopReason::particles;
  Counters counters_;
};

}  // namespace luxodus
