// What a live view serves, requested with raw sockets. Promises of every server of the program are
// tested in tests/unit/runtime/http.
#include "actors/apps/view/view_server.hpp"

#include <catch2/catch.hpp>
#include <thread>

#include "actors/apps/view/view_hub.hpp"
#include "tests/kit/raw_client.hpp"
#include "tests/unit/actors/apps/view/live_room.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

class ServedHub {
 public:
  explicit ServedHub(const std::string& token) {
    server_ = std::move(ViewServer::listen({"127.0.0.1", 0, token, {}})).value();
    HubOptions of_hub;
    of_hub.live.particles = 1 << 14;
    hub_ = std::make_unique<ViewHub>(room_.scene(), of_hub, [this](std::function<void()> function) {
      server_->post(std::move(function));
    });
    thread_ = std::thread([this] { server_->run(*hub_, [this] { return ends_.load(); }); });
  }
  ~ServedHub() {
    ends_ = true;
    thread_.join();
  }
  uint16_t port() const { return server_->port(); }
  /// The address as a browser sends it.
  std::string here() const { return "127.0.0.1:" + std::to_string(port()); }
  std::string get(const std::string& target, const std::string& method = "GET") const {
    return method + " " + target + " HTTP/1.1\r\nHost: " + here() + "\r\n\r\n";
  }
  std::string upgrade(const std::string& target, const std::string& more = "") const {
    return "GET " + target + " HTTP/1.1\r\nHost: " + here() +
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

}  // namespace

TEST_CASE("the server has a page and a socket, and no other path", "[view]") {
  const ServedHub serving("");
  const uint16_t port = serving.port();
  CHECK(answer(port, serving.get("/")) == http_ok);
  for (const char* path : {"/etc/passwd", "/../../etc/passwd", "/live", "/index.html", "//"})
    CHECK(answer(port, serving.get(path)) == "HTTP/1.1 404 Not Found");
  CHECK(answer(port, serving.get("/", "POST")) == "HTTP/1.1 405 Method Not Allowed");
  CHECK(answer(port, serving.upgrade("/live")) == http_switching);
  CHECK(answer(port, serving.upgrade("/live", "Origin: http://" + serving.here() + "\r\n")) ==
        http_switching);
  CHECK(answer(port, serving.upgrade("/live", "Origin: http://elsewhere\r\n")) == http_forbidden);
}

TEST_CASE("a server with a token requires it for page and socket", "[view]") {
  const ServedHub serving("secret");
  const uint16_t port = serving.port();
  CHECK(answer(port, serving.get("/")) == http_forbidden);
  CHECK(answer(port, serving.get("/?token=secreT")) == http_forbidden);
  CHECK(answer(port, serving.get("/?token=secret")) == http_ok);
  CHECK(answer(port, serving.get("/backdrops.json")) == http_forbidden);
  CHECK(answer(port, serving.get("/backdrops.json?token=secret")) == http_ok);
  CHECK(answer(port, serving.get("/people.json")) == http_forbidden);
  CHECK(answer(port, serving.get("/people.json?token=secret")) == http_ok);
  CHECK(answer(port, serving.upgrade("/live")) == http_forbidden);
  CHECK(answer(port, serving.upgrade("/live?token=secret")) == http_switching);
}

TEST_CASE("a malformed WebSocket frame ends only its own connection", "[view]") {
  const ServedHub serving("");
  const uint16_t port = serving.port();
  // Malformed frames: reserved bits, a length of exabytes, an unmasked text.
  for (const std::string& frame :
       {std::string("\xff\xff\xff\xff", 4),
        std::string("\x82\xff\x7f\xff\xff\xff\xff\xff\xff\xff", 10), std::string("\x81\x05hello")})
    CHECK(answer(port, serving.upgrade("/live") + frame) == http_switching);
  CHECK(answer(port, serving.get("/")) == http_ok);
}
