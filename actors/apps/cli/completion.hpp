// Shell completion, generated from the tables of commands and options. Pure; any thread.
#pragma once

#include <string>

#include "actors/apps/cli/options.hpp"

namespace luxodus::cli {

/// A script for bash that completes the program's command lines: commands, options, choices of an
/// option, files and folders.
std::string bash_completion(const Command& program);

/// A script for zsh, which also describes each command and option.
std::string zsh_completion(const Command& program);

}  // namespace luxodus::cli
