// The steps of reading a cluster file, one per part of it. First every table is read by itself,
// which finds mistakes in single keys, names and roles. Consistency between the parts is checked
// only if there are none, so that one slip gives one message. For cluster_file.cpp only.
// Single-threaded.
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
  std::vector<std::string> process_names;    // by node: as given, or the node's own name
  std::map<size_t, uint16_t> ports;          // by node: as given
  std::vector<TableReader::NamePair> links;  // as given
  std::vector<TableReader::Name> shards;     // as given
  TableReader::Name display;                 // as given; "": the controller
  std::vector<const toml::Table*> fault_events;
};

// Reading each table by itself.
void read_hosts(TableReader& top, ClusterReading& reading);
/// Requires: hosts are read.
void read_nodes(TableReader& top, ClusterReading& reading);
void read_topology(TableReader& top, ClusterReading& reading);
void read_faults(TableReader& top, ClusterReading& reading);

// Checks across tables. Require: no problem so far.
void form_processes(ClusterReading& reading, uint16_t metrics_port);
/// Requires: processes are formed.
void give_ports(ClusterReading& reading);
void connect_nodes(ClusterReading& reading);
void place_shards(ClusterReading& reading);
void place_display(ClusterReading& reading);
/// Requires: nodes have their numbers.
void resolve_fault_events(ClusterReading& reading);

/// The node of this name; no_node, and a problem, if there is none.
NodeId named(const std::string& name, const SourcePlace& place, ClusterReading& reading);

}  // namespace luxodus::config
