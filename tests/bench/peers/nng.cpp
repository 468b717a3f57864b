// nng: the req and rep protocols with a context for each request in flight, and callbacks of
// asynchronous operations, as its demonstration of an asynchronous server does.
#include <nng/nng.h>
#include <nng/protocol/reqrep0/rep.h>
#include <nng/protocol/reqrep0/req.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "tests/bench/peers/peer.hpp"

namespace luxodus::bench {

namespace {

/// Contexts of the server: as many as in nng's demonstration.
constexpr size_t server_contexts = 128;

void check(int failed) {
  if (failed == 0) return;
  std::fprintf(stderr, "nng: %s\n", nng_strerror(failed));
  ::_exit(1);
}

/// One conversation at a time: it sends and receives in turn.
struct Talk {
  virtual ~Talk() = default;
  virtual void step() = 0;
  void open(nng_socket socket) {
    check(nng_ctx_open(&context, socket));
    check(nng_aio_alloc(
        &operation, [](void* self) { static_cast<Talk*>(self)->step(); }, this));
  }
  void send(nng_msg* message) {
    sends = true;
    nng_aio_set_msg(operation, message);
    nng_ctx_send(context, operation);
  }
  void receive() {
    sends = false;
    nng_ctx_recv(context, operation);
  }

  nng_ctx context{};
  nng_aio* operation = nullptr;
  bool sends = false;
};

struct Answering final : Talk {
  explicit Answering(const std::vector<std::string>& all) : objects(all) {}
  void step() override {
    check(nng_aio_result(operation));
    if (sends) return receive();
    nng_msg* message = nng_aio_get_msg(operation);
    uint64_t number = 0;
    check(nng_msg_trim_u64(message, &number));
    const std::string& object = objects[number % objects.size()];
    check(nng_msg_append(message, object.data(), object.size()));
    send(message);
  }
  const std::vector<std::string>& objects;
};

struct Asking final : Talk {
  Asking(const Transfer& of, Count& done, uint64_t first) : work(of), objects(done), next(first) {}
  void ask(nng_msg* message) {
    nng_msg_clear(message);
    check(nng_msg_append_u64(message, next % work.objects()));
    next += work.in_flight;
    send(message);
  }
  void step() override {
    check(nng_aio_result(operation));
    if (sends) return receive();
    nng_msg* message = nng_aio_get_msg(operation);
    if (nng_msg_len(message) == work.bytes) objects.add_shared();
    ask(message);
  }
  const Transfer& work;
  Count& objects;
  uint64_t next;
};

[[noreturn]] void wait_for_ever() {
  for (;;) ::pause();
}

void serve(const Transfer& work) {
  const std::vector<std::string> objects(work.objects(), std::string(work.bytes, 'x'));
  nng_socket socket{};
  check(nng_rep0_open(&socket));
  std::vector<std::unique_ptr<Answering>> talks;
  for (size_t i = 0; i < server_contexts; ++i) {
    talks.push_back(std::make_unique<Answering>(objects));
    talks.back()->open(socket);
  }
  check(nng_listen(socket, work.endpoint().c_str(), nullptr, 0));
  for (const auto& talk : talks) talk->receive();
  wait_for_ever();
}

void ask(const Transfer& work, Count& objects) {
  nng_socket socket{};
  check(nng_req0_open(&socket));
  check(nng_dial(socket, work.endpoint().c_str(), nullptr, NNG_FLAG_NONBLOCK));
  std::vector<std::unique_ptr<Asking>> talks;
  for (size_t i = 0; i < work.in_flight; ++i) {
    talks.push_back(std::make_unique<Asking>(work, objects, i));
    talks.back()->open(socket);
  }
  for (const auto& talk : talks) {
    nng_msg* message = nullptr;
    check(nng_msg_alloc(&message, 0));
    talk->ask(message);
  }
  wait_for_ever();
}

void watch(const Transfer& link, const Watch& watch) {
  nng_socket socket{};
  check(nng_req0_open(&socket));
  const auto notify = [](nng_pipe, nng_pipe_ev event, void* with) {
    const Watch& told = *static_cast<const Watch*>(with);
    event == NNG_PIPE_EV_ADD_POST ? told.connected() : told.lost();
  };
  void* with = const_cast<Watch*>(&watch);
  check(nng_pipe_notify(socket, NNG_PIPE_EV_ADD_POST, notify, with));
  check(nng_pipe_notify(socket, NNG_PIPE_EV_REM_POST, notify, with));
  check(nng_dial(socket, link.endpoint().c_str(), nullptr, NNG_FLAG_NONBLOCK));
  wait_for_ever();
}

}  // namespace

Peer nng_peer() {
  Peer peer;
  peer.name = "nng";
  peer.how =
      "req and rep with a context for each request in flight, 128 contexts of the server, "
      "callbacks, messages that are used again; nng_pipe_notify tells of lost pipes";
  peer.serve = serve;
  peer.ask = ask;
  peer.watch = watch;
  return peer;
}

}  // namespace luxodus::bench
