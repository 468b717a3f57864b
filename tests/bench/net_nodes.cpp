// What an application of the library sees over TCP of this host: requests a second, by the fibers
// that ask at once; how soon a killed process is known, and answers again once it was started anew;
// and the memory of a fiber.
#include <fmt/core.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "runtime/node/node.hpp"
#include "tests/bench/net_tables.hpp"

namespace luxodus::bench {

namespace {

constexpr int kills = 7;
constexpr size_t many_fibers = 100'000;

NodeOptions node_of(uint16_t self, int port) {
  NodeOptions options;
  options.self = self;
  options.fibers = 300;
  for (const int at : {port, port + 2})
    options.nodes.push_back("tcp://127.0.0.1:" + std::to_string(at));
  return options;
}

/// A node that answers until it is told to end.
void serve(int port) {
  Node node(node_of(1, port));
  node.actor("echo", [&](Mail& mail) { node.answer(mail, mail.bytes()); }, {.mailbox = 1000});
  node.actor("end", [&](Mail& mail) {
    node.answer(mail, "ends");
    node.leave();
  });
  (void)node.run();
}

/// Requests a second of so many fibers.
double requests_per_s(Node& node, size_t fibers, Nanoseconds span) {
  const Nanoseconds began = node.now(), end = began + span;
  const std::string text(64, 'x');
  size_t answered = 0, running = fibers;
  for (size_t i = 0; i < fibers; ++i)
    (void)node.spawn("asks", [&] {
      while (node.now() < end)
        if (node.ask(actor_at(1, "echo"), text)) ++answered;
      --running;
    });
  while (running > 0 && node.sleep(milliseconds(1))) {
  }
  return static_cast<double>(answered) / seconds_in(node.now() - began);
}

void print_requests(Nanoseconds span) {
  constexpr int port = 17420;
  std::thread other([] { serve(port); });
  Node node(node_of(0, port));
  node.fiber("measures", [&] {
    (void)node.ask(actor_at(1, "echo"), "the link is up");
    fmt::print("\nRequests of 64 B over TCP, by name\n{:<8} {:>12}\n", "fibers", "requests/s");
    for (const size_t fibers : {1, 16, 256})
      fmt::print("{:<8} {:>12.0f}\n", fibers, requests_per_s(node, fibers, span));
    (void)node.ask(actor_at(1, "end"), "");
    node.leave();
  });
  (void)node.run();
  other.join();
}

pid_t start_server(int port) {
  const pid_t child = ::fork();
  if (child == 0) {
    serve(port);
    ::_exit(0);
  }
  return child;
}

/// Servers come from a process that has no threads yet, so that a fork copies no locks.
class Servers {
 public:
  explicit Servers(int port) {
    if (::pipe(orders_) != 0 || ::pipe(answers_) != 0) return;
    maker_ = ::fork();
    if (maker_ != 0) return;
    char order = 0;
    pid_t server = 0;
    while (::read(orders_[0], &order, 1) == 1 && order != 'e') {
      if (order == 's') server = start_server(port);
      if (order == 'k') {
        ::kill(server, SIGKILL);
        ::waitpid(server, nullptr, 0);
      }
      (void)!::write(answers_[1], &order, 1);
    }
    ::_exit(0);
  }
  ~Servers() {
    (void)!::write(orders_[1], "e", 1);
    ::waitpid(maker_, nullptr, 0);
  }
  Servers(const Servers&) = delete;
  Servers& operator=(const Servers&) = delete;
  void start() { order('s'); }
  void kill() { order('k'); }

 private:
  void order(char what) {
    (void)!::write(orders_[1], &what, 1);
    (void)!::read(answers_[0], &what, 1);
  }
  int orders_[2]{}, answers_[2]{};
  pid_t maker_ = 0;
};

double median_ms(std::vector<Nanoseconds> spans) {
  std::sort(spans.begin(), spans.end());
  return seconds_in(spans[spans.size() / 2]) * 1e3;
}

void print_kills() {
  constexpr int port = 17440;
  Servers servers(port);
  std::vector<Nanoseconds> known, answered;
  Node node(node_of(0, port));
  node.fiber("measures", [&] {
    servers.start();
    for (int i = 0; i < kills; ++i) {
      (void)node.ask(actor_at(1, "echo"), "the link is up");
      while (!node.is_up(1) && node.sleep(milliseconds(1))) {
      }
      (void)node.sleep(milliseconds(300 + 37 * i));  // at no fixed moment between two beats
      const Nanoseconds killed = node.now();
      servers.kill();
      while (node.is_up(1) && node.sleep(milliseconds(1))) {
      }
      known.push_back(node.now() - killed);
      (void)node.sleep(milliseconds(500 + 211 * i));
      const Nanoseconds started = node.now();
      servers.start();
      (void)node.ask(actor_at(1, "echo"), "are you back?", seconds(60));
      answered.push_back(node.now() - started);
    }
    servers.kill();
    node.leave();
  });
  (void)node.run();
  fmt::print("\nA killed process, median and longest of {} [ms]\n", kills);
  const auto row = [](const char* what, const std::vector<Nanoseconds>& spans) {
    const Nanoseconds longest = *std::max_element(spans.begin(), spans.end());
    fmt::print("{:<46} {:>8.1f} {:>8.1f}\n", what, median_ms(spans), seconds_in(longest) * 1e3);
  };
  row("known on an idle link, after the kill", known);
  row("has answered again, after it was started", answered);
}

size_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  size_t all = 0, resident = 0;
  file >> all >> resident;
  return resident * 4096;
}

void print_fiber_bytes() {
  const size_t before = resident_bytes();
  Fibers fibers({.count = many_fibers});
  for (size_t i = 0; i < many_fibers; ++i)
    (void)fibers.start("waits", [&fibers] { (void)fibers.suspend("here"); });
  while (fibers.any_ready()) fibers.run_next();
  fmt::print("\nMemory of a suspended fiber, of {}: {} bytes\n", many_fibers,
             (resident_bytes() - before) / many_fibers);
  fibers.cancel_all();
  while (fibers.any_ready()) fibers.run_next();
}

}  // namespace

void print_nodes(Nanoseconds span) {
  print_kills();  // first: it forks
  print_requests(span);
  print_fiber_bytes();
}

}  // namespace luxodus::bench
