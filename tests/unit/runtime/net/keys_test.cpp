#include "runtime/net/keys.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;
namespace fs = std::filesystem;

TEST_CASE("keys are read back as they were written", "[runtime][keys]") {
  const test::TemporaryFolder folder;
  const KeyPair keys = make_keypair();
  REQUIRE(write_keys(keys, folder / "n1.key").ok());
  const auto read = read_keys(folder / "n1.key");
  REQUIRE(read.ok());
  CHECK(read->secret_key == keys.secret_key);
  CHECK(read->public_key == keys.public_key);
  const auto open = read_public_key(folder / "n1.key.pub");
  REQUIRE(open.ok());
  CHECK(open.value() == keys.public_key);
}

TEST_CASE("two key pairs always differ", "[runtime][keys]") {
  CHECK(make_keypair().secret_key != make_keypair().secret_key);
}

TEST_CASE("only the owner may read a secret key file", "[runtime][keys]") {
  const test::TemporaryFolder folder;
  const fs::path path = folder / "n1.key";
  REQUIRE(write_keys(make_keypair(), path).ok());
  CHECK(fs::status(path).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
  fs::permissions(path, fs::perms::others_read, fs::perm_options::add);
  const auto refused = read_keys(path);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.problem().what.find("chmod 600") != std::string::npos);
}

TEST_CASE("an existing key is not overwritten", "[runtime][keys]") {
  const test::TemporaryFolder folder;
  const fs::path path = folder / "n1.key";
  const KeyPair first = make_keypair();
  REQUIRE(write_keys(first, path).ok());
  CHECK_FALSE(write_keys(make_keypair(), path).ok());
  CHECK(read_keys(path)->secret_key == first.secret_key);
  size_t files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder.path())) ++files;
  CHECK(files == 2);  // no half-written file is left
}

TEST_CASE("a file without a key is rejected with the reason", "[runtime][keys]") {
  const test::TemporaryFolder folder;
  const fs::path path = folder / "n1.key";
  CHECK_FALSE(read_keys(path).ok());
  for (const std::string& text : {std::string(), std::string("short\n"), std::string(10'000, 'x'),
                                  std::string(39, 'a') + "\"\n"}) {
    std::ofstream(path) << text;
    fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
    INFO(text.substr(0, 50));
    CHECK_FALSE(read_keys(path).ok());
  }
}
