#include "actors/results/run/scene_state.hpp"

#include <charconv>
#include <string_view>

#include "runtime/core/hash.hpp"

namespace luxodus {

ObjectId StateObject::id() const {
  const std::string all = bytes();
  return object_id_of(std::as_bytes(std::span(all)));
}

/// The seed on a line of its own, then the text.
std::string StateObject::bytes() const {
  return std::to_string(seed) + "\n" + text;
}

Result<StateObject> StateObject::parse(std::span<const std::byte> bytes) {
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  StateObject state;
  const auto [end, error] = std::from_chars(all.data(), all.data() + all.size(), state.seed);
  const auto digits = static_cast<size_t>(end - all.data());
  if (error != std::errc() || digits == all.size() || *end != '\n')
    return problem("a state of the scene begins with its seed, and this does not");
  state.text = all.substr(digits + 1);
  return state;
}

}  // namespace luxodus
