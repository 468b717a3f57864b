#include "runtime/storage/room_reserve.hpp"

#include <sys/statvfs.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;

TEST_CASE("space is reserved without a visible file, and more than there is is refused",
          "[storage]") {
  const test::TemporaryFolder folder;
  const std::string name = folder.path();
  struct statvfs before {};
  REQUIRE(::statvfs(name.c_str(), &before) == 0);
  RoomReserve room;
  REQUIRE(room.take(name, 1 << 20).ok());
  CHECK(folder.entries() == 0);
  if (!room.held()) {
    WARN("skipped: this file system does not promise room");
  } else {
    const uint64_t all = uint64_t{before.f_blocks} * before.f_frsize;
    const auto refused = room.take(name, all + (uint64_t{1} << 30));
    CHECK_FALSE(room.held());
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.problem().text().find("MiB") != std::string::npos);
    REQUIRE(room.take(name, 1 << 20).ok());
    room.release();
    CHECK_FALSE(room.held());
  }
}
