// A key-value store over two nodes. Node 1 holds the values; node 0 reads them through a cache that
// has room for few, so that the least recently used are evicted and fetched again.
//   key_value 1 ENDPOINT0 ENDPOINT1 &
//   key_value 0 ENDPOINT0 ENDPOINT1
#include <cstdio>
#include <cstdlib>
#include <string>

#include "runtime/node/node.hpp"

using namespace luxodus;

namespace {

constexpr int keys = 100;
constexpr size_t value_bytes = 10'000;

std::string value(int n) {
  return std::string(value_bytes, static_cast<char>('a' + n % 26));
}

/// Reads every key twice: the first 10 again and again, as the popular ones of a store are.
int read_all(Node& node) {
  int right = 0;
  for (int n = 0; n < 2 * keys; ++n)
    for (const int k : {n % keys, n % 10}) {
      const auto found = node.get("key " + std::to_string(k));
      if (found && as_text(found.value()) == value(k)) ++right;
    }
  return right;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return std::fputs("usage: key_value 0|1 ENDPOINT0 ENDPOINT1\n", stderr), 2;
  const bool reads = std::atoi(argv[1]) == 0;
  Node node({.self = static_cast<uint16_t>(reads ? 0 : 1),
             .nodes = {argv[2], argv[3]},
             .cache_bytes = 31 * value_bytes,
             .max_object_bytes = value_bytes});
  if (reads)
    node.fiber("reader", [&] {
      const int right = read_all(node);
      const auto& cache = node.objects().server().cache().counters();
      std::printf("%d of %d values, %lu found in the cache, %lu evicted, %lu bytes resident\n",
                  right, 4 * keys, cache.hits, cache.evictions, cache.resident_bytes);
      (void)node.ask(actor_at(1, "store"), "end");
      node.leave();
    });
  for (int n = 0; !reads && n < keys; ++n) node.hold("key " + std::to_string(n), value(n));
  node.actor("store", [&](Mail& mail) {
    node.answer(mail, "ended");
    node.leave();
  });
  return node.run();
}
