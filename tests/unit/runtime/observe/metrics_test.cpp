#include "runtime/observe/metrics.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <string>
#include <thread>
#include <vector>

using namespace luxodus;

TEST_CASE("metrics are written in Prometheus' format, families together", "[runtime][metrics]") {
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

TEST_CASE("readers see what was published, not what was counted since", "[runtime][metrics]") {
  uint64_t turns = 1;
  Metrics metrics("n1");
  metrics.add_counter({"turns", "", "Rounds.", ""}, turns);
  CHECK(metrics.publish());
  turns = 2;
  CHECK(Metrics::published({&metrics}).find("} 1\n") != std::string::npos);
  CHECK(metrics.publish());
  CHECK(Metrics::published({&metrics}).find("} 2\n") != std::string::npos);
}

TEST_CASE("readers never see a partial publication", "[runtime][metrics]") {
  // The two numbers are equal whenever they are published; a torn copy would show a difference.
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
