// Makes the help of a command from its tables: usage, arguments, options and commands under their
// headings, notes.
#include <algorithm>
#include <cstdio>
#include <sstream>
#include <string_view>
#include <type_traits>

#include "actors/apps/cli/options.hpp"
#include "actors/apps/cli/words.hpp"

namespace luxodus::cli {

namespace {

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// As on the command line: an argument by its name in capitals, an option with its value.
std::string written(const Option& option) {
  if (option.is_argument()) return upper(option.name) + (option.is_list() ? "..." : "");
  const std::string word = option.value_word();
  return std::string(option.name) + (word.empty() ? "" : " " + word) +
         (option.is_list() ? "..." : "");
}

std::string described(const Option& option) {
  std::string text = option.meaning;
  std::vector<std::string> more;
  if (option.traits.required && !option.is_argument()) more.emplace_back("required");
  if (const auto& range = option.traits.range)
    more.push_back(number_text(range->low) + " to " + number_text(range->high));
  if (option.traits.needs) more.push_back(std::string("requires ") + option.traits.needs);
  if (option.traits.excludes) more.push_back(std::string("excludes ") + option.traits.excludes);
  if (const std::string usual = option.default_text(); !usual.empty()) more.push_back(usual);
  return more.empty() ? text : text + " (" + joined(more, "; ") + ")";
}

std::string usage(const Command& command, const std::string& path) {
  std::string out = "Usage: " + path + " [OPTIONS]";
  for (const Option& option : command.options) {
    if (!option.is_argument()) continue;
    const std::string word = written(option);
    out += option.traits.required ? " " + word : " [" + word + "]";
  }
  if (!command.commands.empty()) out += command.run ? " [COMMAND]" : " COMMAND";
  return out + "\n";
}

/// Headings in the order in which they first appear.
template <class List, class HeadingOf>
std::vector<std::string> headings(const List& list, const HeadingOf& heading_of) {
  std::vector<std::string> out;
  for (const auto& item : list)
    if (std::find(out.begin(), out.end(), heading_of(item)) == out.end())
      out.push_back(heading_of(item));
  return out;
}

std::string options_text(const Command& command, bool is_program) {
  std::string arguments;
  std::vector<const Option*> options;
  for (const Option& option : command.options) {
    if (option.is_argument())
      arguments += entry(written(option), described(option));
    else
      options.push_back(&option);
  }
  std::string out = arguments.empty() ? "" : "\nArguments:\n" + arguments;
  out += "\nOptions:\n" + entry("-h,--help", "This text");
  if (is_program) out += entry("--version", "Version and commit of the program");
  const auto group_of = [](const Option* option) { return std::string(option->traits.group); };
  std::vector<std::string> groups = headings(options, group_of);
  std::stable_partition(groups.begin(), groups.end(),
                        [](const std::string& group) { return group == "Options"; });
  for (const std::string& group : groups) {
    if (group != "Options") out += "\n" + group + ":\n";
    for (const Option* option : options)
      if (group_of(option) == group) out += entry(written(*option), described(*option));
  }
  return out;
}

std::string commands_text(const Command& command) {
  std::string out;
  const auto heading_of = [](const Command& c) {
    return std::string(*c.heading ? c.heading : "Commands");
  };
  for (const std::string& heading : headings(command.commands, heading_of)) {
    out += "\n" + heading + ":\n";
    for (const Command& c : command.commands)
      if (heading_of(c) == heading) out += entry(c.name, c.summary);
  }
  return out;
}

std::string notes_text(const std::string& notes) {
  std::string out;
  std::istringstream lines(notes);
  for (std::string line; std::getline(lines, line);)
    out += (line.starts_with(' ') ? line : filled(line, 0)) + "\n";
  return out.empty() ? out : "\n" + out;
}

}  // namespace

bool Option::is_list() const {
  return std::holds_alternative<std::vector<std::string>*>(value) ||
         std::holds_alternative<std::vector<double>*>(value);
}

std::string Option::long_name() const {
  const std::string_view names = name;
  const size_t comma = names.find(',');
  return std::string(comma == names.npos ? names : names.substr(comma + 1));
}

std::string Option::value_word() const {
  if (is_flag()) return "";
  if (!traits.choices.empty()) return joined(traits.choices, "|");
  constexpr const char* words[] = {"TEXT",  "NAME",  "FILE",  "FOLDER",
                                   "SCENE", "COUNT", "SHARE", "DURATION"};
  if (std::holds_alternative<double*>(value) || std::holds_alternative<std::vector<double>*>(value))
    return "NUMBER";
  if (std::holds_alternative<std::string*>(value) ||
      std::holds_alternative<std::vector<std::string>*>(value))
    return words[static_cast<size_t>(traits.form)];
  return "UINT";
}

std::string Option::default_text() const {
  const auto shown = [](const auto* target) -> std::string {
    using T = std::remove_cvref_t<decltype(*target)>;
    if constexpr (std::is_same_v<T, std::string>)
      return *target;
    else if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>)
      return number_text(static_cast<double>(*target));
    else
      return "";
  };
  const std::string text = !traits.otherwise.empty() ? traits.otherwise
                           : traits.required         ? std::string()
                                                     : std::visit(shown, value);
  return text.empty() ? text : "default: " + text;
}

std::string help_text(const Command& command, const std::string& path) {
  const bool is_program = path == command.name && !command.commands.empty();
  return command.summary + "\n\n" + usage(command, path) + options_text(command, is_program) +
         commands_text(command) + notes_text(command.notes);
}

}  // namespace luxodus::cli
