// The runtime of Luxodus: actors and fibers of a scheduler, and nodes of an application
// (runtime/node), as a program that uses the library writes them.
#include <memory>
#include <string>
#include <vector>

#include "runtime/actor/actor.hpp"
#include "runtime/node/node.hpp"
#include "tests/bench/peers/peer.hpp"

namespace luxodus::bench {

namespace {

struct Ball {
  uint64_t number = 0;
};

/// Gives each message back to its partner. Its messages are handled on its fiber.
class FiberPlayer final
    : public Actor<FiberPlayer, ControlLane<>, DataLane<Accepts<Ball, 1, WhenFull::reject>>> {
 public:
  FiberPlayer(Scheduler& scheduler, Count* played) : Actor(scheduler, "player"), played_(played) {}
  void on(const Ball& ball) {
    played_->add();
    LUX_CHECK(partner->offer(Ball{ball.number + 1}) == Offered::taken, "there is one ball");
  }
  FiberPlayer* partner = nullptr;

 private:
  Count* played_;
};

/// The same, in the turn in which a message arrives, without a fiber, so that it is not started.
class ControlPlayer final
    : public Actor<ControlPlayer, ControlLane<Accepts<Ball, 1, WhenFull::reject>>, DataLane<>> {
 public:
  ControlPlayer(Scheduler& scheduler, Count* played)
      : Actor(scheduler, "player"), played_(played) {}
  void on(const Ball& ball) {
    played_->add();
    LUX_CHECK(partner->offer(Ball{ball.number + 1}) == Offered::taken, "there is one ball");
  }
  ControlPlayer* partner = nullptr;

 private:
  Count* played_;
};

SchedulerLimits limits_for(size_t fibers) {
  SchedulerLimits limits;
  limits.fibers.count = fibers;
  return limits;
}

/// Begins to handle its messages.
void begin(FiberPlayer& player) {
  player.start();
}
void begin(ControlPlayer&) {}

template <class Player>
void play(Count& played) {
  const SystemClock clock;
  QuietSource source(clock);
  Scheduler scheduler(limits_for(2), clock, source);
  Player first(scheduler, &played), second(scheduler, &played);
  first.partner = &second;
  second.partner = &first;
  begin(first);
  begin(second);
  LUX_CHECK(first.offer(Ball{}) == Offered::taken, "its mailbox is empty");
  for (;;) scheduler.turn();
}

template <class Player, size_t fibers_each>
void hold(size_t count, const std::function<void()>& held) {
  const SystemClock clock;
  QuietSource source(clock);
  Scheduler scheduler(limits_for(fibers_each * count + 1), clock, source);
  std::vector<std::unique_ptr<Player>> players;
  for (size_t i = 0; i < count; ++i) {
    players.push_back(std::make_unique<Player>(scheduler, nullptr));
    begin(*players.back());
  }
  while (scheduler.fibers().any_ready()) scheduler.turn();  // each begins, and waits
  held();
}

/// The holder is node 1, and who asks is node 0.
NodeOptions node_of(uint16_t self, const Transfer& work) {
  NodeOptions options;
  options.self = self;
  for (const int port : {work.port + 2, int{work.port}})
    options.nodes.push_back("tcp://127.0.0.1:" + std::to_string(port));
  options.fibers = work.in_flight + 1;
  options.objects = work.objects();
  options.max_object_bytes = work.bytes;
  options.cache_bytes = 8 * work.bytes;  // nearly every object has to be fetched
  return options;
}

std::string name_of(size_t object) {
  return "object " + std::to_string(object);
}

void serve(const Transfer& work) {
  Node node(node_of(1, work));
  node.actor("echo", [&](Mail& mail) { node.answer(mail, mail.bytes()); });
  for (size_t n = 0; n < work.objects(); ++n) {
    std::string content(work.bytes, 'x');
    content.replace(0, sizeof n, reinterpret_cast<const char*>(&n), sizeof n);
    node.hold(name_of(n), content);
  }
  (void)node.run();
}

/// Each fiber has objects of its own, so that none waits for another's fetch. What is counted are
/// fetches, and not what the cache has.
void ask(const Transfer& work, Count& objects) {
  std::vector<std::string> names;
  for (size_t n = 0; n < work.objects(); ++n) names.push_back(name_of(n));
  Node node(node_of(0, work));
  for (size_t i = 0; i < work.in_flight; ++i)
    node.fiber("asks", [&, i] {
      for (size_t next = i;; next = (next + work.in_flight) % names.size())
        if (node.get(names[next]))
          objects.add(node.objects().server().fetcher().counters().fetches - objects.done());
    });
  (void)node.run();
}

void watch(const Transfer& link, const Watch& watch) {
  Node node(node_of(0, link));
  node.fiber("watches", [&] {
    while (!node.ask(actor_at(1, "echo"), "are you there?") || !node.is_up(1)) {
    }
    watch.connected();
    while (node.is_up(1) && node.sleep(milliseconds(1))) {
    }
    watch.lost();
  });
  (void)node.run();
}

}  // namespace

Peer luxodus_peer() {
  Peer peer;
  peer.name = "Luxodus";
  peer.how =
      "actors of one scheduler, messages on the data lane (a fiber each) and on the control lane "
      "(no fiber); Node::get() of objects by name, through a cache with room for eight, with "
      "credit, retries and the check of each object's hash; a node asks every millisecond whether "
      "its link is up";
  peer.play = play<FiberPlayer>;
  peer.play_without_fibers = play<ControlPlayer>;
  peer.hold_fibers = hold<FiberPlayer, 1>;
  peer.hold_actors = hold<ControlPlayer, 0>;
  peer.serve = serve;
  peer.ask = ask;
  peer.watch = watch;
  return peer;
}

}  // namespace luxodus::bench
