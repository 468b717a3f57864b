// Metrics of a network: counters, links, outboxes, and the memory it takes.
#include <fmt/core.h>

#include "runtime/net/network.hpp"

namespace luxodus {

namespace {

const char* name_of(Kind kind) {
  constexpr const char* names[] = {"link", "control", "request", "reply", "commit"};
  return names[static_cast<size_t>(kind)];
}

size_t links_of(const NetConfig& config) {
  size_t links = 0;
  for (const Edge& edge : config.edges) links += edge.a == config.self || edge.b == config.self;
  return links;
}

size_t max_chunks(const NetConfig& config) {
  return config.max_message_bytes / config.bulk_chunk_bytes + 1;
}

}  // namespace

void Network::add_metrics(Metrics& metrics,
                          const std::function<std::string(NodeId)>& name_of_node) {
  for (const NetCounterName& counter : net_counter_names)
    metrics.add_counter(
        {std::string("net_") + counter.name, "", std::string("Network: ") + counter.help + ".", ""},
        counters_.*counter.value);
  for (size_t i = 0; i < refusal_reasons; ++i) {
    const std::string reason =
        fmt::format("reason=\"{}\"", luxodus::name_of(static_cast<RefusalReason>(i)));
    metrics.add_counter({"net_refused", "", "Neighbours that this node refused.", reason},
                        counters_.refused[i]);
    metrics.add_counter({"net_refused_by_peer", "", "Neighbours that refused this node.", reason},
                        counters_.refused_by_peer[i]);
  }
  for (size_t i = 0; i < links_.size(); ++i) {
    const LinkSample& link = link_samples_[i];
    const std::string to = fmt::format("neighbour=\"{}\"", name_of_node(links_[i].neighbour()));
    metrics.add_gauge(
        {"link_phase", "", "0 connecting, 1 greeting, 2 up, 3 suspect, 4 down, 5 refused.", to},
        link.phase);
    metrics.add_counter({"link_sent", "bytes", "Sent over the link.", to}, link.bytes_sent);
    metrics.add_counter({"link_received", "bytes", "Received over it.", to}, link.bytes_received);
    metrics.add_gauge({"link_credit", "bytes", "What the neighbour still allows.", to},
                      link.credit_bytes);
    metrics.add_gauge({"link_held", "bytes", "Frames of the link that wait here.", to},
                      link.held_bytes);
  }
  for (size_t i = 0; i < routed_kinds.size(); ++i)
    metrics.add_gauge({"outbox_messages", "", "Messages made here that wait for the network.",
                       fmt::format("kind=\"{}\"", name_of(routed_kinds[i]))},
                      outbox_samples_[i]);
}

void Network::sample() {
  for (size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    link_samples_[i] = {static_cast<uint64_t>(link.state().phase()), link.bytes_sent(),
                        link.bytes_received(), link.credit_bytes(), link.held_bytes()};
  }
  for (size_t i = 0; i < routed_kinds.size(); ++i)
    outbox_samples_[i] = router_.outbox(routed_kinds[i]).size();
}

size_t Network::memory_bytes() const {
  size_t sum = scratch_.size();
  for (const Link& link : links_) sum += link.memory_bytes();
  return sum;
}

void Network::plan_memory(MemoryPlan& plan, const NetConfig& config) {
  const size_t links = links_of(config);
  plan.add("frames on their way", links * Link::memory_bytes(config),
           fmt::format("{} links x {} kinds x {} hop classes of windows, resident as they are used",
                       links, routed_kinds.size(), config.hop_limit));
  size_t outboxes = 0;
  for (const Kind kind : routed_kinds)
    outboxes += Outbox::memory_bytes(config.outbox_messages, config.chunk_bytes(kind));
  plan.add("outboxes", outboxes,
           fmt::format("{} kinds x {} messages", routed_kinds.size(), config.outbox_messages));
  plan.add("assemblies", Assembler::memory_bytes(config.assemblies, max_chunks(config)),
           fmt::format("{} messages x a bit for each of {} chunks", config.assemblies,
                       max_chunks(config)));
  plan.add("message being made", limits::message_bytes, "longest head of a message");
}

}  // namespace luxodus
