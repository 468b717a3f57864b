// Reads a command line by the tables of options.hpp. CLI11 finds options, arguments and commands
// among the words; values are read here by common rules: a whole number consists of decimal digits
// and fits its type, and a rejected value is reported with what would be valid.
#include "actors/apps/cli/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string_view>
#include <type_traits>
#include <utility>

#include "actors/apps/cli/command.hpp"
#include "actors/apps/cli/library.hpp"
#include "actors/apps/cli/words.hpp"
#include "runtime/toml/words.hpp"

namespace luxodus::cli {

namespace {

/// `text` cannot be the option's value.
struct Refused {
  std::string why;
};

template <class T>
T read_number(const Option& option, const std::string& text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  bool is_one = error == std::errc() && end == text.data() + text.size();
  if constexpr (std::is_floating_point_v<T>) is_one = is_one && std::isfinite(value);
  const auto& range = option.traits.range;
  const auto as_double = static_cast<double>(value);
  if (is_one && (!range || (range->low <= as_double && as_double <= range->high))) return value;
  std::string bounds;
  if (range)
    bounds = number_text(range->low) + " to " + number_text(range->high);
  else if constexpr (std::is_integral_v<T>)
    bounds = std::to_string(std::numeric_limits<T>::min()) + " to " +
             std::to_string(std::numeric_limits<T>::max());
  throw Refused{"\"" + text + "\" is no " + (std::is_integral_v<T> ? "whole number" : "number") +
                (bounds.empty() ? "" : " from " + bounds)};
}

std::string read_text(const Option& option, std::string text) {
  const auto& choices = option.traits.choices;
  if (!choices.empty()) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (std::find(choices.begin(), choices.end(), text) == choices.end())
      throw Refused{"\"" + text + "\" is none of " + option.value_word()};
  }
  if (option.traits.check)
    if (auto ok = option.traits.check(text); !ok) throw Refused{ok.problem().what};
  return option.traits.form == Form::scene ? find_scene(text) : text;
}

/// Stores all values of an option in its target.
void store(const Option& option, const std::vector<std::string>& texts) {
  const auto read = [&]<class T>(const std::string& text, T& value) {
    if constexpr (std::is_same_v<T, std::string>)
      value = read_text(option, text);
    else
      value = read_number<T>(option, text);
  };
  const auto put = [&](auto* target) {
    using T = std::remove_cvref_t<decltype(*target)>;
    if constexpr (std::is_same_v<T, bool>) {
      *target = true;
    } else if constexpr (std::is_same_v<T, std::vector<std::string>> ||
                         std::is_same_v<T, std::vector<double>>) {
      for (const std::string& text : texts) read(text, target->emplace_back());
    } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      read(texts.back(), *target);
    } else {
      read(texts.back(), target->emplace());
    }
  };
  std::visit(put, option.value);
}

/// Makes an option known to the parser.
void add_option(CLI::App& app, const Option& option) {
  const auto take = [&option](const std::vector<std::string>& texts) {
    try {
      store(option, texts);
    } catch (const Refused& refused) {
      throw CLI::ValidationError(option.is_argument() ? option.name : option.long_name(),
                                 refused.why);
    }
    return true;
  };
  if (option.is_flag()) {
    app.add_flag_callback(option.name, [take] { take({}); });
    return;
  }
  CLI::Option* added = app.add_option(option.name, take);
  if (option.is_list()) added->expected(CLI::detail::expected_max_vector_size);
  if (option.traits.comma_separated) added->delimiter(',');
  if (option.traits.required) added->required();
}

void add_options(CLI::App& app, const Command& command) {
  for (const Option& option : command.options) add_option(app, option);
  for (const Option& option : command.options) {
    CLI::Option* added = app.get_option(option.long_name());
    if (option.traits.needs) added->needs(app.get_option(option.traits.needs));
    if (option.traits.excludes) added->excludes(app.get_option(option.traits.excludes));
  }
}

/// `command` and its texts must not move while `app` lives.
void add_command(CLI::App& app, const Command& command, const std::string& path) {
  app.formatter_fn([&command, path](const CLI::App*, const std::string&, CLI::AppFormatMode) {
    return help_text(command, path);
  });
  add_options(app, command);
  for (const Command& inner : command.commands)
    add_command(*app.add_subcommand(inner.name), inner, path + " " + inner.name);
  if (!command.commands.empty() && !command.run) app.require_subcommand(1);
}

/// ": did you mean run? " of the nearest word, or "; ".
std::string guess(const std::string& word, const std::vector<std::string>& known) {
  // One step more than in a file: commands and options are short, and few.
  const auto nearest = toml::nearest_word(word, {known.begin(), known.end()}, word.size() / 3 + 1);
  return nearest ? ": did you mean " + std::string(*nearest) + "? " : "; ";
}

/// Errors: a first word that is no command, with the command that was likely meant; but for what
/// the parser says better.
Result<void> check_command_word(const Command& program, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return {};
  std::vector<std::string> names;
  for (const Command& command : program.commands) names.push_back(command.name);
  if (std::find(names.begin(), names.end(), argv[1]) != names.end()) return {};
  return problem("there is no command \"" + std::string(argv[1]) + "\"" + guess(argv[1], names) +
                 program.name + " --help lists all commands");
}

/// The called command, and its words.
std::pair<const Command*, std::string> called(const CLI::App& app, const Command& program) {
  const CLI::App* at = &app;
  const Command* command = &program;
  std::string path = program.name;
  while (!at->get_subcommands().empty()) {
    at = at->get_subcommands().front();
    path += " " + at->get_name();
    command = &*std::find_if(command->commands.begin(), command->commands.end(),
                             [&](const Command& c) { return c.name == at->get_name(); });
  }
  return {command, path};
}

/// Describes a wrong command line in a sentence, and where to find help.
std::string sentence(const CLI::ParseError& error, const CLI::App& app, const Command& program) {
  const auto [command, path] = called(app, program);
  const std::string where = path + " --help lists what it takes";
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError)) {
    const std::vector<std::string> rest = app.remaining(true);
    const auto option = std::find_if(rest.begin(), rest.end(),
                                     [](const std::string& word) { return word.starts_with("-"); });
    if (option != rest.end()) {
      std::vector<std::string> names;
      for (const Option& o : command->options)
        if (!o.is_argument()) names.push_back(o.long_name());
      const std::string name = option->substr(0, option->find('='));
      return path + " has no option " + name + guess(name, names) + where;
    }
  }
  return std::string(error.what()) + "; " + where;
}

}  // namespace

int run_command_line(const Command& program, const std::string& version, int argc, char** argv) {
  if (auto ok = check_command_word(program, argc, argv); !ok) return exit_code_of(ok);
  CLI::App app(program.summary, program.name);
  app.set_version_flag("--version", version);
  add_command(app, program, program.name);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::fputs(app.help().c_str(), stdout);
    return ExitCode::success;
  } catch (const CLI::CallForVersion& asked) {
    std::fprintf(stdout, "%s\n", asked.what());
    return ExitCode::success;
  } catch (const CLI::ParseError& error) {
    return exit_code_of(problem(sentence(error, app, program)));
  }
  return called(app, program).first->run();
}

}  // namespace luxodus::cli
