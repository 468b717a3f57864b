// Generates the files by which other systems start, watch and stop the processes of a cluster:
// units for systemd, a job for Slurm, a script for ssh, manifests for Kubernetes. Each starts
// `luxodus node` once for every process. Makes text only; the user ensures that programs, users and
// folders exist on the hosts. Any thread.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/config/cluster_config.hpp"

namespace luxodus {

/// Parameters besides the cluster. The same paths apply on every host.
struct DeployOptions {
  std::filesystem::path program;  // absolute
  std::filesystem::path config;   // absolute
  std::string user;               // the user that units run as
  std::string image;              // container image with the program and the scene at their paths
};

struct DeployFile {
  std::filesystem::path path;  // within the folder of the deployment
  std::string text;
  bool executable = false;
  bool secret = false;  // readable by its owner only
};

/// A folder for each host: a unit for each of its processes, and a target that starts them all.
std::vector<DeployFile> systemd_files(const ClusterConfig& cluster, const DeployOptions& options);

/// One batch job on whole machines with the names of the cluster's hosts.
std::vector<DeployFile> slurm_files(const ClusterConfig& cluster, const DeployOptions& options);

/// One script that starts all processes, shows their output, and stops all when one fails or on
/// request.
std::vector<DeployFile> ssh_files(const ClusterConfig& cluster, const DeployOptions& options);

/// A Service, a ConfigMap with the cluster's file, and for each process a StatefulSet and a Secret
/// with the keys that it needs. Errors: hosts whose names are not those of their pods, or that have
/// several processes; the cluster's file or a key that cannot be read.
Result<std::vector<DeployFile>> kubernetes_files(const ClusterConfig& cluster,
                                                 const DeployOptions& options);

}  // namespace luxodus
