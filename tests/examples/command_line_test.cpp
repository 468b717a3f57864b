// The command line for people and shells: help, old names of options, rejected words, completion,
// and the scenes of an installed program.
#include <algorithm>
#include <regex>
#include <vector>

#include "tests/examples/program_kit.hpp"
#include "tests/kit/room_texts.hpp"

using namespace luxodus::program;
using Catch::Matchers::Contains;

namespace {

/// Lines of a text that match, by their first group.
std::vector<std::string> found(const std::string& text, const std::string& pattern) {
  std::vector<std::string> out;
  std::istringstream lines(text);
  const std::regex wanted(pattern);
  std::smatch match;
  for (std::string line; std::getline(lines, line);)
    if (std::regex_match(line, match, wanted)) out.push_back(match[1]);
  return out;
}

/// The description of each option in a help text: in the option's line, or in the next one.
std::vector<std::string> meanings_in(const std::string& help) {
  return found(std::regex_replace(help, std::regex(R"((\n  -\S+(?: \S+)*)\n +)"), "$1  "),
               R"(  -\S+(?: \S+)*  +(\S.*))");
}

/// Names of the commands that a help text lists.
std::vector<std::string> commands_in(const std::string& help) {
  return found(help, "  ([a-z]+)  +[A-Z].*");
}

/// "run", "topology amp", ...: all commands and subcommands.
std::vector<std::string> all_commands(const TemporaryFolder& folder) {
  std::vector<std::string> all;
  for (const std::string& name : commands_in(run_luxodus(folder, "--help").out)) {
    all.push_back(name);
    for (const std::string& inner : commands_in(run_luxodus(folder, name + " --help").out))
      all.push_back(name + (" " + inner));
  }
  return all;
}

/// The completions of bash for the last of these words.
std::vector<std::string> completed(const TemporaryFolder& folder, const std::string& words) {
  const Outcome said =
      shell(folder, "bash -c 'source <(\"$0\" completion bash); COMP_WORDS=(luxodus " + words +
                        "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _luxodus; "
                        "printf \"%s\\n\" \"${COMPREPLY[@]}\"' " +
                        LUX_PROGRAM);
  INFO(said.err);
  CHECK(said.code == 0);
  return found(said.out, "(.+)");
}

const std::string room = luxodus::test::white_room("[3, 3, 3]") + R"(
[[emitter]]
name = "lamp"
shape = "sphere"
position = [1.5, 1.5, 2]
diameter = 0.2
flux_lm = 100
)";

}  // namespace

TEST_CASE("the help lists every command once, under the seven headings", "[program][help]") {
  const TemporaryFolder folder;
  const std::string help = run_luxodus(folder, "--help").out;
  INFO(help);
  std::vector<std::string> headings = found(help, "([A-Z][a-z ]+):");
  headings.erase(std::find(headings.begin(), headings.end(), "First steps"));
  CHECK(headings == std::vector<std::string>{"Options", "Scenes", "Results", "Assess", "Live",
                                             "Cluster", "Study", "Tools"});
  const std::vector<std::string> commands = commands_in(help);
  CHECK(commands ==
        std::vector<std::string>{"check",    "pack",   "import",  "run",       "render", "export",
                                 "converge", "assess", "compare", "report",    "design", "spacing",
                                 "walk",     "people", "view",    "cluster",   "node",   "status",
                                 "topology", "keygen", "profile", "deploy",    "sim",    "study",
                                 "validate", "keys",   "info",    "completion"});
}

TEST_CASE("every option is described by a noun phrase within 92 columns", "[program][help]") {
  const TemporaryFolder folder;
  const std::vector<std::string> commands = all_commands(folder);
  CHECK(commands.size() > 25);
  for (const std::string& command : commands) {
    const Outcome help = run_luxodus(folder, command + " --help");
    INFO(command << "\n" << help.out);
    CHECK(help.code == 0);
    CHECK(found(help.out, "(.{93,})").empty());
    const std::vector<std::string> meanings = meanings_in(help.out);
    CHECK(meanings.size() >= 1);  // each command has --help
    for (const std::string& meaning : meanings) CHECK_FALSE(std::islower(meaning[0]));
    for (const char* verb : {"Write ", "Print ", "Make ", "Serve ", "Trace ", "Go ", "Hold ",
                             "Replace ", "Of ", "How "})
      for (const std::string& meaning : meanings) CHECK_FALSE(meaning.starts_with(verb));
  }
  CHECK_THAT(run_luxodus(folder, "run --help").out,
             Contains("--seed UINT                 Seed of the random number generator"));
}

TEST_CASE("keys of files are explained by the schemas that read them", "[program][help]") {
  const TemporaryFolder folder;
  const auto keys = [&](const std::string& words) {
    const Outcome said = run_luxodus(folder, "keys " + words);
    INFO(said.err);
    CHECK(said.code == 0);
    CHECK(found(said.out, "(.{93,})").empty());
    return said.out;
  };
  CHECK_THAT(keys("scene"), Contains("  medium.data_set") && Contains("  route "));
  const std::string medium = keys("scene medium");
  CHECK_THAT(medium, Contains("  mass_extinction") && Contains("required)"));
  CHECK(medium.find("maintenance_factor") == std::string::npos);
  const std::string factor = keys("scene maintenance_factor");
  CHECK_THAT(factor, Contains("[[luminaire]]") && Contains("[[emitter]]"));
  CHECK(factor.find("flux_lm") == std::string::npos);
  CHECK_THAT(keys("cluster budget"), Contains("[budget]"));
  CHECK_THAT(keys("study sweep"), Contains("  fibers "));
  const std::string all = run_luxodus(folder, "keys scene --markdown").out;
  REQUIRE(all.size() > 10'000);
  CHECK_THAT(slurp(std::string(LUX_SOURCE_DIR) + "/scenes/formats/scene_file/README.md"),
             Contains(all.substr(0, all.size() - 1)));
  const Outcome wrong = run_luxodus(folder, "keys scene luminare");
  CHECK(wrong.code == 2);
  CHECK_THAT(wrong.err, Contains("did you mean luminaire?"));
}

TEST_CASE("an invalid command line is rejected in a sentence", "[program][help]") {
  const TemporaryFolder folder;
  std::ofstream(folder / "room.toml") << room;
  const std::string scene = (folder / "room.toml").string();
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"run " + scene + " --link-delay 1ms", "--link-delay requires --nodes"},
      {"run " + scene + " --tally-shards 2", "--tally-shards requires --nodes"},
      {"run " + scene + " --seed -1", "--seed: \"-1\" is no whole number from 0 to 18446744073709"},
      {"run " + scene + " --seed 99999999999999999999", "is no whole number"},
      {"run " + scene + " --threads 0", "\"0\" is no whole number from 1 to 1024"},
      {"run " + scene + " --threads 2.5", "\"2.5\" is no whole number"},
      {"run " + scene + " --part-cache-mib nan", "\"nan\" is no number from 0 to 1048576"},
      {"run " + scene + " --metrics 65536", "is no whole number from 0 to 65535"},
      {"run " + scene + " --sed 3", "luxodus run has no option --sed: did you mean --seed?"},
      {"run", "scene is required"},
      {"run " + scene + " --resume --overwrite", "excludes"},
      {"report x --language it", "\"it\" is none of en|de|fr"},
      {"topology", "luxodus topology --help"},
      {"validate --case-time 1m", "--case-time requires --full"},
      {"validate --experiments --full", "excludes"},
      {"validate --experiments --quick", "--experiments excludes --quick"},
      {"validate --experiments --nodes 2", "--experiments excludes --nodes"},
      {"validate --experiments --only T99", "no experiment has \"T99\" in its id or title"}};
  for (const auto& [command, words] : wrong) {
    const Outcome refused = run_luxodus(folder, command);
    INFO(command << "\n" << refused.err);
    CHECK(refused.code == 2);
    CHECK(refused.out.empty());
    CHECK_THAT(refused.err, Contains(words));
    CHECK(std::count(refused.err.begin(), refused.err.end(), '\n') == 1);
  }
}

TEST_CASE("experiments are listed, and one of them is run and written", "[program][help]") {
  const TemporaryFolder folder;
  const Outcome listed = run_luxodus(folder, "validate --experiments --list");
  CHECK(listed.code == 0);
  CHECK_THAT(listed.out, Contains("T8  The gap of a lit Landolt ring"));
  const Outcome one =
      run_luxodus(folder, "validate --experiments --only T2 --out " + (folder / "people").string());
  INFO(one.err << one.out);
  CHECK(one.code == 0);
  CHECK_THAT(one.out, Contains("kept") && Contains("the page is"));
  for (const char* file : {"experiments.md", "experiments.json", "experiments.svg"})
    CHECK(fs::exists(folder / "people" / file));
}

TEST_CASE("bash completes commands, options and their choices", "[program][help]") {
  const TemporaryFolder folder;
  using Words = std::vector<std::string>;
  CHECK(completed(folder, "conv") == Words{"converge"});
  CHECK(completed(folder, "run --se") == Words{"--seed"});
  CHECK(completed(folder, "topology am") == Words{"amp"});
  CHECK(completed(folder, "topology amp --controller-f") == Words{"--controller-forwards"});
  CHECK(completed(folder, "report --language \"\"") == Words{"en", "de", "fr"});
  CHECK(completed(folder, "run --seed \"\"").empty());
  CHECK(completed(folder, "completion z") == Words{"zsh"});
  const std::vector<std::string> all = completed(folder, "\"\"");
  for (const std::string& command : commands_in(run_luxodus(folder, "--help").out))
    CHECK(std::count(all.begin(), all.end(), command) == 1);
}

TEST_CASE("the completion of zsh has each command and option", "[program][help]") {
  const TemporaryFolder folder;
  const std::string script = run_luxodus(folder, "completion zsh").out;
  CHECK(script.starts_with("#compdef luxodus\n"));
  CHECK_THAT(script, Contains("'--seed[Seed of the random number generator]:UINT: '"));
  CHECK_THAT(script, Contains("'--language[Language of the report]:en|de|fr:(en de fr)'"));
  CHECK_THAT(script, Contains("_luxodus_topology_amp() {"));
  std::ofstream(folder / "_luxodus") << script;
  if (shell(folder, "command -v zsh").code == 0)
    CHECK(shell(folder, "zsh -n " + (folder / "_luxodus").string()).code == 0);
}

TEST_CASE("an installed program finds the scenes that ship with it", "[program][help]") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "bin");
  fs::copy_file(LUX_PROGRAM, folder / "bin" / "luxodus");
  const fs::path library = folder / "share/luxodus/scenes/library";
  fs::create_directories(library);
  std::ofstream(library / "shipped.toml") << room;
  fs::create_directories(folder / "elsewhere");
  const auto check = [&](const std::string& scene) {
    return shell(folder, "cd " + (folder / "elsewhere").string() +
                             " && ../bin/luxodus check --json " + scene);
  };
  for (const char* name : {"shipped", "shipped.toml", "scenes/library/shipped.toml"}) {
    INFO(name);
    CHECK(check(name).code == 0);
  }
  CHECK(check("absent").code == 2);
  // The user's own file takes precedence.
  std::ofstream(folder / "elsewhere" / "shipped.toml") << "not = \"a scene\"\n";
  CHECK(check("shipped.toml").code == 2);
}

TEST_CASE("the version names the commit", "[program][help]") {
  const TemporaryFolder folder;
  CHECK(std::regex_match(
      run_luxodus(folder, "--version").out,
      std::regex("luxodus [0-9]+\\.[0-9]+\\.[0-9]+ \\(([0-9a-f]+\\+?|unknown)\\)\n")));
}
