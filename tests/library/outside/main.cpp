// A node by itself: an actor that is asked, and an object that is got.
#include <cstdio>
#include <string>

#include "runtime/node/node.hpp"

using namespace luxodus;

int main() {
  Node node({.nodes = {"ipc://outside.socket"}});
  node.hold("greeting", "hello");
  node.actor("echo", [&](Mail& mail) { node.answer(mail, mail.bytes()); });
  node.fiber("asks", [&] {
    const std::string got(as_text(node.get("greeting").value()));
    const auto answer = node.ask(actor_at(0, "echo"), got);
    std::printf("outside: %s, %s\n", got.c_str(), std::string(answer.value().text()).c_str());
    node.leave();
  });
  return node.run();
}
