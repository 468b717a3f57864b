#include "runtime/config/cluster_file.hpp"

#include <fmt/format.h>

#include <cmath>

#include "runtime/config/cluster_reading.hpp"
#include "runtime/core/hash.hpp"
#include "runtime/core/regular_file.hpp"
#include "runtime/toml/document.hpp"

namespace luxodus {

namespace {

using config::ClusterReading;
using toml::TableReader;

/// Bytes that ZeroMQ and the envelope add to a chunk; net_config.hpp counts the same.
constexpr size_t chunk_overhead_bytes = 128;

Nanoseconds span_of(double seconds_said) {
  return static_cast<Nanoseconds>(std::llround(seconds_said * 1e9));
}

TableReader reader_of(TableReader& top, const std::string& key) {
  return top.inner(key, {key});
}

void read_run(TableReader& top, ClusterReading& reading) {
  TableReader keys = reader_of(top, "run");
  RunChoice& run = reading.cluster.run;
  if (!top.has("run")) return;
  run.name = keys.text("name");
  Hasher hash;
  hash.add(std::string_view(run.name));
  const auto id = keys.maybe_integer("id");
  run.id = id ? static_cast<uint64_t>(*id) : hash.value();
  run.scene = keys.path("scene");
  run.scenario = keys.text("scenario");
  run.at_s = keys.maybe_number("at_s");
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
  TableReader keys = reader_of(top, "links");
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
  net.max_message_bytes = keys.size("max_message_bytes");
  net.assembly_patience = span_of(keys.number("assembly_s"));
  net.times.beat = milliseconds(static_cast<Nanoseconds>(keys.integer("beat_ms")));
  net.times.suspect_after_beats = static_cast<int>(keys.integer("suspect_after"));
  net.times.down_after_beats = static_cast<int>(keys.integer("down_after"));
  net.times.patience = span_of(keys.number("greeting_s"));
  if (net.times.suspect_after_beats >= net.times.down_after_beats)
    keys.problem("suspect_after", "'suspect_after' must be less than 'down_after'");
}

void read_services(TableReader& top, ClusterReading& reading) {
  TableReader lease = reader_of(top, "lease");
  reading.cluster.lease = {static_cast<uint32_t>(lease.integer("batches")),
                           span_of(lease.number("duration_s")),
                           static_cast<uint32_t>(lease.integer("fan_out"))};
  if (reading.cluster.lease.fan_out == 1)
    lease.problem("fan_out", "'fan_out' is 0, or at least 2: a coordinator leads several nodes");

  TableReader timeouts = reader_of(top, "timeouts");
  Timeouts& t = reading.cluster.timeouts;
  t.start = span_of(timeouts.number("start_s"));
  t.lost = span_of(timeouts.number("lost_s"));
  t.fetch_floor = span_of(timeouts.number("fetch_floor_ms") / 1e3);
  t.fetch_attempts = static_cast<uint32_t>(timeouts.integer("fetch_attempts"));
  t.shutdown_phase = span_of(timeouts.number("shutdown_phase_s"));
  t.stall = span_of(timeouts.number("stall_ms") / 1e3);

  reading.shards = reader_of(top, "tally").names("shards");

  TableReader display = reader_of(top, "display");
  reading.display = {display.text("node"), display.place("node")};
  reading.cluster.display.pictures = display.flag("pictures");
  reading.cluster.display.preview_s = display.number("preview_s");
  if (top.has("display") && top.has("view"))
    display.problem("node", "a live view writes no results: leave out [display] or [view]");
  if (top.has("display") && top.has("assess"))
    display.problem("node",
                    "the controller's process writes an assessment: leave out [display] or "
                    "[assess]");

  TableReader keys = reader_of(top, "keys");
  reading.cluster.keys = {keys.path("folder"), keys.flag("insecure")};
  if (keys.has("folder") && reading.cluster.keys.insecure)
    keys.problem("insecure", "'folder' names keys and 'insecure' forgoes them; keep one of them");
}

/// Returns the metrics port of each host's first process.
uint16_t read_observe(TableReader& top, ClusterReading& reading) {
  TableReader keys = reader_of(top, "observe");
  ObserveChoice& observe = reading.cluster.observe;
  observe.metrics_address = keys.text("metrics_address");
  if (!observe.metrics_address.empty() && !is_ipv4(observe.metrics_address))
    keys.problem("metrics_address", "'metrics_address' must be an IPv4 address");
  if (keys.has("allow_host")) observe.allow_host = keys.text("allow_host");
  observe.trace_every = keys.integer("trace_every");
  observe.log_level = keys.choice("log_level");
  return static_cast<uint16_t>(keys.integer("metrics_port"));
}

void read_view(TableReader& top, ClusterReading& reading) {
  ViewChoice& view = reading.cluster.view;
  view.live = top.has("view");
  TableReader keys = reader_of(top, "view");
  view.port = static_cast<uint16_t>(keys.integer("port"));
  view.address = keys.text("address");
  if (keys.has("allow_host")) view.allow_host = keys.text("allow_host");
  view.save_folder = keys.path("save_folder");
}

/// An assessment traces until its verdicts are decided.
void read_assess(TableReader& top, ClusterReading& reading) {
  AssessChoice& assess = reading.cluster.assess;
  assess.asked = top.has("assess");
  TableReader keys = reader_of(top, "assess");
  assess.rules = keys.texts("rules");
  assess.deviations = keys.texts("deviations");
  assess.rounds = static_cast<int>(keys.integer("rounds"));
  assess.smoke_scale = keys.numbers("smoke_scale");
  if (!assess.asked) return;
  if (top.has("view"))
    keys.problem("one cluster serves a live view or assesses: leave out [view] or [assess]");
  const RunChoice& run = reading.cluster.run;
  if (run.particles || run.relative_error || run.time_s)
    keys.problem(
        "an assessment traces what its verdicts need: leave out 'particles', "
        "'relative_error' and 'time_s' in [run], and say 'rounds' here");
}

/// Pictures are made of a finished run.
void read_render(TableReader& top, ClusterReading& reading) {
  RenderChoice& render = reading.cluster.render;
  render.asked = top.has("render");
  TableReader keys = reader_of(top, "render");
  render.view = keys.maybe_text("view").value_or("");
  render.paths = keys.maybe_integer("paths");
  render.time_s = keys.maybe_number("time_s");
  render.error = keys.maybe_number("error");
  render.full_paths = keys.flag("full_paths");
  render.raw = keys.flag("raw");
  if (!render.asked) return;
  if (top.has("view") || top.has("assess") || top.has("display"))
    keys.problem(
        "the controller's process makes pictures and nothing else: leave out [view], [assess] "
        "and [display], or [render]");
  const RunChoice& run = reading.cluster.run;
  if (run.particles || run.relative_error || run.time_s)
    keys.problem(
        "pictures are of a run that has ended: leave out 'particles', 'relative_error' and "
        "'time_s' in [run], and say 'paths', 'time_s' or 'error' here");
}

void check_fan_out(ClusterReading& reading) {
  const ClusterConfig& cluster = reading.cluster;
  if (cluster.tally.shards.empty() || cluster.lease.fan_out == 0) return;
  if (cluster.lease.fan_out >= cluster.workers()) return;
  reading.findings.problem(reading.shards.front().place,
                           "shards of the totals need one coordinator for all nodes: leave out "
                           "'shards', or 'fan_out' in [lease]");
}

void check_keys(ClusterReading& reading) {
  const KeysChoice& keys = reading.cluster.keys;
  if (!leaves_host(reading.cluster) || !keys.folder.empty() || keys.insecure) return;
  reading.findings.problem(
      reading.host_places.back(),
      "links leave their host and there are no keys: say folder = \"keys\" in [keys] and run "
      "`luxodus keygen --cluster FILE`, or, on a network where everybody is trusted, insecure = "
      "true");
}

void read_tables(const toml::Table& document, ClusterReading& reading) {
  TableReader top(document, config::cluster_schema(), {"cluster"}, reading.findings);
  read_run(top, reading);
  read_hosts(top, reading);
  read_nodes(top, reading);
  read_topology(top, reading);
  read_links(top, reading);
  read_services(top, reading);
  const uint16_t metrics_port = read_observe(top, reading);
  read_view(top, reading);
  read_assess(top, reading);
  read_render(top, reading);
  read_faults(top, reading);
  if (reading.findings.any_problem()) return;
  form_processes(reading, metrics_port);
  if (reading.findings.any_problem()) return;
  give_ports(reading);
  connect_nodes(reading);
  place_shards(reading);
  place_display(reading);
  check_fan_out(reading);
  resolve_fault_events(reading);
  check_keys(reading);
}

Problems only(const Problem& problem) {
  Problems problems;
  problems.add(problem);
  return problems;
}

/// Parses a text and calls `read(top)`. Returns all problems.
Problems read_document(std::string_view text, ClusterReading& reading, const auto& read) {
  const auto document = toml::parse(text, reading.start.file, limits::cluster_file_bytes);
  if (!document) return only(document.problem());
  read(document->top);
  return reading.findings.take_problems();
}

}  // namespace

ReadCluster parse_cluster(std::string_view text, const std::filesystem::path& file) {
  ClusterReading reading;
  reading.cluster.file = file;
  reading.start = {file.string(), 1};
  Problems problems =
      read_document(text, reading, [&](const toml::Table& top) { read_tables(top, reading); });
  if (!problems.empty()) return {std::nullopt, std::move(problems), {}};
  return {std::move(reading.cluster), {}, reading.findings.take_warnings()};
}

ReadCluster read_cluster(const std::filesystem::path& file) {
  const auto text = read_regular_file(file, limits::cluster_file_bytes);
  if (!text) return {std::nullopt, only(text.problem()), {}};
  return parse_cluster(text.value(), file);
}

ReadFaults read_fault_file(const std::filesystem::path& file,
                           const std::vector<std::string>& names) {
  const auto text = read_regular_file(file, limits::cluster_file_bytes);
  if (!text) return {std::nullopt, only(text.problem())};
  ClusterReading reading;
  reading.start = {file.string(), 1};
  for (const std::string& name : names) reading.cluster.nodes.emplace_back().name = name;
  Problems problems = read_document(text.value(), reading, [&](const toml::Table& table) {
    TableReader top(table, config::cluster_schema(), {"faults.file"}, reading.findings);
    read_faults(top, reading);
    if (!reading.findings.any_problem()) resolve_fault_events(reading);
  });
  if (!problems.empty()) return {std::nullopt, std::move(problems)};
  return {std::move(reading.cluster.faults), {}};
}

}  // namespace luxodus
