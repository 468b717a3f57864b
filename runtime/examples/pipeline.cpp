// A pipeline that survives kills. Node 0 gives numbers to the squarer on node 1, several at a time,
// and adds up the answers. Kill node 1 at any moment and start it again: no number is lost and none
// counts twice, since a request is repeated until it is answered, and squaring twice is harmless.
//   pipeline 1 ENDPOINT0 ENDPOINT1 &
//   pipeline 0 ENDPOINT0 ENDPOINT1 [NUMBERS]
#include <cstdio>
#include <cstdlib>
#include <string>

#include "runtime/node/node.hpp"

using namespace luxodus;

namespace {

constexpr Nanoseconds patience = seconds(60);  // for a node that has to be started again
constexpr int at_once = 16;

struct Work {
  uint64_t next = 1, last = 10'000;
  uint64_t answered = 0, sum = 0;
};

/// What each of the fibers does that share the numbers. Returns false if one got no answer.
bool take_numbers(Node& node, Work& work) {
  while (work.next <= work.last) {
    const auto squared = node.ask(actor_at(1, "squarer"), std::to_string(work.next++), patience);
    if (!squared) return false;
    work.sum += std::stoull(std::string(squared->text()));
    if (++work.answered % 5000 == 0) std::printf("answered %lu\n", work.answered);
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return std::fputs("usage: pipeline 0|1 ENDPOINT0 ENDPOINT1 [NUMBERS]\n", stderr), 2;
  const bool gives = std::atoi(argv[1]) == 0;
  Work work;
  if (argc > 4) work.last = std::strtoull(argv[4], nullptr, 10);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  Node node({.self = static_cast<uint16_t>(gives ? 0 : 1), .nodes = {argv[2], argv[3]}});
  node.actor("squarer", [&](Mail& mail) {
    const uint64_t number = std::stoull(std::string(mail.text()));
    node.answer(mail, std::to_string(number * number));
    if (number == 0) node.leave();
  });
  int working = at_once;
  for (int i = 0; gives && i < at_once; ++i)
    node.fiber("giver", [&] {
      if (!take_numbers(node, work)) std::puts("a number got no answer");
      if (--working > 0) return;
      std::printf("sum %lu\n", work.sum);
      (void)node.ask(actor_at(1, "squarer"), "0");
      node.leave();
    });
  return node.run();
}
