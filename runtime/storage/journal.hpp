// Records that survive a crash: a head that says what they are of, then records one after another,
// each with its length and check. A record is whole or it is not there: what a crash has torn off
// at the end is cut when the journal is opened again. Damage before whole records is an error, and
// nothing is cut then. It knows nothing of what the records mean.
//
//   head:    "LUXJRNL1" ‖ identity (8 B) ‖ check (8 B)
//   record:  bytes (8 B) ‖ check of bytes and content, chained to the place (8 B) ‖ content
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
/// Of one record: a flush of ten million bins has a third of it.
inline constexpr uint64_t journal_record_bytes = 1u << 30;
}  // namespace limits

class Journal {
 public:
  /// A record; false: it is none that can be used, and the journal is damaged.
  using Visit = std::function<bool(std::span<const std::byte> record)>;

  /// Begins a journal in an empty store, or goes on with one of the same identity: its records are
  /// shown in their order, and a torn end is cut. The store is written to only in these two cases.
  /// Errors: a store that is another journal or none, a damaged record before whole ones, a failed
  /// read or write, `visit` said so.
  static Result<Journal> open(std::unique_ptr<AppendStore> store, uint64_t identity,
                              const Visit& visit);

  /// Adds a record, durably. After an error the record is not there, and the journal takes no other
  /// until one has been cut: a disk that was full may have room again. Errors: as the store's; a
  /// record over its limit.
  Result<void> append(std::span<const std::byte> record);

  /// Forgets all records: they are kept elsewhere now. Errors: as the store's.
  Result<void> restart();

  uint64_t bytes() const { return store_->size(); }
  uint64_t records() const { return records_; }
  /// Bytes of a torn record that opening it has cut.
  uint64_t torn_bytes() const { return torn_bytes_; }

 private:
  explicit Journal(std::unique_ptr<AppendStore> store) : store_(std::move(store)) {}
  Result<void> begin(uint64_t identity);
  Result<void> go_on(uint64_t identity, const Visit& visit);
  Result<void> cut_torn();
  /// Whether a whole record begins anywhere behind the last one that was reached: then what lies
  /// between is damage, since a crash tears off nothing but the end. Checks are chained to places,
  /// so that no other bytes look like one.
  Result<bool> whole_record_follows();

  std::unique_ptr<AppendStore> store_;
  std::vector<std::byte> scratch_;
  uint64_t end_ = 0;  // of the last whole record
  uint64_t records_ = 0;
  uint64_t torn_bytes_ = 0;
};

}  // namespace luxodus
