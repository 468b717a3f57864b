#include "actors/apps/deploy/deploy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "actors/apps/deploy/deploy_process.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

/// The command line of a process, each word quoted for the reader of the file.
template <class Quote>
std::string node_command(const ClusterConfig& cluster, const ClusterProcess& process,
                         const DeployOptions& options, const Quote& quote) {
  std::string line =
      quote(options.program.string()) + " node --config " + quote(options.config.string());
  for (const NodeId id : process.nodes) line += " --name " + quote(cluster.node(id).name);
  return line;
}

/// A word of a unit's command line (systemd.service(5), "Command lines").
std::string unit_word(const std::string& word) {
  std::string out = "\"";
  for (const char c : word) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '%' || c == '$') out += c;
    out += c;
  }
  return out + "\"";
}

/// A path in a unit outside of command lines: percent signs begin specifiers.
std::string unit_path(const fs::path& path) {
  std::string out;
  for (const char c : path.string()) {
    if (c == '%') out += c;
    if (c == ' ' || c == '\\' || c == '"')
      out += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out;
}

/// A word quoted for a shell if necessary.
std::string shell_word(const std::string& word) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string_view("/._-").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string out = "'";
  for (const char c : word) {
    if (c == '\'')
      out += "'\\''";
    else
      out += c;
  }
  return out + "'";
}

// ---- systemd -----------------------------------------------------------------------------------

std::string target_name(const ClusterConfig& cluster) {
  return "luxodus-" + cluster.run.name + ".target";
}
std::string unit_name(const ClusterConfig& cluster, const ClusterProcess& process) {
  return "luxodus-" + cluster.run.name + "-" + process.name + ".service";
}

/// What a node never needs: more privileges, loading code, devices or the kernel, writing outside
/// the folder of the results.
constexpr std::string_view confinement =
    R"(NoNewPrivileges=yes
CapabilityBoundingSet=
UMask=0077
ProtectSystem=strict
ProtectHome=read-only
PrivateTmp=yes
PrivateDevices=yes
ProtectClock=yes
ProtectHostname=yes
ProtectControlGroups=yes
ProtectKernelLogs=yes
ProtectKernelModules=yes
ProtectKernelTunables=yes
RestrictAddressFamilies=AF_UNIX AF_INET AF_INET6 AF_NETLINK
RestrictNamespaces=yes
RestrictRealtime=yes
RestrictSUIDSGID=yes
LockPersonality=yes
MemoryDenyWriteExecute=yes
SystemCallArchitectures=native
SystemCallFilter=@system-service
)";

std::string unit_text(const ClusterConfig& cluster, const ClusterProcess& process,
                      const DeployOptions& options) {
  std::string results;
  if (writes_results(cluster, process)) {
    results = fmt::format(
        "# The results' folder: it must be there, and belong to the user.\n"
        "ReadWritePaths={}\n",
        unit_path(cluster.run.out));
  }
  return fmt::format(
      R"(# Process {process} of run {run} on host {host}.
# Written by `luxodus deploy`; change the cluster's file instead.
[Unit]
Description=Luxodus {run}, {process}
Wants=network-online.target
After=network-online.target
PartOf={target}
StartLimitIntervalSec=300
StartLimitBurst=5

[Service]
Type=exec
User={user}
ExecStart={command}
Restart=on-failure
RestartSec=5
# Bad input does not heal by itself.
RestartPreventExitStatus=2
TimeoutStopSec={stop_s}
{results}{confinement}
[Install]
WantedBy={target}
)",
      fmt::arg("process", process.name), fmt::arg("run", cluster.run.name),
      fmt::arg("host", cluster.hosts[process.host].name), fmt::arg("target", target_name(cluster)),
      fmt::arg("user", options.user),
      fmt::arg("command", node_command(cluster, process, options, unit_word)),
      fmt::arg("stop_s", stop_seconds(cluster)), fmt::arg("results", results),
      fmt::arg("confinement", confinement));
}

// ---- Slurm and ssh -----------------------------------------------------------------------------

std::string shell_command(const ClusterConfig& cluster, const ClusterProcess& process,
                          const DeployOptions& options) {
  return node_command(cluster, process, options, shell_word);
}

/// Hosts with a process, in their order.
std::vector<std::string> used_hosts(const ClusterConfig& cluster) {
  std::vector<std::string> names;
  for (size_t host = 0; host < cluster.hosts.size(); ++host) {
    for (const ClusterProcess& process : cluster.processes) {
      if (process.host != host) continue;
      names.push_back(cluster.hosts[host].name);
      break;
    }
  }
  return names;
}

// The job ends with its controller: the failure of a worker is reported, and the run goes on
// without it. A shell with a trap exits only after its child, which has got the signal as well.
// Whole machines, since the cluster's file counts nodes, not Slurm; SLURM_HOSTFILE and an arbitrary
// distribution place each task on the host that the file says.
constexpr std::string_view slurm_script = R"(#!/bin/bash
# Run {run}: {tasks} processes on {hosts} hosts.
# Written by `luxodus deploy`; change the cluster's file instead.
#   sbatch {run}.sbatch
# Hosts are called here as Slurm calls them.
#SBATCH --job-name={run}
#SBATCH --nodelist={nodelist}
#SBATCH --nodes={hosts}
#SBATCH --exclusive
#SBATCH --mem=0
#SBATCH --no-kill
#SBATCH --output={run}-%j.log
# A minute before its time is over, nodes are asked to end and keep what they have.
#SBATCH --signal=TERM@60
set -euo pipefail

host_file=$(mktemp)
trap 'rm -f "$host_file"' EXIT
cat >"$host_file" <<'END'
{host_lines}END
export SLURM_HOSTFILE=$host_file

read -r -d '' task <<'END' || true
trap : TERM
case $SLURM_PROCID in
{cases}esac
END
srun --ntasks={tasks} --distribution=arbitrary --overcommit --cpu-bind=none --label \
  --kill-on-bad-exit=1 bash -c "$task"
)";

constexpr std::string_view ssh_head = R"(#!/bin/bash
# Run {run}. Written by `luxodus deploy`; change the cluster's file instead.
#   {run}.sh         starts all processes, shows what they say, ends when they have ended
#   {run}.sh stop    stops them, from anywhere; as does Ctrl-C
# It ends as the controller's process does, and stops all when that fails; it tells of others.
# Hosts are reached by ssh without a password, loopback addresses without ssh.
set -euo pipefail

run={run}
names=({names})
controller={controller}
addresses=({addresses})
commands=(
{commands})
)";

// On each host a shell supervises the process: it writes its number to a file for `stop`, forwards
// signals, and returns its exit code.
constexpr std::string_view ssh_body = R"sh(
# Run on the hosts: $0 is RUN/PROCESS, the rest its command.
# shellcheck disable=SC2016
keep='umask 077
note=$HOME/.luxodus/$0.pid
mkdir -p "${note%/*}"
if [ -f "$note" ] && kill -0 "$(cat "$note")" 2>/dev/null; then
  echo "runs already"
  exit 1
fi
"$@" &
child=$!
echo "$child" >"$note"
trap "kill -TERM $child 2>/dev/null" HUP INT TERM
status=0
wait "$child" || status=$?
while kill -0 "$child" 2>/dev/null; do # a signal came between
  status=0
  wait "$child" || status=$?
done
rm -f "$note"
exit "$status"'
# shellcheck disable=SC2016
end='note=$HOME/.luxodus/$0.pid
if [ -f "$note" ]; then kill -TERM "$(cat "$note")" 2>/dev/null || rm -f "$note"; fi'

# on ADDRESS SCRIPT NAME [COMMAND]
on() {
  local line
  line="sh -c $(printf '%q' "$2") $run/$3 ${4:-}"
  case $1 in
    localhost | 127.*) bash -c "$line" </dev/null ;;
    *) ssh -o BatchMode=yes -o ServerAliveInterval=15 -- "$1" "bash -c $(printf '%q' "$line")" \
      </dev/null ;;
  esac
}

stop_all() {
  local i stops=()
  for i in "${!names[@]}"; do
    on "${addresses[i]}" "$end" "${names[i]}" &
    stops+=("$!")
  done
  wait "${stops[@]}" || true
}

start_all() {
  local i ended status result=0 interrupted='' stopping=''
  local -A running=()
  trap 'interrupted=1' INT TERM
  for i in "${!names[@]}"; do
    { on "${addresses[i]}" "$keep" "${names[i]}" "${commands[i]}" 2>&1 |
      sed -u "s/^/${names[i]}: /"; } &
    running[$!]=${names[i]}
  done
  while [ "${#running[@]}" -gt 0 ]; do
    ended='' status=0
    wait -n -p ended "${!running[@]}" || status=$?
    if [ -n "${ended:-}" ]; then # and not a signal
      [ "$status" -eq 0 ] || echo "${running[$ended]}: ended with $status" >&2
      [ "${running[$ended]}" != "$controller" ] || result=$status
      unset "running[$ended]"
    fi
    if [ -z "$stopping" ] && { [ -n "$interrupted" ] || [ "$result" -ne 0 ]; }; then
      stopping=1
      stop_all
    fi
  done
  exit "$result"
}

case ${1:-start} in
  start) start_all ;;
  stop) stop_all ;;
  *)
    echo "usage: $0 [start|stop]" >&2
    exit 2
    ;;
esac
)sh";

}  // namespace

std::vector<DeployFile> systemd_files(const ClusterConfig& cluster, const DeployOptions& options) {
  std::vector<DeployFile> files;
  for (size_t host = 0; host < cluster.hosts.size(); ++host) {
    const fs::path folder = cluster.hosts[host].name;
    std::string wants;
    for (const ClusterProcess& process : cluster.processes) {
      if (process.host != host) continue;
      const std::string unit = unit_name(cluster, process);
      files.push_back({folder / unit, unit_text(cluster, process, options)});
      wants += "Wants=" + unit + "\n";
    }
    if (wants.empty()) continue;
    files.push_back({folder / target_name(cluster),
                     fmt::format("# All processes of run {0} on host {1}. Copy this folder's files "
                                 "to\n# /etc/systemd/system of that host; then systemctl "
                                 "daemon-reload && systemctl start luxodus-{0}.target\n"
                                 "[Unit]\nDescription=Luxodus {0} on {1}\n{2}\n"
                                 "[Install]\nWantedBy=multi-user.target\n",
                                 cluster.run.name, cluster.hosts[host].name, wants)});
  }
  return files;
}

std::vector<DeployFile> slurm_files(const ClusterConfig& cluster, const DeployOptions& options) {
  std::string host_lines, cases, nodelist;
  for (size_t i = 0; i < cluster.processes.size(); ++i) {
    const ClusterProcess& process = cluster.processes[i];
    host_lines += cluster.hosts[process.host].name + "\n";
    const std::string command = shell_command(cluster, process, options);
    cases += hosts_controller(cluster, process)
                 ? fmt::format("  {}) exec {} ;;\n", i, command)
                 : fmt::format("  {}) {} || echo \"{} ended with $?\" >&2 ;;\n", i, command,
                               process.name);
  }
  const auto hosts = used_hosts(cluster);
  for (const std::string& host : hosts) nodelist += (nodelist.empty() ? "" : ",") + host;
  return {{cluster.run.name + ".sbatch",
           fmt::format(slurm_script, fmt::arg("run", cluster.run.name),
                       fmt::arg("tasks", cluster.processes.size()), fmt::arg("hosts", hosts.size()),
                       fmt::arg("nodelist", nodelist), fmt::arg("host_lines", host_lines),
                       fmt::arg("cases", cases)),
           true}};
}

std::vector<DeployFile> ssh_files(const ClusterConfig& cluster, const DeployOptions& options) {
  std::string names, addresses, commands, controller;
  for (const ClusterProcess& process : cluster.processes) {
    const std::string blank = names.empty() ? "" : " ";
    names += blank + shell_word(process.name);
    if (hosts_controller(cluster, process)) controller = shell_word(process.name);
    addresses += blank + shell_word(cluster.hosts[process.host].address);
    commands += "  " + shell_word(shell_command(cluster, process, options)) + "\n";
  }
  return {{cluster.run.name + ".sh",
           fmt::format(ssh_head, fmt::arg("run", cluster.run.name), fmt::arg("names", names),
                       fmt::arg("controller", controller), fmt::arg("addresses", addresses),
                       fmt::arg("commands", commands)) +
               std::string(ssh_body),
           true}};
}

}  // namespace luxodus
