// Reads machines, nodes, shared processes, and ports.
#include <fmt/format.h>

#include <algorithm>

#include "runtime/config/cluster_reading.hpp"
#include "runtime/toml/words.hpp"

namespace luxodus::config {

namespace {

/// A node of one [[node]] table, before all are known.
struct Draft {
  ClusterNode node;
  std::string process;
  std::optional<uint64_t> port;
  SourcePlace place;
};

std::string listen_address(const std::string& address) {
  if (address == "localhost") return "127.0.0.1";
  return is_ipv4(address) ? address : "*";  // only numeric addresses can be bound
}

/// Reads a budget; missing keys come from `base` if it is given.
NodeBudget read_budget(TableReader keys, const NodeBudget* base) {
  NodeBudget budget = base ? *base : NodeBudget{};
  const auto says = [&](std::string_view key) { return !base || keys.has(key); };
  const auto small = [&](std::string_view key) { return static_cast<uint32_t>(keys.integer(key)); };
  if (says("object_bytes")) budget.object_bytes = keys.size("object_bytes");
  if (says("tally_bytes")) budget.tally_bytes = keys.size("tally_bytes");
  if (says("fibers")) budget.fibers = small("fibers");
  if (says("prefetch")) budget.prefetch = small("prefetch");
  if (says("stack_kb")) budget.stack_bytes = small("stack_kb") * 1024;
  if (says("max_maps")) budget.max_maps = small("max_maps");
  return budget;
}

/// Index of the host that a node names, or of the only one.
size_t read_host(TableReader& keys, const ClusterReading& reading) {
  const std::string name = keys.text("host");
  const auto& hosts = reading.cluster.hosts;
  for (size_t i = 0; i < hosts.size(); ++i) {
    if (hosts[i].name == name) return i;
  }
  if (keys.has("host") && !name.empty()) {
    std::vector<std::string_view> known;
    for (const ClusterHost& host : hosts) known.push_back(host.name);
    const auto near = toml::nearest_word(name, known);
    keys.problem("host", fmt::format("there is no host \"{}\"{}", name,
                                     near ? fmt::format("; did you mean \"{}\"?", *near) : ""));
  } else if (hosts.size() > 1) {
    keys.problem("host", "there are several hosts: say on which this node runs");
  }
  return 0;
}

/// Reads one [[node]] table: a node, or `count` of them.
void read_node(const toml::Table& table, const NodeBudget& usual, ClusterReading& reading,
               std::vector<Draft>& drafts) {
  std::vector<std::string> specs{"node"};
  if (toml::chosen_kind(table, cluster_schema(), "node", "role") != "worker")
    specs.push_back("node.controller");
  TableReader keys(table, cluster_schema(), specs, reading.findings);
  Draft draft;
  draft.place = keys.place("name");
  const std::string name = keys.text("name");
  const auto count = static_cast<uint64_t>(keys.integer("count"));
  const bool controller = keys.choice("role") == "controller";
  draft.node.role = controller ? NodeRole::controller : NodeRole::worker;
  draft.node.traces = controller ? keys.flag("traces") : true;
  draft.node.stores = keys.flag("stores");
  draft.node.host = read_host(keys, reading);
  draft.node.budget = read_budget(keys.inner("budget", {"budget"}), &usual);
  draft.process = keys.text("process");
  const std::optional<uint64_t> port = keys.maybe_integer("port");
  if (port && *port + 2 * (count - 1) > 65534)
    keys.problem("port",
                 fmt::format("{} nodes from port {} on need ports above 65535", count, *port));
  const uint64_t room = limits::cluster_nodes - drafts.size();
  if (count > room)
    keys.problem("count", fmt::format("a cluster has at most {} nodes", limits::cluster_nodes));
  for (uint64_t i = 0; i < std::min(count, room); ++i) {
    draft.node.name = count == 1 ? name : name + std::to_string(i);
    if (port) draft.port = *port + 2 * i;
    drafts.push_back(draft);
    if (auto ok = check_name(draft.node.name); !name.empty() && !ok) {
      keys.problem("name",
                   fmt::format("\"{}\" is no name: {}", draft.node.name, ok.problem().what));
      return;
    }
  }
}

/// Adds the worker by which a controller traces, in its process.
void add_tracer(std::vector<Draft>& drafts, ClusterReading& reading) {
  const auto controller = std::find_if(drafts.begin(), drafts.end(), [](const Draft& draft) {
    return draft.node.role == NodeRole::controller && draft.node.traces;
  });
  if (controller == drafts.end() || controller->node.name.empty()) return;
  Draft tracer = *controller;
  tracer.node.role = NodeRole::worker;
  tracer.node.name = tracer_of(controller->node.name);
  tracer.port.reset();
  if (controller->process.empty()) controller->process = controller->node.name;
  tracer.process = controller->process;
  if (auto ok = check_name(tracer.node.name); !ok)
    reading.findings.problem(tracer.place, fmt::format("\"{}\", by which it traces, is no name: {}",
                                                       tracer.node.name, ok.problem().what));
  drafts.push_back(tracer);
}

void check_roles(const std::vector<Draft>& drafts, ClusterReading& reading) {
  const Draft* controller = nullptr;
  bool somebody_traces = false, a_worker_stores = false, a_worker = false;
  for (const Draft& draft : drafts) {
    somebody_traces = somebody_traces || draft.node.traces;
    if (draft.node.role != NodeRole::controller) {
      a_worker = true;
      a_worker_stores = a_worker_stores || draft.node.stores;
      continue;
    }
    if (controller) {
      reading.findings.problem(draft.place,
                               fmt::format("\"{}\" is a second controller; line {} has the first",
                                           draft.node.name, controller->place.line));
    } else {
      controller = &draft;
    }
  }
  if (!controller) {
    reading.findings.problem(reading.start,
                             "there is no controller: one [[node]] needs role = \"controller\"");
  } else if (!somebody_traces) {
    reading.findings.problem(controller->place,
                             "nobody traces: there are no workers; add some, or say traces = true");
  }
  if (a_worker && !a_worker_stores)
    reading.findings.problem(
        reading.start, "no worker has the scene's objects: leave stores = true on one at least");
}

void check_names(const std::vector<Draft>& drafts, ClusterReading& reading) {
  std::map<std::string_view, int> lines;
  for (const Draft& draft : drafts) {
    if (draft.node.name.empty()) continue;
    const auto [it, fresh] = lines.emplace(draft.node.name, draft.place.line);
    if (!fresh) {
      reading.findings.problem(
          draft.place,
          fmt::format("there is a node \"{}\" already, in line {}", draft.node.name, it->second));
    }
  }
}

}  // namespace

void read_hosts(TableReader& top, ClusterReading& reading) {
  const auto tables = top.tables("host", limits::cluster_hosts);
  for (const toml::Table* table : tables) {
    TableReader keys(*table, cluster_schema(), {"host"}, reading.findings);
    ClusterHost host;
    host.name = keys.text("name");
    host.address = keys.text("address");
    const std::string listen = keys.text("listen");
    host.listen = keys.has("listen") ? listen : listen_address(host.address);
    if (keys.has("listen") && !listen.empty() && !is_ipv4(listen))
      keys.problem("listen", "'listen' must be an IPv4 address");
    host.first_port = static_cast<uint16_t>(keys.integer("first_port"));
    if (tables.size() > 1 && !keys.has("address")) {
      keys.problem("address",
                   fmt::format("there are several hosts: say the address of \"{}\"", host.name));
    }
    for (size_t i = 0; i < reading.cluster.hosts.size(); ++i) {
      if (host.name.empty() || reading.cluster.hosts[i].name != host.name) continue;
      keys.problem("name", fmt::format("there is a host \"{}\" already, in line {}", host.name,
                                       reading.host_places[i].line));
    }
    reading.cluster.hosts.push_back(std::move(host));
    reading.host_places.push_back(keys.place("name"));
  }
}

void read_nodes(TableReader& top, ClusterReading& reading) {
  const NodeBudget usual = read_budget(top.inner("budget", {"budget"}), nullptr);
  std::vector<Draft> drafts;
  for (const toml::Table* table : top.tables("node", limits::cluster_nodes)) {
    read_node(*table, usual, reading, drafts);
  }
  if (drafts.empty()) return;  // the problem was reported
  add_tracer(drafts, reading);
  check_names(drafts, reading);
  check_roles(drafts, reading);
  std::stable_partition(drafts.begin(), drafts.end(),
                        [](const Draft& d) { return d.node.role == NodeRole::worker; });
  for (Draft& draft : drafts) {
    if (draft.port)
      reading.ports[reading.cluster.nodes.size()] = static_cast<uint16_t>(*draft.port);
    reading.process_names.push_back(draft.process.empty() ? draft.node.name : draft.process);
    reading.node_places.push_back(draft.place);
    reading.cluster.nodes.push_back(std::move(draft.node));
  }
}

void form_processes(ClusterReading& reading, uint16_t metrics_port) {
  ClusterConfig& cluster = reading.cluster;
  std::map<std::string, size_t> numbers;
  std::vector<uint32_t> on_host(cluster.hosts.size());
  for (size_t i = 0; i < cluster.nodes.size(); ++i) {
    ClusterNode& node = cluster.nodes[i];
    const std::string& name = reading.process_names[i];
    const auto [it, fresh] = numbers.emplace(name, cluster.processes.size());
    if (fresh) {
      const uint32_t port = metrics_port == 0 ? 0 : metrics_port + on_host[node.host]++;
      if (port > 65535) {
        return reading.findings.problem(
            reading.node_places[i],
            fmt::format("the process of \"{}\" would give metrics on port {}: begin with a lower "
                        "metrics_port",
                        node.name, port));
      }
      cluster.processes.push_back({name, node.host, {}, static_cast<uint16_t>(port)});
    }
    ClusterProcess& process = cluster.processes[it->second];
    if (process.host != node.host) {
      reading.findings.problem(
          reading.node_places[i],
          fmt::format("process \"{}\" runs on host \"{}\", and node \"{}\" on \"{}\"", name,
                      cluster.hosts[process.host].name, node.name, cluster.hosts[node.host].name));
    }
    process.nodes.push_back(NodeId{static_cast<uint16_t>(i)});
    node.process = it->second;
  }
}

namespace {

/// TCP ports in use, by address: hosts with the same address share them.
class PortBook {
 public:
  explicit PortBook(ClusterReading& reading) : reading_(reading) {}

  void take(const ClusterHost& host, uint32_t port, std::string who, const SourcePlace& place) {
    const auto [it, fresh] = taken_.emplace(std::pair(host.address, port), who);
    if (fresh) return;
    reading_.findings.problem(place,
                              fmt::format("{} and {} both use port {} of {}; give one another "
                                          "port, or its host another first_port",
                                          it->second, who, port, host.address));
  }

 private:
  ClusterReading& reading_;
  std::map<std::pair<std::string, uint32_t>, std::string> taken_;
};

}  // namespace

void give_ports(ClusterReading& reading) {
  ClusterConfig& cluster = reading.cluster;
  PortBook book(reading);
  std::vector<uint32_t> next;
  for (const ClusterHost& host : cluster.hosts) next.push_back(host.first_port);
  const bool tcp = uses_tcp(cluster);
  for (size_t i = 0; i < cluster.nodes.size(); ++i) {
    ClusterNode& node = cluster.nodes[i];
    const ClusterHost& host = cluster.hosts[node.host];
    const auto said = reading.ports.find(i);
    const uint32_t port = said != reading.ports.end() ? said->second : next[node.host];
    next[node.host] += 2;
    if (port > 65534) {
      return reading.findings.problem(
          reading.node_places[i],
          fmt::format("no port is left for \"{}\": host \"{}\" needs a lower "
                      "first_port",
                      node.name, host.name));
    }
    node.port = static_cast<uint16_t>(port);
    if (!tcp) continue;
    const std::string who = fmt::format("node \"{}\"", node.name);
    book.take(host, port, who, reading.node_places[i]);
    book.take(host, port + 1, who, reading.node_places[i]);
  }
  for (const ClusterProcess& process : cluster.processes) {
    if (process.metrics_port == 0) continue;
    book.take(cluster.hosts[process.host], process.metrics_port,
              fmt::format("metrics of \"{}\"", process.name),
              reading.node_places[process.nodes.front().value]);
  }
}

}  // namespace luxodus::config
