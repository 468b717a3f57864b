// luxodus completion: prints scripts for shell completion.
#include <cstdio>
#include <memory>
#include <utility>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/commands.hpp"
#include "actors/apps/cli/completion.hpp"

namespace luxodus::cli {

Command completion_command(std::function<Command()> program) {
  const auto shell = std::make_shared<std::string>();
  return {.name = "completion",
          .summary = "Print a script that completes command lines in a shell",
          .heading = "Tools",
          .options = {{"shell",
                       shell.get(),
                       "Shell that it is for: bash or zsh",
                       {.choices = {"bash", "zsh"}, .required = true}}},
          .notes =
              "A package installs both scripts. By hand:\n"
              "  luxodus completion bash > ~/.local/share/bash-completion/completions/luxodus\n"
              "  luxodus completion zsh > ~/.zfunc/_luxodus     with ~/.zfunc in fpath",
          .run = [shell, program = std::move(program)] {
            const Command all = program();
            const std::string text = *shell == "bash" ? bash_completion(all) : zsh_completion(all);
            std::fputs(text.c_str(), stdout);
            return ExitCode::success;
          }};
}

}  // namespace luxodus::cli
