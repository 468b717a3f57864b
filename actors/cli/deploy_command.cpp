// luxodus deploy: writes what systemd, Slurm or ssh start the processes of a cluster with.
#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "actors/cli/command.hpp"
#include "actors/cli/commands.hpp"
#include "actors/cli/load_cluster.hpp"
#include "actors/supervise/deploy.hpp"
#include "runtime/core/atomic_file.hpp"
#include "runtime/core/output_path.hpp"

namespace luxodus::cli {

namespace {

namespace fs = std::filesystem;

struct DeployChoice {
  std::string cluster;
  std::string means;
  std::string out = "deploy";
  std::string program;
  std::string user = "luxodus";
};

struct Means {
  const char* name;
  std::vector<DeployFile> (*files)(const ClusterConfig&, const DeployOptions&);
  const char* next_step;
};
constexpr std::array<Means, 3> all_means{{
    {"systemd", systemd_files,
     "copy each host's folder to its /etc/systemd/system and start the target there"},
    {"slurm", slurm_files, "sbatch the file"},
    {"ssh", ssh_files, "run the script; with the argument stop it stops all"},
}};

Result<void> write_file(const fs::path& path, const DeployFile& file) {
  std::error_code failed;
  fs::create_directories(path.parent_path(), failed);
  auto written = write_file_atomically(behind_links(path), std::string_view(file.text));
  if (!written || !file.executable) return written;
  fs::permissions(path, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                  fs::perm_options::add, failed);
  if (failed) return Problem{{path.string(), 0}, "cannot be made executable: " + failed.message()};
  return written;
}

/// A user's name goes into units as it is.
bool is_user_name(const std::string& name) {
  return name_fault(name).empty() && name.find('.') == std::string::npos;
}

int deploy(const DeployChoice& choice) {
  const std::optional<ClusterConfig> read = load_cluster(choice.cluster);
  if (!read) return ExitCode::bad_input;
  if (!is_user_name(choice.user)) {
    tell({{}, fmt::format("\"{}\" is no user's name", choice.user)});
    return ExitCode::bad_input;
  }
  ClusterConfig cluster = *read;
  cluster.run.out = fs::absolute(cluster.run.out).lexically_normal();
  const fs::path program =
      choice.program.empty() ? fs::read_symlink("/proc/self/exe") : fs::absolute(choice.program);
  const DeployOptions options{program.lexically_normal(),
                              fs::absolute(choice.cluster).lexically_normal(), choice.user};
  for (const Means& means : all_means) {
    if (choice.means != means.name) continue;
    for (const DeployFile& file : means.files(cluster, options)) {
      const fs::path path = choice.out / file.path;
      if (const auto written = write_file(path, file); !written) {
        tell(written.problem());
        return ExitCode::failure;
      }
      fmt::print("{}\n", path.string());
    }
    fmt::print(stderr, "Next: {}.\n", means.next_step);
  }
  return ExitCode::success;
}

}  // namespace

Command deploy_command() {
  const auto o = std::make_shared<DeployChoice>();
  std::vector<std::string> names;
  for (const Means& means : all_means) names.emplace_back(means.name);
  return {
      .name = "deploy",
      .summary = "Write what starts, watches and stops the processes of a cluster",
      .heading = "Cluster",
      .options = {{"cluster", &o->cluster, "Cluster file", {.form = Form::file, .required = true}},
                  {"--for",
                   &o->means,
                   "Means by which processes are started",
                   {.choices = names, .required = true}},
                  {"--out", &o->out, "Folder for the files", {.form = Form::folder}},
                  {"--program",
                   &o->program,
                   "Path of luxodus on the hosts",
                   {.form = Form::file, .otherwise = "the path of this program"}},
                  {"--user", &o->user, "User whom units of systemd run as", {.form = Form::name}}},
      .notes =
          "Program, cluster file, scene and keys must have the same paths on every host.\n"
          "  luxodus deploy cluster.toml --for systemd --user lux\n"
          "  luxodus deploy cluster.toml --for slurm && sbatch deploy/RUN.sbatch\n"
          "  luxodus deploy cluster.toml --for ssh && deploy/RUN.sh",
      .run = [o] { return deploy(*o); }};
}

}  // namespace luxodus::cli
