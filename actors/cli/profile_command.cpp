// luxodus profile: count what a cluster's nodes will ask of geometry cells, for its run to plan by.
#include <filesystem>

#include "actors/cli/command.hpp"
#include "actors/cli/load_cluster.hpp"
#include "actors/objects/profile_file.hpp"
#include "actors/supervise/cluster_process.hpp"

namespace luxodus::cli {

namespace {

struct ProfileOptions {
  std::string config;
  std::string out;
  std::string share = "1%";
};

int make_profile(const ProfileOptions& options) {
  std::optional<ClusterConfig> read = load_cluster(options.config);
  if (!read) return ExitCode::bad_input;
  ClusterConfig& cluster = *read;
  const std::filesystem::path out =
      options.out.empty() ? cluster.run.profile : std::filesystem::path(options.out);
  if (out.empty()) {
    tell({{options.config, 0},
          "say where the profile goes: profile = \"FILE\" in [run], which nodes read, or --out"});
    return ExitCode::bad_input;
  }
  auto share = parse_share(options.share);
  if (!share) {
    tell(share.problem());
    return ExitCode::bad_input;
  }
  cluster.keys.folder.clear();  // nobody is talked to
  auto process = ClusterProcessRun::prepare(cluster, {});
  if (!process) {
    tell(process.problem());
    return ExitCode::bad_input;
  }
  auto profile = process.value()->profile(share.value());
  if (!profile) {
    tell(profile.problem());
    return ExitCode::bad_input;
  }
  if (auto ok = write_profile(out, profile.value()); !ok) {
    tell(ok.problem());
    return ExitCode::failure;
  }
  int64_t particles = 0;
  for (const ReferenceCounts& group : profile.value().groups) particles += group.units;
  std::printf("%zu objects, %zu source groups, %lld particles: %s\n", profile.value().objects(),
              profile.value().groups.size(), static_cast<long long>(particles), out.c_str());
  return ExitCode::success;
}

}  // namespace

void add_profile(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ProfileOptions>();
  CLI::App* command =
      app.add_subcommand("profile", "Count which parts of a scene a cluster's nodes will ask for");
  command->footer(
      "For a scene that is larger than a node's budget. With profile = \"FILE\" in the cluster's\n"
      "[run], all nodes read that file and plan alike: who traces which source groups, who holds\n"
      "and who keeps which objects. Results are the same bits with and without.\n"
      "  luxodus profile cluster.toml\n"
      "  luxodus profile cluster.toml --share 5% --out cluster.profile");
  command->add_option("cluster", options->config, "the cluster's file")->required();
  command->add_option("-o,--out", options->out, "where to write it [profile of [run]]");
  command->add_option("--share", options->share, "of the run's particles, to count with [1%]");
  command->callback([options, &exit_code] { exit_code = make_profile(*options); });
}

}  // namespace luxodus::cli
