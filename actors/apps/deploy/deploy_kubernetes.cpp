// Manifests for Kubernetes. A process is a StatefulSet of one pod, because each has its own name,
// keys and results; a headless Service gives the pods the host names by which nodes connect. The
// cluster's file states everything, so its hosts have the names of their pods.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "actors/apps/deploy/deploy.hpp"
#include "actors/apps/deploy/deploy_process.hpp"
#include "runtime/core/base64.hpp"
#include "runtime/core/regular_file.hpp"

namespace luxodus {

namespace {

namespace fs = std::filesystem;

/// Size of a file that a pod needs: a cluster's file, a key.
constexpr uint64_t max_manifest_file_bytes = uint64_t{1} << 20;  // the limit of a ConfigMap

std::string service_of(const ClusterConfig& cluster) {
  return "luxodus-" + cluster.run.name;
}
std::string set_of(const ClusterConfig& cluster, const ClusterProcess& process) {
  return service_of(cluster) + "-" + process.name;
}
/// The host name by which other pods of the namespace find it.
std::string address_of_pod(const ClusterConfig& cluster, const ClusterProcess& process) {
  return set_of(cluster, process) + "-0." + service_of(cluster);
}

/// A YAML string in double quotes, which is also valid JSON.
std::string yaml_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < ' ')
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + "\"";
}

/// A text as a block of YAML that keeps its lines.
std::string indented(std::string_view text, size_t blanks) {
  std::string out;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    if (!line.empty()) out.append(blanks, ' ').append(line);
    out += '\n';
    text.remove_prefix(std::min(text.size(), line.size() + 1));
  }
  return out;
}

/// Whether it is a DNS label, as names of pods and services must be.
bool is_label(std::string_view name) {
  const auto fits = [](char c) {
    return std::islower(static_cast<unsigned char>(c)) ||
           std::isdigit(static_cast<unsigned char>(c)) || c == '-';
  };
  return !name.empty() && name.size() <= 63 && name.front() != '-' && name.back() != '-' &&
         std::all_of(name.begin(), name.end(), fits);
}

/// Whether pods can be made of this cluster.
Result<void> check_pods(const ClusterConfig& cluster) {
  std::vector<size_t> processes_on(cluster.hosts.size(), 0);
  std::string wrong;
  for (const ClusterProcess& process : cluster.processes) {
    const ClusterHost& host = cluster.hosts[process.host];
    const std::string set = set_of(cluster, process);
    // The pod's name has "-0" appended.
    if (!is_label(set + "-0"))
      return problem(fmt::format(
          "\"{}\" cannot name a pod: call run and process by lower-case letters, digits and "
          "hyphens, at most 63 in all",
          set));
    if (++processes_on[process.host] > 1)
      return problem(fmt::format(
          "host \"{}\" has several processes, and a pod has one: give each process a host of its "
          "own",
          host.name));
    if (const std::string address = address_of_pod(cluster, process); host.address != address)
      wrong +=
          fmt::format("{}\"{}\" for host \"{}\"", wrong.empty() ? "" : ", ", address, host.name);
  }
  if (wrong.empty()) return {};
  return problem("pods are found by their names, so say in [[host]] the address " + wrong);
}

constexpr std::string_view shared_manifest = R"(# Run {run} on Kubernetes.
# Written by `luxodus deploy`; change the cluster's file instead.
#   kubectl apply{keys_file} -f {run}.yaml
# A pod whose process has ended well rests; the results lie in the claim of the display's pod, which
# is the controller's unless the cluster's file names another.
# Delete what this file makes when they have been copied: kubectl delete -f {run}.yaml
apiVersion: v1
kind: Service
metadata:
  name: {service}
  labels: {{app: luxodus, run: "{run}"}}
spec:
  clusterIP: None
  # Nodes meet before any of them is ready.
  publishNotReadyAddresses: true
  selector: {{app: luxodus, run: "{run}"}}
---
apiVersion: v1
kind: ConfigMap
metadata:
  name: {service}
  labels: {{app: luxodus, run: "{run}"}}
data:
  cluster.toml: |2
{config})";

/// A pod is restarted whatever its process returns, so one that has ended well sleeps. The shell is
/// the container's first process and receives signals; it forwards them.
constexpr std::string_view keep_running =
    R"sh(stopped= told=
"$0" "$@" & child=$!
trap "stopped=1 told=1; kill -TERM $child 2>/dev/null" TERM INT
status=0; wait $child || status=$?
# A signal ends a wait, which then says nothing of the process; 127: it was waited for before.
while [ -n "$told" ]; do
  told= again=0; wait $child || again=$?
  [ $again -eq 127 ] || status=$again
done
if [ -n "$stopped" ] || [ $status -ne 0 ]; then exit $status; fi
trap 'kill $! 2>/dev/null && wait $!; exit 0' TERM INT; while :; do sleep 3600 & wait $!; done)sh";

constexpr std::string_view set_manifest = R"(---
apiVersion: apps/v1
kind: StatefulSet
metadata:
  name: {set}
  labels: {{app: luxodus, run: "{run}", process: "{process}"}}
spec:
  serviceName: {service}
  replicas: 1
  selector:
    matchLabels: {{app: luxodus, run: "{run}", process: "{process}"}}
  template:
    metadata:
      labels: {{app: luxodus, run: "{run}", process: "{process}"}}
    spec:
      automountServiceAccountToken: false
      terminationGracePeriodSeconds: {grace_s}
      securityContext:
        runAsNonRoot: true
        runAsUser: 10001
        runAsGroup: 10001
        fsGroup: 10001
        seccompProfile: {{type: RuntimeDefault}}
{init}      containers:
        - name: node
          image: {image}
          command: ["/bin/sh", "-c", {script}]
          args: [{args}]
          resources:
            requests: {{cpu: "{threads}"}}
{ports}          securityContext:
            allowPrivilegeEscalation: false
            readOnlyRootFilesystem: true
            capabilities: {{drop: [ALL]}}
          volumeMounts:
            - {{name: config, mountPath: {config_path}, subPath: cluster.toml, readOnly: true}}
            - {{name: scratch, mountPath: /tmp}}
{mounts}      volumes:
        - name: config
          configMap: {{name: {service}}}
        - name: scratch
          emptyDir: {{}}
{volumes}{claims})";

constexpr std::string_view keys_copied = R"(      initContainers:
        # A node refuses keys that others may read, and a Secret's files are the group's too.
        - name: keys
          image: {image}
          command: ["/bin/sh", "-c", "umask 077 && cp /secret/* \"$0\" && chmod 600 \"$0\"/*"]
          args: [{folder}]
          securityContext:
            allowPrivilegeEscalation: false
            readOnlyRootFilesystem: true
            capabilities: {{drop: [ALL]}}
          volumeMounts:
            - {{name: secret, mountPath: /secret, readOnly: true}}
            - {{name: keys, mountPath: {folder}}}
)";

std::string words_of(const ClusterConfig& cluster, const ClusterProcess& process,
                     const DeployOptions& options) {
  std::string words = yaml_text(options.program.string()) + ", \"node\", \"--config\", " +
                      yaml_text(options.config.string());
  for (const NodeId id : process.nodes)
    words += ", \"--name\", " + yaml_text(cluster.node(id).name);
  return words;
}

/// For Kubernetes and readers; pods reach each other's ports without it.
std::string ports_of(const ClusterConfig& cluster, const ClusterProcess& process) {
  std::string ports;
  const auto add = [&](const std::string& name, int port) {
    ports += fmt::format("            - {{name: {}, containerPort: {}}}\n", name, port);
  };
  for (size_t i = 0; i < process.nodes.size(); ++i) {
    const int port = cluster.node(process.nodes[i]).port;
    add(fmt::format("control-{}", i), port);
    add(fmt::format("bulk-{}", i), port + 1);
  }
  if (process.metrics_port != 0) add("metrics", process.metrics_port);
  return "          ports:\n" + ports;
}

/// The volume claim of a pod that writes results or a journal, which outlive the pod.
std::string claim_of(const ClusterConfig& cluster, const ClusterProcess& process) {
  if (!writes_results(cluster, process)) return "";
  return fmt::format(
      "  volumeClaimTemplates:\n"
      "    - metadata: {{name: results, labels: {{app: luxodus, run: \"{}\"}}}}\n"
      "      spec:\n"
      "        accessModes: [ReadWriteOnce]\n"
      "        resources: {{requests: {{storage: 8Gi}}}}\n",
      cluster.run.name);
}

std::string manifest_of(const ClusterConfig& cluster, const ClusterProcess& process,
                        const DeployOptions& options) {
  const bool keyed = !cluster.keys.folder.empty();
  const std::string set = set_of(cluster, process);
  const std::string folder = yaml_text(cluster.keys.folder.string());
  std::string mounts, volumes;
  if (keyed) {
    mounts += fmt::format("            - {{name: keys, mountPath: {}, readOnly: true}}\n", folder);
    volumes += fmt::format(
        "        - name: secret\n          secret: {{secretName: {}, defaultMode: 0440}}\n"
        "        - name: keys\n          emptyDir: {{medium: Memory}}\n",
        set);
  }
  if (writes_results(cluster, process))
    mounts += fmt::format("            - {{name: results, mountPath: {}}}\n",
                          yaml_text(cluster.run.out.string()));
  const std::string init =
      keyed ? fmt::format(keys_copied, fmt::arg("image", yaml_text(options.image)),
                          fmt::arg("folder", folder))
            : "";
  return fmt::format(
      set_manifest, fmt::arg("set", set), fmt::arg("run", cluster.run.name),
      fmt::arg("process", process.name), fmt::arg("service", service_of(cluster)),
      fmt::arg("grace_s", stop_seconds(cluster)), fmt::arg("init", init),
      fmt::arg("image", yaml_text(options.image)),
      fmt::arg("args", words_of(cluster, process, options)),
      fmt::arg("threads", process.nodes.size()), fmt::arg("script", yaml_text(keep_running)),
      fmt::arg("ports", ports_of(cluster, process)),
      fmt::arg("config_path", yaml_text(options.config.string())), fmt::arg("mounts", mounts),
      fmt::arg("volumes", volumes), fmt::arg("claims", claim_of(cluster, process)));
}

/// The keys of a process' own nodes, and the public keys of all.
Result<std::string> secret_of(const ClusterConfig& cluster, const ClusterProcess& process) {
  std::string data;
  const auto add = [&](const fs::path& path) -> Result<void> {
    const auto text = read_regular_file(path, max_manifest_file_bytes);
    if (!text) return text.problem();
    data += fmt::format("  {}: {}\n", yaml_text(path.filename().string()), base64(text.value()));
    return {};
  };
  for (const NodeId id : process.nodes)
    if (auto added = add(key_path(cluster.keys.folder, cluster.node(id).name)); !added)
      return added.problem();
  for (const ClusterNode& node : cluster.nodes)
    if (auto added = add(public_key_path(cluster.keys.folder, node.name)); !added)
      return added.problem();
  return fmt::format(
      "---\napiVersion: v1\nkind: Secret\nmetadata:\n  name: {}\n"
      "  labels: {{app: luxodus, run: \"{}\"}}\ntype: Opaque\ndata:\n{}",
      set_of(cluster, process), cluster.run.name, data);
}

}  // namespace

Result<std::vector<DeployFile>> kubernetes_files(const ClusterConfig& cluster,
                                                 const DeployOptions& options) {
  if (auto ok = check_pods(cluster); !ok) return problem_in(cluster.file, ok.problem());
  const auto config = read_regular_file(options.config, max_manifest_file_bytes);
  if (!config) return config.problem();
  const std::string keys_file =
      cluster.keys.folder.empty() ? "" : " -f " + cluster.run.name + "-keys.yaml";
  std::string manifest = fmt::format(
      shared_manifest, fmt::arg("run", cluster.run.name), fmt::arg("service", service_of(cluster)),
      fmt::arg("keys_file", keys_file), fmt::arg("config", indented(config.value(), 4)));
  std::string secrets = fmt::format(
      "# Keys of run {}: whoever reads this file can pose as its nodes.\n", cluster.run.name);
  for (const ClusterProcess& process : cluster.processes) {
    manifest += manifest_of(cluster, process, options);
    if (cluster.keys.folder.empty()) continue;
    auto secret = secret_of(cluster, process);
    if (!secret) return secret.problem();
    secrets += secret.value();
  }
  std::vector<DeployFile> files{{cluster.run.name + ".yaml", std::move(manifest)}};
  if (!cluster.keys.folder.empty())
    files.push_back({cluster.run.name + "-keys.yaml", std::move(secrets), false, true});
  return files;
}

}  // namespace luxodus
