#include "actors/apps/deploy/cluster_status.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <thread>

#include "runtime/net/link_state.hpp"
#include "runtime/observe/metrics_text.hpp"

namespace luxodus {

namespace {

/// Processes asked in parallel: the timeouts of dead hosts then overlap, and a thread is cheap.
constexpr size_t asked_at_once = 32;

/// One node's numbers on a page, by name; several links or hops are added up.
using Numbers = std::map<std::string, double, std::less<>>;

struct Page {
  std::map<std::string, Numbers> nodes;
  std::map<std::string, std::string> roles;
  std::optional<double> process_bytes;
};

/// Names of nodes, by number.
using NodeNames = std::map<std::string, std::string, std::less<>>;

/// The neighbours' views of a node: the worst phase that any of them reports.
using Suspicions = std::map<std::string, bool>;

bool is_silent(double phase) {
  return phase == static_cast<double>(LinkPhase::suspect) ||
         phase == static_cast<double>(LinkPhase::down) ||
         phase == static_cast<double>(LinkPhase::refused);
}

Page read_page(const std::string& text, Suspicions& suspicions, NodeNames& names) {
  Page page;
  for (const MetricSample& sample : parse_metrics(text)) {
    if (sample.name == "luxodus_process_resident_bytes") page.process_bytes = sample.value;
    const std::string node(sample.label("node"));
    if (node.empty()) continue;
    if (sample.name == "luxodus_node_info") {
      page.roles[node] = sample.label("role");
      names[std::string(sample.label("number"))] = node;
    }
    if (sample.name == "luxodus_link_phase" && is_silent(sample.value))
      suspicions[std::string(sample.label("neighbour"))] = true;
    page.nodes[node][sample.name] += sample.value;
  }
  return page;
}

std::optional<double> number(const Numbers& numbers, std::string_view name) {
  const auto at = numbers.find(name);
  return at == numbers.end() ? std::nullopt : std::optional(at->second);
}

std::optional<double> hit_rate(const Numbers& numbers) {
  const auto hits = number(numbers, "luxodus_cache_hits_total");
  const auto misses = number(numbers, "luxodus_cache_misses_total");
  const auto joined = number(numbers, "luxodus_cache_joined_total");
  if (!hits || !misses || !joined) return std::nullopt;
  const double asked = *hits + *misses + *joined;
  return asked > 0 ? std::optional(*hits / asked) : std::nullopt;
}

NodeStatus row_of(const std::string& node, const Page& page, const Suspicions& suspicions,
                  const NodeNames& names) {
  NodeStatus row;
  row.node = node;
  row.process_bytes = page.process_bytes;
  const auto known = page.nodes.find(node);
  if (known == page.nodes.end()) {
    row.state = NodeState::starting;
    return row;
  }
  row.state = suspicions.count(node) > 0 ? NodeState::suspect : NodeState::up;
  const auto role = page.roles.find(node);
  if (role != page.roles.end()) row.role = role->second;
  const Numbers& n = known->second;
  if (const auto leads = number(n, "luxodus_led_by")) {
    const std::string number_of_it = fmt::format("{:.0f}", *leads);
    const auto name = names.find(number_of_it);
    row.led_by = name == names.end() ? "node " + number_of_it : name->second;
  }
  row.fibers = number(n, "luxodus_fibers_live");
  row.waiting = number(n, "luxodus_fibers_suspended");
  row.letters = number(n, "luxodus_mailbox_waiting");
  row.letters_rejected = number(n, "luxodus_mailbox_rejected_total");
  row.restarts = number(n, "luxodus_actor_restarts_total");
  row.hit_rate = hit_rate(n);
  row.credit_bytes = number(n, "luxodus_link_credit_bytes");
  row.batches = number(n, "luxodus_batches_total");
  if (!row.batches) row.batches = number(n, "luxodus_batches_counted_total");
  row.particles_per_s = number(n, "luxodus_particles_per_second");
  row.resident_bytes = number(n, "luxodus_objects_resident_bytes");
  return row;
}

/// The text of a column: the number in its unit, or a dash.
std::string shown(const std::optional<double>& value, double unit, int digits) {
  return value ? fmt::format("{:.{}f}", *value / unit, digits) : "-";
}

using Row = std::array<std::string, 16>;

Row cells_of(const NodeStatus& s) {
  constexpr double mib = 1024.0 * 1024.0;
  return {s.node,
          name_of(s.state),
          s.role.empty() ? "-" : s.role,
          s.led_by.empty() ? "-" : s.led_by,
          s.process,
          shown(s.fibers, 1, 0),
          shown(s.waiting, 1, 0),
          shown(s.letters, 1, 0),
          shown(s.letters_rejected, 1, 0),
          shown(s.restarts, 1, 0),
          shown(s.hit_rate, 0.01, 2),
          shown(s.credit_bytes, 1024, 0),
          shown(s.batches, 1, 0),
          shown(s.particles_per_s, 1, 0),
          shown(s.resident_bytes, mib, 1),
          shown(s.process_bytes, mib, 0)};
}

}  // namespace

const char* name_of(NodeState state) {
  constexpr const char* names[] = {"up", "suspect", "starting", "down"};
  return names[static_cast<size_t>(state)];
}

Result<std::vector<AskedProcess>> processes_of(const ClusterConfig& cluster) {
  std::vector<AskedProcess> asked;
  for (const ClusterProcess& process : cluster.processes) {
    if (process.metrics_port == 0)
      return problem_in(cluster.file,
                        "this cluster serves no metrics: say metrics_port in [observe]");
    AskedProcess& one = asked.emplace_back();
    one.name = process.name;
    const bool everywhere = cluster.observe.metrics_address == "0.0.0.0";
    one.url.host =
        everywhere ? cluster.hosts[process.host].address : cluster.observe.metrics_address;
    one.url.port = process.metrics_port;
    for (const NodeId node : process.nodes) one.nodes.push_back(cluster.node(node).name);
  }
  return asked;
}

std::vector<Result<std::string>> ask(const std::vector<AskedProcess>& processes,
                                     Nanoseconds patience) {
  std::vector<Result<std::string>> pages(processes.size(), problem("was not asked"));
  std::atomic<size_t> next{0};
  const auto work = [&] {
    for (size_t i = next++; i < processes.size(); i = next++)
      pages[i] = http_get(processes[i].url, patience);
  };
  std::vector<std::thread> threads;
  for (size_t i = 0; i < std::min(asked_at_once, processes.size()); ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  return pages;
}

std::vector<NodeStatus> status_of(const std::vector<AskedProcess>& processes,
                                  const std::vector<Result<std::string>>& pages) {
  Suspicions suspicions;
  NodeNames names;
  std::vector<Page> read;
  for (const Result<std::string>& page : pages)
    read.push_back(page ? read_page(page.value(), suspicions, names) : Page{});
  std::vector<NodeStatus> rows;
  for (size_t i = 0; i < processes.size(); ++i) {
    std::vector<std::string> nodes = processes[i].nodes;
    if (nodes.empty())
      for (const auto& [name, numbers] : read[i].nodes) nodes.push_back(name);
    if (nodes.empty()) nodes.emplace_back("?");
    for (const std::string& node : nodes) {
      NodeStatus row = pages[i].ok() ? row_of(node, read[i], suspicions, names) : NodeStatus{};
      row.node = node;
      row.process = processes[i].name;
      if (!pages[i].ok()) row.problem = pages[i].problem().what;
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::string status_table(const std::vector<NodeStatus>& rows) {
  const Row headings{"node",     "state",       "role",         "led by",
                     "process",  "fibers",      "waiting",      "letters",
                     "rejected", "restarts",    "hits %",       "credit KiB",
                     "batches",  "particles/s", "resident MiB", "process MiB"};
  constexpr size_t words = 5;  // columns of text are left-aligned, numbers right-aligned
  std::vector<Row> cells{headings};
  for (const NodeStatus& row : rows) cells.push_back(cells_of(row));
  std::array<size_t, std::tuple_size_v<Row>> widths{};
  for (const Row& row : cells)
    for (size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  std::string out;
  for (size_t r = 0; r < cells.size(); ++r) {
    std::string line;
    for (size_t c = 0; c < widths.size(); ++c) {
      const std::string blanks(widths[c] - cells[r][c].size(), ' ');
      line += (c == 0 ? "" : "  ");
      line += c < words ? cells[r][c] + blanks : blanks + cells[r][c];
    }
    if (r > 0 && !rows[r - 1].problem.empty()) line += "  " + rows[r - 1].problem;
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
  return out;
}

}  // namespace luxodus
