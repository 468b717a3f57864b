// luxodus status: prints one line for each node of a run, from the processes that serve metrics.
#include <fmt/core.h>

#include <algorithm>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/quantities.hpp"
#include "actors/apps/deploy/cluster_status.hpp"
#include "actors/results/formats/json_out.hpp"
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
  json["restarts"] = value(row.restarts);
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
    if (!url) return url.problem();
    asked.push_back({fmt::format("{}:{}", url.value().host, url.value().port), url.value(), {}});
  }
  if (options.config.empty()) return asked;
  const ReadCluster read = read_cluster(options.config);
  if (!read.cluster) return read.problems.list().front();
  for (const Problem& warning : read.warnings) warn(warning);
  auto processes = processes_of(*read.cluster);
  if (!processes) return processes.problem();
  for (AskedProcess& process : processes.value()) asked.push_back(std::move(process));
  return asked;
}

Result<ExitCode> show_status(const StatusOptions& options) {
  const auto patience = parse_seconds(options.patience);
  const auto processes = processes_from(options);
  if (!patience) return patience.problem();
  if (!processes) return processes.problem();
  if (processes.value().empty())
    return problem("say which cluster, by its file, or where its numbers are served, --url");
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

Command status_command() {
  const auto o = std::make_shared<StatusOptions>();
  return {.name = "status",
          .summary = "Show how the nodes of a running cluster are",
          .heading = "Cluster",
          .options = {{"config", &o->config, "Cluster file", {.form = Form::file}},
                      {"--url", &o->urls,
                       "Address (HOST:PORT) where a process serves its metrics; may be repeated"},
                      {"--patience",
                       &o->patience,
                       "Time to wait for a process that does not answer",
                       {.form = Form::duration}},
                      {"--json", &o->json, "Output as an array of objects instead of a table"}},
          .notes =
              "Asks each process of the cluster for its metrics ([observe] metrics_port) and "
              "prints a line per node.\n"
              "  luxodus status cluster.toml\n"
              "  luxodus status --url 127.0.0.1:9464     a run with --nodes and --metrics 9464\n"
              "State: up; suspect: a neighbour hears nothing of it; starting; down: its process "
              "does not answer. Exit code 1 where any node is down.",
          .run = [o] { return exit_code_of(show_status(*o)); }};
}

}  // namespace luxodus::cli
