// A journal: records that survive a crash. It starts with a head that identifies their content;
// each record has its length and check. A record is there whole or not at all: the part that a
// crash leaves at the end is truncated when the journal is opened again. Damage before whole
// records is an error, and then nothing is truncated. The journal does not interpret records.
//
//   head:    "LUXJRNL1" ‖ identity (8 B) ‖ check (8 B)
//   record:  bytes (8 B) ‖ check of offset, bytes and content (8 B) ‖ content
//
// Numbers are little-endian. Thread rule: one node's thread.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "runtime/storage/append_store.hpp"

namespace luxodus {

namespace limits {
/// Longest record: a flush of ten million bins takes a third of it.
inline constexpr uint64_t journal_record_bytes = 1u << 30;
}  // namespace limits

class Journal {
 public:
  /// Receives a record. Returns false if it is unusable, and the journal therefore damaged.
  using Visit = std::function<bool(std::span<const std::byte> record)>;

  /// Begins a journal in an empty store, or continues one of the same identity: passes its records
  /// to `visit` in order, and truncates a torn end. The store is written only in these two cases.
  /// Errors: a store with another journal or other data, a damaged record before whole ones, a
  /// failed read or write, a record that `visit` rejects.
  static Result<Journal> open(std::unique_ptr<AppendStore> store, uint64_t identity,
                              const Visit& visit);

  /// Appends a record, durably. After an error the record is not there, and its torn part is
  /// truncated before the next append: a full disk may have room again. Errors: those of the store;
  /// a record over its limit.
  Result<void> append(std::span<const std::byte> record);

  /// Removes all records, once they are kept elsewhere. Errors: those of the store.
  Result<void> restart();

  uint64_t bytes() const { return store_->size(); }
  uint64_t records() const { return records_; }
  /// Bytes of a torn record that open() truncated.
  uint64_t torn_bytes() const { return torn_bytes_; }

 private:
  explicit Journal(std::unique_ptr<AppendStore> store) : store_(std::move(store)) {}
  Result<void> begin(uint64_t identity);
  Result<void> go_on(uint64_t identity, const Visit& visit);
  Result<void> cut_torn();
  /// Whether a whole record begins anywhere after the last one that was read: then the bytes
  /// between are damage, since a crash tears only the end. Checks include offsets, so other bytes
  /// do not look like a record.
  Result<bool> whole_record_follows();

  std::unique_ptr<AppendStore> store_;
  std::vector<std::byte> scratch_;
  uint64_t end_ = 0;  // of the last whole record
  uint64_t records_ = 0;
  uint64_t torn_bytes_ = 0;
};

}  // namespace luxodus
