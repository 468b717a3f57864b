// Two actors on two nodes: one asks the other for an object by its name, and waits for it on a
// fiber, without blocking its node. Start both, in any order:
//   object 1 tcp://127.0.0.1:7400 tcp://127.0.0.1:7410 &
//   object 0 tcp://127.0.0.1:7400 tcp://127.0.0.1:7410
#include <cstdio>
#include <cstdlib>

#include "runtime/node/node.hpp"

using namespace luxodus;

int main(int argc, char** argv) {
  if (argc != 4) return std::fputs("usage: object 0|1 ENDPOINT0 ENDPOINT1\n", stderr), 2;
  const bool asks = std::atoi(argv[1]) == 0;
  Node node({.self = static_cast<uint16_t>(asks ? 0 : 1), .nodes = {argv[2], argv[3]}});
  if (asks) {
    node.fiber("asker", [&] {
      const auto object = node.get("greeting");
      std::puts(object ? std::string(as_text(object.value())).c_str()
                       : object.problem().text().c_str());
      (void)node.ask(actor_at(1, "holder"), "thank you");
      node.leave();
    });
  } else {
    node.hold("greeting", "hello from the other node");
    node.actor("holder", [&](Mail& mail) {
      node.answer(mail, "goodbye");
      node.leave();
    });
  }
  return node.run();
}
