#include "runtime/http/http_get.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "tests/kit/raw_client.hpp"
#include "tests/unit/runtime/http/served_site.hpp"

using namespace luxodus;
using namespace luxodus::test;
using Catch::Matchers::Contains;

TEST_CASE("a page's address is host and port, optionally with scheme and path", "[runtime][http]") {
  const auto whole = parse_http_url("http://lux1.example.org:9464/metrics");
  REQUIRE(whole.ok());
  CHECK(whole.value().host == "lux1.example.org");
  CHECK(whole.value().port == 9464);
  CHECK(parse_http_url("127.0.0.1:80").value().text() == "http://127.0.0.1:80/metrics");
  CHECK(parse_http_url("[::1]:80").value().text() == "http://[::1]:80/metrics");
  CHECK(parse_http_url("here:1/x").value().path == "/x");
  for (const char* wrong :
       {"", "here", ":80", "here:", "here:0", "here:99999", "here:80x", "https://here:80",
        "here:80/a b", "he re:80", "a:b:80", "here:80/\r\nHost: there"}) {
    INFO(wrong);
    CHECK_FALSE(parse_http_url(wrong).ok());
  }
}

TEST_CASE("a page is fetched whole, and another status is a problem with that status",
          "[runtime][http]") {
  const std::string page(300'000, 'x');
  const ServedSite serving([&] { return page; });
  HttpUrl url{"127.0.0.1", serving.port()};
  const auto got = http_get(url, seconds(30));
  REQUIRE(got.ok());
  CHECK(got.value() == page);
  url.path = "/nothing";
  const auto missing = http_get(url, seconds(30));
  REQUIRE_FALSE(missing.ok());
  CHECK_THAT(missing.problem().what, Contains("404"));
}

TEST_CASE("a page longer than the limit is rejected, and so is an address where nothing answers",
          "[runtime][http]") {
  uint16_t port = 0;
  {
    const ServedSite serving([] { return std::string(limits::http_page_bytes + (1 << 16), 'x'); });
    port = serving.port();
    const auto long_one = http_get({"127.0.0.1", port}, seconds(30));
    REQUIRE_FALSE(long_one.ok());
    CHECK_THAT(long_one.problem().what, Contains("longer than"));
  }
  const auto gone = http_get({"127.0.0.1", port}, seconds(30));
  REQUIRE_FALSE(gone.ok());
  CHECK_THAT(gone.problem().what, Contains(std::to_string(port)));
}

TEST_CASE("a server that accepts and does not answer times out", "[runtime][http]") {
  // The system accepts connections, but no server reads them.
  const auto server = HttpServer::listen({}, {});
  REQUIRE(server.ok());
  const auto mute = http_get({"127.0.0.1", server.value()->port()}, milliseconds(50));
  REQUIRE_FALSE(mute.ok());
  CHECK_THAT(mute.problem().what, Contains("no answer in time"));
}
