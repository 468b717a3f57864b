#include "runtime/net/assembler.hpp"

#include <algorithm>
#include <utility>

namespace luxodus {

Assembler::Assembler(size_t messages, size_t max_chunks) : slots_(messages), free_(messages) {
  for (Slot& slot : slots_) slot.come.reserve((max_chunks + 63) / 64);
}

const Assembler::Slot* Assembler::find(const Envelope& envelope) const {
  for (const Slot& slot : slots_)
    if (slot.used && slot.id == envelope.id && slot.kind == envelope.kind) return &slot;
  return nullptr;
}

void Assembler::begin(const Envelope& envelope, std::span<std::byte> room, Nanoseconds now) {
  Slot& slot = *std::find_if(slots_.begin(), slots_.end(), [](const Slot& s) { return !s.used; });
  --free_;
  slot.used = true;
  slot.id = envelope.id;
  slot.by = envelope.from;
  slot.kind = envelope.kind;
  slot.chunk_bytes = envelope.chunk_bytes;
  slot.total_bytes = envelope.total_bytes;
  slot.missing = (envelope.total_bytes - 1) / envelope.chunk_bytes + 1;
  slot.touched = now;
  slot.room = room.first(envelope.total_bytes);
  slot.come.assign((slot.missing + 63) / 64, 0);
}

Assembler::Added Assembler::add(const Envelope& envelope, std::span<const std::byte> body,
                                Nanoseconds now) {
  Slot& slot = *find(envelope);
  if (slot.chunk_bytes != envelope.chunk_bytes || slot.total_bytes != envelope.total_bytes)
    return Added::inconsistent;
  uint64_t& word = slot.come[envelope.chunk / 64];
  const uint64_t bit = uint64_t{1} << (envelope.chunk % 64);
  if ((word & bit) == 0) {
    word |= bit;
    --slot.missing;
    slot.touched = now;
    std::copy(body.begin(), body.end(),
              slot.room.begin() +
                  static_cast<std::ptrdiff_t>(size_t{envelope.chunk} * envelope.chunk_bytes));
  }
  return slot.missing == 0 ? Added::complete : Added::incomplete;
}

std::span<const std::byte> Assembler::bytes(const Envelope& envelope) const {
  return find(envelope)->room;
}

void Assembler::close(const MessageId& id, Kind kind) {
  if (empty()) return;
  for (Slot& slot : slots_) {
    if (!slot.used || slot.id != id || slot.kind != kind) continue;
    slot.used = false;
    ++free_;
  }
}

std::optional<Assembler::Abandoned> Assembler::make_room(NodeId newcomer) {
  const auto count_of = [&](NodeId node) {
    return std::count_if(slots_.begin(), slots_.end(),
                         [&](const Slot& slot) { return slot.used && slot.by == node; });
  };
  const Slot* worst = nullptr;
  auto most = count_of(newcomer) + 1;
  for (const Slot& slot : slots_) {
    if (!slot.used || slot.missing == 0) continue;
    const auto count = count_of(slot.by);
    if (count < most || (count == most && (worst == nullptr || slot.touched >= worst->touched)))
      continue;
    most = count;
    worst = &slot;
  }
  if (worst == nullptr) return std::nullopt;
  const Abandoned abandoned{worst->id, worst->kind};
  close(abandoned.id, abandoned.kind);
  return abandoned;
}

std::optional<Assembler::Abandoned> Assembler::close_idle(Nanoseconds before) {
  if (empty()) return std::nullopt;
  for (const Slot& slot : slots_) {
    if (!slot.used || slot.missing == 0 || slot.touched >= before) continue;
    const Abandoned abandoned{slot.id, slot.kind};
    close(abandoned.id, abandoned.kind);
    return abandoned;
  }
  return std::nullopt;
}

}  // namespace luxodus
