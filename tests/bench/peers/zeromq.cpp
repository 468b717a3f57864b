// Plain libzmq: a DEALER that asks and a ROUTER that answers, without credit, retries and hashes.
// Its guide recommends this pair for requests of which many are in flight.
#include <cstring>
#include <string>
#include <vector>
#include <zmq.hpp>

#include "tests/bench/peers/peer.hpp"

namespace luxodus::bench {

namespace {

void serve(const Transfer& work) {
  zmq::context_t context;
  zmq::socket_t socket(context, zmq::socket_type::router);
  socket.set(zmq::sockopt::sndhwm, 0);
  socket.set(zmq::sockopt::rcvhwm, 0);
  socket.bind(work.endpoint());
  std::vector<zmq::message_t> objects(work.objects());
  for (zmq::message_t& object : objects) {
    object.rebuild(work.bytes);
    std::memset(object.data(), 'x', work.bytes);
  }
  zmq::message_t asker, request, answer;
  for (;;) {
    if (!socket.recv(asker) || !socket.recv(request)) continue;
    uint64_t number = 0;
    std::memcpy(&number, request.data(), sizeof number);
    answer.copy(objects[number % objects.size()]);  // shares the bytes
    socket.send(asker, zmq::send_flags::sndmore);
    socket.send(request, zmq::send_flags::sndmore);
    socket.send(answer, zmq::send_flags::none);
  }
}

void ask(const Transfer& work, Count& objects) {
  zmq::context_t context;
  zmq::socket_t socket(context, zmq::socket_type::dealer);
  socket.set(zmq::sockopt::sndhwm, 0);
  socket.set(zmq::sockopt::rcvhwm, 0);
  socket.connect(work.endpoint());
  uint64_t asked = 0;
  const auto send = [&] {
    const uint64_t number = asked++ % work.objects();
    socket.send(zmq::buffer(&number, sizeof number), zmq::send_flags::none);
  };
  for (size_t i = 0; i < work.in_flight; ++i) send();
  zmq::message_t number, object;
  for (;;) {
    if (!socket.recv(number) || !socket.recv(object)) continue;
    if (object.size() == work.bytes) objects.add();
    send();
  }
}

/// A socket says nothing of its connections, but its monitor does.
void watch(const Transfer& link, const Watch& watch) {
  zmq::context_t context;
  zmq::socket_t socket(context, zmq::socket_type::dealer);
  const char* const events = "inproc://events";
  ::zmq_socket_monitor(socket.handle(), events,
                       ZMQ_EVENT_HANDSHAKE_SUCCEEDED | ZMQ_EVENT_DISCONNECTED);
  zmq::socket_t monitor(context, zmq::socket_type::pair);
  monitor.connect(events);
  socket.connect(link.endpoint());
  zmq::message_t event, address;
  while (monitor.recv(event) && monitor.recv(address)) {
    uint16_t number = 0;
    std::memcpy(&number, event.data(), sizeof number);
    if (number == ZMQ_EVENT_HANDSHAKE_SUCCEEDED) watch.connected();
    if (number == ZMQ_EVENT_DISCONNECTED) watch.lost();
  }
}

}  // namespace

Peer zeromq_peer() {
  Peer peer;
  peer.name = "ZeroMQ";
  peer.how =
      "libzmq by itself: DEALER and ROUTER without high-water marks, one I/O thread a process, "
      "answers that share their bytes; a socket monitor tells of disconnections, its sockets do "
      "not";
  peer.serve = serve;
  peer.ask = ask;
  peer.watch = watch;
  return peer;
}

}  // namespace luxodus::bench
