#!/usr/bin/env bash
# Installs what Luxodus needs on Debian 12, and nothing that is there already: a second call only
# looks. Both ./run.sh and ./test.sh call it.
#   ./setup.sh --run      what the program is built with
#   ./setup.sh --tests    that, and what tests and documents need besides; the default
#   ./setup.sh --package  all that, and what tests/tools/package_test.sh makes a package with
set -euo pipefail
cd "$(dirname "$0")"

want=${1:---tests}
case $want in
  --run | --tests | --package) ;;
  *)
    echo "setup.sh: $want is none of --run, --tests and --package" >&2
    exit 2
    ;;
esac

packages=(
  # compiler and build
  g++ cmake ninja-build pkg-config ccache
  # rays, meshes, threads
  libembree-dev libtbb-dev libglm-dev
  # text: scene files, options, logs, reports
  libtomlplusplus-dev libcli11-dev libspdlog-dev libfmt-dev nlohmann-json3-dev
  # values as bytes
  libcereal-dev
  # pictures, drawings, data
  libdxflib-dev
  # containers of luminaires (GLDF)
  libzip-dev libpugixml-dev
  # trajectories of people (SQLite, HDF5)
  libsqlite3-dev libhdf5-dev
  # smoke from OpenVDB files
  libopenvdb-dev
  # mixed-integer programs: where emergency luminaires go; moving them without gradients
  coinor-libcbc-dev libnlopt-dev
  libopenexr-dev libpng-dev librsvg2-dev libcairo2-dev fonts-dejavu-core libzstd-dev libxxhash-dev
  # nodes: fibers, links, messages
  libboost-context-dev libzmq3-dev cppzmq-dev libcapnp-dev capnproto
  # the live view's server
  libboost-dev
  # the Python module
  pybind11-dev python3-dev python3-numpy
)
if [ "$want" != --run ]; then
  packages+=(
    # tests and formatting
    catch2 python3 python3-yaml clang-format iproute2 poppler-utils ffmpeg
    # documents
    mkdocs mkdocs-material
  )
fi
if [ "$want" = --package ]; then
  packages+=(help2man dpkg-dev file)
fi

# Others' Node.js will do; Debian's comes where there is none.
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  packages+=(nodejs npm)
fi

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "setup.sh: this is no Debian; install by hand what these packages hold: ${packages[*]}" >&2
  exit 0
fi

# dpkg-query fails when it knows nothing of a package; what counts is the list it prints.
installed=" $(dpkg-query --show --showformat='${Package} ${db:Status-Status}\n' "${packages[@]}" \
  2>/dev/null | awk '$2 == "installed" { print $1 }' | sort -u | tr '\n' ' ' || true) "
missing=()
for package in "${packages[@]}"; do
  [[ $installed == *" $package "* ]] || missing+=("$package")
done

install_missing() {
  echo "setup.sh: installing ${missing[*]}"
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || {
      echo "setup.sh: run as root, or install sudo: apt-get install ${missing[*]}" >&2
      exit 1
    }
    as_root=(sudo)
  fi
  # Another apt may hold the lock for a while, on a machine that has just started.
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive
    apt-get -o DPkg::Lock::Timeout=300 -qq)
  "${apt[@]}" update
  "${apt[@]}" install -y --no-install-recommends "${missing[@]}" >/dev/null
}
if [ ${#missing[@]} -gt 0 ]; then
  install_missing
fi

# Packages of npm, as the lock in a folder says: without them something is missing, which says so
# itself, and all else is built.
fetch_packages() {
  local folder=$1 what=$2 without=$3
  local have=$folder/node_modules/.package-lock.json
  if [ -e "$have" ] && [ ! "$folder/package-lock.json" -nt "$have" ]; then
    return
  fi
  echo "setup.sh: fetching what $what"
  if ! (cd "$folder" && npm ci --no-audit --no-fund --loglevel=error); then
    rm -rf "$folder/node_modules"
    echo "setup.sh: npm could not; $without" >&2
  fi
}
fetch_packages actors/apps/view/page "the live view's page is built with" \
  "the live view will have no page"
fetch_packages actors/import/shapes "computes the shapes of IFC models" \
  "luxodus import ifc will not work"
