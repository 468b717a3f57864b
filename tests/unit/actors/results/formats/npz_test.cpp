// Archives of arrays for NumPy: headers, order of bytes, texts.
#include "actors/results/formats/npz.hpp"

#include <catch2/catch.hpp>
#include <cstring>

using namespace luxodus;

namespace {

/// The bytes of the only array of an archive, from its magic on.
std::string only_array(const NpyArray& array) {
  const auto archive = npz_of({array});
  REQUIRE(archive);
  const size_t begin = archive->find("\x93NUMPY");
  const size_t end = archive->find("PK\x01\x02");
  REQUIRE(begin != std::string::npos);
  REQUIRE(end != std::string::npos);
  return archive->substr(begin, end - begin);
}

}  // namespace

TEST_CASE("the header of an array ends at a multiple of 64 with a line feed", "[results][npz]") {
  for (size_t length : {0, 1, 9, 10, 12345, 1234567}) {
    const std::string bytes = only_array(npy_bytes("a", {length, 1}, std::string(length, 'x')));
    CHECK(bytes.substr(6, 2) == std::string("\1\0", 2));
    const auto header = static_cast<size_t>(static_cast<unsigned char>(bytes[8])) +
                        256 * static_cast<size_t>(static_cast<unsigned char>(bytes[9]));
    CHECK((10 + header) % 64 == 0);
    CHECK(bytes[10 + header - 1] == '\n');
    CHECK(bytes.size() == 10 + header + length);
    CHECK(bytes.find("'descr': '|u1', 'fortran_order': False, 'shape': (" + std::to_string(length) +
                     ", 1, ), }") != std::string::npos);
  }
}

TEST_CASE("numbers are doubles in little-endian order", "[results][npz]") {
  const std::string bytes = only_array(npy_numbers("a", {1.5, -2}));
  double back[2];
  std::memcpy(back, bytes.data() + bytes.size() - sizeof back, sizeof back);
  CHECK(back[0] == 1.5);
  CHECK(back[1] == -2);
  CHECK(bytes.find("'<f8'") != std::string::npos);
}

TEST_CASE("texts are code points, and bytes that are no UTF-8 are replaced", "[results][npz]") {
  const std::string bytes = only_array(npy_text("a", "A\xc3\xa9\xf0\x9f\x9a\xaa\xff"));
  CHECK(bytes.find("'<U4'") != std::string::npos);
  CHECK(bytes.find("'shape': (), ") != std::string::npos);
  const unsigned char expected[] = {'A',  0,    0, 0, 0xe9, 0,    0, 0,
                                    0xaa, 0xf6, 1, 0, 0xfd, 0xff, 0, 0};
  CHECK(std::memcmp(bytes.data() + bytes.size() - sizeof expected, expected, sizeof expected) == 0);
  CHECK(only_array(npy_texts("a", {"x", "long"})).find("'<U4'") != std::string::npos);
}
