// The server of a live view with raw sockets.
#include "actors/view/view_server.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <thread>

#include "actors/view/view_hub.hpp"
#include "tests/unit/actors/view/live_room.hpp"

using namespace luxodus;

namespace {

/// A connection to the server; it may be made when no descriptor is left to make one.
class Client {
 public:
  Client() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) { REQUIRE(socket_ >= 0); }
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void say(uint16_t port, const std::string& bytes) const {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(::connect(socket_, reinterpret_cast<sockaddr*>(&place), sizeof place) == 0);
    REQUIRE(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
            static_cast<ssize_t>(bytes.size()));
    ::shutdown(socket_, SHUT_WR);
  }
  std::string hear_some() const {
    std::string out(4096, '\0');
    const ssize_t count = ::recv(socket_, out.data(), out.size(), 0);
    out.resize(static_cast<size_t>(std::max<ssize_t>(0, count)));
    return out;
  }
  std::string hear_all() const {
    std::string out;
    for (std::string some = hear_some(); !some.empty(); some = hear_some()) out += some;
    return out;
  }

 private:
  const int socket_;
};

/// What the server answers to these bytes, to the end of its line.
std::string answer(uint16_t port, const std::string& bytes) {
  const Client client;
  client.say(port, bytes);
  const std::string text = client.hear_some();
  return text.substr(0, text.find("\r\n"));
}

class Serving {
 public:
  explicit Serving(const std::string& token, std::vector<std::string> allowed_hosts = {}) {
    ServerOptions options;
    options.port = 0;
    options.token = token;
    options.allowed_hosts = std::move(allowed_hosts);
    server_ = std::move(ViewServer::listen(options)).value();
    HubOptions of_hub;
    of_hub.live.particles = 1 << 14;
    hub_ = std::make_unique<ViewHub>(room_.scene(), of_hub, [this](std::function<void()> function) {
      server_->post(std::move(function));
    });
    thread_ = std::thread([this] { server_->run(*hub_, [this] { return ends_.load(); }); });
  }
  ~Serving() {
    ends_ = true;
    thread_.join();
  }
  uint16_t port() const { return server_->port(); }
  uint64_t accepts_failed() const { return server_->accepts_failed(); }
  /// As a browser says where it is.
  std::string here(const std::string& name = "127.0.0.1") const {
    return name + ":" + std::to_string(port());
  }
  std::string get(const std::string& target, const std::string& method = "GET") const {
    return method + " " + target + " HTTP/1.1\r\nHost: " + here() + "\r\n\r\n";
  }
  std::string upgrade(const std::string& target, const std::string& more = "") const {
    return upgrade_at(here(), target, more);
  }
  static std::string upgrade_at(const std::string& host, const std::string& target,
                                const std::string& more) {
    return "GET " + target + " HTTP/1.1\r\nHost: " + host +
           "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
           "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
           more + "\r\n";
  }

 private:
  const test::LiveRoom room_;
  std::unique_ptr<ViewServer> server_;
  std::unique_ptr<ViewHub> hub_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

constexpr const char* ok = "HTTP/1.1 200 OK";
constexpr const char* switching = "HTTP/1.1 101 Switching Protocols";
constexpr const char* forbidden = "HTTP/1.1 403 Forbidden";

}  // namespace

TEST_CASE("the server has a page and a socket, and no other path of the machine", "[view]") {
  const Serving serving("");
  const uint16_t port = serving.port();
  CHECK(answer(port, serving.get("/")) == ok);
  for (const char* path : {"/etc/passwd", "/../../etc/passwd", "/live", "/index.html", "//"})
    CHECK(answer(port, serving.get(path)) == "HTTP/1.1 404 Not Found");
  CHECK(answer(port, serving.get("/", "POST")) == "HTTP/1.1 405 Method Not Allowed");
  CHECK(answer(port, serving.upgrade("/live")) == switching);
  CHECK(answer(port, serving.upgrade("/live", "Origin: http://" + serving.here() + "\r\n")) ==
        switching);
  CHECK(answer(port, serving.upgrade("/live", "Origin: http://elsewhere\r\n")) == forbidden);
}

TEST_CASE("a site whose name leads to this machine is served nothing", "[view]") {
  const Serving serving("", {"view.example.org", "behind:9000"});
  const uint16_t port = serving.port();
  const auto page_at = [&](const std::string& host) {
    return answer(port, "GET / HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
  };
  const auto socket_at = [&](const std::string& host, const std::string& origin) {
    return answer(port, Serving::upgrade_at(host, "/live", "Origin: " + origin + "\r\n"));
  };
  // Its page says its own name in both: they agree.
  const std::string evil = serving.here("evil.example");
  CHECK(page_at(evil) == forbidden);
  CHECK(socket_at(evil, "http://" + evil) == forbidden);
  CHECK(page_at("evil.example") == forbidden);
  CHECK(answer(port, "GET / HTTP/1.0\r\n\r\n") == "HTTP/1.0 403 Forbidden");
  for (const char* name : {"127.0.0.1", "localhost", "LOCALHOST", "[::1]"})
    CHECK(page_at(serving.here(name)) == ok);
  CHECK(page_at("localhost") == forbidden);    // port 80
  CHECK(page_at("localhost:1") == forbidden);  // another server's
  CHECK(page_at("10.0.0.1:" + std::to_string(port)) == forbidden);
  CHECK(page_at("view.example.org") == ok);
  CHECK(socket_at("View.Example.Org:8443", "https://view.example.org:8443") == switching);
  CHECK(page_at("behind:9000") == ok);
  CHECK(page_at("behind") == forbidden);
  CHECK(socket_at(serving.here(), "http://view.example.org") == forbidden);
  CHECK(socket_at(serving.here(), "null") == forbidden);
  CHECK(socket_at(serving.here(), "file://" + serving.here()) == forbidden);
}

TEST_CASE("a server with a token wants it for page and socket", "[view]") {
  const Serving serving("secret");
  const uint16_t port = serving.port();
  CHECK(answer(port, serving.get("/")) == forbidden);
  CHECK(answer(port, serving.get("/?token=secreT")) == forbidden);
  CHECK(answer(port, serving.get("/?token=secret")) == ok);
  CHECK(answer(port, serving.upgrade("/live")) == forbidden);
  CHECK(answer(port, serving.upgrade("/live?token=secret")) == switching);
}

TEST_CASE("who asks for the head of the page gets its length and no page", "[view]") {
  const Serving serving("");
  const auto all = [&](const std::string& method) {
    const Client client;
    client.say(serving.port(), serving.get("/", method));
    return client.hear_all();
  };
  const std::string whole = all("GET"), head = all("HEAD");
  const size_t body = whole.find("\r\n\r\n") + 4;
  REQUIRE(whole.size() > body);
  CHECK(head == whole.substr(0, body));
  CHECK(head.find("Content-Length: " + std::to_string(whole.size() - body)) != std::string::npos);
}

TEST_CASE("when descriptors run out the server rests between its tries, and goes on after",
          "[view]") {
  spdlog::set_level(spdlog::level::off);
  const Serving serving("");
  REQUIRE(answer(serving.port(), serving.get("/")) == ok);
  const Client late;
  rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_NOFILE, &before) == 0);
  rlimit none = before;
  none.rlim_cur = 0;
  REQUIRE(::setrlimit(RLIMIT_NOFILE, &none) == 0);
  late.say(serving.port(), serving.get("/"));
  while (serving.accepts_failed() < 3) std::this_thread::yield();
  const uint64_t tried = serving.accepts_failed();
  REQUIRE(::setrlimit(RLIMIT_NOFILE, &before) == 0);
  CHECK(tried < 20);  // without rests it would be thousands
  const std::string heard = late.hear_some();
  CHECK(heard.substr(0, heard.find("\r\n")) == ok);
}

TEST_CASE("rubbish ends its own connection alone", "[view]") {
  const Serving serving("");
  const uint16_t port = serving.port();
  std::string noise(3000, 'x');
  for (size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<char>((i * 7919 + i / 3) & 0xff);
  CHECK(answer(port, noise).find("200") == std::string::npos);
  CHECK(answer(port, "GET / HTTP/1.1\r\n" + std::string(20'000, 'a')).find("200") ==
        std::string::npos);
  // Frames that lie: reserved bits, a length of exabytes, an unmasked text.
  for (const std::string& frame :
       {std::string("\xff\xff\xff\xff", 4),
        std::string("\x82\xff\x7f\xff\xff\xff\xff\xff\xff\xff", 10), std::string("\x81\x05hello")})
    CHECK(answer(port, serving.upgrade("/live") + frame) == switching);
  CHECK(answer(port, serving.get("/")) == ok);
}
