// Keys of nodes (CURVE25519, written in Z85, 40 characters) and their files: a secret key per node,
// which only its owner may read, and beside it a public key that goes into every node's allow-list.
// The transport encrypts, not this. Pure but for files; any thread.
#pragma once

#include <filesystem>
#include <string>

#include "runtime/core/result.hpp"

namespace luxodus {

struct KeyPair {
  std::string public_key;  // Z85
  std::string secret_key;  // Z85
};

/// A new pair from the system's random generator. Errors (exception): a libzmq without CURVE.
KeyPair make_keypair();

/// The public key of a secret key, or a Problem if it is not a key.
Result<std::string> public_key_of(const std::string& secret_key);

/// Writes `path` (secret, mode 0600) and `path`.pub, each atomically. Errors: a file that exists
/// already, since another node may depend on it; a folder that cannot be written.
Result<KeyPair> write_keys(const KeyPair& keys, const std::filesystem::path& path);

/// Reads a secret key file. Errors: no such file, no key in it, or others than its owner may read
/// it.
Result<KeyPair> read_keys(const std::filesystem::path& path);

/// Reads a public key file. Errors: no such file, no key in it.
Result<std::string> read_public_key(const std::filesystem::path& path);

}  // namespace luxodus
