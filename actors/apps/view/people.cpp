#include "actors/apps/view/people.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "actors/results/formats/json_out.hpp"
#include "runtime/core/base64.hpp"

namespace luxodus {

namespace {

static_assert(std::endian::native == std::endian::little);

/// Steps of a person who is there for this long: the last one is not before the end.
size_t steps_in(double duration_s, double step_s) {
  return static_cast<size_t>(std::ceil(duration_s / step_s - 1e-9));
}

size_t places_of(const std::vector<PlacedPerson>& people, double step_s) {
  size_t out = 0;
  for (const PlacedPerson& one : people)
    out += 1 + steps_in(one.times_s.back() - one.times_s.front(), step_s);
  return out;
}

std::string feet_of(const PlacedPerson& person, double step_s) {
  const double first_s = person.times_s.front(), last_s = person.times_s.back();
  const size_t steps = steps_in(last_s - first_s, step_s);
  std::string bytes;
  bytes.reserve((steps + 1) * 3 * sizeof(float));
  for (size_t k = 0; k <= steps; ++k) {
    const glm::dvec3 foot =
        foot_at(person, std::min(first_s + step_s * static_cast<double>(k), last_s));
    for (int axis = 0; axis < 3; ++axis) {
      char value[sizeof(float)];
      const auto number = static_cast<float>(foot[axis]);
      std::memcpy(value, &number, sizeof number);
      bytes.append(value, sizeof value);
    }
  }
  return base64(bytes);
}

}  // namespace

Result<std::string> people_json(const std::vector<PlacedPerson>& people) {
  if (people.size() > limits::view_people)
    return problem("the live view shows at most " + std::to_string(limits::view_people) +
                   " people, and there are " + std::to_string(people.size()));
  double step_s = view_people_step_s;
  while (places_of(people, step_s) > limits::view_people_places) step_s *= 2;
  Json list = Json::array();
  for (const PlacedPerson& one : people)
    list.push_back({{"eye_height", one.eye_height_m},
                    {"from", one.times_s.front()},
                    {"to", one.times_s.back()},
                    {"feet", feet_of(one, step_s)}});
  return Json({{"step", step_s}, {"people", std::move(list)}}).dump();
}

}  // namespace luxodus
