// luxodus status: one line for each node of a run, asked of the processes that serve metrics.
#include <fmt/core.h>

#include <algorithm>

#include "actors/cli/command.hpp"
#include "actors/output/json_out.hpp"
#include "actors/supervise/cluster_status.hpp"
#include "runtime/config/cluster_file.hpp"

namespace luxodus::cli {

namespace {

struct StatusOptions {
  std::string config;
  std::vector<std::string> urls;
  std::string patience = "2s";
  bool json = false;
};

Json row_json(const NodeStatus& row) {
  const auto value = [](const std::optional<double>& v) { return v ? Json(*v) : Json(); };
  Json json;
  json["node"] = row.node;
  json["process"] = row.process;
  json["state"] = name_of(row.state);
  json["role"] = row.role;
  json["fibers"] = value(row.fibers);
  json["fibers_waiting"] = value(row.waiting);
  json["hit_rate"] = value(row.hit_rate);
  json["credit_bytes"] = value(row.credit_bytes);
  json["batches"] = value(row.batches);
  json["particles_per_second"] = value(row.particles_per_s);
  json["resident_bytes"] = value(row.resident_bytes);
  json["process_bytes"] = value(row.process_bytes);
  if (!row.problem.empty()) json["problem"] = row.problem;
  return json;
}

Result<std::vector<AskedProcess>> processes_from(const StatusOptions& options) {
  std::vector<AskedProcess> asked;
  for (const std::string& text : options.urls) {
    auto url = parse_http_url(text);
    if (!url.ok()) return url.problem();
    asked.push_back({fmt::format("{}:{}", url.value().host, url.value().port), url.value(), {}});
  }
  if (options.config.empty()) return asked;
  const ReadCluster read = read_cluster(options.config);
  if (!read.cluster) return read.problems.list().front();
  auto processes = processes_of(*read.cluster);
  if (!processes.ok()) return processes.problem();
  for (AskedProcess& process : processes.value()) asked.push_back(std::move(process));
  return asked;
}

int show_status(const StatusOptions& options) {
  const auto patience = parse_seconds(options.patience);
  const auto processes = processes_from(options);
  if (!patience.ok() || !processes.ok()) {
    tell(patience.ok() ? processes.problem() : patience.problem());
    return ExitCode::bad_input;
  }
  if (processes.value().empty()) {
    tell({{}, "say which cluster, by its file, or where its numbers are served, --url"});
    return ExitCode::bad_input;
  }
  const auto pages = ask(processes.value(), static_cast<Nanoseconds>(patience.value() * 1e9));
  const std::vector<NodeStatus> rows = status_of(processes.value(), pages);
  if (options.json) {
    Json json = Json::array();
    for (const NodeStatus& row : rows) json.push_back(row_json(row));
    std::fputs(json_text(json).c_str(), stdout);
  } else {
    std::fputs(status_table(rows).c_str(), stdout);
  }
  const bool any_down = std::any_of(
      rows.begin(), rows.end(), [](const NodeStatus& row) { return row.state == NodeState::down; });
  return any_down ? ExitCode::failure : ExitCode::success;
}

}  // namespace

void add_status(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<StatusOptions>();
  CLI::App* command = app.add_subcommand("status", "Show how the nodes of a running cluster are");
  command->footer(
      "Asks each process of the cluster for its numbers ([observe] metrics_port) and prints a line "
      "per node.\n"
      "  luxodus status cluster.toml\n"
      "  luxodus status --url 127.0.0.1:9464     a run with --nodes and --metrics 9464\n"
      "State: up; suspect: a neighbour hears nothing of it; starting; down: its process does not "
      "answer.\n"
      "Ends with 1 where any node is down.");
  command->add_option("config", options->config, "the cluster's file");
  command->add_option("--url", options->urls,
                      "where a process serves its numbers, host:port; may be repeated");
  command->add_option("--patience", options->patience, "with a process that does not answer [2s]");
  command->add_flag("--json", options->json, "print an array of objects instead of a table");
  command->callback([options, &exit_code] { exit_code = show_status(*options); });
}

}  // namespace luxodus::cli
