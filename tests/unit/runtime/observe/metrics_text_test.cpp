// Metrics text written by one process and parsed by another, and invalid text.
#include "runtime/observe/metrics_text.hpp"

#include <catch2/catch.hpp>

#include "runtime/observe/metrics.hpp"

using namespace luxodus;

TEST_CASE("published metrics are parsed back, with names, labels and numbers",
          "[runtime][metrics]") {
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

TEST_CASE("lines that are no samples are skipped", "[runtime][metrics]") {
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
