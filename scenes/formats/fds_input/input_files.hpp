// Reads the groups of an FDS input file and of the files that &CATF names in it. Any thread.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "scenes/formats/fds_input/namelist.hpp"

namespace luxodus::fds_input {

struct InputFile {
  std::string name;
  std::unique_ptr<const std::string> text;  // the groups are views into it
  std::vector<Group> groups;
};

struct InputFiles {
  std::string main;
  std::vector<InputFile> files;    // the main file first
  std::vector<std::string> notes;  // files that are passed over
};

/// Files of &CATF lie in the folder of `file` or below it, links followed; as in FDS, their &HEAD
/// and everything after &TAIL is ignored. One that lies elsewhere is only searched for the names of
/// its groups, and passed over if they are of chemistry alone.
/// Errors: as namelist.hpp; a file that cannot be read, lies elsewhere, or names others itself.
Result<InputFiles> read_input_files(const std::filesystem::path& file);

}  // namespace luxodus::fds_input
