// The files by which others start, watch and stop the processes of a cluster: units for systemd, a
// job for Slurm, a script over ssh, manifests for Kubernetes. Each starts `luxodus node` once for
// every process. Text only: nothing is written, started or asked; that programs, users and folders
// exist on the hosts is for whoever installs it. Any thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/config/cluster_config.hpp"

namespace luxodus {

/// What a start needs to know besides the cluster. The same paths hold on every host.
struct DeployOptions {
  std::filesystem::path program;  // absolute
  std::filesystem::path config;   // absolute
  std::string user;               // whom units run as
  std::string image;              // of containers: it has the program and the scene at their paths
};

struct DeployFile {
  std::filesystem::path path;  // within the folder of the deployment
  std::string text;
  bool executable = false;
  bool secret = false;  // for its owner alone
};

/// A folder for each host: a unit for each of its processes, and a target that starts them all.
std::vector<DeployFile> systemd_files(const ClusterConfig& cluster, const DeployOptions& options);

/// One batch job on whole machines, whose names are those of the cluster's hosts.
std::vector<DeployFile> slurm_files(const ClusterConfig& cluster, const DeployOptions& options);

/// One script that starts all, shows what they say, and stops all when one fails or is asked to.
std::vector<DeployFile> ssh_files(const ClusterConfig& cluster, const DeployOptions& options);

/// A Service, a ConfigMap with the cluster's file, and for each process a StatefulSet and a Secret
/// with the keys that it needs. Errors: hosts that are not called as their pods are, or have
/// several processes; the cluster's file or a key that cannot be read.
Result<std::vector<DeployFile>> kubernetes_files(const ClusterConfig& cluster,
                                                 const DeployOptions& options);

}  // namespace luxodus
