#include "scenes/formats/fields/fds_sizes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "scenes/formats/fields/data_set_fields.hpp"

namespace luxodus::fds {

namespace {

/// Times are a float's bytes in one file and nine digits in the other.
constexpr double time_share = 1e-6;

struct SizeLine {
  double time_s = 0;
  int64_t packed = 0;  // bytes of the frame
  double highest = 0;
};

/// "time, values, bytes, highest value", after a line with the format.
Result<std::vector<SizeLine>> size_lines(const std::string& file, std::string_view text) {
  std::vector<SizeLine> out;
  for (int number = 1; !text.empty(); ++number) {
    const size_t end = text.find('\n');
    if (end == std::string_view::npos) break;  // cut off: the run is in progress
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    const auto words = data_set::words_of(line);
    // The line of the format, again where a restarted run wrote it again.
    if (words.size() < 2) continue;
    const auto number_at = [&](size_t place) {
      return place < words.size() ? data_set::number_in<double>(words[place]) : std::nullopt;
    };
    const auto time = number_at(0), packed = number_at(2), highest = number_at(3);
    const bool whole = time && packed && highest && std::isfinite(*time) &&
                       std::abs(*packed) < 1e15 && std::isfinite(*highest);
    if (!whole)
      return problem_in(file, number,
                        "this line has no time, number of values, number of bytes and highest "
                        "value");
    out.push_back({*time, static_cast<int64_t>(*packed), *highest});
  }
  return out;
}

bool goes_with(const SizeLine& line, const Frame& frame) {
  return line.packed == static_cast<int64_t>(frame.bytes) &&
         std::abs(line.time_s - frame.time_s) <= time_share * std::max(1.0, std::abs(frame.time_s));
}

}  // namespace

Result<void> add_highest_values(const Case& fire, FrameFiles& smoke) {
  const std::string file = smoke.files.front().string() + ".sz";
  const auto text = read_text_within(fire, file, limits::sizes_bytes);
  if (!text)
    return problem_in(file,
                      fmt::format("{}: from FDS 6.11 on, densities of Smoke3D are shares of values "
                                  "that are in this file",
                                  text.problem().what),
                      text.problem().kind);
  const auto lines = size_lines(file, text.value());
  if (!lines) return lines.problem();
  // From the end: after a restart, lines of the part that was abandoned stand before those that
  // hold.
  size_t end = lines->size();
  bool any = false;
  for (size_t i = smoke.frames.size(); i-- > 0;) {
    Frame& frame = smoke.frames[i];
    const bool ahead = end == 0 || frame.time_s > lines.value()[end - 1].time_s + same_tick_s;
    if (!any && ahead) {
      smoke.frames.pop_back();
      continue;
    }
    while (end > 0 && !goes_with(lines.value()[end - 1], frame)) --end;
    if (end == 0)
      return problem_in(file, fmt::format("it has no line for the frame of {:.9g} s and {} bytes: "
                                          "the two files are of different runs",
                                          frame.time_s, frame.bytes));
    frame.highest = lines.value()[--end].highest;
    any = true;
    if (!(frame.highest >= 0))
      return problem_in(file,
                        fmt::format("the highest value at {:.9g} s is negative", frame.time_s));
  }
  return {};
}

}  // namespace luxodus::fds
