#include "runtime/storage/journal.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "runtime/storage/memory_store.hpp"
#include "tests/kit/temporary_folder.hpp"

using namespace luxodus;

namespace {

namespace fs = std::filesystem;

using Bytes = std::vector<std::byte>;

Bytes bytes_of(const std::string& text) {
  const auto span = std::as_bytes(std::span(text));
  return {span.begin(), span.end()};
}

std::string text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// An in-memory store that outlives its journals, and fails on request.
struct Disk {
  Bytes bytes;
  size_t room = SIZE_MAX;
};

class DiskStore final : public AppendStore {
 public:
  explicit DiskStore(Disk& disk) : disk_(disk), bytes_(disk.bytes) {}
  uint64_t size() const override { return bytes_.size(); }
  Result<void> read(uint64_t offset, std::span<std::byte> into) override {
    return bytes_.read(offset, into);
  }
  Result<void> append(std::span<const std::byte> bytes) override {
    const size_t left = disk_.room - std::min<size_t>(disk_.room, bytes_.size());
    if (bytes.size() <= left) return bytes_.append(bytes);
    (void)bytes_.append(bytes.first(left));
    return problem("the disk is full");
  }
  Result<void> truncate(uint64_t size) override { return bytes_.truncate(size); }

 private:
  Disk& disk_;
  MemoryStore bytes_;
};

/// Opens a journal over the disk and lists its records.
Result<Journal> opened(Disk& disk, std::vector<std::string>& records, uint64_t identity = 7) {
  records.clear();
  return Journal::open(std::make_unique<DiskStore>(disk), identity,
                       [&](std::span<const std::byte> record) {
                         records.push_back(text_of(record));
                         return true;
                       });
}

/// A disk with three records.
Disk filled() {
  Disk disk;
  std::vector<std::string> none;
  auto journal = opened(disk, none);
  REQUIRE(journal.ok());
  for (const char* text : {"first", "", "third, and longer"})
    REQUIRE(journal->append(bytes_of(text)).ok());
  return disk;
}

const std::vector<std::string> three = {"first", "", "third, and longer"};

}  // namespace

TEST_CASE("a reopened journal returns its records in order", "[storage]") {
  Disk disk = filled();
  std::vector<std::string> records;
  auto journal = opened(disk, records);
  REQUIRE(journal.ok());
  CHECK(records == three);
  CHECK(journal->records() == 3);
  CHECK(journal->torn_bytes() == 0);
  REQUIRE(journal->append(bytes_of("fourth")).ok());
  REQUIRE(opened(disk, records).ok());
  CHECK(records.size() == 4);
  CHECK(records.back() == "fourth");
}

TEST_CASE("a journal truncated anywhere keeps every whole record, and continues", "[storage]") {
  const Disk whole = filled();
  size_t most = 0;
  for (size_t bytes = 0; bytes <= whole.bytes.size(); ++bytes) {
    INFO("cut to " << bytes << " bytes");
    Disk disk{{whole.bytes.begin(), whole.bytes.begin() + static_cast<std::ptrdiff_t>(bytes)}};
    std::vector<std::string> records;
    auto journal = opened(disk, records);
    REQUIRE(journal.ok());
    CHECK(records.size() >= most);
    most = records.size();
    for (size_t i = 0; i < records.size(); ++i) CHECK(records[i] == three[i]);
    REQUIRE(journal->append(bytes_of("after the crash")).ok());
    REQUIRE(opened(disk, records).ok());
    CHECK(records.size() == most + 1);
    CHECK(records.back() == "after the crash");
  }
  CHECK(most == 3);
}

TEST_CASE("a flipped bit before whole records is an error, and no record is ever wrong",
          "[storage]") {
  const Disk whole = filled();
  const size_t last = whole.bytes.size() - 16 - three.back().size();
  for (size_t bit = 0; bit < 8 * whole.bytes.size(); ++bit) {
    INFO("bit " << bit);
    Disk disk = whole;
    disk.bytes[bit / 8] ^= std::byte{static_cast<uint8_t>(1u << (bit % 8))};
    std::vector<std::string> records;
    const auto journal = opened(disk, records);
    if (bit / 8 < 24) {
      CHECK_FALSE(journal.ok());  // its head: of another run, or no journal
      continue;
    }
    if (bit / 8 < last) {
      REQUIRE_FALSE(journal.ok());
      CHECK(journal.problem().what.find("whole records follow") != std::string::npos);
      CHECK(disk.bytes.size() == whole.bytes.size());
    } else {
      REQUIRE(journal.ok());
      CHECK(records.size() == 2);
      CHECK(disk.bytes.size() == last);
    }
    for (size_t i = 0; i < records.size(); ++i) CHECK(records[i] == three[i]);
  }
}

TEST_CASE("a full disk loses only the record without space", "[storage]") {
  Disk disk = filled();
  std::vector<std::string> records;
  auto journal = opened(disk, records);
  REQUIRE(journal.ok());
  disk.room = disk.bytes.size() + 20;
  CHECK_FALSE(journal->append(bytes_of("this does not fit")).ok());
  CHECK(journal->records() == 3);
  disk.room = SIZE_MAX;
  REQUIRE(journal->append(bytes_of("this does")).ok());
  REQUIRE(opened(disk, records).ok());
  CHECK(records.size() == 4);
  CHECK(records.back() == "this does");
}

TEST_CASE("a journal of another run is rejected, and a restarted one is empty", "[storage]") {
  Disk disk = filled();
  const Bytes before = disk.bytes;
  std::vector<std::string> records;
  const auto other = opened(disk, records, 8);
  REQUIRE_FALSE(other.ok());
  CHECK(other.problem().what.find("another run") != std::string::npos);
  CHECK(disk.bytes == before);
  auto journal = opened(disk, records);
  REQUIRE(journal.ok());
  REQUIRE(journal->restart().ok());
  REQUIRE(journal->append(bytes_of("of the new beginning")).ok());
  REQUIRE(opened(disk, records).ok());
  CHECK(records == std::vector<std::string>{"of the new beginning"});
}

TEST_CASE("a journal file is open in one process at a time", "[storage]") {
  const test::TemporaryFolder folder;
  const fs::path path = folder / "run.journal";
  std::vector<std::string> records;
  const auto visit = [&](std::span<const std::byte> record) {
    records.push_back(text_of(record));
    return true;
  };
  {
    auto store = FileStore::open(path);
    REQUIRE(store.ok());
    auto journal = Journal::open(std::move(store).value(), 7, visit);
    REQUIRE(journal.ok());
    REQUIRE(journal->append(bytes_of("kept")).ok());
    const auto second = FileStore::open(path);
    REQUIRE_FALSE(second.ok());
    CHECK(second.problem().what.find("another process") != std::string::npos);
  }
  std::ofstream(path, std::ios::app) << "torn";
  auto store = FileStore::open(path);
  REQUIRE(store.ok());
  auto journal = Journal::open(std::move(store).value(), 7, visit);
  REQUIRE(journal.ok());
  CHECK(records == std::vector<std::string>{"kept"});
  CHECK(journal->torn_bytes() == 4);
  CHECK(fs::file_size(path) == journal->bytes());
  CHECK_FALSE(FileStore::open(folder.path()).ok());
  CHECK_FALSE(FileStore::open(folder / "none" / "run.journal").ok());
}
