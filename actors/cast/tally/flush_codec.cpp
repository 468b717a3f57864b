#include "actors/cast/tally/flush_codec.hpp"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

namespace luxodus {

namespace {

constexpr int fast = 1;  // of zstd's levels: a flush is packed on the node's own thread
constexpr size_t longest_number = 19;  // bytes of 128 bits, seven at a time
constexpr size_t numbers_of_ledger = 11;
/// Most address space reserved: a flush is packed to a fraction of its bound; a longer one grows.
constexpr uint64_t max_reserved_bytes = 64 << 20;
constexpr uint64_t reserved_step_bins = 16384;

/// Work between two yields: about half a millisecond each.
constexpr size_t unpacked_between_rests = 512 << 10;
constexpr int64_t bins_between_rests = 16384;
/// Bins added between two yields: each may be the first on its page, which the system then has to
/// provide, in 1 to 3 us in a virtual machine.
constexpr size_t bins_added_between_rests = 1024;
constexpr const char* abandoned = "the reading of the flush was broken off";

/// A write buffer for numbers with room for their longest form, flushed at once.
class Numbers {
 public:
  void put(UInt128 v) {
    while (v >> 64 != 0) {
      bytes_[size_++] = static_cast<std::byte>(static_cast<uint8_t>(v) | 0x80);
      v >>= 7;
    }
    auto low = static_cast<uint64_t>(v);
    for (; low >= 0x80; low >>= 7)
      bytes_[size_++] = static_cast<std::byte>(static_cast<uint8_t>(low) | 0x80);
    bytes_[size_++] = static_cast<std::byte>(static_cast<uint8_t>(low));
  }
  void put_signed(Int128 v) {
    put((static_cast<UInt128>(v) << 1) ^ static_cast<UInt128>(v >> 127));
  }
  void move_to(std::vector<std::byte>& out) {
    out.insert(out.end(), bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ = 0;
  }

 private:
  std::array<std::byte, numbers_of_ledger * longest_number> bytes_;
  size_t size_ = 0;
};

void put(std::vector<std::byte>& out, UInt128 v) {
  Numbers numbers;
  numbers.put(v);
  numbers.move_to(out);
}

void put_ledger(std::vector<std::byte>& out, const EnergyBalance& l) {
  Numbers numbers;
  for (const Int128 v : {l.emitted, l.roulette_gain, l.absorbed_surfaces, l.absorbed_media,
                         l.escaped, l.roulette_loss, l.lost_too_long})
    numbers.put_signed(v);
  for (const uint64_t v : {l.particles, l.rays, l.hits, l.collisions}) numbers.put(v);
  numbers.move_to(out);
}

/// Reads numbers; after a missing or too long one, all further ones are 0 and ok() is false.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes)
      : at_(bytes.data()), end_(bytes.data() + bytes.size()) {}

  UInt128 get() {
    uint64_t low = 0;  // most numbers have less than 63 bits
    for (unsigned shift = 0; shift < 63; shift += 7) {
      if (at_ == end_) return fail();
      const auto byte = static_cast<uint8_t>(*at_++);
      low |= static_cast<uint64_t>(byte & 0x7f) << shift;
      if (byte < 0x80) return low;
    }
    UInt128 v = low;
    for (size_t i = 9; i < longest_number && at_ != end_; ++i) {
      const auto byte = static_cast<uint8_t>(*at_++);
      v |= static_cast<UInt128>(byte & 0x7f) << (7 * i);
      if (byte < 0x80) return v;
    }
    return fail();
  }
  uint64_t get_up_to(uint64_t most) {
    const UInt128 v = get();
    return v <= most ? static_cast<uint64_t>(v) : static_cast<uint64_t>(fail());
  }
  Int128 get_signed() {
    const UInt128 v = get();
    return static_cast<Int128>(v >> 1) ^ -static_cast<Int128>(v & 1);
  }
  UInt128 fail() {
    ok_ = false;
    at_ = end_;
    return 0;
  }
  bool ok() const { return ok_; }
  bool at_end() const { return at_ == end_; }
  const std::byte* at() const { return at_; }

 private:
  const std::byte* at_;
  const std::byte* end_;
  bool ok_ = true;
};

/// The group's next bin, at or after `after_last`; false if there is none.
bool next_bin(Reader& in, uint64_t& after_last, const BinRange& bins, TotalsGain::Bin& bin) {
  const uint64_t distance = in.get_up_to(static_cast<uint64_t>(bins.end - bins.first));
  if (distance == 0) return false;
  after_last += distance;
  if (after_last > static_cast<uint64_t>(bins.end)) in.fail();
  bin.index = static_cast<int64_t>(after_last - 1);
  bin.total.sum = in.get_signed();
  bin.total.squares = in.get();
  return in.ok();
}

EnergyBalance get_ledger(Reader& in) {
  EnergyBalance l;
  for (Int128* v : {&l.emitted, &l.roulette_gain, &l.absorbed_surfaces, &l.absorbed_media,
                    &l.escaped, &l.roulette_loss, &l.lost_too_long})
    *v = in.get_signed();
  for (uint64_t* v : {&l.particles, &l.rays, &l.hits, &l.collisions}) *v = in.get_up_to(UINT64_MAX);
  return l;
}

/// Upper bound of the bytes that totals of this size can take.
size_t max_bytes(int groups, int64_t totals) {
  const auto bins = static_cast<size_t>(groups) * static_cast<size_t>(totals);
  return (bins * 3 + static_cast<size_t>(groups) * 2 + numbers_of_ledger + 1) * longest_number;
}

}  // namespace

struct FlushEncoder::Zstd {
  std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context{ZSTD_createCCtx(), ZSTD_freeCCtx};
};

FlushEncoder::FlushEncoder(int groups, int64_t totals) : zstd_(std::make_unique<Zstd>()) {
  ZSTD_CCtx_setParameter(zstd_->context.get(), ZSTD_c_compressionLevel, fast);
  ZSTD_CCtx_setParameter(zstd_->context.get(), ZSTD_c_checksumFlag, 1);
  const uint64_t bins = static_cast<uint64_t>(groups) * static_cast<uint64_t>(totals);
  packed_.reserve(std::min(bins * flush_bytes_of_bin, max_reserved_bytes) + ZSTD_CStreamOutSize());
  raw_.reserve(reserved_step_bins * flush_bytes_of_bin);
  raw_.push_back({});
  pack(false);  // zstd allocates with the first byte of a stream
}

uint64_t FlushEncoder::batches_of_group() {
  if (counts_ == FlushCounts::without) return 0;
  return static_cast<uint64_t>(emptied_ != nullptr ? emptied_->take_batches(group_)
                                                   : totals_->batches(group_));
}

EnergyBalance FlushEncoder::balance() {
  if (counts_ == FlushCounts::without) return {};
  return emptied_ != nullptr ? emptied_->take_ledger() : totals_->balance();
}

void FlushEncoder::begin(Totals& totals, const BinRange& bins, FlushCounts counts) {
  totals_ = emptied_ = &totals;
  begin_bins(bins, counts);
}

void FlushEncoder::begin_copy(const Totals& totals, const BinRange& bins, FlushCounts counts) {
  totals_ = &totals;
  emptied_ = nullptr;
  begin_bins(bins, counts);
}

void FlushEncoder::begin_bins(const BinRange& bins, FlushCounts counts) {
  bins_ = bins;
  counts_ = counts;
  group_ = 0;
  next_ = after_last_ = bins.first;
  raw_.clear();
  packed_.clear();
  ZSTD_CCtx_reset(zstd_->context.get(), ZSTD_reset_session_only);
  put(raw_, static_cast<uint64_t>(totals_->groups()));
  put(raw_, batches_of_group());
}

FlushEncoder::~FlushEncoder() = default;

/// A group is its batches, its bins (each as the distance from the previous one plus one), and a
/// zero.
bool FlushEncoder::step(int64_t bins) {
  Numbers numbers;
  next_ = std::min(totals_->next_bin(group_, next_), bins_.end);
  const int64_t end = std::min(next_ + bins, bins_.end);
  const auto put_bin = [&](int64_t index, const Total& total) {
    numbers.put(static_cast<uint64_t>(index - after_last_ + 1));
    numbers.put_signed(total.sum);
    numbers.put(total.squares);
    numbers.move_to(raw_);
    after_last_ = index + 1;
  };
  if (emptied_ != nullptr) {
    emptied_->take_bins(group_, next_, end, put_bin);
  } else {
    const SparseArray<Total>& totals = totals_->state(group_).totals;
    totals.for_each_touched(next_, end, [&](int64_t begin, int64_t behind) {
      for (int64_t i = begin; i < behind; ++i) {
        const Total& total = totals[static_cast<size_t>(i)];
        if (total.sum != 0 || total.squares != 0) put_bin(i, total);
      }
    });
  }
  next_ = end;
  const bool group_done = next_ == bins_.end;
  bool done = false;
  if (group_done) {
    put(raw_, 0);
    next_ = after_last_ = bins_.first;
    done = ++group_ == totals_->groups();
    if (done)
      put_ledger(raw_, balance());
    else
      put(raw_, batches_of_group());
  }
  pack(done);
  return done;
}

size_t FlushEncoder::memory_bytes() const {
  return longest_raw_ + longest_packed_ + ZSTD_sizeof_CCtx(zstd_->context.get());
}

/// Never announces a stream's length, so that zstd reuses its memory.
void FlushEncoder::pack(bool last) {
  ZSTD_inBuffer in{raw_.data(), raw_.size(), 0};
  while (in.pos < in.size) pack_more(in, ZSTD_e_continue);
  while (last && pack_more(in, ZSTD_e_end) != 0) {
  }
  longest_raw_ = std::max(longest_raw_, raw_.size());
  longest_packed_ = std::max(longest_packed_, packed_.size());
  raw_.clear();
}

/// Appends what zstd has yet to write.
size_t FlushEncoder::pack_more(ZSTD_inBuffer_s& in, int how) {
  const size_t before = packed_.size();
  packed_.resize(before + ZSTD_CStreamOutSize());
  ZSTD_outBuffer out{packed_.data() + before, packed_.size() - before, 0};
  const size_t left =
      ZSTD_compressStream2(zstd_->context.get(), &out, &in, static_cast<ZSTD_EndDirective>(how));
  packed_.resize(before + out.pos);
  if (ZSTD_isError(left)) throw std::runtime_error("flush: zstd could not pack it");
  return left;
}

// ---- reading ---------------------------------------------------------------------------------

struct FlushReader::Zstd {
  std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context{ZSTD_createDCtx(), ZSTD_freeDCtx};
};

FlushReader::FlushReader() : zstd_(std::make_unique<Zstd>()), piece_(ZSTD_DStreamOutSize()) {}
FlushReader::~FlushReader() = default;
FlushReader::FlushReader(FlushReader&&) noexcept = default;

/// Unpacks frames of unknown size, up to `most` bytes.
Result<void> FlushReader::unpack(std::span<const std::byte> bytes, size_t most,
                                 const FlushRest& rest, std::vector<std::byte>& out) {
  ZSTD_DCtx_reset(zstd_->context.get(), ZSTD_reset_session_only);
  out.clear();
  // address space, which becomes memory on use
  out.reserve(std::min<size_t>(most, max_reserved_bytes));
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  size_t hint = 1;
  size_t rest_at = unpacked_between_rests;
  while (in.pos < in.size) {
    ZSTD_outBuffer to{piece_.data(), piece_.size(), 0};
    hint = ZSTD_decompressStream(zstd_->context.get(), &to, &in);
    if (ZSTD_isError(hint) || out.size() + to.pos > most)
      return problem("the flush is no packed totals of this scene");
    out.insert(out.end(), piece_.begin(), piece_.begin() + static_cast<std::ptrdiff_t>(to.pos));
    if (out.size() < rest_at) continue;
    rest_at = out.size() + unpacked_between_rests;
    if (!rest()) return problem(abandoned);
  }
  if (hint != 0) return problem("the flush is cut short");
  return {};
}

Result<FlushGain> FlushReader::read(std::span<const std::byte> bytes, int groups,
                                    const BinRange& bins, const FlushRest& rest) {
  FlushGain gain;
  if (!spare_.empty()) {
    gain = std::move(spare_.back());
    spare_.pop_back();
  }
  const size_t most = max_bytes(groups, bins.end - bins.first);
  if (auto raw = unpack(bytes, most, rest, gain.raw_); !raw) return raw.problem();
  gain.range_ = bins;
  gain.batches_.clear();
  gain.begins_.clear();
  Reader in(gain.raw_);
  const auto wrong = [] { return problem("the flush does not fit this scene's totals"); };
  if (in.get_up_to(static_cast<uint64_t>(groups)) != static_cast<uint64_t>(groups)) return wrong();
  TotalsGain::Bin bin;
  int64_t count = 0;
  for (int g = 0; g < groups; ++g) {
    gain.batches_.push_back(static_cast<int64_t>(in.get_up_to(uint64_t{1} << 40)));
    gain.begins_.push_back(static_cast<size_t>(in.at() - gain.raw_.data()));
    auto after_last = static_cast<uint64_t>(bins.first);
    while (next_bin(in, after_last, bins, bin))
      if (++count % bins_between_rests == 0 && !rest()) return problem(abandoned);
  }
  gain.bins_ = count;
  gain.ledger_ = get_ledger(in);
  if (!in.ok() || !in.at_end()) return wrong();
  return gain;
}

int64_t FlushGain::batches() const {
  return std::accumulate(batches_.begin(), batches_.end(), int64_t{0});
}

void FlushGain::add_to(Totals& totals, const FlushRest& rest) const {
  piece_.groups.resize(batches_.size());
  for (size_t g = 0; g < batches_.size(); ++g) {
    piece_.groups[g].batches = batches_[g];
    piece_.groups[g].bins.clear();
  }
  piece_.balance = ledger_;
  totals.add(piece_);
  piece_.balance = {};
  for (auto& group : piece_.groups) group.batches = 0;
  for (size_t g = 0; g < batches_.size(); ++g) {
    Reader in({raw_.data() + begins_[g], raw_.size() - begins_[g]});
    auto& bins = piece_.groups[g].bins;
    auto after_last = static_cast<uint64_t>(range_.first);
    TotalsGain::Bin bin;
    for (bool more = true; more;) {
      bins.clear();
      while (bins.size() < bins_added_between_rests &&
             (more = next_bin(in, after_last, range_, bin)))
        bins.push_back(bin);
      totals.add(piece_);
      rest();
    }
    bins.clear();
  }
}

}  // namespace luxodus
