// The pieces of reading a cluster's file, one per part of it. First every table is read by itself,
// and what is wrong with single keys, names and roles is found; only of a file without such faults
// is asked whether its parts fit together, so that one slip is one sentence. For cluster_file.cpp
// alone. Single-threaded.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "runtime/config/cluster_config.hpp"
#include "runtime/config/cluster_schema.hpp"
#include "runtime/toml/table_reader.hpp"

namespace luxodus::config {

using toml::TableReader;

struct ClusterReading {
  ClusterConfig cluster;
  toml::Findings findings;
  SourcePlace start;                         // of the file
  std::vector<SourcePlace> host_places;      // by number
  std::vector<SourcePlace> node_places;      // by number
  std::vector<std::string> process_names;    // by node: as said, or the node's own
  std::map<size_t, uint16_t> ports;          // by node: as said
  std::vector<TableReader::NamePair> links;  // as said
  std::vector<TableReader::Name> shards;     // as said
  TableReader::Name display;                 // as said; "": the controller
  std::vector<const toml::Table*> fault_events;
};

// Each table by itself.
void read_hosts(TableReader& top, ClusterReading& reading);
/// Requires: hosts are read.
void read_nodes(TableReader& top, ClusterReading& reading);
void read_topology(TableReader& top, ClusterReading& reading);
void read_faults(TableReader& top, ClusterReading& reading);

// What must fit together. Require: no problem so far.
void form_processes(ClusterReading& reading, uint16_t metrics_port);
/// Requires: processes are formed.
void give_ports(ClusterReading& reading);
void connect_nodes(ClusterReading& reading);
void place_shards(ClusterReading& reading);
void place_display(ClusterReading& reading);
/// Requires: nodes have their numbers.
void resolve_fault_events(ClusterReading& reading);

/// The node of this name; no_node, and a problem, where there is none.
NodeId named(const std::string& name, const SourcePlace& place, ClusterReading& reading);

}  // namespace luxodus::config
