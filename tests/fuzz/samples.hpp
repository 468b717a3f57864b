// One of every message, all fields set: what the codec must carry, and what mutations start from.
// The lists of fields say what there is to set.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "proto/codec.hpp"

namespace luxodus::test {

/// Sets every field to something of its own: numbers count on from field to field.
struct Sampler {
  uint8_t& last;

  template <class Value>
  void operator()(const char* name, Value& value, const char* = "", AtMost limit = {}) const {
    if constexpr (Listed<Value>) {
      Value::fields(*this, value);
    } else if constexpr (std::is_same_v<Value, bool>) {
      value = !value;
    } else if constexpr (std::is_enum_v<Value>) {
      value = last_value<Value>;
    } else if constexpr (Number<Value>) {
      const size_t number = ++last;
      value = {static_cast<uint8_t>(limit.count == 0 ? number : std::min(number, limit.count))};
    } else if constexpr (std::is_same_v<Value, std::string>) {
      value = name + std::string(" ") + std::to_string(++last);
    } else {
      for (int i = 0; i < 3; ++i) {
        ItemOf<Value> item{};
        if constexpr (Number<decltype(item)>)
          item = ++last;
        else
          for_each_field(*this, item);
        value.push_back(item);
      }
    }
  }
};

inline std::vector<Message> sample_messages() {
  std::vector<Message> out;
  uint8_t last = 0;
  for_each_message([&](auto message) {
    for_each_field(Sampler{last}, message);
    out.push_back(std::move(message));
  });
  return out;
}

inline Envelope sample_envelope() {
  Envelope out;
  uint8_t last = 0;
  Envelope::fields(Sampler{last}, out);
  return out;
}

/// A whole frame: envelope, message, payload.
inline std::vector<std::byte> sample_frame(Codec& codec, const Message& message,
                                           std::span<const std::byte> payload = {}) {
  std::vector<std::byte> body(limits::message_bytes);
  body.resize(codec.encode(message, body).value());
  body.insert(body.end(), payload.begin(), payload.end());
  std::vector<std::byte> frame(limits::frame_head_bytes);
  frame.resize(codec.encode(sample_envelope(), body, frame));
  frame.insert(frame.end(), body.begin(), body.end());
  return frame;
}

}  // namespace luxodus::test
