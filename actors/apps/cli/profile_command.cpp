// luxodus profile: counts the accesses of a cluster's nodes to geometry cells, by which its run is
// planned.
#include <filesystem>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/load_cluster.hpp"
#include "actors/apps/cli/quantities.hpp"
#include "actors/cast/parts/profile_file.hpp"
#include "actors/cast/process/cluster_process.hpp"

namespace luxodus::cli {

namespace {

struct ProfileOptions {
  std::string config;
  std::string out;
  std::string share = "1%";
};

Result<ExitCode> make_profile(const ProfileOptions& options) {
  auto [read, told] = load_cluster(options.config);
  if (!read) return exit_code_of(told);
  ClusterConfig& cluster = *read;
  const std::filesystem::path out =
      options.out.empty() ? cluster.run.profile : std::filesystem::path(options.out);
  if (out.empty())
    return problem_in(
        options.config,
        "say where the profile goes: profile = \"FILE\" in [run], which nodes read, or --out");
  auto share = parse_share(options.share);
  if (!share) return share.problem();
  cluster.keys.folder.clear();  // no connections are made
  auto process = ClusterProcessRun::prepare(cluster, {});
  if (!process) return process.problem();
  auto profile = process.value()->profile(share.value());
  if (!profile) return profile.problem();
  if (auto ok = write_profile(out, profile.value()); !ok) return ok.problem();
  int64_t particles = 0;
  for (const ReferenceCounts& group : profile.value().groups) particles += group.units;
  std::printf("%zu scene parts, %zu source groups, %lld particles: %s\n", profile.value().objects(),
              profile.value().groups.size(), static_cast<long long>(particles), out.c_str());
  return ExitCode::success;
}

}  // namespace

Command profile_command() {
  const auto o = std::make_shared<ProfileOptions>();
  return {
      .name = "profile",
      .summary = "Count which parts of a scene the nodes of a cluster will need",
      .heading = "Cluster",
      .options = {{"cluster", &o->config, "Cluster file", {.form = Form::file, .required = true}},
                  {"-o,--out",
                   &o->out,
                   "File of the profile",
                   {.form = Form::file, .otherwise = "profile of [run]"}},
                  {"--share",
                   &o->share,
                   "Share of the run's particles to count with",
                   {.form = Form::share}}},
      .notes =
          "For a scene that is larger than a node's budget. With profile = \"FILE\" in the "
          "cluster's [run], all nodes read that file and plan alike: which node traces which "
          "source groups, holds which scene parts, and keeps which. Results are the same bits "
          "with and without.\n"
          "  luxodus profile cluster.toml\n"
          "  luxodus profile cluster.toml --share 5% --out cluster.profile",
      .run = [o] { return exit_code_of(make_profile(*o)); }};
}

}  // namespace luxodus::cli
