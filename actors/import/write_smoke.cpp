#include "actors/import/write_smoke.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>
#include <vector>

#include "actors/import/import_files.hpp"
#include "runtime/core/atomic_file.hpp"
#include "scenes/formats/fields/data_set.hpp"

namespace luxodus {
namespace {

static_assert(std::endian::native == std::endian::little);  // as the header states

/// A file of NRRD: its header, an empty line, and the extinction of each cell.
std::vector<std::byte> nrrd_of(const VdbSmoke& smoke, const SmokeOrigin& origin) {
  const glm::dvec3 edge = smoke.spacing * origin.metres_per_unit;
  // NRRD's origin is the middle of its first cell.
  const glm::dvec3 first = smoke.origin * origin.metres_per_unit + 0.5 * edge;
  const std::string head = fmt::format(
      "NRRD0005\n# Made by luxodus import vdb: grid {} of {},\n"
      "# with an extinction of {:g} 1/m for a value of 1.\n"
      "type: float\ndimension: 3\nsizes: {} {} {}\n"
      "space dimension: 3\nspace directions: ({:.17g},0,0) (0,{:.17g},0) (0,0,{:.17g})\n"
      "space origin: ({:.17g},{:.17g},{:.17g})\nendian: little\nencoding: raw\n"
      "field:=extinction\n\n",
      as_name(origin.grid, "without a name"), as_name(origin.file, "a file"),
      origin.extinction_per_unit, smoke.nx, smoke.ny, smoke.nz, edge.x, edge.y, edge.z, first.x,
      first.y, first.z);
  std::vector<std::byte> out(head.size() + smoke.values.size() * sizeof(float));
  std::memcpy(out.data(), head.data(), head.size());
  std::byte* at = out.data() + head.size();
  for (const float value : smoke.values) {
    const auto extinction =
        static_cast<float>(static_cast<double>(value) * origin.extinction_per_unit);
    std::memcpy(at, &extinction, sizeof extinction);
    at += sizeof extinction;
  }
  return out;
}

/// Equal after every import: an existing file is kept.
constexpr std::string_view medium_text =
    R"(# Made by `luxodus import vdb`, and yours from now on: name it in the 'include' of a scene.
# smoke.nrrd beside it is written anew by every import; its head says of which grid it is.
[[medium]]
name = "smoke"
kind = "data_set"
file = "smoke.nrrd"
quantity = "extinction"
wavelength_nm = 633
# The file does not know how the smoke scatters: these are usual values of flaming fires.
albedo = 0.2
phase = "hg"
g = 0.6
angstrom = 1
)";

}  // namespace

Result<bool> write_smoke(const VdbSmoke& smoke, const SmokeOrigin& origin, const std::string& out) {
  const float most =
      smoke.values.empty() ? 0 : *std::max_element(smoke.values.begin(), smoke.values.end());
  if (static_cast<double>(most) * origin.extinction_per_unit >
      static_cast<double>(limits::extinction_per_m))
    return problem_in(
        origin.file, fmt::format("its largest value is {:g}, and {:g} 1/m of it is no smoke: state "
                                 "another extinction for a value of 1",
                                 most, static_cast<double>(most) * origin.extinction_per_unit));
  const auto folder = import_folder(out);
  if (!folder) return folder.problem();
  const auto bytes = nrrd_of(smoke, origin);
  if (auto ok = write_file_atomically(folder.value() / "smoke.nrrd", std::span(bytes)); !ok)
    return ok.problem();
  return write_unless_there(folder.value() / "smoke.toml", std::string(medium_text));
}

}  // namespace luxodus
