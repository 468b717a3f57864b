#include "runtime/config/cluster_config.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace luxodus {

namespace {

bool is_loopback(const std::string& address) {
  return address == "localhost" || (is_ipv4(address) && address.starts_with("127."));
}

/// Local sockets have a name in the network namespace, so no file is left behind.
Endpoints local_endpoints(const ClusterConfig& cluster, const ClusterNode& node,
                          std::string_view scheme) {
  const std::string base =
      fmt::format("{}luxodus/{}/{:x}/{}", scheme, cluster.run.name, cluster.run.id, node.name);
  return {base + ".control", base + ".bulk"};
}

Endpoints tcp_endpoints(const std::string& address, const ClusterNode& node) {
  return {fmt::format("tcp://{}:{}", address, node.port),
          fmt::format("tcp://{}:{}", address, node.port + 1)};
}

Endpoints endpoints_of(const ClusterConfig& cluster, NodeId id, Carrier carrier, bool listening) {
  const ClusterNode& node = cluster.node(id);
  switch (carrier) {
    case Carrier::memory:
      return local_endpoints(cluster, node, "inproc://");
    case Carrier::local:
      return local_endpoints(cluster, node, "ipc://@");
    case Carrier::tcp:
      break;
  }
  const ClusterHost& host = cluster.host_of(id);
  return tcp_endpoints(listening ? host.listen : host.address, node);
}

}  // namespace

std::optional<NodeId> find_node(const ClusterConfig& cluster, std::string_view name) {
  for (size_t i = 0; i < cluster.nodes.size(); ++i) {
    if (cluster.nodes[i].name == name) return NodeId{static_cast<uint16_t>(i)};
  }
  return std::nullopt;
}

Result<void> check_name(std::string_view name) {
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == '.';
  };
  const bool edges_good = !name.empty() && name.front() != '-' && name.front() != '.';
  if (edges_good && name.size() <= limits::cluster_name_chars &&
      std::all_of(name.begin(), name.end(), good))
    return {};
  return problem(fmt::format(
      "a name has 1 to {} letters, digits, '-', '_' or '.', the first no '-' and no '.'",
      limits::cluster_name_chars));
}

bool is_ipv4(const std::string& address) {
  in_addr binary;
  return ::inet_pton(AF_INET, address.c_str(), &binary) == 1;
}

Result<void> check_address(const std::string& address) {
  constexpr size_t dns_name_chars = 253;  // RFC 1035
  const auto good = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-'; };
  const bool numeric = address.find_first_not_of("0123456789.") == std::string::npos;
  bool name = !numeric && address.size() <= dns_name_chars && address.back() != '.';
  for (size_t i = 0; name && i < address.size(); ++i) {
    const bool begins = i == 0 || address[i - 1] == '.';
    name = good(address[i]) ? !(begins && address[i] == '-') : address[i] == '.' && !begins;
  }
  if (name || is_ipv4(address)) return {};
  return problem("this is neither an IPv4 address nor a host's name");
}

NetConfig net_config(const ClusterConfig& cluster, NodeId self) {
  NetConfig net = cluster.links;
  net.self = self;
  net.nodes = cluster.nodes.size();
  net.identity.node = self;
  net.identity.level = cluster.run.level;
  net.identity.run_id = cluster.run.id;
  return net;
}

Carrier carrier_between(const ClusterConfig& cluster, NodeId a, NodeId b) {
  if (cluster.node(a).process == cluster.node(b).process) return Carrier::memory;
  const bool same_host = cluster.node(a).host == cluster.node(b).host;
  return same_host && !cluster.tcp_within_host ? Carrier::local : Carrier::tcp;
}

bool uses_tcp(const ClusterConfig& cluster) {
  const auto other_host = [&](const ClusterProcess& p) {
    return p.host != cluster.processes.front().host;
  };
  return std::any_of(cluster.processes.begin(), cluster.processes.end(), other_host) ||
         (cluster.tcp_within_host && cluster.processes.size() > 1);
}

bool leaves_host(const ClusterConfig& cluster) {
  return uses_tcp(cluster) &&
         std::any_of(cluster.processes.begin(), cluster.processes.end(), [&](const auto& process) {
           const ClusterHost& host = cluster.hosts[process.host];
           return !is_loopback(host.address) || !is_loopback(host.listen);
         });
}

NodeLinks links_of(const ClusterConfig& cluster, NodeId self, std::span<const Edge> edges) {
  NodeLinks links;
  std::vector<Carrier> listening;
  for (const Edge& edge : edges) {
    if (edge.b == self) {
      const Carrier carrier = carrier_between(cluster, self, edge.a);
      links.connect.emplace_back(edge.a, endpoints_of(cluster, edge.a, carrier, false));
    } else if (edge.a == self) {
      const Carrier carrier = carrier_between(cluster, self, edge.b);
      if (std::count(listening.begin(), listening.end(), carrier) > 0) continue;
      listening.push_back(carrier);
      links.listen.push_back(endpoints_of(cluster, self, carrier, true));
    }
  }
  return links;
}

std::filesystem::path key_path(const std::filesystem::path& folder, std::string_view node) {
  return folder / (std::string(node) + ".key");
}

std::filesystem::path public_key_path(const std::filesystem::path& folder, std::string_view node) {
  return folder / (std::string(node) + ".key.pub");
}

}  // namespace luxodus
