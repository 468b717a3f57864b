// The command line as data: commands, what they take, and what runs. Help, shell completion and
// man pages are made of these tables; options.cpp alone reads a command line by them, and is the
// only source that includes CLI11. Values are written while the command line is read. One thread.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus::cli {

/// Where a value goes. Its type says what may be written; a bool is a flag, which takes no value; a
/// list takes several values, and may be given more than once.
using Target = std::variant<bool*, int*, uint16_t*, uint32_t*, int64_t*, uint64_t*, double*,
                            std::string*, std::vector<std::string>*, std::vector<double>*,
                            std::optional<uint16_t>*, std::optional<uint64_t>*>;

/// What a text stands for: its word in the help, and what a shell completes it with. A scene is a
/// file, or one that ships, by its name: see library.hpp.
enum class Form { text, name, file, folder, scene, count, share, duration };

/// Numbers from `low` to `high`, both included.
struct Range {
  double low, high;
};

/// What else an option may have.
struct OptionTraits {
  Form form = Form::text;
  /// The default, for people. Without it the target's value is shown, where that says something.
  std::string otherwise = {};
  std::optional<Range> range = {};
  std::vector<std::string> choices = {};  // words that may be written, in small letters
  const char* group = "Options";          // heading in the help
  const char* old_name = nullptr;         // of one release ago: taken with a warning
  const char* needs = nullptr;            // another option, without which this is refused
  const char* excludes = nullptr;         // another option, with which this is refused
  bool required = false;
  bool comma_separated = false;  // a list
  /// Whether a text is taken.
  std::function<Result<void>(const std::string&)> check = {};
};

/// An option ("--out", "-o,--out"), or an argument by its place ("scene").
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
  /// "UINT", "FILE", "en|de|fr"; "" of a flag.
  std::string value_word() const;
  /// "default: 4", "default: all cores"; "" where there is none to speak of.
  std::string default_text() const;
};

/// A command, with commands of its own or without.
struct Command {
  std::string name;
  std::string summary;       // one line
  const char* heading = "";  // under which it stands in the list of commands
  std::vector<Option> options = {};
  /// Paragraphs and examples below the options. Lines that begin with blanks stay as they are;
  /// others are filled.
  std::string notes = {};
  std::vector<Command> commands = {};
  /// Its exit code. Without it one of `commands` must be named. Owns what `options` point into.
  std::function<int()> run = {};
};

/// What `luxodus NAME --help` prints. `path`: all words by which the command is called.
std::string help_text(const Command& command, const std::string& path);

/// Reads a command line and runs what it asks for: an exit code. Help and version are printed;
/// errors are told on standard error and give 2. Throws what a command throws.
/// `version`: what --version prints.
int run_command_line(const Command& program, const std::string& version, int argc, char** argv);

}  // namespace luxodus::cli
