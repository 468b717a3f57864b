#include "runtime/config/cluster_file.hpp"

#include <fmt/format.h>

#include <cmath>

#include "runtime/config/cluster_reading.hpp"
#include "runtime/config/document.hpp"
#include "runtime/core/hash.hpp"

namespace luxodus {

namespace {

using config::ClusterReading;
using config::TableReader;

/// What ZeroMQ and the envelope add to a chunk; net_config.hpp counts the same.
constexpr size_t chunk_overhead_bytes = 128;

Nanoseconds span_of(double seconds_said) {
  return static_cast<Nanoseconds>(std::llround(seconds_said * 1e9));
}

TableReader reader_of(TableReader& top, std::string_view key, ClusterReading& reading) {
  return TableReader(top.table(key), {key}, reading.findings, top.place(key));
}

void read_run(TableReader& top, ClusterReading& reading) {
  TableReader keys = reader_of(top, "run", reading);
  RunChoice& run = reading.cluster.run;
  if (!top.has("run")) return;
  run.name = keys.name("name");
  Hasher hash;
  hash.add(std::string_view(run.name));
  run.id = keys.maybe_integer("id").value_or(hash.value());
  run.scene = keys.path("scene");
  run.scenario = keys.text("scenario");
  run.out = keys.path("out");
  if (!keys.has("out")) run.out = reading.cluster.file.parent_path() / "out" / run.name;
  run.profile = keys.path("profile");
  run.sharing = keys.flag("sharing");
  run.particles = keys.maybe_integer("particles");
  run.relative_error = keys.maybe_number("relative_error");
  run.time_s = keys.maybe_number("time_s");
  run.level = keys.choice("level") == "bit" ? Level::bit : Level::statistical;
}

void read_links(TableReader& top, ClusterReading& reading) {
  TableReader keys = reader_of(top, "links", reading);
  reading.cluster.tcp_within_host = keys.choice("same_host") == "tcp";
  NetConfig& net = reading.cluster.links;
  net.hop_limit = static_cast<uint8_t>(keys.integer("hop_limit"));
  net.small_chunk_bytes = keys.size("small_chunk_bytes");
  net.bulk_chunk_bytes = keys.size("bulk_chunk_bytes");
  net.small_window_bytes =
      keys.integer("small_window_chunks") * (net.small_chunk_bytes + chunk_overhead_bytes);
  net.bulk_window_bytes =
      keys.integer("bulk_window_chunks") * (net.bulk_chunk_bytes + chunk_overhead_bytes);
  net.outbox_messages = keys.integer("outbox_messages");
  net.assemblies = keys.integer("assemblies");
  net.max_message_bytes = keys.size("message_most");
  net.assembly_patience = span_of(keys.number("assembly_s"));
  net.times.beat = milliseconds(static_cast<Nanoseconds>(keys.integer("beat_ms")));
  net.times.suspect_after_beats = static_cast<int>(keys.integer("suspect_after"));
  net.times.down_after_beats = static_cast<int>(keys.integer("down_after"));
  net.times.patience = span_of(keys.number("greeting_s"));
  if (net.times.suspect_after_beats >= net.times.down_after_beats)
    keys.problem("suspect_after", "'suspect_after' must be less than 'down_after'");
}

void read_services(TableReader& top, ClusterReading& reading) {
  TableReader lease = reader_of(top, "lease", reading);
  reading.cluster.lease = {static_cast<uint32_t>(lease.integer("batches")),
                           span_of(lease.number("duration_s"))};

  TableReader timeouts = reader_of(top, "timeouts", reading);
  Timeouts& t = reading.cluster.timeouts;
  t.start = span_of(timeouts.number("start_s"));
  t.lost = span_of(timeouts.number("lost_s"));
  t.fetch_floor = span_of(timeouts.number("fetch_floor_ms") / 1e3);
  t.fetch_attempts = static_cast<uint32_t>(timeouts.integer("fetch_attempts"));
  t.shutdown_phase = span_of(timeouts.number("shutdown_phase_s"));
  t.stall = span_of(timeouts.number("stall_ms") / 1e3);

  // As many as a flush names, the controller's aside (proto: limits::tally_shards).
  reading.shards = reader_of(top, "tally", reading).names("shards", limits::tally_shards);

  TableReader keys = reader_of(top, "keys", reading);
  reading.cluster.keys = {keys.path("folder"), keys.flag("insecure")};
  if (keys.has("folder") && reading.cluster.keys.insecure)
    keys.problem("insecure", "'folder' names keys and 'insecure' forgoes them; keep one of them");
}

/// Returns the port of each host's first process.
uint16_t read_observe(TableReader& top, ClusterReading& reading) {
  TableReader keys = reader_of(top, "observe", reading);
  ObserveChoice& observe = reading.cluster.observe;
  observe.metrics_address = keys.address("metrics_address");
  if (!observe.metrics_address.empty() && !is_ipv4(observe.metrics_address))
    keys.problem("metrics_address", "'metrics_address' must be an IPv4 address");
  observe.trace_every = keys.integer("trace_every");
  observe.log_level = keys.choice("log_level");
  return static_cast<uint16_t>(keys.integer("metrics_port"));
}

void read_view(TableReader& top, ClusterReading& reading) {
  ViewChoice& view = reading.cluster.view;
  view.live = top.has("view");
  TableReader keys = reader_of(top, "view", reading);
  view.port = static_cast<uint16_t>(keys.integer("port"));
  view.address = keys.address("address");
  if (keys.has("allow_host")) view.allow_host = keys.address("allow_host");
  view.save_folder = keys.path("save_folder");
}

void check_keys(ClusterReading& reading) {
  const KeysChoice& keys = reading.cluster.keys;
  if (!leaves_host(reading.cluster) || !keys.folder.empty() || keys.insecure) return;
  reading.findings.add(
      reading.host_places.back(),
      "links leave their host and there are no keys: say folder = \"keys\" in [keys] and run "
      "`luxodus keygen --cluster FILE`, or, on a network where everybody is trusted, insecure = "
      "true");
}

void read_tables(const toml::table& document, ClusterReading& reading) {
  TableReader top(document, {"cluster"}, reading.findings, reading.start);
  read_run(top, reading);
  read_hosts(top, reading);
  read_nodes(top, reading);
  read_topology(top, reading);
  read_links(top, reading);
  read_services(top, reading);
  const uint16_t metrics_port = read_observe(top, reading);
  read_view(top, reading);
  read_faults(top, reading);
  if (!reading.findings.empty()) return;
  form_processes(reading, metrics_port);
  if (!reading.findings.empty()) return;
  give_ports(reading);
  connect_nodes(reading);
  place_shards(reading);
  resolve_fault_events(reading);
  check_keys(reading);
}

Problems read_document(std::string_view text, ClusterReading& reading, const auto& read) {
  return config::read_document(text, reading.start, limits::cluster_file_bytes, reading.findings,
                               read);
}

Result<std::string> text_of(const std::filesystem::path& file) {
  return config::text_of_file(file, limits::cluster_file_bytes);
}

Problems only(const Problem& problem) {
  Problems problems;
  problems.add(problem);
  return problems;
}

}  // namespace

ReadCluster parse_cluster(std::string_view text, const std::filesystem::path& file) {
  ClusterReading reading;
  reading.cluster.file = file;
  reading.start = {file.string(), 1};
  Problems problems = read_document(
      text, reading, [&](const toml::table& document) { read_tables(document, reading); });
  if (!problems.list().empty()) return {std::nullopt, std::move(problems)};
  return {std::move(reading.cluster), {}};
}

ReadCluster read_cluster(const std::filesystem::path& file) {
  const auto text = text_of(file);
  if (!text.ok()) return {std::nullopt, only(text.problem())};
  return parse_cluster(text.value(), file);
}

ReadFaults read_fault_file(const std::filesystem::path& file,
                           const std::vector<std::string>& names) {
  const auto text = text_of(file);
  if (!text.ok()) return {std::nullopt, only(text.problem())};
  ClusterReading reading;
  reading.start = {file.string(), 1};
  for (const std::string& name : names) reading.cluster.nodes.emplace_back().name = name;
  Problems problems = read_document(text.value(), reading, [&](const toml::table& document) {
    TableReader top(document, {"faults.file"}, reading.findings, reading.start);
    read_faults(top, reading);
    if (reading.findings.empty()) resolve_fault_events(reading);
  });
  if (!problems.list().empty()) return {std::nullopt, std::move(problems)};
  return {std::move(reading.cluster.faults), {}};
}

}  // namespace luxodus
