#include "actors/tally/flush_codec.hpp"

#include <zstd.h>

#include <stdexcept>

namespace luxodus {

namespace {

constexpr int fast = 1;  // of zstd's levels: a flush is packed on the node's own thread
constexpr size_t longest_number = 19;  // bytes of 128 bits, seven at a time
constexpr size_t numbers_of_ledger = 11;
/// What is read at once: a number, a bin, or the ledger, which is the longest.
constexpr size_t longest_item = numbers_of_ledger * longest_number;
constexpr size_t bins_of_a_piece = 16384;

void put(std::vector<std::byte>& out, UInt128 v) {
  while (v >= 0x80) {
    out.push_back(static_cast<std::byte>(static_cast<uint8_t>(v) | 0x80));
    v >>= 7;
  }
  out.push_back(static_cast<std::byte>(static_cast<uint8_t>(v)));
}
void put_signed(std::vector<std::byte>& out, Int128 v) {
  put(out, (static_cast<UInt128>(v) << 1) ^ static_cast<UInt128>(v >> 127));
}

}  // namespace

/// Reads numbers; once one is missing or too long, all that follow are 0 and ok() is false.
class FlushDecoder::Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  UInt128 get() {
    UInt128 v = 0;
    for (size_t i = 0; i < longest_number; ++i) {
      if (bytes_.empty()) break;
      const auto byte = static_cast<uint8_t>(bytes_.front());
      bytes_ = bytes_.subspan(1);
      v |= static_cast<UInt128>(byte & 0x7f) << (7 * i);
      if (byte < 0x80) return v;
    }
    ok_ = false;
    return 0;
  }
  uint64_t get_up_to(uint64_t most) {
    const UInt128 v = get();
    if (v > most) ok_ = false;
    return ok_ ? static_cast<uint64_t>(v) : 0;
  }
  Int128 get_signed() {
    const UInt128 v = get();
    return static_cast<Int128>(v >> 1) ^ -static_cast<Int128>(v & 1);
  }
  bool ok() const { return ok_; }
  size_t left() const { return bytes_.size(); }

 private:
  std::span<const std::byte> bytes_;
  bool ok_ = true;
};

namespace {

void put_ledger(std::vector<std::byte>& out, const Ledger& l) {
  for (const Int128 v : {l.emitted, l.roulette_gain, l.absorbed_surfaces, l.absorbed_media,
                         l.escaped, l.roulette_loss, l.lost_too_long})
    put_signed(out, v);
  for (const uint64_t v : {l.particles, l.rays, l.hits, l.collisions}) put(out, v);
}

template <class Reader>
Ledger get_ledger(Reader& in) {
  Ledger l;
  for (Int128* v : {&l.emitted, &l.roulette_gain, &l.absorbed_surfaces, &l.absorbed_media,
                    &l.escaped, &l.roulette_loss, &l.lost_too_long})
    *v = in.get_signed();
  for (uint64_t* v : {&l.particles, &l.rays, &l.hits, &l.collisions}) *v = in.get_up_to(UINT64_MAX);
  return l;
}

}  // namespace

struct FlushEncoder::Zstd {
  std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context{ZSTD_createCCtx(), ZSTD_freeCCtx};
};

FlushEncoder::FlushEncoder(Totals& totals) : totals_(totals), zstd_(std::make_unique<Zstd>()) {
  ZSTD_CCtx_setParameter(zstd_->context.get(), ZSTD_c_compressionLevel, fast);
  ZSTD_CCtx_setParameter(zstd_->context.get(), ZSTD_c_checksumFlag, 1);
  put(raw_, static_cast<uint64_t>(totals.groups()));
  put(raw_, static_cast<uint64_t>(totals.take_batches(0)));
}

FlushEncoder::~FlushEncoder() = default;

/// A group is its batches, its bins (each the distance from the last one plus one), and a zero.
bool FlushEncoder::step(int64_t bins) {
  const int64_t end = std::min(next_ + bins, totals_.layout().totals());
  totals_.take_bins(group_, next_, end, [&](int64_t index, const Total& total) {
    put(raw_, static_cast<uint64_t>(index - after_last_ + 1));
    put_signed(raw_, total.sum);
    put(raw_, total.squares);
    after_last_ = index + 1;
  });
  next_ = end;
  const bool group_done = next_ == totals_.layout().totals();
  bool done = false;
  if (group_done) {
    put(raw_, 0);
    next_ = after_last_ = 0;
    done = ++group_ == totals_.groups();
    if (done)
      put_ledger(raw_, totals_.take_ledger());
    else
      put(raw_, static_cast<uint64_t>(totals_.take_batches(group_)));
  }
  pack(done);
  return done;
}

void FlushEncoder::pack(bool last) {
  ZSTD_inBuffer in{raw_.data(), raw_.size(), 0};
  size_t left = 1;
  while (in.pos < in.size || (last && left != 0)) {
    const size_t before = packed_.size();
    packed_.resize(before + ZSTD_CStreamOutSize());
    ZSTD_outBuffer out{packed_.data() + before, packed_.size() - before, 0};
    left =
        ZSTD_compressStream2(zstd_->context.get(), &out, &in, last ? ZSTD_e_end : ZSTD_e_continue);
    packed_.resize(before + out.pos);
    if (ZSTD_isError(left)) throw std::runtime_error("flush: zstd could not pack it");
  }
  raw_.clear();
}

std::vector<std::byte> encode_flush(Totals& totals) {
  FlushEncoder encoder(totals);
  while (!encoder.step(totals.layout().totals())) {
  }
  return encoder.take_bytes();
}

// ---- decoding --------------------------------------------------------------------------------

/// What has been unpacked and not read is a part of an item: the buffer stays as small as a piece
/// of zstd's output, whatever the bytes claim.
struct FlushDecoder::Zstd {
  std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context{ZSTD_createDCtx(), ZSTD_freeDCtx};
  ZSTD_inBuffer in;
  bool ended = false;  // all frames are whole, and unpacked
};

FlushDecoder::FlushDecoder(std::span<const std::byte> bytes, int groups, int64_t totals)
    : groups_(groups), totals_(totals), zstd_(std::make_unique<Zstd>()) {
  zstd_->in = {bytes.data(), bytes.size(), 0};
  last_.groups.resize(static_cast<size_t>(groups));
}

FlushDecoder::~FlushDecoder() = default;

bool FlushDecoder::step() {
  if (state_ == State::failed || zstd_->ended) return true;
  if (!unpack()) return true;
  Reader in(buffer_);
  while (state_ < State::done && (in.left() >= longest_item || zstd_->ended)) {
    if (!read_item(in)) {
      fail("the flush does not fit this scene's totals");
      return true;
    }
  }
  if (state_ == State::done && in.left() > 0) fail("the flush goes on after its end");
  buffer_.erase(buffer_.begin(), buffer_.end() - static_cast<std::ptrdiff_t>(in.left()));
  return state_ == State::failed || zstd_->ended;
}

bool FlushDecoder::unpack() {
  const size_t before = buffer_.size();
  buffer_.resize(before + ZSTD_DStreamOutSize());
  ZSTD_outBuffer out{buffer_.data(), buffer_.size(), before};
  const size_t hint = ZSTD_decompressStream(zstd_->context.get(), &out, &zstd_->in);
  buffer_.resize(out.pos);
  if (ZSTD_isError(hint)) return fail("the flush is no packed totals of this scene");
  const bool all_in = zstd_->in.pos == zstd_->in.size;
  zstd_->ended = all_in && hint == 0;
  if (all_in && hint != 0 && out.pos < out.size) return fail("the flush is cut short");
  return true;
}

bool FlushDecoder::fail(const char* why) {
  state_ = State::failed;
  problem_ = {{}, why};
  return false;
}

/// In order: the number of groups; for each its batches, bins and a zero; the ledger.
bool FlushDecoder::read_item(Reader& in) {
  switch (state_) {
    case State::count:
      if (in.get_up_to(static_cast<uint64_t>(groups_)) != static_cast<uint64_t>(groups_))
        return false;
      state_ = State::batches;
      return in.ok();
    case State::batches:
      last_.groups[group_].batches = static_cast<int64_t>(in.get_up_to(uint64_t{1} << 40));
      next_ = 0;
      state_ = State::bins;
      return in.ok();
    case State::bins:
      return read_bin(in);
    case State::ledger:
      last_.ledger = get_ledger(in);
      pieces_.push_back(std::move(last_));
      state_ = State::done;
      return in.ok();
    case State::done:
    case State::failed:
      break;
  }
  return false;
}

bool FlushDecoder::read_bin(Reader& in) {
  const uint64_t distance = in.get_up_to(static_cast<uint64_t>(totals_));
  if (distance == 0) {
    ++group_;
    state_ = group_ == static_cast<size_t>(groups_) ? State::ledger : State::batches;
    return in.ok();
  }
  TotalsGain::Bin bin;
  const uint64_t index = next_ + distance - 1;
  bin.index = static_cast<int64_t>(index);
  bin.total.sum = in.get_signed();
  bin.total.squares = in.get();
  if (!in.ok() || index >= static_cast<uint64_t>(totals_)) return false;
  next_ = index + 1;
  if (pieces_.empty() || pieces_.back().groups[group_].bins.size() == bins_of_a_piece ||
      group_of_piece_ != group_) {
    pieces_.emplace_back().groups.resize(static_cast<size_t>(groups_));
    group_of_piece_ = group_;
  }
  pieces_.back().groups[group_].bins.push_back(bin);
  return true;
}

Result<std::vector<TotalsGain>> FlushDecoder::take() {
  if (state_ == State::failed) return problem_;
  return std::move(pieces_);
}

Result<std::vector<TotalsGain>> decode_flush(std::span<const std::byte> bytes, int groups,
                                             int64_t totals) {
  FlushDecoder decoder(bytes, groups, totals);
  while (!decoder.step()) {
  }
  return decoder.take();
}

}  // namespace luxodus
