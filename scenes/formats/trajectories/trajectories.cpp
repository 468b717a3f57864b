// The content decides which reader is asked.
#include "scenes/formats/trajectories/trajectories.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "runtime/core/printable.hpp"
#include "runtime/core/regular_file.hpp"
#include "runtime/core/text.hpp"
#include "scenes/formats/trajectories/trajectory_rows.hpp"

namespace luxodus {

namespace {

constexpr std::string_view sqlite_magic{"SQLite format 3\0", 16};
constexpr std::string_view hdf5_magic = "\x89HDF\r\n\x1a\n";
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// Whether a file begins as HDF5 does, whose own process reads all of it.
Result<bool> begins_as_hdf5(const std::filesystem::path& file) {
  const auto opened = open_regular_file(file);
  if (!opened) return opened.problem();
  std::array<char, hdf5_magic.size()> first{};
  const ssize_t got = ::read(opened->descriptor.number(), first.data(), first.size());
  if (got < 0) return system_problem(file, "this file cannot be read", errno);
  return std::string_view(first.data(), static_cast<size_t>(got)) == hdf5_magic;
}

}  // namespace

Result<Trajectories> trajectories_of(std::string_view bytes, const std::filesystem::path& file) {
  const std::string name = file.string();
  if (bytes.starts_with(sqlite_magic)) return sqlite_trajectories(bytes, name);
  if (bytes.starts_with(hdf5_magic)) return hdf5_trajectories(name);
  if (bytes.starts_with(byte_order_mark)) bytes.remove_prefix(byte_order_mark.size());
  const std::string_view first = trimmed(bytes.substr(0, bytes.find('\n')));
  const std::string_view text = trimmed(bytes.substr(0, 4096));
  if (text.starts_with('{')) return pathfinder_json_trajectories(bytes, name);
  if (first.find(',') != std::string_view::npos) return pathfinder_csv_trajectories(bytes, name);
  const size_t end = first.find_first_of(" \t");
  if (first.starts_with('#') || whole_of(first.substr(0, end)))
    return text_trajectories(bytes, name);
  return problem_in(
      name,
      fmt::format("this is no file of trajectories that is known: it begins with \"{}\". Read "
                  "are SQLite and HDF5 of JuPedSim, text of PeTrack (with a header of lines "
                  "that begin with #), CSV and JSON of Pathfinder",
                  excerpt(first)));
}

Result<Trajectories> read_trajectories(const std::filesystem::path& file) {
  const auto is_hdf5 = begins_as_hdf5(file);
  if (!is_hdf5) return is_hdf5.problem();
  if (is_hdf5.value()) return hdf5_trajectories(file.string());
  const auto bytes = read_regular_file(file, limits::trajectory_file_bytes);
  if (!bytes) return bytes.problem();
  return trajectories_of(bytes.value(), file);
}

}  // namespace luxodus
