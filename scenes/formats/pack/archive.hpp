// Plain values to bytes and back, by cereal: archives that write into memory, and that read
// untrusted bytes. A count is checked against the remaining bytes before memory is allocated, an
// enumeration against its last value; a number must be finite. Anything else throws DamagedArchive.
// Native byte order (little endian). Any thread, one archive per thread.
#pragma once

#include <cereal/cereal.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace luxodus {

/// The bytes are not what an archive has written.
struct DamagedArchive : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class BytesOut : public cereal::OutputArchive<BytesOut, cereal::AllowEmptyClassElision> {
 public:
  BytesOut() : OutputArchive(this) {}
  void put(const void* from, size_t count) {
    const auto* bytes = static_cast<const std::byte*>(from);
    bytes_.insert(bytes_.end(), bytes, bytes + count);
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

class BytesIn : public cereal::InputArchive<BytesIn, cereal::AllowEmptyClassElision> {
 public:
  explicit BytesIn(std::span<const std::byte> bytes) : InputArchive(this), left_(bytes) {}
  void get(void* to, size_t count) {
    if (count > left_.size()) throw DamagedArchive("it is cut short");
    if (count > 0) std::memcpy(to, left_.data(), count);
    left_ = left_.subspan(count);
  }
  size_t left() const { return left_.size(); }

 private:
  std::span<const std::byte> left_;
};

template <class T>
requires std::is_arithmetic_v<T>
void CEREAL_SAVE_FUNCTION_NAME(BytesOut& out, const T& value) {
  out.put(&value, sizeof value);
}
template <class T>
requires std::is_arithmetic_v<T>
void CEREAL_LOAD_FUNCTION_NAME(BytesIn& in, T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    uint8_t byte = 0;
    in.get(&byte, sizeof byte);
    if (byte > 1) throw DamagedArchive("it holds what is neither yes nor no");
    value = byte == 1;
  } else {
    in.get(&value, sizeof value);
  }
  if constexpr (std::is_floating_point_v<T>) {
    if (!std::isfinite(value)) throw DamagedArchive("it holds a number that is not finite");
  }
}
template <class T>
void CEREAL_SERIALIZE_FUNCTION_NAME(BytesOut& out, cereal::SizeTag<T>& tag) {
  out(static_cast<uint64_t>(tag.size));
}
template <class T>
void CEREAL_SERIALIZE_FUNCTION_NAME(BytesIn& in, cereal::SizeTag<T>& tag) {
  uint64_t count = 0;
  in(count);
  if (count > in.left()) throw DamagedArchive("it holds a list longer than itself");
  tag.size = static_cast<cereal::size_type>(count);
}
template <class Archive, class T>
requires std::is_same_v<Archive, BytesOut> || std::is_same_v<Archive, BytesIn>
void CEREAL_SERIALIZE_FUNCTION_NAME(Archive& archive, cereal::NameValuePair<T>& pair) {
  archive(pair.value);  // names are not stored
}
template <class T>
void CEREAL_SAVE_FUNCTION_NAME(BytesOut& out, const cereal::BinaryData<T>& data) {
  out.put(data.data, static_cast<size_t>(data.size));
}
template <class T>
void CEREAL_LOAD_FUNCTION_NAME(BytesIn& in, cereal::BinaryData<T>& data) {
  in.get(data.data, static_cast<size_t>(data.size));
}

/// A value of an enumeration that ends with `last`.
template <class E>
struct Choice {
  E& value;
  E last;

  template <class Archive>
  void serialize(Archive& archive) {
    auto number = static_cast<uint8_t>(value);
    archive(number);
    if (number > static_cast<uint8_t>(last)) throw DamagedArchive("it holds an unknown word");
    value = static_cast<E>(number);
  }
};
template <class E>
Choice<E> choice(E& value, E last) {
  return {value, last};
}

}  // namespace luxodus

CEREAL_SETUP_ARCHIVE_TRAITS(luxodus::BytesIn, luxodus::BytesOut)

namespace glm {

template <class Archive, length_t N, class T, qualifier Q>
void serialize(Archive& archive, vec<N, T, Q>& v) {
  for (length_t i = 0; i < N; ++i) archive(v[i]);
}
template <class Archive, length_t C, length_t R, class T, qualifier Q>
void serialize(Archive& archive, mat<C, R, T, Q>& m) {
  for (length_t i = 0; i < C; ++i) archive(m[i]);
}

}  // namespace glm
