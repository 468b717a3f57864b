// The keys by which nodes know each other (CURVE25519, written in Z85, 40 characters), and their
// files: a secret one per node, which only its owner may read, and a public one beside it that
// goes into every node's allow-list. It encrypts nothing; the transport does.
// Any thread.
#pragma once

#include <filesystem>
#include <string>

#include "runtime/core/result.hpp"

namespace luxodus {

struct KeyPair {
  std::string public_key;  // Z85
  std::string secret_key;  // Z85
};

/// A new pair, from the system's randomness.
/// Errors (exception): a libzmq without CURVE.
KeyPair make_keypair();

/// The public key of a secret one; a Problem if it is none.
Result<std::string> public_key_of(const std::string& secret_key);

/// Writes `path` (secret, mode 0600) and `path`.pub, each whole or not at all.
/// Errors: a file that exists already, since another node may depend on it; a folder that cannot
/// be written.
Result<KeyPair> write_keys(const KeyPair& keys, const std::filesystem::path& path);

/// Reads a secret key's file.
/// Errors: no such file, no key in it, or others than its owner may read it.
Result<KeyPair> read_keys(const std::filesystem::path& path);

/// Reads a public key's file. Errors: no such file, no key in it.
Result<std::string> read_public_key(const std::filesystem::path& path);

}  // namespace luxodus
