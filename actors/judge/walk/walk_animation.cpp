// The animation is declared in the SVG itself (SMIL), so that a browser plays it without a script.
#include <fmt/format.h>

#include <algorithm>

#include "actors/judge/report/plan_parts.hpp"
#include "actors/judge/walk/walk_files.hpp"

namespace luxodus {

namespace {

/// Colours of people by what they read at a step.
constexpr const char* reads_colour = "#2f8f5b";
constexpr const char* undecided_colour = "#e0b23a";
constexpr const char* unread_colour = "#4a2a33";

const char* colour_of(const WalkStep& step) {
  if (step.reads()) return reads_colour;
  return step.count(SignAnswer::undecided) > 0 ? undecided_colour : unread_colour;
}

/// Seconds of the clock in a second of the animation.
constexpr double played_times = 4;
/// Height of the line that shows the time [mm].
constexpr double clock_mm = 1;

/// The times of an animation as shares of it.
struct PlayedTime {
  double from_s = 0, to_s = 1;
  double share(double time_s) const {
    return std::clamp((time_s - from_s) / std::max(to_s - from_s, 1e-9), 0.0, 1.0);
  }
  /// An attribute that changes, with its shares of the time and values.
  std::string animate(const char* attribute, const std::string& shares, const std::string& values,
                      bool in_jumps) const {
    return fmt::format(
        "<animate attributeName=\"{}\" dur=\"{:.2f}s\" repeatCount=\"indefinite\" "
        "calcMode=\"{}\" keyTimes=\"{}\" values=\"{}\"/>",
        attribute, std::max(to_s - from_s, 1e-3) / played_times, in_jumps ? "discrete" : "linear",
        shares, values);
  }
};

/// Key times and values of one person on a level.
struct PersonTrack {
  std::string shares, x, y, colours, shown_shares, shown;
};

PersonTrack track_of(const WalkedPerson& walked, const Sheet& sheet, const PlayedTime& time,
                     double step_s) {
  PersonTrack out;
  const auto add = [](std::string& list, const std::string& value) {
    list += (list.empty() ? "" : ";") + value;
  };
  const auto at = [&](double share, const WalkStep& step) {
    add(out.shares, fmt::format("{:.5f}", share));
    add(out.x, fmt::format("{:.2f}", sheet.x(step.eye.x)));
    add(out.y, fmt::format("{:.2f}", sheet.y(step.eye.y)));
    add(out.colours, colour_of(step));
  };
  const double first = time.share(walked.steps.front().time_s),
               last = time.share(walked.steps.back().time_s);
  if (first > 0) at(0, walked.steps.front());
  for (const WalkStep& step : walked.steps) at(time.share(step.time_s), step);
  if (last < 1) at(1, walked.steps.back());
  if (first > 0) {
    add(out.shown_shares, "0");
    add(out.shown, "hidden");
  }
  add(out.shown_shares, fmt::format("{:.5f}", first));
  add(out.shown, "visible");
  if (const double gone = time.share(walked.steps.back().time_s + step_s); gone < 1) {
    add(out.shown_shares, fmt::format("{:.5f}", gone));
    add(out.shown, "hidden");
  }
  return out;
}

}  // namespace

std::string walk_animation(const PlanLevel& level, const std::vector<const WalkedPerson*>& walks,
                           double step_s) {
  Legend legend;
  legend.add(legend_square(reads_colour), 3, "reads a sign");
  legend.add(legend_square(undecided_colour), 3, "undecided");
  legend.add(legend_square(unread_colour), 3, "reads none");
  DrawnBox box(level);
  PlayedTime time{1e300, -1e300};
  for (const WalkedPerson* walked : walks) {
    for (const WalkStep& step : walked->steps) box.take(glm::dvec2(step.eye));
    time.from_s = std::min(time.from_s, walked->steps.front().time_s);
    time.to_s = std::max(time.to_s, walked->steps.back().time_s);
  }
  const Sheet sheet = box.sheet(PlanSize(), legend);
  std::string people;
  for (const WalkedPerson* walked : walks) {
    const PersonTrack track = track_of(*walked, sheet, time, step_s);
    people += fmt::format("<circle r=\"{:.2f}\">", sheet.mm(body_radius_m)) +
              time.animate("cx", track.shares, track.x, false) +
              time.animate("cy", track.shares, track.y, false) +
              time.animate("fill", track.shares, track.colours, true) +
              time.animate("visibility", track.shown_shares, track.shown, true) + "</circle>\n";
  }
  people +=
      fmt::format("<rect x=\"0\" y=\"{:.2f}\" height=\"{}\" fill=\"#888\">{}</rect>\n",
                  sheet.height() - clock_mm, clock_mm,
                  time.animate("width", "0;1", fmt::format("0;{:.2f}", sheet.width()), false));
  people += text_at(border_mm, sheet.height() - 2 * clock_mm,
                    fmt::format("{:g} to {:g} s", time.from_s, time.to_s));
  return finished(sheet, legend, building(level, sheet) + people).svg;
}

}  // namespace luxodus
