// Reads the fault events of a cluster file.
#include <cmath>

#include "runtime/config/cluster_reading.hpp"

namespace luxodus::config {

namespace {

Nanoseconds span_of_ms(double ms) {
  return std::llround(ms * 1e6);
}

Fault::Kind kind_of(const std::string& word) {
  for (int k = 0; k < fault_kinds; ++k)
    if (word == name_of(static_cast<Fault::Kind>(k))) return static_cast<Fault::Kind>(k);
  return Fault::Kind::pause;  // the invalid word was reported
}

bool is_between_two(Fault::Kind kind) {
  return kind == Fault::Kind::cut || kind == Fault::Kind::clog || kind == Fault::Kind::disconnect;
}

NodeId named(TableReader& keys, std::string_view key, const ClusterConfig& cluster) {
  const std::string name = keys.text(key);
  if (const auto node = find_node(cluster, name)) return *node;
  if (!name.empty()) keys.problem(key, "there is no node \"" + name + "\"");
  return {};
}

/// Reads `actor`, which only failures have.
void read_actor(TableReader& keys, Fault& fault) {
  const bool of_actor = fault.kind == Fault::Kind::failure;
  fault.actor = keys.choice("actor");
  if (of_actor != keys.has("actor"))
    keys.problem(of_actor ? "kind" : "actor", of_actor ? "an actor fails: say 'actor', too"
                                                       : "'actor' is for kind = \"failure\"");
}

Fault read_event(const toml::Table& table, ClusterReading& reading) {
  TableReader keys(table, cluster_schema(), {"faults.event"}, reading.findings);
  Fault fault;
  fault.kind = kind_of(keys.choice("kind"));
  fault.at = span_of_ms(1e3 * keys.number("at_s"));
  fault.lasts = span_of_ms(1e3 * keys.number("lasts_s"));
  fault.node = named(keys, "node", reading.cluster);
  fault.factor = keys.number("factor");
  read_actor(keys, fault);
  if (!is_between_two(fault.kind)) {
    if (keys.has("peer")) keys.problem("peer", "'peer' is for what happens between two nodes");
    return fault;
  }
  if (!keys.has("peer"))
    keys.problem("kind", "this happens between two nodes: say 'peer', too");
  else
    fault.peer = named(keys, "peer", reading.cluster);
  return fault;
}

}  // namespace

void read_faults(TableReader& top, ClusterReading& reading) {
  TableReader keys = top.inner("faults", {"faults"});
  FaultPlan& plan = reading.cluster.faults;
  LinkTraits& links = plan.links;
  plan.seed = static_cast<uint64_t>(keys.integer("seed"));
  links.delay = span_of_ms(keys.number("delay_ms"));
  links.jitter = span_of_ms(keys.number("jitter_ms"));
  links.tail_share = keys.number("tail_share");
  links.tail = span_of_ms(keys.number("tail_ms"));
  links.bytes_per_second = keys.number("bytes_per_second");
  links.queue_bytes = keys.size("queue_bytes");
  links.loss = keys.number("loss");
  links.duplication = keys.number("duplication");
  links.reordering = keys.number("reordering");
  links.corruption = keys.number("corruption");
  reading.fault_events = keys.tables("event", limits::cluster_faults);
  if (const auto until_s = keys.maybe_number("until_s"))
    plan.healed_at = span_of_ms(1e3 * *until_s);
}

void resolve_fault_events(ClusterReading& reading) {
  for (const toml::Table* table : reading.fault_events)
    reading.cluster.faults.faults.push_back(read_event(*table, reading));
}

}  // namespace luxodus::config
