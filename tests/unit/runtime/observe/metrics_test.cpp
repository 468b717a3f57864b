#include "runtime/observe/metrics.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <string>
#include <thread>
#include <vector>

#include "runtime/observe/metrics_server.hpp"

using namespace luxodus;

namespace {

int connected(uint16_t port) {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(port);
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  REQUIRE(connect(fd, reinterpret_cast<sockaddr*>(&place), sizeof place) == 0);
  return fd;
}

/// Sends `request` as it is to the server and gives all that comes back.
std::string exchange(uint16_t port, const std::string& request) {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(port);
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  std::string answer;
  if (connect(fd, reinterpret_cast<sockaddr*>(&place), sizeof place) == 0 &&
      send(fd, request.data(), request.size(), MSG_NOSIGNAL) ==
          static_cast<ssize_t>(request.size())) {
    char part[512];
    for (ssize_t n = 0; (n = recv(fd, part, sizeof part, 0)) > 0;)
      answer.append(part, static_cast<size_t>(n));
  }
  close(fd);
  return answer;
}

std::unique_ptr<MetricsServer> serving(std::function<std::string()> page) {
  auto server = MetricsServer::start("127.0.0.1", 0, std::move(page));
  REQUIRE(server.ok());
  return std::move(server).value();
}

bool begins(const std::string& text, const std::string& with) {
  return text.rfind(with, 0) == 0;
}

}  // namespace

TEST_CASE("metrics are written as Prometheus reads them, families together", "[runtime][metrics]") {
  uint64_t fetches = 0, resident = 0;
  Histogram latency;
  Metrics one("n1"), two("n2");
  for (Metrics* node : {&one, &two}) {
    node->add_counter({"fetches", "", "Objects asked for.", ""}, fetches);
    node->add_gauge({"resident", "bytes", "What the cache holds.", ""}, resident);
    node->add_histogram({"fetch", "", "Time to an answer.", "hops=\"2\""}, latency);
  }
  fetches = 12;
  resident = 4096;
  latency.add(milliseconds(250));
  CHECK(one.publish());
  const std::string text = Metrics::published({&one, &two});
  CHECK(text ==
        "# HELP luxodus_fetch_seconds Time to an answer.\n"
        "# TYPE luxodus_fetch_seconds summary\n"
        "luxodus_fetch_seconds{node=\"n1\",hops=\"2\",quantile=\"0.5\"} 0.25\n"
        "luxodus_fetch_seconds{node=\"n1\",hops=\"2\",quantile=\"0.9\"} 0.25\n"
        "luxodus_fetch_seconds{node=\"n1\",hops=\"2\",quantile=\"0.99\"} 0.25\n"
        "luxodus_fetch_seconds{node=\"n1\",hops=\"2\",quantile=\"0.999\"} 0.25\n"
        "luxodus_fetch_seconds{node=\"n1\",hops=\"2\",quantile=\"0.9999\"} 0.25\n"
        "luxodus_fetch_seconds_sum{node=\"n1\",hops=\"2\"} 0.25\n"
        "luxodus_fetch_seconds_count{node=\"n1\",hops=\"2\"} 1\n"
        "luxodus_fetch_seconds{node=\"n2\",hops=\"2\",quantile=\"0.5\"} 0\n"
        "luxodus_fetch_seconds{node=\"n2\",hops=\"2\",quantile=\"0.9\"} 0\n"
        "luxodus_fetch_seconds{node=\"n2\",hops=\"2\",quantile=\"0.99\"} 0\n"
        "luxodus_fetch_seconds{node=\"n2\",hops=\"2\",quantile=\"0.999\"} 0\n"
        "luxodus_fetch_seconds{node=\"n2\",hops=\"2\",quantile=\"0.9999\"} 0\n"
        "luxodus_fetch_seconds_sum{node=\"n2\",hops=\"2\"} 0\n"
        "luxodus_fetch_seconds_count{node=\"n2\",hops=\"2\"} 0\n"
        "# HELP luxodus_fetches_total Objects asked for.\n"
        "# TYPE luxodus_fetches_total counter\n"
        "luxodus_fetches_total{node=\"n1\"} 12\n"
        "luxodus_fetches_total{node=\"n2\"} 0\n"
        "# HELP luxodus_resident_bytes What the cache holds.\n"
        "# TYPE luxodus_resident_bytes gauge\n"
        "luxodus_resident_bytes{node=\"n1\"} 4096\n"
        "luxodus_resident_bytes{node=\"n2\"} 0\n");
}

TEST_CASE("what is read is what was published, not what is counted meanwhile",
          "[runtime][metrics]") {
  uint64_t turns = 1;
  Metrics metrics("n1");
  metrics.add_counter({"turns", "", "Rounds.", ""}, turns);
  CHECK(metrics.publish());
  turns = 2;
  CHECK(Metrics::published({&metrics}).find("} 1\n") != std::string::npos);
  CHECK(metrics.publish());
  CHECK(Metrics::published({&metrics}).find("} 2\n") != std::string::npos);
}

TEST_CASE("readers and a publishing node do not meet", "[runtime][metrics]") {
  // The two numbers are equal whenever they are published; a torn copy would show them apart.
  uint64_t first = 0, second = 0;
  Metrics metrics("n1");
  metrics.add_gauge({"first", "", "One of two.", ""}, first);
  metrics.add_gauge({"second", "", "The other.", ""}, second);
  std::atomic<bool> stop{false};
  std::thread node([&] {
    while (!stop) {
      ++first;
      ++second;
      metrics.publish();
    }
  });
  bool equal = true;
  for (int i = 0; i < 500; ++i) {
    const std::string text = Metrics::published({&metrics});
    const auto value = [&](const std::string& name) {
      const size_t at = text.find("luxodus_" + name + "{");
      const size_t from = text.find("} ", at) + 2;
      return text.substr(from, text.find('\n', from) - from);
    };
    equal = equal && value("first") == value("second");
  }
  stop = true;
  node.join();
  CHECK(equal);
}

TEST_CASE("the server answers GET /metrics with the page of the moment",
          "[runtime][metrics][server]") {
  std::atomic<int> asked{0};
  const auto server = serving([&] { return "page " + std::to_string(++asked) + "\n"; });
  for (int i = 1; i <= 3; ++i) {
    const std::string answer =
        exchange(server->port(), "GET /metrics HTTP/1.1\r\nHost: here\r\n\r\n");
    CHECK(begins(answer, "HTTP/1.1 200 OK\r\n"));
    CHECK(answer.find("Content-Length: 7\r\n") != std::string::npos);
    CHECK(answer.find("\r\n\r\npage " + std::to_string(i) + "\n") != std::string::npos);
  }
}

TEST_CASE("the server refuses what it does not know, and lives on", "[runtime][metrics][server]") {
  const auto server = serving([] { return std::string("page\n"); });
  const auto ask = [&](const std::string& request) { return exchange(server->port(), request); };
  CHECK(begins(ask("GET / HTTP/1.1\r\n\r\n"), "HTTP/1.1 404"));
  CHECK(begins(ask("POST /metrics HTTP/1.1\r\n\r\n"), "HTTP/1.1 405"));
  CHECK(begins(ask("\r\n\r\n"), "HTTP/1.1 400"));
  CHECK(begins(ask("GET /metrics SMTP\r\n\r\n"), "HTTP/1.1 400"));
  CHECK(begins(ask(std::string(9 * 1024, 'a')), "HTTP/1.1 431"));
  const std::string head = ask("HEAD /metrics HTTP/1.1\r\n\r\n");
  CHECK(begins(head, "HTTP/1.1 200 OK\r\n"));
  CHECK(head.ends_with("\r\n\r\n"));
  CHECK(begins(ask("GET /metrics HTTP/1.0\r\n\r\n"), "HTTP/1.1 200"));
}

TEST_CASE("an answer does not wait for the end of a client that says nothing",
          "[runtime][metrics][server]") {
  const auto server = serving([] { return std::string("page\n"); });
  // On a machine that stands still for seconds its time may be over: then once more.
  bool answered_before = false;
  for (int i = 0; i < 5 && !answered_before; ++i) {
    const int mute = connected(server->port());
    CHECK(begins(exchange(server->port(), "GET /metrics HTTP/1.1\r\n\r\n"), "HTTP/1.1 200"));
    char part[8];
    answered_before = recv(mute, part, sizeof part, MSG_DONTWAIT) < 0;  // it is there still
    close(mute);
  }
  CHECK(answered_before);
}

TEST_CASE("clients that say nothing or read nothing keep nobody waiting, however many they are",
          "[runtime][metrics][server]") {
  const std::string page(8 << 20, 'p');  // more than a socket takes at once
  const auto server = serving([&] { return page; });
  std::vector<int> mute;
  for (size_t i = 0; i < 3 * limits::http_clients; ++i) {
    mute.push_back(connected(server->port()));
    const std::string request = i % 3 == 0 ? "GET /metrics HTTP/1.1\r\n\r\n" : "GET /met";
    if (i % 3 > 0)
      CHECK(send(mute.back(), request.data(), request.size(), MSG_NOSIGNAL) ==
            static_cast<ssize_t>(request.size()));
  }
  // One after another the mute would take limits::http_client each: three minutes.
  for (int i = 0; i < 3; ++i)
    CHECK(exchange(server->port(), "GET /metrics HTTP/1.1\r\n\r\n").size() > page.size());
  for (const int fd : mute) close(fd);
}

TEST_CASE("a server that cannot listen says where and why", "[runtime][metrics][server]") {
  const auto page = [] { return std::string(); };
  const auto first = serving(page);
  const auto second = MetricsServer::start("127.0.0.1", first->port(), page);
  REQUIRE_FALSE(second.ok());
  CHECK(second.problem().what.find(std::to_string(first->port())) != std::string::npos);
  CHECK(second.problem().what.find("in use") != std::string::npos);
  const auto nowhere = MetricsServer::start("localhost", 0, page);
  REQUIRE_FALSE(nowhere.ok());
  CHECK(nowhere.problem().what.find("no IPv4 address") != std::string::npos);
}
