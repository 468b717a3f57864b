#!/bin/bash
# A pool of stacks makes every fiber of Boost take at least one page more than malloc does.
#
# Package    libboost1.74-dev, libboost-context1.74.0 1.74.0+ds1-21 (Debian 12)
# One would guess  that pooled_fixedsize_stack takes at most as much resident memory as
#                  fixedsize_stack of the same size, since it asks for many stacks at once and keeps
#                  no head of malloc for each
# It is            6 kB more for each of 20 000 suspended fibers: Boost.Pool links free pieces of a
#                  block through their first bytes, which are the far ends of the stacks. So each
#                  has a resident page there, also those in reserve, as blocks grow twofold
# Needs      apt-get, g++ and the network; works in a folder of its own
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
version=1.74.0+ds1-21
apt-get download -qq libboost1.74-dev=$version libboost-context1.74.0=$version > /dev/null
for package in *.deb; do dpkg-deb -x "$package" .; done
cat > stacks.cpp << 'EOF'
#include <boost/context/fiber.hpp>
#include <boost/context/fixedsize_stack.hpp>
#include <boost/context/pooled_fixedsize_stack.hpp>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <vector>
namespace context = boost::context;
long resident() {
  std::ifstream file("/proc/self/statm");
  long all = 0, pages = 0;
  file >> all >> pages;
  return pages * 4096;
}
template <class Stacks>
void measure(Stacks stacks) {
  constexpr int count = 20000;
  std::vector<context::fiber> fibers;
  fibers.reserve(count);
  const long before = resident();
  for (int i = 0; i < count; ++i) {
    fibers.emplace_back(std::allocator_arg, stacks,
                        [](context::fiber&& caller) { return std::move(caller).resume(); });
    fibers.back() = std::move(fibers.back()).resume();  // it waits
  }
  std::printf("%ld\n", (resident() - before) / count);
}
int main(int, char** argv) {
  constexpr size_t bytes = 65536;
  std::strcmp(argv[1], "pool") == 0 ? measure(context::pooled_fixedsize_stack(bytes))
                                    : measure(context::fixedsize_stack(bytes));
}
EOF
lib=usr/lib/$(dpkg-architecture -q DEB_HOST_MULTIARCH 2> /dev/null || gcc -print-multiarch)
g++ -std=c++17 -O2 -Iusr/include stacks.cpp "$lib/libboost_context.so.1.74.0" -o stacks
pool=$(LD_LIBRARY_PATH=$lib ./stacks pool)
malloc=$(LD_LIBRARY_PATH=$lib ./stacks malloc)
echo "Boost 1.74: a suspended fiber takes $pool bytes with a pool of stacks, $malloc with malloc"
[ "$pool" -ge 8192 ] && [ "$malloc" -lt 6144 ]
