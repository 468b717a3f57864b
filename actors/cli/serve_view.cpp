#include "actors/cli/serve_view.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>

#include "actors/cli/command.hpp"

namespace luxodus::cli {

namespace {

bool is_loopback(const std::string& address) {
  return address == "127.0.0.1" || address == "::1";
}

/// 128 bits that nobody guesses, from the system. Not the light's random numbers.
std::string new_token() {
  std::array<uint8_t, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("the system gives no random numbers for a token");
  std::string out;
  for (const uint8_t byte : bytes) out += fmt::format("{:02x}", byte);
  return out;
}

}  // namespace

Result<Done> serve_view(std::shared_ptr<const SceneDescription> scene, ServerOptions server,
                        const HubOptions& options) {
  if (scene->packed)
    return Problem{{scene->file, 0}, "a pack cannot be changed live: view its scene file"};
  if (!is_loopback(server.address)) server.token = new_token();
  auto listening = ViewServer::listen(server);
  if (!listening.ok()) return listening.problem();
  ViewServer& serving = *listening.value();
  ViewHub hub(std::move(scene), options,
              [&](std::function<void()> function) { serving.post(std::move(function)); });
  std::printf("http://%s:%u/%s%s\nCtrl-C ends it.\n", server.address.c_str(), serving.port(),
              server.token.empty() ? "" : "?token=", server.token.c_str());
  std::fflush(stdout);
  serving.run(hub, interrupt_flag());
  return Done{};
}

}  // namespace luxodus::cli
