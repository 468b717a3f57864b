// CAF: event-based actors, and the middleman between two systems.
#include <caf/all.hpp>
#include <caf/io/all.hpp>
#include <memory>
#include <vector>

#include "tests/bench/peers/processes.hpp"

namespace luxodus::bench {

namespace {

using Ball = caf::atom_constant<caf::atom("ball")>;
using Partner = caf::atom_constant<caf::atom("partner")>;
using Fetch = caf::atom_constant<caf::atom("fetch")>;
using Bytes = std::vector<char>;  // CAF copies it to the wire in one piece

struct Config : caf::actor_system_config {
  explicit Config(bool network) {
    set("scheduler.max-threads", 1u);
    if (network) load<caf::io::middleman>();
  }
};

/// Gives each number back to its partner, of which the first message tells.
caf::behavior player(caf::event_based_actor* self, Count* played) {
  const auto partner = std::make_shared<caf::actor>();
  return {[=](Partner, const caf::actor& other) { *partner = other; },
          [=](Ball ball, uint64_t number) {
            played->add();
            self->send(*partner, ball, number + 1);
          }};
}

void play(Count& played) {
  Config config(false);
  caf::actor_system system(config);
  const caf::actor first = system.spawn(player, &played), second = system.spawn(player, &played);
  caf::anon_send(first, Partner::value, second);
  caf::anon_send(second, Partner::value, first);
  caf::anon_send(first, Ball::value, uint64_t{0});
  system.await_all_actors_done();
}

void hold(size_t count, const std::function<void()>& held) {
  Config config(false);
  caf::actor_system system(config);
  Count none;
  std::vector<caf::actor> players;
  for (size_t i = 0; i < count; ++i) players.push_back(system.spawn(player, &none));
  caf::scoped_actor self(system);
  // The one thread has started all of them when it starts the last.
  const caf::actor last = system.spawn(
      [](caf::event_based_actor*) -> caf::behavior { return {[](Ball) { return Ball::value; }}; });
  self->request(last, caf::infinite, Ball::value).receive([](Ball) {}, [](const caf::error&) {});
  held();
}

void serve(const Transfer& work) {
  Config config(true);
  caf::actor_system system(config);
  std::vector<caf::message> objects;
  for (size_t n = 0; n < work.objects(); ++n)
    objects.push_back(caf::make_message(Bytes(work.bytes, 'x')));
  const caf::actor holder = system.spawn([&objects](caf::event_based_actor*) -> caf::behavior {
    return {[&objects](Fetch, uint64_t number) { return objects[number % objects.size()]; }};
  });
  if (!system.middleman().publish(holder, work.port, "127.0.0.1", true)) return;
  system.await_all_actors_done();
}

/// The actor of the other process, as soon as that is there.
caf::actor holder_at(caf::actor_system& system, const Transfer& work) {
  for (;;) {
    if (auto holder = system.middleman().remote_actor("127.0.0.1", work.port)) return *holder;
    let_pass(milliseconds(10));
  }
}

struct Asker {
  caf::event_based_actor* self;
  caf::actor holder;
  const Transfer* work;
  Count* objects;
  uint64_t asked = 0;

  void ask() {
    self->request(holder, caf::infinite, Fetch::value, asked++ % work->objects())
        .then([this](const Bytes& object) {
          if (object.size() == work->bytes) objects->add();
          ask();
        });
  }
};

void ask(const Transfer& work, Count& objects) {
  Config config(true);
  caf::actor_system system(config);
  const caf::actor holder = holder_at(system, work);
  system.spawn([&](caf::event_based_actor* self) {
    const auto asker = std::make_shared<Asker>(Asker{self, holder, &work, &objects});
    self->attach_functor([asker] {});  // lives as long as the actor
    for (size_t i = 0; i < work.in_flight; ++i) asker->ask();
  });
  system.await_all_actors_done();
}

void watch(const Transfer& link, const Watch& watch) {
  Config config(true);
  caf::actor_system system(config);
  caf::scoped_actor self(system);
  const caf::actor holder = holder_at(system, link);
  self->monitor(holder);
  watch.connected();
  self->receive([&](const caf::down_msg&) { watch.lost(); });
}

}  // namespace

Peer caf_peer() {
  Peer peer;
  peer.name = "CAF";
  peer.how =
      "event-based actors on one scheduler thread (scheduler.max-threads = 1); between processes "
      "the middleman with its defaults, requests without timeouts, objects as messages that are "
      "made once; monitor() tells of actors that are lost";
  peer.play = peer.play_without_fibers = play;
  peer.hold_actors = hold;
  peer.serve = serve;
  peer.ask = ask;
  peer.watch = watch;
  return peer;
}

}  // namespace luxodus::bench
