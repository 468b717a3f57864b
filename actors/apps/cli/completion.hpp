// Shell completion, made of the tables of commands and options. Pure.
#pragma once

#include <string>

#include "actors/apps/cli/options.hpp"

namespace luxodus::cli {

/// A script for bash that completes the program's command lines: commands, options, words that an
/// option may have, files and folders.
std::string bash_completion(const Command& program);

/// The same for zsh, with what each command and option is.
std::string zsh_completion(const Command& program);

}  // namespace luxodus::cli
