#include "scenes/light/tally/sparse_array.hpp"

#include <catch2/catch.hpp>
#include <thread>
#include <utility>

#include "runtime/core/random.hpp"

using namespace luxodus;

namespace {

using Array = SparseArray<int64_t>;
constexpr int64_t page = Array::page_elements;
constexpr size_t page_bytes = ZeroedMemory::page_bytes;
using Runs = std::vector<std::pair<int64_t, int64_t>>;

Runs touched(const Array& array, int64_t first, int64_t end) {
  Runs runs;
  array.for_each_touched(first, end, [&](int64_t a, int64_t b) { runs.emplace_back(a, b); });
  return runs;
}
Runs touched(const Array& array) {
  return touched(array, 0, static_cast<int64_t>(array.size()));
}

}  // namespace

TEST_CASE("an array that was never written is zero and takes no memory", "[tally][sparse]") {
  const Array array(1000 * page);
  CHECK(array.bytes() == 0);
  CHECK(touched(array).empty());
  CHECK(array[999 * page] == 0);
  CHECK(array.bytes() == 0);
  CHECK(touched(Array()).empty());
}

TEST_CASE("touched elements are visited page by page, within the requested range",
          "[tally][sparse]") {
  Array array(10 * page + 5);
  *array.touch(2 * page + 7) = 1;
  *array.touch(3 * page) = 2;
  *array.touch(10 * page + 4) = 3;
  CHECK(touched(array) == Runs{{2 * page, 4 * page}, {10 * page, 10 * page + 5}});
  CHECK(touched(array, 2 * page + 3, 3 * page + 1) == Runs{{2 * page + 3, 3 * page + 1}});
  CHECK(touched(array, 4 * page, 10 * page).empty());
  CHECK(touched(array, 5, 5).empty());
  CHECK(array.next_touched(0, 5 * page) == 2 * page);
  CHECK(array.next_touched(2 * page + 9, 5 * page) == 2 * page + 9);
  CHECK(array.next_touched(4 * page, 10 * page) == 10 * page);
  CHECK(array.bytes() == 3 * page_bytes);
  CHECK(array.bytes_to_touch(0, 4 * page) == 2 * page_bytes);
  CHECK(array.bytes_to_touch(1, 2) == page_bytes);
}

TEST_CASE("a run of elements on several pages touches all of them", "[tally][sparse]") {
  Array array(8 * page);
  array.touch(page - 1, 2)[1] = 5;
  CHECK(touched(array) == Runs{{0, 2 * page}});
  array.touch(4 * page - 1, 2 * page + 2);
  CHECK(touched(array) == Runs{{0, 2 * page}, {3 * page, 7 * page}});
}

TEST_CASE("unmarked writes are found, unless their memory was released", "[tally][sparse]") {
  if (!ZeroedMemory::use_is_told()) {
    WARN("this system does not tell which pages are in use: all count as touched");
    return;
  }
  Array array(600 * page, Cleared::given_back);
  array.data()[3] = 1;
  array.data()[300 * page] = 2;
  CHECK(touched(array).empty());
  array.find_touched();
  CHECK(touched(array) == Runs{{0, page}, {300 * page, 301 * page}});
  CHECK(array.bytes() == 2 * page_bytes);
  array.clear();
  array.data()[599 * page] = 3;
  array.find_touched();
  CHECK(touched(array) == Runs{{599 * page, 600 * page}});
}

TEST_CASE("cleared elements are zero, and their memory is kept or released as requested",
          "[tally][sparse]") {
  for (const Cleared cleared : {Cleared::kept, Cleared::given_back}) {
    Array array(4 * page, cleared);
    for (const int64_t i : {int64_t{0}, page, 2 * page, 3 * page + 1}) *array.touch(i) = 9;
    array.clear(1, 3 * page);  // the first page lies only partly in it
    CHECK(touched(array) == Runs{{0, page}, {3 * page, 4 * page}});
    CHECK(array[0] == 9);
    CHECK(array[page] == 0);
    CHECK(array.bytes() == (cleared == Cleared::kept ? 4 : 2) * page_bytes);
    array.clear();
    CHECK(touched(array).empty());
    CHECK(array[3 * page + 1] == 0);
    CHECK(array.bytes() == (cleared == Cleared::kept ? 4 : 0) * page_bytes);
    *array.touch(page) += 2;
    CHECK(array[page] == 2);
  }
}

TEST_CASE("a copy is equal, holds the touched pages, and is independent", "[tally][sparse]") {
  Array array(100 * page);
  *array.touch(50 * page) = 4;
  *array.touch(7) = 5;
  array.clear(0, page);
  Array copy = array;
  CHECK(copy == array);
  CHECK(copy.bytes() == page_bytes);
  *copy.touch(0) = 1;
  CHECK_FALSE(copy == array);
  array = std::move(copy);
  CHECK(array[0] == 1);
  CHECK(array[50 * page] == 4);
}

TEST_CASE("an array holds the values of a plain one after any writes and clears",
          "[tally][sparse]") {
  constexpr int64_t size = 20 * page + 100;
  Random random(5, RandomStream::test);
  random.start(0);
  Array array(size, Cleared::given_back);
  std::vector<int64_t> plain(size);
  for (int round = 0; round < 50; ++round) {
    for (int i = 0; i < 20; ++i) {
      const int64_t at = random.bits() % size;
      *array.touch(at) += i;
      plain[static_cast<size_t>(at)] += i;
    }
    const auto first = static_cast<int64_t>(random.bits() % 20) * page;
    const int64_t end = std::min<int64_t>(size, first + 3 * page);
    if (round % 3 == 0) {
      array.clear(first, end);
      std::fill(plain.begin() + first, plain.begin() + end, 0);
    }
    CHECK(std::equal(plain.begin(), plain.end(), array.data()));
    int64_t outside = 0, behind = 0;
    for (const auto& [a, b] : touched(array)) {
      outside += std::count_if(plain.begin() + behind, plain.begin() + a,
                               [](int64_t v) { return v != 0; });
      behind = b;
    }
    CHECK(outside == 0);
  }
}

TEST_CASE("threads touch different elements of one page", "[tally][sparse]") {
  Array array(2 * page);
  std::vector<std::thread> threads;
  for (int64_t t = 0; t < 4; ++t)
    threads.emplace_back([&array, t] {
      for (int64_t i = t; i < 2 * page; i += 4) *array.touch(i) = i;
    });
  for (std::thread& thread : threads) thread.join();
  int64_t wrong = 0;
  for (int64_t i = 0; i < 2 * page; ++i) wrong += array[static_cast<size_t>(i)] != i;
  CHECK(wrong == 0);
  CHECK(touched(array) == Runs{{0, 2 * page}});
}
