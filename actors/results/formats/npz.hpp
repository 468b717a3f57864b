// Arrays for NumPy: .npz files, which are ZIP archives of .npy files of format version 1.0
// (numpy.lib.format). Equal content gives equal bytes. Pure; any thread.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/core/result.hpp"

namespace luxodus {

namespace limits {
/// Bytes of all arrays of a file: an archive without extensions ends at 4 GiB.
inline constexpr size_t max_npz_bytes = size_t{3} << 30;
}  // namespace limits

/// Elements in C order: the last index runs fastest.
struct NpyArray {
  std::string name;  // plain ASCII, unique in its file
  std::string type;  // as NumPy's `descr`, e.g. "<f8"
  std::vector<size_t> shape;
  std::string bytes;
};

NpyArray npy_numbers(std::string name, const std::vector<double>& values);
/// Requires: as many values as the shape says.
NpyArray npy_truths(std::string name, std::vector<size_t> shape, const std::vector<char>& values);
NpyArray npy_bytes(std::string name, std::vector<size_t> shape, std::string values);
/// A single text, and a list of texts; UTF-8.
NpyArray npy_text(std::string name, std::string_view text);
NpyArray npy_texts(std::string name, const std::vector<std::string>& texts);

/// Errors: more than limits::max_npz_bytes.
Result<std::string> npz_of(std::vector<NpyArray> arrays);

}  // namespace luxodus
