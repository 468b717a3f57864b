// Small OpenVDB files for tests, written with OpenVDB.
#pragma once

#include <openvdb/openvdb.h>

#include <filesystem>
#include <string>

#include "tests/kit/temporary_folder.hpp"

namespace luxodus::test {

/// A fog volume of cells of 0.5 x 0.25 x 0.125, from index (2, -1, 4).
inline openvdb::FloatGrid::Ptr fog(const std::string& name = "density", float background = 0) {
  openvdb::initialize();
  auto grid = openvdb::FloatGrid::create(background);
  grid->setName(name);
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
  transform->preScale(openvdb::Vec3d(0.5, 0.25, 0.125));
  transform->postTranslate(openvdb::Vec3d(10, 20, 30));
  grid->setTransform(transform);
  auto cells = grid->getAccessor();
  cells.setValue(openvdb::Coord(2, -1, 4), 1.0F);
  cells.setValue(openvdb::Coord(4, 0, 4), 2.0F);
  cells.setValue(openvdb::Coord(3, 1, 6), 3.0F);
  return grid;
}

/// smoke.vdb. `compression`: flags of openvdb::io.
inline std::filesystem::path written_grids(
    const TemporaryFolder& folder, const openvdb::GridPtrVec& grids,
    uint32_t compression = openvdb::io::Archive::DEFAULT_COMPRESSION_FLAGS) {
  const auto path = folder / "smoke.vdb";
  openvdb::io::File file(path.string());
  file.setCompression(compression);
  file.write(grids);
  file.close();
  return path;
}

}  // namespace luxodus::test
