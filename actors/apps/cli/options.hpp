// The command line as data: commands, their options, and the functions they call. Help, shell
// completion and man pages are generated from these tables; only options.cpp reads a command line
// by them, and includes CLI11. Values are stored while the command line is read. One thread.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus::cli {

/// Where a value is stored. The type defines the syntax: a bool is a flag without a value; a list
/// takes several values, and may be given more than once.
using Target = std::variant<bool*, int*, uint16_t*, uint32_t*, int64_t*, uint64_t*, double*,
                            std::string*, std::vector<std::string>*, std::vector<double>*,
                            std::optional<uint16_t>*, std::optional<uint64_t>*>;

/// Meaning of a text: its word in the help, and how a shell completes it. A scene is a file, or the
/// name of one that ships: see library.hpp.
enum class Form { text, name, file, folder, scene, count, share, duration };

/// Numbers from `low` to `high`, both included.
struct Range {
  double low, high;
};

/// Optional properties of an option.
struct OptionTraits {
  Form form = Form::text;
  /// The default, as displayed. If empty, the target's value is shown, if it says something.
  std::string otherwise = {};
  std::optional<Range> range = {};
  std::vector<std::string> choices = {};  // allowed words, in lower case
  const char* group = "Options";          // heading in the help
  const char* needs = nullptr;            // another option that this one requires
  const char* excludes = nullptr;         // another option that excludes this one
  bool required = false;
  bool comma_separated = false;  // a list
  /// Whether a text is taken.
  std::function<Result<void>(const std::string&)> check = {};
};

/// An option ("--out", "-o,--out"), or a positional argument ("scene").
struct Option {
  const char* name;
  Target value;
  std::string meaning;  // a noun phrase
  OptionTraits traits = {};

  bool is_argument() const { return name[0] != '-'; }
  bool is_flag() const { return std::holds_alternative<bool*>(value); }
  bool is_list() const;
  /// "--out" of "-o,--out".
  std::string long_name() const;
  /// "UINT", "FILE", "en|de|fr"; "" for a flag.
  std::string value_word() const;
  /// "default: 4", "default: all cores"; "" if there is none to show.
  std::string default_text() const;
};

/// A command, with or without subcommands.
struct Command {
  std::string name;
  std::string summary;       // one line
  const char* heading = "";  // its heading in the list of commands
  std::vector<Option> options = {};
  /// Paragraphs and examples below the options. Lines that begin with blanks are kept; others are
  /// filled.
  std::string notes = {};
  std::vector<Command> commands = {};
  /// Returns its exit code. Without it one of `commands` must be named. Owns the targets of
  /// `options`.
  std::function<int()> run = {};
};

/// The text of `luxodus NAME --help`. `path`: all words of the command.
std::string help_text(const Command& command, const std::string& path);

/// Reads a command line and runs the command: returns its exit code. Help and version are printed;
/// errors are printed on standard error and give 2. Passes on a command's exceptions.
/// `version`: the text of --version.
int run_command_line(const Command& program, const std::string& version, int argc, char** argv);

}  // namespace luxodus::cli
