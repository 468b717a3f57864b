// Two nodes send each other messages of a Cap'n Proto schema of their own (ping.capnp), and count.
//   ping_pong 1 ENDPOINT0 ENDPOINT1 &
//   ping_pong 0 ENDPOINT0 ENDPOINT1 [ROUNDS]
#include <ping.capnp.h>

#include <cstdio>
#include <cstdlib>

#include "proto/own_message.hpp"
#include "runtime/node/node.hpp"

using namespace luxodus;
using example::Ping;

namespace {

OwnMessage ping(uint32_t round, const char* text) {
  return write_own<Ping>([&](Ping::Builder out) {
    out.setRound(round);
    out.setText(text);
  });
}

/// The number in a message; 0 if it is no Ping.
uint32_t round_of(const Mail& mail) {
  uint32_t round = 0;
  (void)read_own<Ping>(mail.schema, mail.bytes(), [&](Ping::Reader in) { round = in.getRound(); });
  return round;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return std::fputs("usage: ping_pong 0|1 ENDPOINT0 ENDPOINT1 [ROUNDS]\n", stderr), 2;
  const bool serves = std::atoi(argv[1]) == 0;
  const auto rounds = static_cast<uint32_t>(argc > 4 ? std::atoi(argv[4]) : 1000);
  Node node({.self = static_cast<uint16_t>(serves ? 0 : 1), .nodes = {argv[2], argv[3]}});
  node.actor("pong", [&](Mail& mail) {
    const uint32_t round = round_of(mail);
    node.answer(mail, ping(round + 1, "pong"));
    if (round == 0) node.leave();
  });
  if (serves)
    node.fiber("ping", [&] {
      uint32_t round = 1;
      while (round < rounds) {
        const auto answer = node.ask(actor_at(1, "pong"), ping(round, "ping"));
        if (!answer) return (void)std::puts(answer.problem().text().c_str()), node.leave();
        round = round_of(answer.value());
      }
      std::printf("%u rounds\n", round);
      (void)node.ask(actor_at(1, "pong"), ping(0, "the end"));
      node.leave();
    });
  return node.run();
}
