// small_vdb FILE: writes an OpenVDB file with a fog volume "density" of 3 x 3 x 3 cells, three of
// which have smoke, and a level set "surface".
#include <cstdio>
#include <exception>

#include "tests/unit/scenes/formats/vdb/vdb_kit.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: small_vdb FILE\n");
    return 2;
  }
  try {
    const auto surface = luxodus::test::fog("surface");
    surface->setGridClass(openvdb::GRID_LEVEL_SET);
    openvdb::io::File file(argv[1]);
    file.write(openvdb::GridPtrVec{luxodus::test::fog(), surface});
    file.close();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "small_vdb: %s\n", error.what());
    return 1;
  }
  return 0;
}
