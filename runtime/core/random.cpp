#include "runtime/core/random.hpp"

#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace luxodus {

#ifdef __AVX2__
namespace {

void philox_round(__m256i& c0, __m256i& c1, __m256i& c2, __m256i& c3, __m256i m0, __m256i m1,
                  __m256i k0, __m256i k1, __m256i low_half) {
  const __m256i p0 = _mm256_mul_epu32(m0, c0);
  const __m256i p1 = _mm256_mul_epu32(m1, c2);
  c0 = _mm256_xor_si256(_mm256_xor_si256(_mm256_srli_epi64(p1, 32), c1), k0);
  c2 = _mm256_xor_si256(_mm256_xor_si256(_mm256_srli_epi64(p0, 32), c3), k1);
  c1 = _mm256_and_si256(p1, low_half);
  c3 = _mm256_and_si256(p0, low_half);
}

}  // namespace
#endif

void Random::refill() {
#ifdef __AVX2__
  const __m256i m0 = _mm256_set1_epi64x(0xD2511F53);
  const __m256i m1 = _mm256_set1_epi64x(0xCD9E8D57);
  const __m256i low_half = _mm256_set1_epi64x(0xFFFFFFFF);
  const __m256i first = _mm256_set1_epi64x(block_);
  __m256i a0 = _mm256_add_epi64(first, _mm256_set_epi64x(3, 2, 1, 0));
  __m256i b0 = _mm256_add_epi64(first, _mm256_set_epi64x(7, 6, 5, 4));
  __m256i a1 = _mm256_set1_epi64x(stream_), b1 = a1;
  __m256i a2 = _mm256_set1_epi64x(static_cast<uint32_t>(particle_)), b2 = a2;
  __m256i a3 = _mm256_set1_epi64x(static_cast<uint32_t>(particle_ >> 32)), b3 = a3;
  uint32_t key0 = static_cast<uint32_t>(seed_);
  uint32_t key1 = static_cast<uint32_t>(seed_ >> 32);
  for (int round = 0; round < 10; ++round) {
    const __m256i k0 = _mm256_set1_epi64x(key0);
    const __m256i k1 = _mm256_set1_epi64x(key1);
    philox_round(a0, a1, a2, a3, m0, m1, k0, k1, low_half);
    philox_round(b0, b1, b2, b3, m0, m1, k0, k1, low_half);
    key0 += 0x9E3779B9u;
    key1 += 0xBB67AE85u;
  }
  auto* out = reinterpret_cast<__m256i*>(words_.data());
  _mm256_store_si256(out + 0, a0);
  _mm256_store_si256(out + 1, b0);
  _mm256_store_si256(out + 2, a1);
  _mm256_store_si256(out + 3, b1);
  _mm256_store_si256(out + 4, a2);
  _mm256_store_si256(out + 5, b2);
  _mm256_store_si256(out + 6, a3);
  _mm256_store_si256(out + 7, b3);
#else
  for (uint32_t lane = 0; lane < blocks_per_refill; ++lane) {
    const auto word = philox_block({block_ + lane, stream_, static_cast<uint32_t>(particle_),
                                    static_cast<uint32_t>(particle_ >> 32)},
                                   seed_);
    for (uint32_t w = 0; w < 4; ++w) words_[w * blocks_per_refill + lane] = word[w];
  }
#endif
  block_ += blocks_per_refill;
  next_ = 0;
}

}  // namespace luxodus
