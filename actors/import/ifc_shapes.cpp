#include "actors/import/ifc_shapes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>

#include "actors/import/answer_folder.hpp"
#include "runtime/core/atomic_file.hpp"
#include "runtime/core/file_descriptor.hpp"
#include "runtime/core/printable.hpp"
#include "runtime/core/reading_share.hpp"
#include "runtime/core/regular_file.hpp"

namespace luxodus {
namespace {

namespace fs = std::filesystem;

/// Size of the process' output: a line for each mesh, and for each thing that it could not compute.
constexpr uint64_t max_said_bytes = uint64_t{256} << 20;
constexpr size_t max_notes = 200;
/// Exit codes of ifc_shapes.mjs.
constexpr int no_package = 3, no_shapes = 4;
/// posix_spawnp reports a missing program by the shell's exit code.
constexpr int not_found = 127;

/// Exit code of a process; nothing if it did not end in time and was killed. `waits` is called
/// twice a second.
Result<std::optional<int>> run_process(const std::vector<std::string>& words, const fs::path& out,
                                       const fs::path& err, double seconds,
                                       const std::function<void()>& waits) {
  std::vector<std::string> held = words;
  std::vector<char*> arguments;
  for (std::string& word : held) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  constexpr int write_flags = O_WRONLY | O_CREAT | O_TRUNC;
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), write_flags, 0600);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), write_flags, 0600);
  pid_t process = 0;
  const int error =
      ::posix_spawnp(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT) return std::optional(not_found);
  if (error != 0) return system_problem(words[0], "cannot be started", error);
  // glibc 2.36 declares pidfd_open without extern "C".
  const FileDescriptor watched(static_cast<int>(::syscall(SYS_pidfd_open, process, 0)));
  pollfd ends{watched.number(), POLLIN, 0};
  constexpr double look_s = 0.5;
  int ready = watched.valid() ? 0 : 1;
  for (double waited_s = 0; ready == 0 && waited_s < seconds;) {
    const double wait_s = std::min(look_s, seconds - waited_s);
    ready = ::poll(&ends, 1, static_cast<int>(std::ceil(wait_s * 1000)));
    if (ready < 0) ready = errno == EINTR ? 0 : 1;
    waited_s += wait_s;
    if (ready == 0) waits();
  }
  if (ready == 0) ::kill(process, SIGKILL);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0)
    if (errno != EINTR) return system_problem(words[0], "was lost", errno);
  if (ready == 0) return std::optional<int>();
  return std::optional(WIFEXITED(status) ? WEXITSTATUS(status) : 1);
}

struct Said {
  std::map<uint64_t, glm::dvec3> places;  // of nodes by their number, glTF axes
  std::map<uint64_t, uint64_t> uncut;
  std::vector<std::string> notes;
};

/// The three numbers of a line, with nothing after them.
std::optional<glm::dvec3> numbers_of(std::string_view line) {
  glm::dvec3 out(0);
  for (glm::length_t i = 0; i < 3; ++i) {
    while (line.starts_with(' ')) line.remove_prefix(1);
    const auto [stop, error] = std::from_chars(line.data(), line.data() + line.size(), out[i]);
    if (error != std::errc()) return std::nullopt;
    line.remove_prefix(static_cast<size_t>(stop - line.data()));
  }
  return line.empty() && is_finite(out) ? std::optional(out) : std::nullopt;
}

void add_place(std::string_view line, Said& said) {
  uint64_t number = 0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
  if (error != std::errc()) return;
  const auto place = numbers_of(line.substr(static_cast<size_t>(end - line.data())));
  if (place) said.places.emplace(number, *place);
}

void add_uncut(std::string_view line, Said& said) {
  uint64_t product = 0, count = 0;
  const char* end = line.data() + line.size();
  const auto first = std::from_chars(line.data(), end, product);
  if (first.ec != std::errc() || first.ptr == end) return;
  if (std::from_chars(first.ptr + 1, end, count).ec == std::errc()) said.uncut[product] += count;
}

Said said_by(const fs::path& file) {
  Said said;
  const auto text = read_regular_file(file, max_said_bytes);
  if (!text) return said;
  std::string_view rest = text.value();
  size_t left_out = 0;
  while (!rest.empty()) {
    const size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.starts_with("note ") && said.notes.size() < max_notes)
      said.notes.push_back(excerpt(line.substr(5), 200));
    else if (line.starts_with("note "))
      ++left_out;
    else if (line.starts_with("at "))
      add_place(line.substr(3), said);
    else if (line.starts_with("uncut "))
      add_uncut(line.substr(6), said);
  }
  if (left_out > 0)
    said.notes.push_back(fmt::format("{} more of the shapes, which are not listed", left_out));
  return said;
}

/// The share of products in the last complete line that the process has written about it; 0 before
/// the first.
double share_said_in(const fs::path& file) {
  const auto text = read_regular_file(file, max_said_bytes);
  if (!text) return 0;
  constexpr std::string_view word = "\ndone ";
  const std::string all = "\n" + text.value();
  const size_t end = all.rfind('\n');
  const size_t begin = end == 0 ? std::string::npos : all.rfind(word, end - 1);
  if (begin == std::string::npos) return 0;
  double share = 0;
  (void)std::from_chars(all.data() + begin + word.size(), all.data() + all.size(), share);
  return share >= 0 && share <= 1 ? share : 0;
}

/// The number after the first '#' of a node's name; one that no node has if there is none.
uint64_t number_of_node(std::string_view name) {
  uint64_t number = UINT64_MAX;
  const size_t at = name.find('#');
  if (at != std::string_view::npos)
    (void)std::from_chars(name.data() + at + 1, name.data() + name.size(), number);
  return number;
}

/// The first line of the process' error output.
std::string complaint(const fs::path& file) {
  const auto text = read_regular_file(file, max_said_bytes);
  if (!text) return "it said nothing";
  std::string_view rest = text.value();
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    if (line.find("Error:") != std::string_view::npos) return excerpt(line, 200);
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
  }
  return excerpt(text.value(), 200);
}

}  // namespace

double opacity_of(const ImportedPart& part) {
  constexpr std::string_view word = "opacity ";
  const std::string_view name = part.material_name;
  double opacity = 1;
  if (name.starts_with(word))
    (void)std::from_chars(name.data() + word.size(), name.data() + name.size(), opacity);
  return opacity >= 0 && opacity <= 1 ? opacity : 1;
}

Result<IfcShapes> ifc_shapes(const fs::path& model, const fs::path& script, double seconds,
                             ReadingShare* reading, const std::vector<uint64_t>& only) {
  const std::string file = model.string();
  std::error_code failed;
  if (!fs::is_regular_file(script, failed))
    return problem_in(script.string(),
                      "the script that computes the shapes of IFC models is not "
                      "there: is the program installed whole?");
  const AnswerFolder folder;
  if (folder.path().empty())
    return system_problem(fs::temp_directory_path(failed).string(), "no folder can be made", errno);
  const fs::path glb = folder.path() / "shapes.glb", out = folder.path() / "out",
                 err = folder.path() / "err";
  const uint64_t bytes = fs::file_size(model, failed);
  ReadingPart computed(reading, failed ? 0 : bytes);
  std::vector<std::string> words{"node", script.string(), fs::absolute(model).string(),
                                 glb.string()};
  if (!only.empty()) {
    words.push_back((folder.path() / "numbers").string());
    const std::string numbers = fmt::format("{}", fmt::join(only, "\n"));
    if (auto ok = write_file_atomically(words.back(), std::string_view(numbers)); !ok)
      return ok.problem();
  }
  const auto code =
      run_process(words, out, err, seconds, [&] { computed.at_share(share_said_in(out)); });
  if (!code) return code.problem();
  if (!code.value())
    return problem_in(file, fmt::format("its shapes take longer than {:g} s to compute: give more "
                                        "by --seconds, or export a part of the model",
                                        seconds));
  const Said said = said_by(out);
  if (code.value() == not_found)
    return problem_in(file,
                      "its shapes are computed by Node.js, and there is no program 'node': "
                      "install Node.js 18 or later (./setup.sh does)");
  if (code.value() == no_package)
    return problem_in(file,
                      "its shapes are computed by the npm package @ifc-lite/wasm, which is "
                      "not installed beside " +
                          script.string() + ": run ./setup.sh, or 'npm ci' in that folder");
  if (code.value() == no_shapes) return IfcShapes{{}, said.notes, said.uncut, {}, {}};
  if (code.value() != 0)
    return problem_in(file, "its shapes cannot be computed: " + complaint(err));
  auto parts = import_mesh(glb.string(), 1, UpAxis::y);
  if (!parts)
    return problem_in(file, "its shapes cannot be read: " + parts.problem().what,
                      parts.problem().kind);
  for (ImportedPart& part : parts.value()) {
    const auto place = said.places.find(number_of_node(part.name));
    if (place == said.places.end())
      return problem_in(file,
                        "its shapes come without their place (a line \"at NUMBER X Y Z\" of " +
                            script.filename().string() +
                            "), and the building would stand elsewhere: import it again, and "
                            "install the program anew if that does not help");
    const glm::dvec3 offset = to_z_up(UpAxis::y).vector(place->second);
    for (glm::dvec3& p : part.mesh.positions) p += offset;
  }
  return IfcShapes{std::move(parts).value(), said.notes, said.uncut, {}, {}};
}

}  // namespace luxodus
