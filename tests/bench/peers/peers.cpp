// The tables of peers. In each of seven rounds every library does the work once, in turn, so that
// what other programs take of this host falls on all. A ratio is the median over the rounds.
#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/measure.hpp"
#include "tests/bench/net_tables.hpp"
#include "tests/bench/peers/processes.hpp"

namespace luxodus::bench {

namespace {

constexpr size_t rounds = 7;
constexpr size_t many = 100'000;

/// Those that were compiled in; Luxodus is the first.
std::vector<Peer> all_peers() {
  std::vector<Peer> peers{luxodus_peer()};
#ifdef LUX_PEER_BOOST_FIBER
  peers.push_back(boost_fiber_peer());
#endif
#ifdef LUX_PEER_CAF
  peers.push_back(caf_peer());
#endif
  peers.push_back(zeromq_peer());
#ifdef LUX_PEER_NNG
  peers.push_back(nng_peer());
#endif
#ifdef LUX_PEER_OPEN_MPI
  peers.push_back(open_mpi_peer());
#endif
  return peers;
}

/// One of the figures that a piece of work gives.
struct Kind {
  const char* name;
  bool more_is_better;
  int decimals;
};
using Kinds = std::vector<Kind>;
/// By kind; nothing where a library has none.
using Figures = std::vector<std::optional<double>>;
/// A library's figures, once; nothing if it has no such work, or failed.
using Measure = std::function<std::optional<Figures>(const Peer&)>;

void print_head(const char* title, const Kinds& kinds) {
  std::string line = fmt::format("\n{}\n{:<26} {:<12}", title, "work", "library");
  for (const Kind& kind : kinds)
    line += fmt::format(" {:>13} {:>7} {:>12}", kind.name, "ratio", "range");
  fmt::print("{}\n", line);
}

/// One cell of a library: its median, and how many times better Luxodus is in the same rounds.
std::string cell(const Kind& kind, size_t at, const std::vector<std::optional<Figures>>& ours,
                 const std::vector<std::optional<Figures>>& theirs) {
  std::vector<double> figures, ratios;
  for (size_t round = 0; round < rounds; ++round) {
    if (!theirs[round] || !(*theirs[round])[at]) continue;
    const double figure = *(*theirs[round])[at];
    figures.push_back(figure);
    if (!ours[round] || !(*ours[round])[at]) continue;
    const double own = *(*ours[round])[at];
    ratios.push_back(kind.more_is_better ? own / figure : figure / own);
  }
  if (figures.empty()) return fmt::format(" {:>13} {:>7} {:>12}", "none", "", "");
  std::string text = fmt::format(" {:>13.{}f}", summarise(figures).median, kind.decimals);
  if (&ours == &theirs || ratios.empty()) return text + fmt::format(" {:>7} {:>12}", "", "");
  const Summary ratio = summarise(ratios);
  return text + fmt::format(" {:>7.2f} {:>12}", ratio.median,
                            fmt::format("{:.2f}-{:.2f}", ratio.low, ratio.high));
}

/// Those that have the work, beginning with Luxodus, in turn; every second round backwards.
void print_work(const std::string& label, const Kinds& kinds, std::vector<Peer> peers,
                const Measure& measure) {
  std::vector<std::vector<std::optional<Figures>>> all(peers.size(),
                                                       std::vector<std::optional<Figures>>(rounds));
  for (size_t round = 0; round < rounds; ++round)
    for (size_t n = 0; n < peers.size(); ++n) {
      const size_t i = round % 2 == 0 ? n : peers.size() - 1 - n;
      all[i][round] = measure(peers[i]);
    }
  for (size_t i = 0; i < peers.size(); ++i) {
    std::string line = fmt::format("{:<26} {:<12}", i == 0 ? label : "", peers[i].name);
    for (size_t at = 0; at < kinds.size(); ++at) line += cell(kinds[at], at, all[0], all[i]);
    fmt::print("{}\n", line);
  }
  std::fflush(stdout);
}

template <class Work>
std::vector<Peer> that_have(Work Peer::*work) {
  std::vector<Peer> peers = all_peers();
  std::erase_if(peers, [&](const Peer& peer) { return peer.*work == nullptr; });
  return peers;
}

uint16_t next_port() {
  static uint16_t port = 17500;
  // Below those that the system gives to connections; each run takes four of its own.
  port = static_cast<uint16_t>(port < 32000 ? port + 4 : 17500);
  return port;
}

void print_messages(Nanoseconds span) {
  const Kinds kinds{{"ns", false, 1}};
  print_head("Ping-pong of two actors or fibers of one thread, one way [processor time]", kinds);
  const auto row = [&](const char* label, auto work) {
    print_work(label, kinds, that_have(work), [&](const Peer& peer) -> std::optional<Figures> {
      const auto taken = play(peer.*work, span);
      if (!taken) return std::nullopt;
      return Figures{taken->processor_ns()};
    });
  };
  row("control lane", &Peer::play_without_fibers);
  row("data lane", &Peer::play);
}

void print_memory() {
  const Kinds kinds{{"bytes", false, 0}};
  print_head("Memory of each of 100 000 that wait for a message", kinds);
  const auto row = [&](const char* label, auto work) {
    print_work(label, kinds, that_have(work), [&](const Peer& peer) -> std::optional<Figures> {
      const auto bytes = bytes_of_each(peer.*work, many);
      if (!bytes) return std::nullopt;
      return Figures{*bytes};
    });
  };
  row("with a fiber", &Peer::hold_fibers);
  row("without a fiber", &Peer::hold_actors);
}

void print_transfers(Nanoseconds span, size_t bytes, size_t in_flight) {
  const Kinds kinds{{"objects/s", true, 0}, {"us/object", false, 2}};
  print_head("Objects asked for over TCP of this host, between two processes [processor time]",
             kinds);
  std::vector<Peer> peers = all_peers();
  std::erase_if(peers, [](const Peer& peer) { return !peer.ask && !peer.command; });
  const auto row = [&](size_t of_bytes, size_t at_once) {
    print_work(fmt::format("{} B, {} in flight", of_bytes, at_once), kinds, peers,
               [&](const Peer& peer) -> std::optional<Figures> {
                 const auto taken = transfer(peer, {of_bytes, at_once, next_port()}, span);
                 if (!taken) return std::nullopt;
                 if (peer.polls) return Figures{taken->rate(), std::nullopt};
                 return Figures{taken->rate(), taken->processor_ns() * 1e-3};
               });
  };
  if (bytes > 0) return row(bytes, in_flight);
  for (const size_t of_bytes : {64, 4096, 100'000})
    for (const size_t at_once : {1, 16, 256, 4096}) row(of_bytes, at_once);
}

void print_losses() {
  const Kinds kinds{{"ms", false, 1}};
  print_head("A process killed on an idle link, until the other knows", kinds);
  int n = 0;
  print_work("killed", kinds, that_have(&Peer::watch),
             [&](const Peer& peer) -> std::optional<Figures> {
               const Nanoseconds idle = milliseconds(300 + 37 * (n++ % 16));
               const auto known = known_after(peer, {64, 1, next_port()}, idle);
               if (!known) return std::nullopt;
               return Figures{*known * 1e3};
             });
}

}  // namespace

void print_peers(Nanoseconds span, size_t bytes, size_t in_flight) {
  const Nanoseconds share = span / 4;
  fmt::print(
      "\nLuxodus and its peers: medians of {} rounds of {:.2f} s; ratio: so many times "
      "better is Luxodus\n",
      rounds, seconds_in(share));
  for (const Peer& peer : all_peers()) fmt::print("  {}: {}\n", peer.name, peer.how);
  const std::string_view absent = LUX_PEERS_ABSENT;
  if (!absent.empty()) fmt::print("  not installed when this was compiled: {}\n", absent);
  fmt::print("  SObjectizer: no package of Debian 12\n");
  if (bytes == 0) {
    print_messages(share);
    print_memory();
    print_losses();
  }
  print_transfers(share, bytes, in_flight);
}

}  // namespace luxodus::bench
