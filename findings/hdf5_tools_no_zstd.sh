#!/usr/bin/env bash
# JuPedSim's HDF5 (schema 2) compresses its table of trajectories by Zstandard, filter 32015. The
# library of Debian does not have this filter, and neither has the package of "external filters".
# h5dump lists the table and cannot read a row of it.
#
# Package          hdf5-tools and libhdf5 1.10.8, hdf5-filter-plugin 0.0~git20221111 (Debian 12)
# One would guess  that a current libhdf5, or at least its package of filters, reads Zstandard
# It is            LZ4 and BZip2 that this package brings; reading fails
# Needs            apt-get download, dpkg, g++, libhdf5-dev, libzstd-dev and the network; works in a
#                  folder of its own
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get download -qq hdf5-tools=1.10.8+repack1-1 libhdf5-hl-100=1.10.8+repack1-1 \
  libhdf5-103-1=1.10.8+repack1-1 hdf5-filter-plugin=0.0~git20221111.49e3b65-4 >download.log 2>&1
for package in ./*.deb; do dpkg -x "$package" root; done
cat >write.cpp <<'CPP'
// Writes 1000 frames of one person, packed by a filter with the number of Zstandard.
#include <hdf5.h>
#include <zstd.h>

size_t pack(unsigned, size_t, const unsigned*, size_t bytes, size_t* held, void** buffer) {
  const size_t most = ZSTD_compressBound(bytes);
  void* out = H5allocate_memory(most, 0);
  const size_t made = ZSTD_compress(out, most, *buffer, bytes, 3);
  H5free_memory(*buffer);
  *buffer = out;
  *held = most;
  return made;
}

int main() {
  const H5Z_class2_t zstd{H5Z_CLASS_T_VERS, 32015, 1, 0, "zstd", nullptr, nullptr, pack};
  H5Zregister(&zstd);
  const hsize_t rows = 1000;
  float x[1000];
  for (int i = 0; i < 1000; ++i) x[i] = 0.1F * static_cast<float>(i);
  const hid_t file = H5Fcreate("people.h5", H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t how = H5Pcreate(H5P_DATASET_CREATE), space = H5Screate_simple(1, &rows, nullptr);
  H5Pset_chunk(how, 1, &rows);
  H5Pset_filter(how, 32015, H5Z_FLAG_MANDATORY, 0, nullptr);
  const hid_t table =
      H5Dcreate2(file, "trajectory", H5T_IEEE_F32LE, space, H5P_DEFAULT, how, H5P_DEFAULT);
  H5Dwrite(table, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, x);
  H5Dclose(table);
  return H5Fclose(file) < 0 ? 1 : 0;
}
CPP
g++ -o write write.cpp $(pkg-config --cflags --libs hdf5 libzstd)
./write
plugins=$(find root -name '*.so*' -path '*plugin*')
[ -n "$plugins" ]
if grep -qi zstd <<<"$plugins"; then
  echo "the package of filters brings Zstandard now"
  exit 1
fi
export HDF5_PLUGIN_PATH=$PWD/$(dirname "$(head -1 <<<"$plugins")")
export LD_LIBRARY_PATH=$PWD/root/usr/lib/x86_64-linux-gnu
h5dump=root/usr/bin/h5dump
"$h5dump" -p -H people.h5 | tr -s ' \n' ' ' | grep -q 'FILTER_ID 32015'
if "$h5dump" -d /trajectory people.h5 >dump.txt 2>&1 &&
  ! grep -q 'unable to print data' dump.txt; then
  echo "h5dump reads Zstandard now"
  exit 1
fi
said=$(grep -i -m1 -E 'unable|error' dump.txt)
echo "h5dump lists filter 32015 and cannot read the table: $said"
echo "filters of the package: $(basename -a $plugins | tr '\n' ' ')"
