// Text of PeTrack, of the data archive of pedestrian dynamics, and of older versions of JuPedSim:
// lines of id, frame, x, y and mostly z, behind lines that begin with #. Only these say the rate of
// frames and the unit. Their z is the height of a head, or anything else, and is not read. Columns
// viewDirX and viewDirY, which PeTrack can add, are where the person looks.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "runtime/core/printable.hpp"
#include "runtime/core/text.hpp"
#include "scenes/formats/trajectories/trajectory_rows.hpp"

namespace luxodus {

namespace {

constexpr size_t max_columns = 64;

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> out;
  constexpr std::string_view blanks = " \t\r";
  for (size_t from = line.find_first_not_of(blanks);
       from != std::string_view::npos && out.size() < max_columns;) {
    const size_t to = std::min(line.find_first_of(blanks, from), line.size());
    out.push_back(line.substr(from, to - from));
    from = line.find_first_not_of(blanks, to);
  }
  return out;
}

/// What the lines say that begin with #.
struct TextHeader {
  std::optional<double> fps;
  std::optional<double> metres;  // per unit of length
  std::optional<size_t> facing;  // number of the column of viewDirX, from 0
};

Result<void> read_rate(std::string_view line, const std::string& file, int number,
                       TextHeader& header) {
  const size_t digit = line.find_first_of("+-.0123456789", line.find("framerate"));
  const size_t end = std::min(line.find_first_not_of("+-.0123456789eE", digit), line.size());
  const auto fps = digit == std::string_view::npos ? std::optional<double>()
                                                   : decimal_of(line.substr(digit, end - digit));
  if (!fps)
    return problem_in(
        file, number,
        fmt::format("\"{}\" states no rate of frames: write \"# framerate: 25\"", excerpt(line)));
  const auto checked = checked_fps(*fps, file, number);
  if (!checked) return checked.problem();
  if (header.fps && *header.fps != checked.value())
    return problem_in(file, number, "a second rate of frames differs from the first one");
  header.fps = checked.value();
  return {};
}

/// Whether `word` stands in the text and no letter follows.
bool says_unit(const std::string& text, std::string_view word) {
  for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const size_t next = at + word.size();
    if (next == text.size() || std::isalpha(static_cast<unsigned char>(text[next])) == 0)
      return true;
  }
  return false;
}

Result<void> read_unit(std::string_view line, const std::string& file, int number,
                       TextHeader& header) {
  std::string lower(line);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::optional<double> metres;
  for (const char* word : {"x/cm", "in cm", "[cm]"})
    if (says_unit(lower, word)) metres = 0.01;
  for (const char* word : {"x/m", "in m", "[m]", "in metres", "in meters"})
    if (says_unit(lower, word)) {
      if (metres == 0.01)
        return problem_in(file, number, "the line names both m and cm as the unit of length");
      metres = 1;
    }
  if (!metres) return {};
  if (header.metres && *header.metres != *metres)
    return problem_in(file, number, "a second unit of length differs from the first one");
  header.metres = metres;
  return {};
}

Result<void> read_comment(std::string_view line, const std::string& file, int number,
                          TextHeader& header) {
  if (line.find("framerate") != std::string_view::npos) {
    if (auto ok = read_rate(line, file, number, header); !ok) return ok;
  }
  if (auto ok = read_unit(line, file, number, header); !ok) return ok;
  // Columns are named in the line that begins with "# id frame".
  const auto words = words_of(line.substr(line.find_first_not_of('#')));
  if (words.size() > 4 && words[0] == "id" && words[1] == "frame")
    for (size_t i = 4; i + 1 < words.size(); ++i)
      if (words[i] == "viewDirX" && words[i + 1] == "viewDirY") header.facing = i;
  return {};
}

Result<void> complete(const TextHeader& header, const std::string& file, int number) {
  if (!header.fps)
    return problem_in(file, number,
                      "the header states no rate of frames: write a line \"# framerate: 25\" "
                      "before the first row");
  if (!header.metres)
    return problem_in(
        file, number,
        "the header states no unit of length: write a line \"# id frame x/m y/m z/m\" "
        "(or x/cm y/cm z/cm) before the first row");
  return {};
}

Result<TrajectoryRow> row_of(std::string_view line, const std::string& file, int number,
                             const TextHeader& header) {
  const auto words = words_of(line);
  const auto id = words.size() < 4 ? std::optional<int64_t>() : whole_of(words[0]);
  const auto frame = id ? whole_of(words[1]) : std::optional<int64_t>();
  const auto x = frame ? decimal_of(words[2]) : std::optional<double>();
  const auto y = x ? decimal_of(words[3]) : std::optional<double>();
  if (!y)
    return problem_in(
        file, number,
        fmt::format("\"{}\" is no row of numbers: id frame x y, and z", excerpt(line)));
  TrajectoryRow row{.id = *id,
                    .time_s = static_cast<double>(*frame) / *header.fps,
                    .place = glm::dvec3(*x, *y, 0) * *header.metres,
                    .facing = glm::dvec2(0)};
  if (header.facing) {
    if (words.size() < *header.facing + 2)
      return problem_in(file, number, "the columns viewDirX and viewDirY are missing here");
    const auto to_x = decimal_of(words[*header.facing]);
    const auto to_y = decimal_of(words[*header.facing + 1]);
    if (!to_x || !to_y) return problem_in(file, number, "viewDirX or viewDirY is no number");
    row.facing = {*to_x, *to_y};
  }
  return row;
}

}  // namespace

Result<Trajectories> text_trajectories(std::string_view bytes, const std::string& file) {
  TextHeader header;
  TrajectoryRows rows(file, TrajectoryRows::Order::ascending);
  bool begun = false;
  int number = 0;
  while (!bytes.empty()) {
    const size_t end = std::min(bytes.find('\n'), bytes.size());
    const std::string_view line = trimmed(bytes.substr(0, end));
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
    ++number;
    if (line.empty()) continue;
    if (line.starts_with('#')) {
      if (line.find_first_not_of('#') == std::string_view::npos) continue;
      if (begun) continue;  // notes among the rows state nothing
      if (auto ok = read_comment(line, file, number, header); !ok) return ok.problem();
      continue;
    }
    if (!begun)
      if (auto ok = complete(header, file, number); !ok) return ok.problem();
    begun = true;
    const auto row = row_of(line, file, number, header);
    if (!row) return row.problem();
    if (auto ok = rows.add(row.value(), number); !ok) return ok.problem();
  }
  return rows.people_of({.form = "text with a header, as of PeTrack",
                         .has_heights = false,
                         .fps = header.fps,
                         .people = {}});
}

}  // namespace luxodus
