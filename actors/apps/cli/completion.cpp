#include "actors/apps/cli/completion.hpp"

#include <functional>

#include "actors/apps/cli/words.hpp"

namespace luxodus::cli {

namespace {

/// Calls `visit(command, words)` for a command and all its subcommands; `words`: "topology amp", ""
/// for the program itself.
void for_each_command(const Command& command, const std::string& words,
                      const std::function<void(const Command&, const std::string&)>& visit) {
  visit(command, words);
  for (const Command& inner : command.commands)
    for_each_command(inner, words + (words.empty() ? "" : " ") + inner.name, visit);
}

/// "-o" and "--out" of "-o,--out".
std::vector<std::string> names_of(const Option& option) {
  const std::string all = option.name;
  const size_t comma = all.find(',');
  if (comma == all.npos) return {all};
  return {all.substr(0, comma), all.substr(comma + 1)};
}

/// The arguments of compgen for a value; "" if unknown.
std::string compgen_of(const Option& option) {
  if (!option.traits.choices.empty()) return "-W \"" + joined(option.traits.choices, " ") + "\"";
  if (option.traits.form == Form::folder) return "-d";
  return option.traits.form == Form::file || option.traits.form == Form::scene ? "-f" : "";
}

/// Lines of a bash `case` about the values of options, and about arguments of a command.
struct BashCases {
  std::string deeper, values, words;
};

BashCases bash_cases(const Command& program) {
  BashCases cases;
  for_each_command(program, "", [&](const Command& command, const std::string& path) {
    std::vector<std::string> words{"--help"};
    if (path.empty()) words.emplace_back("--version");
    for (const Command& inner : command.commands) {
      cases.deeper += "      \"" + path + " " + inner.name + "\") command+=\"${command:+ }" +
                      inner.name + "\" ;;\n";
      words.push_back(inner.name);
    }
    std::string argument = "-f";  // completion of arguments: most often a file
    for (const Option& option : command.options) {
      const std::string offered = compgen_of(option);
      if (option.is_argument()) {
        argument = offered.empty() ? "" : offered;
        continue;
      }
      std::vector<std::string> patterns;
      for (const std::string& name : names_of(option)) {
        words.push_back(name);
        patterns.push_back("\"" + path + " " + name + "\"");
      }
      if (option.is_flag()) continue;
      cases.values += "    " + joined(patterns, " | ") + ") ";
      cases.values += offered.empty() ? "return ;;\n" : "offer=(" + offered + ") ;;\n";
    }
    cases.words += "      \"" + path + "\") words=\"" + joined(words, " ") + "\" offer=(" +
                   (command.commands.empty() ? argument : "") + ") ;;\n";
  });
  return cases;
}

/// Quoted for a shell.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// Escapes the special characters of _arguments.
std::string spec_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string zsh_action(const Option& option) {
  if (!option.traits.choices.empty()) return "(" + joined(option.traits.choices, " ") + ")";
  if (option.traits.form == Form::folder) return "_files -/";
  return option.traits.form == Form::file || option.traits.form == Form::scene ? "_files" : " ";
}

/// The specifications by which _arguments completes a command.
std::string zsh_specs(const Command& command) {
  std::string out = "    '(-h --help)'{-h,--help}'[This text]' \\\n";
  for (const Option& option : command.options) {
    const std::string action = ":" +
                               spec_text(option.is_argument() ? option.name : option.value_word()) +
                               ":" + zsh_action(option);
    if (option.is_argument()) {
      out += "    " + quoted((option.is_list() ? "*" : "") + action) + " \\\n";
      continue;
    }
    for (const std::string& name : names_of(option))
      out += "    " +
             quoted((option.is_list() ? "*" : "") + name + "[" + spec_text(option.meaning) + "]" +
                    (option.is_flag() ? "" : action)) +
             " \\\n";
  }
  return out;
}

std::string zsh_name(const std::string& path) {
  std::string name = "_luxodus";
  for (const char c : path.empty() ? path : " " + path) name += c == ' ' ? '_' : c;
  return name;
}

std::string zsh_function(const Command& command, const std::string& path) {
  std::string out = zsh_name(path) + "() {\n";
  if (command.commands.empty())
    return out + "  _arguments \\\n" + zsh_specs(command) + "    && return 0\n}\n";
  out += "  local context state state_descr line\n  typeset -A opt_args\n  local -a commands=(\n";
  std::string calls;
  for (const Command& inner : command.commands) {
    std::string summary;
    for (const char c : inner.summary) summary += c == ':' ? std::string("\\:") : std::string(1, c);
    out += "    " + quoted(inner.name + ":" + summary) + "\n";
    calls += "        " + inner.name + ") " +
             zsh_name(path + (path.empty() ? "" : " ") + inner.name) + " ;;\n";
  }
  out += "  )\n  _arguments -C \\\n    '(-h --help)'{-h,--help}'[This text]' \\\n";
  if (path.empty()) out += "    '--version[Version and commit of the program]' \\\n";
  out += "    '1:command:->command' '*::argument:->argument'\n  case $state in\n    command) ";
  out += std::string("_describe -t commands command commands") + (command.run ? "; _files" : "") +
         " ;;\n    argument)\n      case $words[1] in\n" + calls + "      esac ;;\n  esac\n}\n";
  return out;
}

}  // namespace

std::string bash_completion(const Command& program) {
  const BashCases cases = bash_cases(program);
  return "# bash completion of luxodus, as `luxodus completion bash` prints it\n"
         "_luxodus() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  local command= words= i offer=()\n"
         "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
         "    case \"$command ${COMP_WORDS[i]}\" in\n" +
         cases.deeper +
         "    esac\n"
         "  done\n"
         "  COMPREPLY=()\n"
         "  case \"$command $before\" in\n" +
         cases.values +
         "  esac\n"
         "  if ((${#offer[@]} == 0)); then\n"
         "    case \"$command\" in\n" +
         cases.words +
         "    esac\n"
         "    if [[ $word == -* || ${#offer[@]} == 0 ]]; then offer=(-W \"$words\"); fi\n"
         "  fi\n"
         "  mapfile -t COMPREPLY < <(compgen \"${offer[@]}\" -- \"$word\")\n"
         "}\n"
         "complete -o filenames -F _luxodus luxodus\n";
}

std::string zsh_completion(const Command& program) {
  std::string out = "#compdef luxodus\n# as `luxodus completion zsh` prints it\n";
  for_each_command(program, "", [&](const Command& command, const std::string& path) {
    out += zsh_function(command, path);
  });
  return out + "_luxodus \"$@\"\n";
}

}  // namespace luxodus::cli
