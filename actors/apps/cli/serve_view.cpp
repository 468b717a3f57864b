#include "actors/apps/cli/serve_view.hpp"

#include <fmt/format.h>
#include <sys/random.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "actors/apps/cli/load_scene.hpp"
#include "actors/apps/cli/people_asked.hpp"
#include "actors/apps/cli/signals.hpp"
#include "actors/apps/view/people.hpp"
#include "runtime/core/log.hpp"
#include "runtime/http/served_names.hpp"

namespace luxodus::cli {

namespace {

bool is_loopback(const std::string& address) {
  return address == "127.0.0.1" || address == "::1";
}

/// 128 unpredictable bits from the system, unrelated to the random numbers of light.
std::string new_token() {
  std::array<uint8_t, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("the system gives no random numbers for a token");
  std::string out;
  for (const uint8_t byte : bytes) out += fmt::format("{:02x}", byte);
  return out;
}

/// Tries to make a file there: permissions do not reveal a full or read-only file system.
Result<void> can_save_in(const std::filesystem::path& folder) {
  std::string name = (folder / ".luxodus-view-XXXXXX").string();
  const int file = ::mkstemp(name.data());
  if (file < 0) {
    const int failed = errno;
    return problem_in(folder,
                      std::string("variants cannot be saved in this folder: ") +
                          std::strerror(failed) + "; make it, or name another (--save-folder)",
                      kind_of_errno(failed));
  }
  ::close(file);
  ::unlink(name.c_str());
  return {};
}

}  // namespace

SceneAtTime times_of_view(const std::string& file, const SceneDescription& scene) {
  if (!scene.people_are_bodies) return reader_of_times(file, scene, FireFrames::between);
  log_info("people stand as bodies: the view shows one time, which --at chooses");
  return {};
}

Result<std::string> people_of_view(const SceneDescription& scene, const std::string& file,
                                   const std::string& trajectories) {
  if (scene.packed) return people_json({});  // serve_view refuses it, in its own words
  if (!scene.people_are_bodies) {
    const auto people = people_shown(scene, file, trajectories);
    return people ? people_json(people->people) : people.problem();
  }
  if (!trajectories.empty())
    return problem_in(file,
                      "people stand as bodies in this scene: leave out --trajectories, or "
                      "people_as_bodies");
  return people_json({});
}

Result<void> serve_view(std::shared_ptr<const SceneDescription> scene, HttpAddress server,
                        const HubOptions& options, const std::function<Result<void>()>& goes_on) {
  if (scene->packed)
    return problem_in(scene->file, "a pack cannot be changed live: view its scene file");
  if (auto ok = can_save_in(options.save_folder); !ok) return ok.problem();
  if (!is_loopback(server.address)) server.token = new_token();
  auto listening = ViewServer::listen(server);
  if (!listening) return listening.problem();
  ViewServer& serving = *listening.value();
  ViewHub hub(std::move(scene), options,
              [&](std::function<void()> function) { serving.post(std::move(function)); });
  std::printf("%s/%s%s\nCtrl-C ends it.\n", http_address(server.address, serving.port()).c_str(),
              server.token.empty() ? "" : "?token=", server.token.c_str());
  std::fflush(stdout);
  Result<void> outcome;
  serving.run(hub, [&] {
    if (goes_on) outcome = goes_on();
    return !outcome || interrupt_flag();
  });
  return outcome;
}

}  // namespace luxodus::cli
