#include "runtime/config/cluster_schema.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/config/cluster_config.hpp"

namespace luxodus::config {

namespace {

using toml::KeySpec;
using toml::TableSpec;

std::vector<TableSpec> run_tables() {
  return {
      {"cluster",
       "Top of the file",
       {
           {"run", "table", "", "required", "", "what is computed, and where results go"},
           {"host", "tables", "", "required", "", "the machines"},
           {"node", "tables", "", "required", "", "the nodes, exactly one of them the controller"},
           {"budget", "table", "", "", "", "what every node may hold"},
           {"topology", "table", "", "", "", "who has a link to whom"},
           {"links", "table", "", "", "", "how links work"},
           {"lease", "table", "", "", "", "how work is given out"},
           {"timeouts", "table", "", "", "", "how long is waited for what"},
           {"tally", "table", "", "", "", "where what is counted lies"},
           {"display", "table", "", "", "", "where the run is shown and its results are written"},
           {"keys", "table", "", "", "", "by which nodes know each other"},
           {"observe", "table", "", "", "", "what can be seen of a run"},
           {"view", "table", "", "", "", "a live view in place of a run that ends"},
           {"assess", "table", "", "", "",
            "an assessment in place of a run; every node must hold the whole scene"},
           {"render", "table", "", "", "",
            "pictures of a finished run; every node must hold the whole scene"},
           {"faults", "table", "", "", "", "what shall go wrong, on purpose: for rehearsals"},
       }},
      {"run",
       "`[run]`",
       {
           {"name", "name", "", "required", "",
            "of the run: in logs, results, names of local sockets"},
           {"id", "integer", "", "", "[0, 9e18]",
            "nodes of another run are refused; follows from the name unless said"},
           {"scene", "path", "", "required", "", "scene file or pack"},
           {"scenario", "text", "", "\"\"", "",
            "state of the building; the scene's first if empty"},
           {"at_s", "number", "s", "", "[-1e6, 1e9]",
            "time of the state of a scene that changes in time, as `--at`; the scene's own unless "
            "said"},
           {"out", "path", "", "", "",
            "folder of the results, on the host of the display; `out/NAME` beside this file unless "
            "said"},
           {"profile", "path", "", "", "",
            "file of `luxodus profile`, by which nodes that fetch objects plan who traces, holds "
            "and keeps what; no plan without it"},
           {"sharing", "flag", "", "true", "",
            "nodes of one process share what several of them have built of the scene: one copy, "
            "built once"},
           {"particles", "integer", "", "", "[1, 9e18]",
            "the run ends after so many; the first that is reached of this and the next two ends "
            "it"},
           {"relative_error", "number", "", "", "(0, 1]", "... at this relative standard error"},
           {"time_s", "number", "s", "", "(0, 1e8]", "... after this time"},
           {"level", "choice", "", "\"bit\"", "bit, statistical",
            "results are equal to the bit (all processors then have the same instruction set), or "
            "within their errors"},
       }},
  };
}

std::vector<TableSpec> node_tables() {
  return {
      {"host",
       "`[[host]]`: a machine",
       {
           {"name", "name", "", "required", "",
            "of the machine; Slurm's name of it, if Slurm is used"},
           {"address", "address", "", "\"127.0.0.1\"", "",
            "IPv4 address or host name that others connect to; mandatory with several hosts"},
           {"listen", "address", "", "", "",
            "IPv4 address to listen on; `address` where that is one, else all of the machine"},
           {"first_port", "integer", "", "27600", "[1024, 65534]",
            "its nodes use two TCP ports each from here on, in their order"},
       }},
      {"node",
       "`[[node]]`: one thread with its share of memory; numbered as they stand, the controller "
       "last",
       {
           {"name", "name", "", "required", "", "of the node, and of its key file"},
           {"count", "integer", "", "1", "[1, 1024]",
            "with more than one these are nodes NAME0, NAME1, ..."},
           {"host", "text", "", "", "", "where it runs; mandatory with several hosts"},
           {"role", "choice", "", "\"worker\"", "worker, controller",
            "traces, or gives out work and collects results"},
           {"process", "name", "", "", "",
            "nodes of one host that name the same process share it; its own unless said"},
           {"port", "integer", "", "", "[1024, 65534]",
            "TCP port for what is urgent, and the next for bulk; from `first_port` unless said"},
           {"stores", "flag", "", "true", "",
            "its host has the scene's objects, and it holds its part of them for all; without, it "
            "gets all from others, and the skeleton of a pack is enough"},
           {"budget", "table", "", "", "", "what this node may hold, where it differs"},
       }},
      {"node.controller",
       "`[[node]]` with `role = \"controller\"`",
       {{"traces", "flag", "", "false", "",
         "it traces particles too, by a worker in its process, NAME-tracer"}}},
      {"budget",
       "`[budget]` for all nodes, `[node.budget]` for one, which says what differs",
       {
           {"object_bytes", "size", "B", "\"1 GiB\"", "[1048576, 1e14]",
            "geometry, media and textures held at once, as built; a scene that fits is resident"},
           {"tally_bytes", "size", "B", "\"256 MiB\"", "[1048576, 1e14]",
            "scores of batches in work, totals until they are sent, and the sending; a tally that "
            "is full is sent at once, and a batch that is more by itself ends the run"},
           {"fibers", "integer", "", "4096", "[1, 100000]",
            "particles followed at once; more hide more delay and share more fetches"},
           {"prefetch", "integer", "", "0", "[0, 64]",
            "cells that a ray enters next, asked for ahead of the one that is waited for"},
           {"stack_kb", "integer", "KiB", "64", "[48, 1024]", "stack of one fiber"},
           {"max_maps", "integer", "", "0", "[0, 1e7]",
            "memory maps for guards between stacks; 0: its part of the system's limit"},
       }},
  };
}

TableSpec link_table() {
  return {
      "links",
      "`[links]`",
      {
          {"same_host", "choice", "", "\"ipc\"", "ipc, tcp",
           "between processes of one host; within a process it is memory, between hosts TCP"},
          {"hop_limit", "integer", "", "5", "[1, 15]", "links that a message may pass"},
          {"small_chunk_bytes", "size", "B", "4096", "[1024, 1048576]",
           "longest piece of control messages and requests"},
          {"bulk_chunk_bytes", "size", "B", "65536", "[4096, 16777216]",
           "longest piece of objects and results"},
          {"small_window_chunks", "integer", "", "4", "[1, 1024]",
           "pieces of a kind and hop class on their way over one link"},
          {"bulk_window_chunks", "integer", "", "16", "[1, 1024]",
           "the same for bulk: bandwidth x round trip x 2, in pieces, at least 4"},
          {"outbox_messages", "integer", "", "64", "[1, 65536]",
           "messages of a kind made by a node that wait for the network"},
          {"assemblies", "integer", "", "64", "[1, 65536]",
           "messages in several pieces that come in at once; also fetches in flight, up to 256"},
          {"max_message_bytes", "size", "B", "\"64 MiB\"", "[65536, 1e9]", "longest message"},
          {"beat_ms", "integer", "ms", "250", "[10, 60000]", "between signs of life"},
          {"suspect_after", "integer", "", "3", "[1, 100]", "missed beats"},
          {"down_after", "integer", "", "8", "[2, 1000]",
           "missed beats, more than `suspect_after`"},
          {"greeting_s", "number", "s", "10", "(0, 3600]", "patience with a neighbour's greeting"},
          {"assembly_s", "number", "s", "10", "(0, 3600]",
           "patience with the next piece of a message"},
      }};
}

std::vector<TableSpec> topology_tables() {
  const KeySpec max_links = {"links", "integer", "", "4", "[1, 64]", "of a node, at most"};
  const KeySpec controller = {
      "controller",
      "choice",
      "",
      "\"endpoint\"",
      "endpoint, forwards, node",
      "passes no messages on; passes them on; is wired as all other nodes are"};
  const KeySpec controller_links = {"controller_links",
                                    "integer",
                                    "",
                                    "4",
                                    "[1, 64]",
                                    "of the controller, at most, unless it is wired as a node"};
  return {
      {"topology",
       "`[topology]`",
       {{"kind", "choice", "", "\"amp\"", "amp, file, links",
         "a minimum-path graph of as many nodes; a graph's file; links one by one"}}},
      {"topology.amp",
       "`[topology]` with `kind = \"amp\"`",
       {max_links, controller, controller_links}},
      {"topology.file",
       "`[topology]` with `kind = \"file\"`",
       {{"file", "path", "", "required", "", "as `luxodus topology` writes it"}}},
      {"topology.links",
       "`[topology]` with `kind = \"links\"`",
       {{"pairs", "name pairs", "", "required", "", "`[[\"n0\", \"n1\"], ...]`: names of nodes"},
        max_links,
        controller,
        controller_links}},
      link_table(),
  };
}

std::vector<TableSpec> service_tables() {
  return {
      {"lease",
       "`[lease]`",
       {
           {"batches", "integer", "", "4", "[1, 1024]",
            "batches lent to a node at once: two in work, the others at hand"},
           {"duration_s", "number", "s", "60", "(0, 86400]",
            "after which they are given to another"},
           {"fan_out", "integer", "", "0", "[0, 1023]",
            "nodes that a coordinator leads at most. 0: the controller leads all below 64 workers, "
            "else a square root of them, which lead the others and trace nothing"},
       }},
      {"timeouts",
       "`[timeouts]`",
       {
           {"start_s", "number", "s", "60", "(0, 86400]",
            "until all nodes are there: a run begins with all its workers, or ends without"},
           {"lost_s", "number", "s", "30", "(0, 86400]",
            "a worker that no way leads to for so long is lost, and its batches are lent again; a "
            "worker whose controller is lost ends"},
           {"fetch_floor_ms", "number", "ms", "50", "(0, 60000]",
            "for an object, at least; else three times the usual"},
           {"fetch_attempts", "integer", "", "4", "[1, 100]", "at one holder, before the next"},
           {"shutdown_phase_s", "number", "s", "10", "(0, 3600]", "for each step of an end"},
           {"stall_ms", "number", "ms", "20", "(0, 60000]", "a fiber that runs longer is reported"},
       }},
      {"tally",
       "`[tally]`",
       {
           {"shards", "names", "", "", "",
            "workers that hold a share of the totals each, in equal ranges of bins; the first "
            "share stays with the controller. Losing one of them ends the run without a result"},
       }},
      {"display",
       "`[display]`",
       {
           {"node", "text", "", "\"\"", "",
            "the node that shows the run and writes the results, on its host; the controller "
            "unless said. Losing it loses no flux: begun again, it asks for it anew"},
           {"pictures", "flag", "", "false", "",
            "a picture of every camera when the run has ended, as `luxodus run` makes them"},
           {"preview_s", "number", "s", "0", "[0, 1e8]",
            "between previews while the run goes on; 0: none but when the process gets SIGUSR1"},
       }},
      {"keys",
       "`[keys]`",
       {
           {"folder", "path", "", "", "",
            "NAME.key and NAME.key.pub of each node, made by `luxodus keygen`; encrypts all links "
            "but those within a process"},
           {"insecure", "flag", "", "false", "",
            "links beyond a host need keys, or this; anybody can then read and forge what they "
            "carry"},
       }},
      {"observe",
       "`[observe]`",
       {
           {"metrics_port", "integer", "", "0", "[0, 65535]",
            "of a host's first process, the next port of its second, ...; 0: none"},
           {"metrics_address", "address", "", "\"127.0.0.1\"", "", "IPv4 address to answer on"},
           {"allow_host", "address", "", "", "",
            "a name under which the numbers may be asked for, beside the address and the host's"},
           {"trace_every", "integer", "", "0", "[0, 1e12]",
            "particles of which one is traced; 0: none"},
           {"log_level", "choice", "", "\"info\"", "debug, info, warn, error", "what is logged"},
       }},
      {"view",
       "`[view]`: the controller's process serves a live view, for which all workers trace, until "
       "Ctrl-C; every node must hold the whole scene",
       {
           {"port", "integer", "", "8080", "[0, 65535]", "of the page; 0: any that is free"},
           {"address", "address", "", "\"127.0.0.1\"", "",
            "to listen on; beyond this machine a token is demanded, which the controller prints"},
           {"allow_host", "address", "", "", "",
            "a name under which browsers may ask for the page, beside the address"},
           {"save_folder", "path", "", "", "",
            "where variants are saved, on the controller's host; the folder it was started in "
            "unless said"},
       }},
      {"assess",
       "`[assess]`: the controller's process assesses the scene into `out` of `[run]`",
       {
           {"rules", "texts", "", "", "", "rule sets; those of the scene unless said"},
           {"deviations", "texts", "", "", "",
            "national deviations from them; those of the scene unless said"},
           {"rounds", "integer", "", "4", "[1, 8]",
            "of paths, each of four times as many, for what is undecided"},
           {"smoke_scale", "numbers", "", "[]", "[0, 1e6]",
            "signs are assessed again with all smoke times each of these"},
       }},
      {"render",
       "`[render]`: the controller's process makes pictures of the finished run in `out` of "
       "`[run]`, as `luxodus render` does, and all workers trace them",
       {
           {"view", "text", "", "", "", "name of one camera; all unless said"},
           {"paths", "integer", "", "", "[1, 65536]",
            "a pixel at most; 32 unless said, 65536 with `time_s` or `error`"},
           {"time_s", "number", "s", "", "(0, 1e9]",
            "of all pictures together, after which no more paths are added"},
           {"error", "number", "", "", "(0, 1]",
            "at which pictures end, as `--picture-error` of `luxodus render` has it"},
           {"full_paths", "flag", "", "false", "",
            "paths traced to their end instead of to the run's flux"},
           {"raw", "flag", "", "false", "", "PNG files of the light as traced, with its noise"},
       }},
  };
}

std::vector<TableSpec> fault_tables() {
  return {
      {"faults.file",
       "Top of a file of faults alone, as `luxodus sim --faults FILE` reads it",
       {{"faults", "table", "", "required", "", "what shall go wrong"}}},
      {"faults",
       "`[faults]`: what every link does to frames, each way; without the table, nothing",
       {
           {"seed", "integer", "", "1", "[0, 9e18]", "of all that is left to chance"},
           {"delay_ms", "number", "ms", "0", "[0, 100]", "one way, at least"},
           {"jitter_ms", "number", "ms", "0", "[0, 1000]", "on top, uniform"},
           {"tail_share", "number", "", "0", "[0, 1]", "of frames that take longer"},
           {"tail_ms", "number", "ms", "0", "[0, 10000]", "by up to so much"},
           {"bytes_per_second", "number", "B/s", "0", "[0, 1e12]", "of each link; 0: no limit"},
           {"queue_bytes", "size", "B", "\"4 MiB\"", "[65536, 1e9]",
            "that wait for a link of limited speed"},
           {"loss", "number", "", "0", "[0, 1]", "share of frames that are lost"},
           {"duplication", "number", "", "0", "[0, 1]", "that come twice"},
           {"reordering", "number", "", "0", "[0, 1]",
            "that are overtaken by what is sent within `tail_ms`"},
           {"corruption", "number", "", "0", "[0, 1]", "that come with a few bits turned"},
           {"until_s", "number", "s", "", "(0, 1e8]",
            "after which links only delay; to the end unless said"},
           {"event", "tables", "", "", "", "what happens at a moment"},
       }},
      {"faults.event",
       "`[[faults.event]]`: something that happens to a node, or between two",
       {
           {"kind", "choice", "", "required",
            "crash, pause, slow, cut, clog, disconnect, full_disk, failed_read, failure",
            "the node's process ends at once; it stands still; its work takes `factor` as long; "
            "frames from `node` to `peer` are lost; they wait; both ends lose the connection; its "
            "journal finds no room; it can read nothing of the scene that it holds; one of its "
            "actors "
            "fails at what it does next"},
           {"at_s", "number", "s", "required", "[0, 1e8]", "since the start of the node"},
           {"lasts_s", "number", "s", "1", "(0, 1e8]", "how long"},
           {"node", "text", "", "required", "", "a node's name"},
           {"peer", "text", "", "", "", "a neighbour's name, for what happens between two"},
           {"factor", "number", "", "10", "[1, 1e6]", "of `slow`"},
           {"actor", "choice", "", "\"tracer\"",
            "coordinator, journal, tracer, tally_shard, part_server, display",
            "of `failure`: which actor of the node"},
       }},
  };
}

bool is_plain(std::string_view text) {
  return std::none_of(text.begin(), text.end(),
                      [](char c) { return static_cast<unsigned char>(c) < 0x20; });
}
bool is_name(std::string_view text) {
  return check_name(text).ok();
}
bool is_address(std::string_view text) {
  return check_address(std::string(text)).ok();
}

}  // namespace

std::vector<toml::TextRule> text_rules() {
  return {
      {"text", is_plain, "a text without control characters"},
      {"name", is_name,
       fmt::format("1 to {} letters, digits, '-', '_' or '.', the first no '-' and no '.'",
                   limits::cluster_name_chars)},
      {"address", is_address, "an IPv4 address or a host's name"},
  };
}

const toml::Schema& cluster_schema() {
  static const toml::Schema schema = [] {
    toml::Schema all;
    for (auto part :
         {run_tables(), node_tables(), topology_tables(), service_tables(), fault_tables()}) {
      for (auto& table : part) all.tables.push_back(std::move(table));
    }
    all.text_rules = text_rules();
    return all;
  }();
  return schema;
}

}  // namespace luxodus::config
