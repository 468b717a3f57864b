// luxodus deploy: writes the files by which systemd, Slurm, ssh or Kubernetes start a cluster.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <filesystem>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/load_cluster.hpp"
#include "actors/apps/deploy/deploy.hpp"
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
  std::string image;
};

using Files = std::vector<DeployFile>;

/// Wraps a function that never fails.
template <Files (*files)(const ClusterConfig&, const DeployOptions&)>
Result<Files> always(const ClusterConfig& cluster, const DeployOptions& options) {
  return files(cluster, options);
}

struct Means {
  const char* name;
  Result<Files> (*files)(const ClusterConfig&, const DeployOptions&);
  const char* next_step;
};
constexpr std::array<Means, 4> all_means{{
    {"systemd", always<systemd_files>,
     "copy each host's folder to its /etc/systemd/system and start the target there"},
    {"slurm", always<slurm_files>, "sbatch the file"},
    {"ssh", always<ssh_files>, "run the script; with the argument stop it stops all"},
    {"kubernetes", kubernetes_files, "kubectl apply the files; the one with keys is secret"},
}};

Result<void> write_file(const fs::path& path, const DeployFile& file) {
  std::error_code failed;
  fs::create_directories(path.parent_path(), failed);
  if (file.secret) {  // an existing file keeps its permissions when rewritten
    if (const int made = ::open(path.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600); made >= 0)
      ::close(made);
    fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write, failed);
  }
  auto written = write_file_atomically(behind_links(path), std::string_view(file.text));
  if (!written || !file.executable) return written;
  fs::permissions(path, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                  fs::perm_options::add, failed);
  if (failed) return system_problem(path, "cannot be made executable", failed.value());
  return written;
}

/// A user's name is written into units unquoted.
bool is_user_name(const std::string& name) {
  return check_name(name) && name.find('.') == std::string::npos;
}

Result<ExitCode> deploy(const DeployChoice& choice) {
  const auto [read, told] = load_cluster(choice.cluster);
  if (!read) return exit_code_of(told);
  if (!is_user_name(choice.user))
    return problem(fmt::format("\"{}\" is no user's name", choice.user));
  if (choice.means == "kubernetes" && choice.image.empty())
    return problem("say --image: of containers that have the program and the scene at their paths");
  ClusterConfig cluster = *read;
  if (!cluster.keys.folder.empty())
    cluster.keys.folder = fs::absolute(cluster.keys.folder).lexically_normal();
  cluster.run.out = fs::absolute(cluster.run.out).lexically_normal();
  const fs::path program =
      choice.program.empty() ? fs::read_symlink("/proc/self/exe") : fs::absolute(choice.program);
  const DeployOptions options{program.lexically_normal(),
                              fs::absolute(choice.cluster).lexically_normal(), choice.user,
                              choice.image};
  for (const Means& means : all_means) {
    if (choice.means != means.name) continue;
    const Result<Files> files = means.files(cluster, options);
    if (!files) return files.problem();
    for (const DeployFile& file : files.value()) {
      const fs::path path = choice.out / file.path;
      if (auto ok = write_file(path, file); !ok) return ok.problem();
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
                  {"--user", &o->user, "User whom units of systemd run as", {.form = Form::name}},
                  {"--image",
                   &o->image,
                   "Image of containers, for kubernetes",
                   {.form = Form::name, .otherwise = "none"}}},
      .notes =
          "Program, cluster file, scene and keys must have the same paths on every host.\n"
          "  luxodus deploy cluster.toml --for systemd --user lux\n"
          "  luxodus deploy cluster.toml --for slurm && sbatch deploy/RUN.sbatch\n"
          "  luxodus deploy cluster.toml --for ssh && deploy/RUN.sh\n"
          "  luxodus deploy cluster.toml --for kubernetes --image registry/luxodus:1",
      .run = [o] { return exit_code_of(deploy(*o)); }};
}

}  // namespace luxodus::cli
