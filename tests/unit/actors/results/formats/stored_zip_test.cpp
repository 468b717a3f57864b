// ZIP archives of texts, byte by byte as APPNOTE.TXT of PKWARE has them.
#include "actors/results/formats/stored_zip.hpp"

#include <catch2/catch.hpp>

#include "tests/kit/zip_kit.hpp"

using namespace luxodus;

namespace {

uint32_t number_at(const std::string& bytes, size_t at, int count) {
  uint32_t out = 0;
  for (int i = count - 1; i >= 0; --i)
    out = out << 8 | static_cast<unsigned char>(bytes.at(at + static_cast<size_t>(i)));
  return out;
}

}  // namespace

TEST_CASE("a stored archive has each file behind its header and in the directory", "[zip]") {
  const std::string content = "ZIP archives have a CRC\n";
  const std::string bytes = stored_zip({{"a.txt", content}, {"folder/b", ""}});
  // PKWARE's APPNOTE.TXT 4.3.7: signature, sizes, CRC.
  CHECK(bytes.substr(0, 4) == "PK\x03\x04");
  CHECK(number_at(bytes, 14, 4) == luxodus::test::crc32_of(content));
  CHECK(number_at(bytes, 18, 4) == content.size());
  CHECK(number_at(bytes, 22, 4) == content.size());
  CHECK(bytes.substr(30, 5) == "a.txt");
  CHECK(bytes.substr(35, content.size()) == content);
  // 4.3.16: the end says where the directory of two entries is.
  const size_t end = bytes.size() - 22;
  CHECK(bytes.substr(end, 4) == "PK\x05\x06");
  CHECK(number_at(bytes, end + 10, 2) == 2);
  const size_t directory = number_at(bytes, end + 16, 4);
  CHECK(bytes.substr(directory, 4) == "PK\x01\x02");
  CHECK(number_at(bytes, end + 12, 4) == end - directory);
  // 4.3.12: the second entry points at its header.
  const size_t second = directory + 46 + 5;
  CHECK(bytes.substr(second, 4) == "PK\x01\x02");
  const size_t header = number_at(bytes, second + 42, 4);
  CHECK(bytes.substr(header, 4) == "PK\x03\x04");
  CHECK(bytes.substr(header + 30, 8) == "folder/b");
  CHECK(stored_zip({{"a.txt", content}}) == stored_zip({{"a.txt", content}}));
}
