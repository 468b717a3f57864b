#include "runtime/http/http_server.hpp"

#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "tests/kit/raw_client.hpp"
#include "tests/unit/runtime/http/served_site.hpp"

using namespace luxodus;
using namespace luxodus::test;

namespace {

std::string one_page() {
  return "page\n";
}

bool begins(const std::string& text, const std::string& with) {
  return text.rfind(with, 0) == 0;
}

/// Echoes every message, and counts its instances.
class Echo final : public SocketListener {
 public:
  Echo(WebSocket& socket, std::atomic<int>& open) : socket_(socket), open_(open) { ++open_; }
  ~Echo() override { --open_; }
  void hears(std::string_view message) override {
    socket_.send(std::make_shared<const std::string>(message), WebSocket::Kind::text, false);
  }

 private:
  WebSocket& socket_;
  std::atomic<int>& open_;
};

HttpSite echoing(std::atomic<int>& open) {
  HttpSite site;
  site.socket_path = "/live";
  site.opened = [&open](WebSocket& socket) { return std::make_unique<Echo>(socket, open); };
  return site;
}

std::string upgrade(const std::string& host, const std::string& more = "") {
  return "GET /live HTTP/1.1\r\nHost: " + host +
         "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
         "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
         more + "\r\n";
}

/// A text frame of a client; its mask is zero.
std::string frame(const std::string& text) {
  return std::string("\x81") + static_cast<char>(0x80 | text.size()) + std::string(4, '\0') + text;
}

}  // namespace

TEST_CASE("each answer is the current page", "[runtime][http]") {
  std::atomic<int> asked{0};
  const ServedSite serving([&] { return "page " + std::to_string(++asked) + "\n"; });
  for (int i = 1; i <= 3; ++i) {
    const std::string text = whole_answer(serving.port(), serving.request());
    CHECK(begins(text, "HTTP/1.1 200 OK\r\n"));
    CHECK(text.find("Content-Length: 7\r\n") != std::string::npos);
    CHECK(text.ends_with("\r\n\r\npage " + std::to_string(i) + "\n"));
  }
}

TEST_CASE("the server rejects unknown requests, and goes on", "[runtime][http]") {
  const ServedSite serving(one_page);
  const auto ask = [&](const std::string& bytes) { return answer(serving.port(), bytes); };
  CHECK(begins(ask(serving.request("GET", "/")), "HTTP/1.1 404"));
  for (const char* path : {"/etc/passwd", "/../../etc/passwd", "/live", "//metrics"})
    CHECK(begins(ask(serving.request("GET", path)), "HTTP/1.1 404"));
  CHECK(begins(ask(serving.request("POST")), "HTTP/1.1 405"));
  CHECK(begins(ask("\r\n\r\n"), "HTTP/1.1 400"));
  CHECK(begins(ask("GET /metrics SMTP\r\n\r\n"), "HTTP/1.1 400"));
  CHECK(
      begins(ask("GET /metrics HTTP/1.1\r\nHost: " + std::string(9 * 1024, 'a')), "HTTP/1.1 431"));
  CHECK(
      begins(ask("GET /metrics HTTP/1.0\r\nHost: " + serving.here() + "\r\n\r\n"), "HTTP/1.0 200"));
  CHECK(ask(serving.request()) == http_ok);
}

TEST_CASE("a HEAD request gets the page's length and no page", "[runtime][http]") {
  const ServedSite serving(one_page);
  const std::string whole = whole_answer(serving.port(), serving.request());
  const std::string head = whole_answer(serving.port(), serving.request("HEAD"));
  CHECK(head.ends_with("\r\n\r\n"));
  CHECK(whole == head + "page\n");
}

TEST_CASE("a site whose name resolves to this machine is served nothing", "[runtime][http]") {
  HttpAddress at;
  at.allowed_hosts = {"view.example.org", "behind:9000"};
  std::atomic<int> open{0};
  const ServedSite serving(one_page, at, echoing(open));
  const uint16_t port = serving.port();
  const auto page_at = [&](const std::string& host) {
    return answer(port, "GET /metrics HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
  };
  const auto socket_at = [&](const std::string& host, const std::string& origin) {
    return answer(port, upgrade(host, "Origin: " + origin + "\r\n"));
  };
  // Host and Origin agree: both are the site's name.
  const std::string evil = serving.here("evil.example");
  CHECK(page_at(evil) == http_forbidden);
  CHECK(socket_at(evil, "http://" + evil) == http_forbidden);
  CHECK(page_at("evil.example") == http_forbidden);
  CHECK(answer(port, "GET /metrics HTTP/1.1\r\n\r\n") == http_forbidden);
  CHECK(answer(port, "GET /metrics HTTP/1.0\r\n\r\n") == "HTTP/1.0 403 Forbidden");
  for (const char* name : {"127.0.0.1", "localhost", "LOCALHOST", "[::1]"})
    CHECK(page_at(serving.here(name)) == http_ok);
  CHECK(page_at("localhost") == http_forbidden);    // port 80
  CHECK(page_at("localhost:1") == http_forbidden);  // another server's
  CHECK(page_at("10.0.0.1:" + std::to_string(port)) == http_forbidden);
  CHECK(page_at("view.example.org") == http_ok);
  CHECK(socket_at("View.Example.Org:8443", "https://view.example.org:8443") == http_switching);
  CHECK(page_at("behind:9000") == http_ok);
  CHECK(page_at("behind") == http_forbidden);
  CHECK(socket_at(serving.here(), "http://" + serving.here()) == http_switching);
  CHECK(socket_at(serving.here(), "http://view.example.org") == http_forbidden);
  CHECK(socket_at(serving.here(), "null") == http_forbidden);
  CHECK(socket_at(serving.here(), "file://" + serving.here()) == http_forbidden);
}

TEST_CASE("a server with a token requires it for pages and sockets", "[runtime][http]") {
  HttpAddress at;
  at.token = "secret";
  std::atomic<int> open{0};
  const ServedSite serving(one_page, at, echoing(open));
  const auto page_at = [&](const std::string& target) {
    return answer(serving.port(), serving.request("GET", target));
  };
  CHECK(page_at("/metrics") == http_forbidden);
  CHECK(page_at("/metrics?token=secreT") == http_forbidden);
  CHECK(page_at("/metrics?token=secret") == http_ok);
  CHECK(answer(serving.port(), upgrade(serving.here())) == http_forbidden);
}

TEST_CASE("an answer does not wait for a silent client to end", "[runtime][http]") {
  const ServedSite serving(one_page);
  // On a machine that stalls for seconds its time may be over: then another try.
  bool answered_before = false;
  for (int i = 0; i < 5 && !answered_before; ++i) {
    const RawClient mute;
    mute.connect(serving.port());
    CHECK(answer(serving.port(), serving.request()) == http_ok);
    answered_before = mute.is_waiting();
  }
  CHECK(answered_before);
}

TEST_CASE("silent and non-reading clients delay no others, however many they are",
          "[runtime][http]") {
  const std::string page(8 << 20, 'p');  // more than a socket takes at once
  const ServedSite serving([&] { return page; });
  std::vector<RawClient> mute(3 * limits::http_clients);
  for (size_t i = 0; i < mute.size(); ++i) {
    mute[i].connect(serving.port());
    if (i % 3 > 0) mute[i].say(i % 3 == 1 ? serving.request() : "GET /met");
  }
  // Served one after another the silent clients would take limits::http_client each: twenty
  // minutes.
  for (int i = 0; i < 3; ++i)
    CHECK(whole_answer(serving.port(), serving.request()).size() > page.size());
}

TEST_CASE("without descriptors the server pauses between its tries, and goes on afterwards",
          "[runtime][http]") {
  spdlog::set_level(spdlog::level::off);
  const ServedSite serving(one_page);
  REQUIRE(answer(serving.port(), serving.request()) == http_ok);
  const RawClient late;
  rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_NOFILE, &before) == 0);
  rlimit none = before;
  none.rlim_cur = 0;
  REQUIRE(::setrlimit(RLIMIT_NOFILE, &none) == 0);
  late.connect(serving.port());
  late.say(serving.request());
  while (serving.server().accepts_failed() < 3) std::this_thread::yield();
  const uint64_t tried = serving.server().accepts_failed();
  REQUIRE(::setrlimit(RLIMIT_NOFILE, &before) == 0);
  CHECK(tried < 20);  // without rests it would be thousands
  CHECK(begins(late.hear_some(), http_ok));
}

TEST_CASE("invalid bytes end only their own connection", "[runtime][http]") {
  std::atomic<int> open{0};
  const ServedSite serving(one_page, {}, echoing(open));
  const uint16_t port = serving.port();
  std::string noise(3000, 'x');
  for (size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<char>((i * 7919 + i / 3) & 0xff);
  CHECK(answer(port, noise).find("200") == std::string::npos);
  CHECK(answer(port, "GET / HTTP/1.1\r\n" + std::string(20'000, 'a')).find("200") ==
        std::string::npos);
  // Invalid frames: reserved bits, a length of exabytes, an unmasked text.
  for (const std::string& lie :
       {std::string("\xff\xff\xff\xff", 4),
        std::string("\x82\xff\x7f\xff\xff\xff\xff\xff\xff\xff", 10), std::string("\x81\x05hello")})
    CHECK(answer(port, upgrade(serving.here()) + lie) == http_switching);
  CHECK(answer(port, serving.request()) == http_ok);
}

TEST_CASE("a socket's messages are received and answered, and its listener ends with it",
          "[runtime][http]") {
  std::atomic<int> open{0};
  const ServedSite serving(one_page, {}, echoing(open));
  {
    const RawClient client;
    client.connect(serving.port());
    client.say(upgrade(serving.here()));
    CHECK(begins(client.hear_some(), http_switching));
    client.say(frame("hello"));
    CHECK(client.hear_some() == "\x81\x05hello");
    CHECK(open == 1);
  }
  while (open != 0) std::this_thread::yield();
  CHECK(answer(serving.port(), serving.request()) == http_ok);
}

TEST_CASE("listeners of sockets that are still open end with the server", "[runtime][http]") {
  std::atomic<int> open{0};
  const RawClient client;
  {
    const ServedSite serving(one_page, {}, echoing(open));
    client.connect(serving.port());
    client.say(upgrade(serving.here()));
    CHECK(begins(client.hear_some(), http_switching));
    client.say(frame("hello"));
    CHECK(client.hear_some() == "\x81\x05hello");
  }
  CHECK(open == 0);
}

TEST_CASE("sockets beyond the limit are refused", "[runtime][http]") {
  std::atomic<int> open{0};
  HttpSite site = echoing(open);
  site.limits.sockets = 1;
  const ServedSite serving(one_page, {}, site);
  const RawClient first;
  first.connect(serving.port());
  first.say(upgrade(serving.here()));
  CHECK(begins(first.hear_some(), http_switching));
  CHECK(answer(serving.port(), upgrade(serving.here())) == http_forbidden);
}

TEST_CASE("a server that cannot listen names the address and the reason", "[runtime][http]") {
  const ServedSite first(one_page);
  const auto second = HttpServer::listen({"127.0.0.1", first.port()}, {});
  REQUIRE_FALSE(second.ok());
  CHECK(second.problem().what.find(std::to_string(first.port())) != std::string::npos);
  CHECK(second.problem().what.find("in use") != std::string::npos);
  const auto nowhere = HttpServer::listen({"localhost", 0}, {});
  REQUIRE_FALSE(nowhere.ok());
  CHECK(nowhere.problem().what.find("no numeric address") != std::string::npos);
}
