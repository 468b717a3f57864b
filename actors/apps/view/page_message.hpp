// Decodes messages from viewers (PROTOCOL.md), which are untrusted: types, ranges and lengths are
// checked, and invalid messages are refused with a reason. Pure; any thread.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
inline constexpr size_t page_message_bytes = 64 << 10;
inline constexpr double max_view_factor = 10, max_view_smoke = 100, max_view_seconds = 1e6;
inline constexpr size_t view_name_chars = 200;
/// Limit on copies in a view: each is a source group of its own, with its totals and its light.
inline constexpr size_t view_added = 256;
/// Limit on a traced picture: 960 x 546. Its sums take 310 MB, twice while a pass may end early.
inline constexpr int64_t view_picture_pixels = 1 << 19;
inline constexpr int min_view_picture_edge = 16;
}  // namespace limits

struct FactorEdit {
  std::string group;
  double factor = 1;
};
struct ScenarioEdit {
  std::string name;
};
struct SmokeEdit {
  double factor = 1;
};
/// Another state of a scene that has a clock.
struct StateEdit {
  double at_s = 0;
};
struct TimeEdit {
  std::optional<double> seconds;  // since the mains failure; none: fully on
};
struct MoveEdit {
  bool is_sign = true;  // else a luminaire
  std::string name;
  glm::dvec3 position{0};
  std::optional<glm::dvec3> facing;
};
struct AddEdit {
  bool is_sign = true;  // else a luminaire
  std::string of;
  bool of_type = false;  // `of` is a type of the design
  glm::dvec3 position{0};
  std::optional<glm::dvec3> facing;
};
struct RemoveEdit {
  std::string name;
};
struct SaveEdit {
  std::string name;
};
/// Undoes or redoes steps: the building as after the first `done` ones.
struct HistoryEdit {
  int64_t done = 0;
};
struct EditWish {
  bool wanted = false;
};
struct ProbeAsk {
  int64_t id = 0;
  uint32_t triangle = 0;
  bool front = true;
};
struct JudgeAsk {
  std::string sign;
  int64_t id = 0;  // echoed, so that a viewer tells answers apart
};
/// Requests a traced picture of the viewer's view.
struct RenderAsk {
  int64_t id = 0;
  glm::dvec3 eye{0}, target{1, 0, 0}, up{0, 0, 1};
  double vertical_fov_deg = 60;
  int width = 0, height = 0;
  bool human = false;  // as an adapted eye sees it, instead of one exposure
};
/// Cancels the viewer's picture.
struct RenderStop {};
/// Asks for places of further luminaires, replacing the named ones.
struct SuggestAsk {
  std::vector<std::string> free;
};
/// Asks for the checks of the codes.
struct ChecksAsk {
  int64_t id = 0;  // as of JudgeAsk
};
using PageMessage =
    std::variant<FactorEdit, ScenarioEdit, SmokeEdit, StateEdit, TimeEdit, MoveEdit, AddEdit,
                 RemoveEdit, SaveEdit, HistoryEdit, EditWish, ProbeAsk, JudgeAsk, RenderAsk,
                 RenderStop, SuggestAsk, ChecksAsk>;

/// Errors: an invalid message, one sentence.
Result<PageMessage> decode_page_message(std::string_view text);

/// Whether only the editor may send it.
bool is_edit(const PageMessage& message);

}  // namespace luxodus
