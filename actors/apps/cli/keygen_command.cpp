// luxodus keygen: makes the key pairs by which nodes of several hosts authenticate each other.
#include <fmt/format.h>

#include <filesystem>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/load_cluster.hpp"
#include "runtime/net/keys.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct KeygenOptions {
  std::string out;
  std::string cluster;
  std::vector<std::string> names;
  bool force = false;
};

/// Takes names and folder from the cluster's file.
Result<void> take_cluster(const ClusterConfig& cluster, KeygenOptions& options) {
  if (options.out.empty()) options.out = cluster.keys.folder.string();
  if (options.names.empty()) {
    for (const ClusterNode& node : cluster.nodes) options.names.push_back(node.name);
    return {};
  }
  for (const std::string& name : options.names)
    if (!find_node(cluster, name))
      return problem_in(options.cluster, fmt::format("there is no node \"{}\"", name));
  return {};
}

/// Makes the folder with access for its owner only: others could replace keys in it.
Result<void> make_folder(const fs::path& folder) {
  std::error_code failed;
  const bool is_new = fs::create_directories(folder, failed);
  const int made = failed.value();
  if (is_new) fs::permissions(folder, fs::perms::owner_all, failed);
  const fs::file_status status = fs::status(folder, failed);
  if (!fs::is_directory(status))
    return problem_in(folder, "is no folder, and none can be made there", kind_of_errno(made));
  if ((status.permissions() & (fs::perms::group_write | fs::perms::others_write)) !=
      fs::perms::none)
    return problem_in(folder, "others may write here, and replace keys: chmod go-w it");
  return {};
}

/// Asked before a single key is written.
Result<void> can_begin(const KeygenOptions& options) {
  if (options.out.empty())
    return problem_in(
        options.cluster,
        "say where keys go: --out DIR, or folder = \"keys\" in [keys] of the cluster");
  if (options.names.empty()) return problem("name nodes, or a cluster: --cluster FILE");
  std::string there;
  for (const std::string& name : options.names) {
    if (auto ok = check_name(name); !ok)
      return problem(fmt::format("\"{}\" is no node's name: {}", name, ok.problem().what));
    for (const fs::path& path : {key_path(options.out, name), public_key_path(options.out, name)}) {
      std::error_code failed;
      if (fs::exists(fs::symlink_status(path, failed))) there += " " + path.filename().string();
    }
  }
  if (there.empty() || options.force) return {};
  return problem_in(options.out,
                    fmt::format("there already:{}; nodes may depend on these keys. Name the nodes "
                                "that lack one, or replace keys by --force",
                                there));
}

Result<ExitCode> keygen(KeygenOptions options) {
  if (!options.cluster.empty()) {
    const auto [cluster, told] = load_cluster(options.cluster);
    if (!cluster) return exit_code_of(told);
    if (auto ok = take_cluster(*cluster, options); !ok) return ok.problem();
  }
  if (auto ok = can_begin(options); !ok) return ok.problem();
  if (auto ok = make_folder(options.out); !ok) return ok.problem();
  for (const std::string& name : options.names) {
    const fs::path path = key_path(options.out, name);
    if (options.force) {
      std::error_code failed;
      fs::remove(path, failed);
      fs::remove(public_key_path(options.out, name), failed);
    }
    const auto written = write_keys(make_keypair(), path);
    if (!written) return written.problem();
    fmt::print("{}  {}\n", written->public_key, name);
  }
  return ExitCode::success;
}

}  // namespace

Command keygen_command() {
  const auto o = std::make_shared<KeygenOptions>();
  return {.name = "keygen",
          .summary = "Make key pairs for the nodes of a cluster",
          .heading = "Cluster",
          .options = {{"names",
                       &o->names,
                       "Names of nodes",
                       {.form = Form::name, .otherwise = "all nodes of the cluster"}},
                      {"--cluster",
                       &o->cluster,
                       "Cluster file whose nodes need keys",
                       {.form = Form::file}},
                      {"--out",
                       &o->out,
                       "Folder for the keys",
                       {.form = Form::folder, .otherwise = "keys.folder of the cluster"}},
                      {"--force", &o->force, "Replacement of keys that are there"}},
          .notes =
              "Writes NAME.key, which only its owner may read and only its node needs, and "
              "NAME.key.pub, which all nodes need; prints the public keys.\n"
              "  luxodus keygen --cluster cluster.toml\n"
              "  luxodus keygen --out keys n0 n1 controller",
          .run = [o] { return exit_code_of(keygen(*o)); }};
}

}  // namespace luxodus::cli
