#include <zmq.h>

#include <array>
#include <stdexcept>

#include "runtime/net/keys.hpp"

namespace luxodus {

namespace {
using KeyText = std::array<char, 41>;  // Z85 and its terminator
}

KeyPair make_keypair() {
  KeyText open, secret;
  if (zmq_curve_keypair(open.data(), secret.data()) != 0)
    throw std::runtime_error("this libzmq was built without CURVE");
  return {open.data(), secret.data()};
}

Result<std::string> public_key_of(const std::string& secret_key) {
  KeyText open;
  std::array<uint8_t, 32> binary;
  if (secret_key.size() != open.size() - 1 ||
      zmq_z85_decode(binary.data(), secret_key.c_str()) == nullptr ||
      zmq_curve_public(open.data(), secret_key.c_str()) != 0)
    return problem("is no secret key: 40 characters of Z85");
  return std::string(open.data());
}

}  // namespace luxodus
