// What one process writes another reads, and nothing that comes instead does harm.
#include "runtime/observe/metrics_text.hpp"

#include <catch2/catch.hpp>

#include "runtime/observe/http_get.hpp"
#include "runtime/observe/metrics.hpp"
#include "runtime/observe/metrics_server.hpp"

using namespace luxodus;

TEST_CASE("what is published is read again, names, labels and numbers", "[runtime][metrics]") {
  uint64_t hits = 7;
  Histogram delay;
  Metrics metrics("n\"3\\");
  metrics.add_counter({"cache_hits", "", "Hits.", ""}, hits);
  metrics.add_histogram({"fetch_delay", "", "Delay.", "hops=\"2\""}, delay);
  delay.add(milliseconds(250));
  REQUIRE(metrics.publish());
  const auto samples = parse_metrics(Metrics::published({&metrics}));
  REQUIRE(samples.size() == 8);
  CHECK(samples[0].name == "luxodus_cache_hits_total");
  CHECK(samples[0].label("node") == "n\"3\\");
  CHECK(samples[0].value == 7);
  CHECK(samples[1].label("hops") == "2");
  CHECK(samples[1].label("quantile") == "0.5");
  CHECK(samples[1].value == 0.25);
  CHECK(samples[1].label("no_such_label").empty());
}

TEST_CASE("lines that are no samples are passed over", "[runtime][metrics]") {
  for (const char* line :
       {"", "# HELP a b", "{} 1", "a", "a{", "a{b}", "a{b=\"c} 1", "a{b=\"c\\", "a b", "a 1x",
        "a{b=\"c\"", "a{=\"c\"} 1", "\x01\xff", "a{b=\"c\"d=e} 1"}) {
    INFO(line);
    CHECK_FALSE(parse_metric(line).has_value());
  }
  CHECK(parse_metric("a 1")->value == 1);
  CHECK(parse_metric("a{} 1e3 1700000000\r")->value == 1000);
  CHECK(parse_metrics("a 1\n\nnonsense\nb 2").size() == 2);
}

TEST_CASE("an address of a page is host and port, and perhaps more", "[runtime][http]") {
  const auto whole = parse_http_url("http://lux1.example.org:9464/metrics");
  REQUIRE(whole.ok());
  CHECK(whole.value().host == "lux1.example.org");
  CHECK(whole.value().port == 9464);
  CHECK(parse_http_url("127.0.0.1:80").value().text() == "http://127.0.0.1:80/metrics");
  CHECK(parse_http_url("here:1/x").value().path == "/x");
  for (const char* wrong :
       {"", "here", ":80", "here:", "here:0", "here:99999", "here:80x", "https://here:80",
        "here:80/a b", "he re:80", "a:b:80", "here:80/\r\nHost: there"}) {
    INFO(wrong);
    CHECK_FALSE(parse_http_url(wrong).ok());
  }
}

TEST_CASE("a page is fetched whole, and another status is a problem that says so",
          "[runtime][http]") {
  const std::string page(300'000, 'x');
  const auto server = MetricsServer::start("127.0.0.1", 0, [&] { return page; });
  REQUIRE(server.ok());
  HttpUrl url{"127.0.0.1", server.value()->port()};
  const auto got = http_get(url, seconds(30));
  REQUIRE(got.ok());
  CHECK(got.value() == page);
  url.path = "/nothing";
  const auto missing = http_get(url, seconds(30));
  REQUIRE_FALSE(missing.ok());
  CHECK(missing.problem().what.find("404") != std::string::npos);
}

TEST_CASE("a page longer than the limit is refused, and so is a place where nobody answers",
          "[runtime][http]") {
  uint16_t port = 0;
  {
    const auto server = MetricsServer::start(
        "127.0.0.1", 0, [] { return std::string(limits::http_page_bytes + (1 << 16), 'x'); });
    REQUIRE(server.ok());
    port = server.value()->port();
    const auto long_one = http_get({"127.0.0.1", port}, seconds(30));
    REQUIRE_FALSE(long_one.ok());
    CHECK(long_one.problem().what.find("longer than") != std::string::npos);
  }
  const auto gone = http_get({"127.0.0.1", port}, seconds(30));
  REQUIRE_FALSE(gone.ok());
  CHECK(gone.problem().what.find(std::to_string(port)) != std::string::npos);
}
