// fault_proxy PORT:TARGET...: stands between nodes of this machine and makes their connections
// behave like a bad network. For each pair it listens on 127.0.0.1:PORT and connects to
// 127.0.0.1:TARGET. Commands come on its standard input, one per line; it repeats a line when that
// is in force, as an acknowledgement.
//
//   delay MS     every byte is delayed by this, in each direction
//   rate BYTES   bytes a second, in each direction of each connection; 0: unlimited
//   harm BYTES   one of this many bytes, on average, has a flipped bit; 0: none
//   stall        connections stay and nothing passes: an undetected partition
//   refuse       connections break, and new ones are refused: a detected partition
//   drop         connections break, once
//   heal         ends the faults above
//   count        prints the numbers of bytes and connections so far
//
// It ends with its standard input.
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <list>
#include <string>
#include <tuple>
#include <vector>

#include "runtime/core/clock.hpp"
#include "runtime/core/random.hpp"

using namespace luxodus;

namespace {

/// Bytes read at once, and the limit on bytes held in one direction: beyond it the sender is
/// blocked.
constexpr size_t piece_bytes = 64 << 10;
constexpr size_t max_held = 1 << 20;

struct Troubles {
  Nanoseconds delay = 0;
  double bytes_per_second = 0;
  double harmed_every = 0;
  bool stalled = false;
  bool refused = false;
};

struct Pair {
  int listener = -1;
  uint16_t target = 0;
};

struct Piece {
  Nanoseconds due = 0;
  std::vector<char> bytes;
  size_t sent = 0;
};

/// Bytes on their way from one end of a connection to the other.
struct Way {
  int from = -1;
  int to = -1;
  std::deque<Piece> pieces;
  size_t held = 0;
  Nanoseconds free_at = 0;  // by the rate limit
  bool ended = false;       // the sender has closed
};

struct Connection {
  Way forth, back;
  bool broken = false;
};

int socket_of_loopback(uint16_t port, sockaddr_in& place) {
  place = {};
  place.sin_family = AF_INET;
  place.sin_port = htons(port);
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
}

class Proxy {
 public:
  Proxy() : random_(1, RandomStream::test) { random_.start(0); }

  bool listen(uint16_t port, uint16_t target) {
    sockaddr_in place;
    const int listener = socket_of_loopback(port, place);
    const int yes = 1;
    ::setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    pairs_.push_back({listener, target});
    return ::bind(listener, reinterpret_cast<sockaddr*>(&place), sizeof place) == 0 &&
           ::listen(listener, 64) == 0;
  }

  /// Runs until the standard input ends.
  void run() {
    while (turn()) {
    }
  }

 private:
  bool turn() {
    std::vector<pollfd> watched{{STDIN_FILENO, POLLIN, 0}};
    // Ends without a request are not polled, since one that has hung up would be reported forever.
    for (const Pair& pair : pairs_)
      watched.push_back({troubles_.stalled ? -1 : pair.listener, POLLIN, 0});
    Nanoseconds next = seconds(3600);
    const Nanoseconds now = clock_.now();
    for (const Connection& c : connections_) {
      const short at_a = wanted(c.forth, c.back, now, next);
      const short at_b = wanted(c.back, c.forth, now, next);
      watched.push_back({at_a != 0 ? c.forth.from : -1, at_a, 0});
      watched.push_back({at_b != 0 ? c.back.from : -1, at_b, 0});
    }
    const int wait_ms = static_cast<int>((next + milliseconds(1) - 1) / milliseconds(1));
    if (::poll(watched.data(), watched.size(), wait_ms) < 0 && errno != EINTR) return false;
    size_t at = 1 + pairs_.size();
    for (Connection& c : connections_) {
      serve(c, watched[at].revents, watched[at + 1].revents);
      at += 2;
    }
    for (size_t i = 0; i < pairs_.size(); ++i)
      if (watched[1 + i].revents != 0) accept(pairs_[i]);
    const bool goes_on = watched[0].revents == 0 || read_commands();
    close_broken();
    return goes_on;
  }

  /// The events to poll for at the end that `in` comes from and `out` goes to.
  short wanted(const Way& in, const Way& out, Nanoseconds now, Nanoseconds& next) const {
    if (troubles_.stalled) return 0;
    short events = 0;
    if (!in.ended && in.held < max_held) events |= POLLIN;
    if (!out.pieces.empty()) {
      const Nanoseconds left = out.pieces.front().due - now;
      if (left <= 0)
        events |= POLLOUT;
      else
        next = std::min(next, left);
    }
    return events;
  }

  void serve(Connection& c, short at_a, short at_b) {
    // A closed end is detected by reading or writing, which a stall forbids.
    if (troubles_.stalled) return;
    for (auto& [way, in, out] : {std::tuple<Way*, short, short>{&c.forth, at_a, at_b},
                                 std::tuple<Way*, short, short>{&c.back, at_b, at_a}}) {
      if ((in & (POLLIN | POLLHUP | POLLERR)) != 0 && !way->ended && !take(*way)) c.broken = true;
      if ((out & (POLLOUT | POLLHUP | POLLERR)) != 0 && !give(*way)) c.broken = true;
      if (way->ended && way->pieces.empty()) c.broken = true;
    }
  }

  /// False: the connection is broken.
  bool take(Way& way) {
    const double rate = troubles_.bytes_per_second;
    const size_t most =
        rate > 0 ? std::clamp<size_t>(static_cast<size_t>(rate / 50), 1, piece_bytes) : piece_bytes;
    Piece piece;
    piece.bytes.resize(most);
    const ssize_t count = ::recv(way.from, piece.bytes.data(), most, 0);
    if (count < 0) return errno == EAGAIN || errno == EINTR;
    if (count == 0) {
      way.ended = true;
      return true;
    }
    piece.bytes.resize(static_cast<size_t>(count));
    harm(piece.bytes);
    const Nanoseconds now = clock_.now();
    way.free_at = std::max(way.free_at, now);
    if (rate > 0) way.free_at += static_cast<Nanoseconds>(1e9 * static_cast<double>(count) / rate);
    piece.due = way.free_at + troubles_.delay;
    way.held += piece.bytes.size();
    bytes_ += static_cast<unsigned long long>(count);
    way.pieces.push_back(std::move(piece));
    return true;
  }

  bool give(Way& way) {
    const Nanoseconds now = clock_.now();
    while (!way.pieces.empty() && way.pieces.front().due <= now) {
      Piece& piece = way.pieces.front();
      const ssize_t count = ::send(way.to, piece.bytes.data() + piece.sent,
                                   piece.bytes.size() - piece.sent, MSG_NOSIGNAL);
      if (count < 0) return errno == EAGAIN || errno == EINTR;
      piece.sent += static_cast<size_t>(count);
      if (piece.sent < piece.bytes.size()) return true;
      way.held -= piece.bytes.size();
      way.pieces.pop_front();
    }
    return true;
  }

  void harm(std::vector<char>& bytes) {
    if (troubles_.harmed_every <= 0) return;
    for (char& byte : bytes)
      if (random_.uniform_double() * troubles_.harmed_every < 1)
        byte = static_cast<char>(byte ^ (1 << (random_.bits() % 8)));
  }

  void accept(const Pair& pair) {
    if (troubles_.stalled) return;
    const int client = ::accept4(pair.listener, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (client < 0) return;
    ++accepted_;
    sockaddr_in place;
    const int server = socket_of_loopback(pair.target, place);
    const int yes = 1;
    ::setsockopt(client, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    ::setsockopt(server, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    const bool begun = ::connect(server, reinterpret_cast<sockaddr*>(&place), sizeof place) == 0 ||
                       errno == EINPROGRESS;
    Connection& c = connections_.emplace_back();
    c.forth.from = c.back.to = client;
    c.forth.to = c.back.from = server;
    c.broken = !begun || troubles_.refused;
  }

  void close_broken() {
    for (auto c = connections_.begin(); c != connections_.end();) {
      if (!c->broken) {
        ++c;
        continue;
      }
      ::close(c->forth.from);
      ::close(c->back.from);
      c = connections_.erase(c);
    }
  }

  bool read_commands() {
    char text[512];
    const ssize_t count = ::read(STDIN_FILENO, text, sizeof text);
    if (count <= 0) return false;
    typed_.append(text, static_cast<size_t>(count));
    for (size_t end = typed_.find('\n'); end != std::string::npos; end = typed_.find('\n')) {
      obey(typed_.substr(0, end));
      typed_.erase(0, end + 1);
    }
    return true;
  }

  void obey(const std::string& line) {
    char word[16] = "";
    double number = 0;
    const int found = std::sscanf(line.c_str(), "%15s %lf", word, &number);
    const std::string command = found > 0 ? word : "";
    if (command == "delay") {
      troubles_.delay = static_cast<Nanoseconds>(number * 1e6);
    } else if (command == "rate") {
      troubles_.bytes_per_second = number;
    } else if (command == "harm") {
      troubles_.harmed_every = number;
    } else if (command == "stall") {
      troubles_.stalled = true;
    } else if (command == "refuse" || command == "drop") {
      troubles_.refused = command == "refuse";
      for (Connection& c : connections_) c.broken = true;
    } else if (command == "heal") {
      troubles_ = {};
    } else if (command != "count") {
      std::printf("unknown command: ");
    }
    if (command == "count") std::printf("bytes %llu connections %llu ", bytes_, accepted_);
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
  }

  const SystemClock clock_;
  Random random_;
  Troubles troubles_;
  std::vector<Pair> pairs_;
  std::list<Connection> connections_;
  std::string typed_;
  unsigned long long bytes_ = 0;
  unsigned long long accepted_ = 0;
};

}  // namespace

int main(int count, char** words) {
  Proxy proxy;
  for (int i = 1; i < count; ++i) {
    unsigned port = 0, target = 0;
    if (std::sscanf(words[i], "%u:%u", &port, &target) != 2 || port > 65535 || target > 65535) {
      std::fprintf(stderr, "usage: fault_proxy PORT:TARGET...; commands on standard input\n");
      return 2;
    }
    if (!proxy.listen(static_cast<uint16_t>(port), static_cast<uint16_t>(target))) {
      std::fprintf(stderr, "fault_proxy: cannot listen on port %u: %s\n", port,
                   std::strerror(errno));
      return 1;
    }
  }
  std::printf("ready\n");
  std::fflush(stdout);
  proxy.run();
  return 0;
}
