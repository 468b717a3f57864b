#include "runtime/storage/journal.hpp"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "runtime/core/hash.hpp"

namespace luxodus {

namespace {

constexpr std::array<char, 8> magic = {'L', 'U', 'X', 'J', 'R', 'N', 'L', '1'};

struct Head {
  std::array<char, 8> magic;
  uint64_t identity;
  uint64_t check;
};
static_assert(sizeof(Head) == 24);

struct RecordHead {
  uint64_t bytes;
  uint64_t check;
};
static_assert(sizeof(RecordHead) == 16);

uint64_t check_of(const Head& head) {
  return XXH3_64bits(&head, offsetof(Head, check));
}

/// The check includes the offset, so that an old record of the file is never taken for a current
/// one.
uint64_t check_of(uint64_t place, std::span<const std::byte> content) {
  const std::array<uint64_t, 2> start = {place, content.size()};
  return XXH3_64bits_withSeed(content.data(), content.size(),
                              XXH3_64bits(start.data(), sizeof start));
}

template <class T>
std::span<std::byte> bytes_of(T& value) {
  return std::as_writable_bytes(std::span(&value, 1));
}

}  // namespace

Result<Journal> Journal::open(std::unique_ptr<AppendStore> store, uint64_t identity,
                              const Visit& visit) {
  Journal journal(std::move(store));
  // Less than a head is the rest of a start that crashed.
  const bool fresh = journal.store_->size() < sizeof(Head);
  const auto opened = fresh ? journal.begin(identity) : journal.go_on(identity, visit);
  if (!opened) return opened.problem();
  return journal;
}

Result<void> Journal::begin(uint64_t identity) {
  if (store_->size() > 0)
    if (auto cut = store_->truncate(0); !cut) return cut.problem();
  Head head{magic, identity, 0};
  head.check = check_of(head);
  if (auto put = store_->append(bytes_of(head)); !put) return put.problem();
  end_ = sizeof head;
  return {};
}

Result<void> Journal::go_on(uint64_t identity, const Visit& visit) {
  Head head{};
  if (auto got = store_->read(0, bytes_of(head)); !got) return got.problem();
  if (head.magic != magic || head.check != check_of(head))
    return problem("the journal's head is not that of a journal: move the file away");
  if (head.identity != identity)
    return problem(
        "the journal is of another run (scene, seed or partition): move it away, or "
        "give another --out");
  end_ = sizeof head;
  while (store_->size() - end_ >= sizeof(RecordHead)) {
    RecordHead record{};
    if (auto got = store_->read(end_, bytes_of(record)); !got) return got.problem();
    const uint64_t begin = end_ + sizeof record;
    if (record.bytes > limits::journal_record_bytes || record.bytes > store_->size() - begin) break;
    scratch_.resize(record.bytes);
    if (auto got = store_->read(begin, scratch_); !got) return got.problem();
    if (record.check != check_of(end_, scratch_)) break;
    if (!visit(scratch_))
      return problem("record " + std::to_string(records_) +
                     " of the journal is whole, and does not belong to this run");
    end_ = begin + record.bytes;
    ++records_;
  }
  torn_bytes_ = store_->size() - end_;
  const auto follows = whole_record_follows();
  if (!follows) return follows.problem();
  if (follows.value())
    return problem("record " + std::to_string(records_) + " of the journal (from byte " +
                   std::to_string(end_) +
                   " on) is damaged, and whole records follow it: nothing was cut; restore "
                   "the file from a copy, or move it away to begin anew");
  return cut_torn();
}

Result<bool> Journal::whole_record_follows() {
  const uint64_t size = store_->size();
  // Bounds hashing: what looks like a record's length seldom is one, but can be made to on purpose.
  uint64_t budget = 16 * (size - end_) + (uint64_t{64} << 20);
  std::vector<std::byte> window(uint64_t{1} << 20), content;
  for (uint64_t first = end_ + 1; first + sizeof(RecordHead) <= size;) {
    const uint64_t read = std::min<uint64_t>(window.size(), size - first);
    if (auto got = store_->read(first, std::span(window).first(read)); !got) return got.problem();
    const uint64_t places = read - sizeof(RecordHead) + 1;
    for (uint64_t i = 0; i < places; ++i) {
      RecordHead head{};
      std::memcpy(&head, window.data() + i, sizeof head);
      const uint64_t begin = first + i + sizeof head;
      if (head.bytes > limits::journal_record_bytes || head.bytes > size - begin) continue;
      if (head.bytes > budget) return true;  // unknown: then nothing may be truncated
      budget -= head.bytes;
      content.resize(head.bytes);
      if (auto got = store_->read(begin, content); !got) return got.problem();
      if (head.check == check_of(first + i, content)) return true;
    }
    first += places;
  }
  return false;
}

Result<void> Journal::cut_torn() {
  if (store_->size() == end_) return {};
  return store_->truncate(end_);
}

Result<void> Journal::append(std::span<const std::byte> record) {
  if (record.size() > limits::journal_record_bytes)
    return problem("a record is longer than a journal takes");
  if (auto cut = cut_torn(); !cut) return cut.problem();
  const RecordHead head{record.size(), check_of(end_, record)};
  scratch_.resize(sizeof head + record.size());
  std::memcpy(scratch_.data(), &head, sizeof head);
  std::memcpy(scratch_.data() + sizeof head, record.data(), record.size());
  if (auto put = store_->append(scratch_); !put) return put.problem();
  end_ += scratch_.size();
  ++records_;
  return {};
}

Result<void> Journal::restart() {
  if (auto cut = store_->truncate(sizeof(Head)); !cut) return cut.problem();
  end_ = sizeof(Head);
  records_ = 0;
  return {};
}

}  // namespace luxodus
