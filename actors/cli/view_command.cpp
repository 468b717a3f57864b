// luxodus view: a live walk through the building, in a browser.
#include <fmt/format.h>
#include <sys/random.h>

#include <array>

#include "actors/cli/command.hpp"
#include "actors/view/view_hub.hpp"
#include "actors/view/view_server.hpp"

namespace luxodus::cli {

namespace {

struct ViewOptions {
  std::string scene;
  ServerOptions server;
  LiveOptions live;
  std::string scenario;
  std::string save_folder = ".";
  std::string particles = "100M";
};

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

Result<ExitCode> view(ViewOptions options) {
  const auto scene = load_scene(options.scene);
  if (!scene) return ExitCode::bad_input;
  if (scene->packed)
    return Problem{{options.scene, 0}, "a pack cannot be changed live: view its scene file"};
  if (const auto found = find_scenario(*scene, options.scenario); !found.ok())
    return found.problem();
  if (!is_loopback(options.server.address)) options.server.token = new_token();
  auto server = ViewServer::listen(options.server);
  if (!server.ok()) return server.problem();
  install_interrupt_handler();
  options.live.particles = parse_count(options.particles).value();
  HubOptions hub_options{options.live, {}, options.save_folder};
  hub_options.first.scenario = options.scenario;
  ViewServer& serving = *server.value();
  ViewHub hub(scene, hub_options,
              [&](std::function<void()> function) { serving.post(std::move(function)); });
  std::printf("http://%s:%u/%s%s\nCtrl-C ends it.\n", options.server.address.c_str(),
              serving.port(),
              options.server.token.empty() ? "" : "?token=", options.server.token.c_str());
  std::fflush(stdout);
  serving.run(hub, interrupt_flag());
  return ExitCode::success;
}

}  // namespace

void add_view(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ViewOptions>();
  options->live.threads = default_threads();
  CLI::App* command = app.add_subcommand("view", "Walk through the building in a browser, live");
  command->footer(
      "Traces while you walk; dim, move, thicken, and see it at once. Beyond this machine\n"
      "(--address) the page is served to those alone who have the token that is printed.\n"
      "  luxodus view scenes/library/office_floor.toml\n"
      "  luxodus view office.toml --address 0.0.0.0 --port 9000");
  command->add_option("scene", options->scene, "scene file (TOML)")->required();
  command->add_option("--scenario", options->scenario, "state of the building [the first]");
  command->add_option("--port", options->server.port, "port; 0: any that is free [8080]");
  command->add_option("--address", options->server.address, "to listen on [127.0.0.1]");
  command->add_option("--save-folder", options->save_folder, "where variants are saved [.]");
  command
      ->add_option("--particles", options->particles,
                   "of each state of the building, at most [100M]")
      ->check(CLI::Validator(
          [](std::string& text) {
            const auto count = parse_count(text);
            return count.ok() && count.value() > 0 ? "" : "a count such as 500k or 10M is wanted";
          },
          "COUNT"));
  command->add_option("--seed", options->live.seed, "of all random numbers [1]")
      ->check(seed_number());
  command->add_option("--threads", options->live.threads, "threads [all]")
      ->check(CLI::Range(1, 1024));
  command->callback([options, &exit_code] {
    const auto ended = view(*options);
    if (!ended.ok()) tell(ended.problem());
    exit_code = ended.ok() ? ended.value() : ExitCode::bad_input;
  });
}

}  // namespace luxodus::cli
