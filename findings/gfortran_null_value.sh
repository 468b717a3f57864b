#!/usr/bin/env bash
# GNU Fortran passes over a null value behind the last element of a namelist array, and refuses a
# number there. So input files of FDS with a comma too many are valid for FDS.
#
# Package          gfortran-12, libgfortran-12-dev, libgfortran5 12.2.0-14+deb12u1 (Debian 12)
# One would guess  that "XB = 1,2,1,2,0,1,," has seven values of six, and is an error as
#                  "XB = 1,2,1,2,0,1,7" is
# It is            read, as if the last comma were not there
# Needs            gcc-12, apt-get download, dpkg and the network; works in a folder of its own
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
version=12.2.0-14+deb12u1
apt-get download -qq "gfortran-12=$version" "libgfortran-12-dev=$version" "libgfortran5=$version" \
  >download.log 2>&1
for package in ./*.deb; do dpkg -x "$package" root; done
cat >read.f90 <<'F90'
program read_group
  real(8) :: xb(6) = -1
  character(8) :: id = 'none'
  integer :: ios
  namelist /obst/ xb, id
  read (*, nml=obst, iostat=ios)
  print '(i0,6(1x,i0),1x,a)', ios, nint(xb), trim(id)
end program
F90
own=root/usr/lib/gcc/x86_64-linux-gnu/12/
root/usr/bin/x86_64-linux-gnu-gfortran-12 -fno-use-linker-plugin -static-libgfortran \
  -B "$own" -B /usr/lib/gcc/x86_64-linux-gnu/12/ -L "$own" -o read read.f90
null=$(echo "&OBST XB=1,2,1,2,0,1,, ID='wall' /" | ./read)
number=$(echo "&OBST XB=1,2,1,2,0,1,7, ID='wall' /" | ./read)
echo "gfortran 12.2.0, status, XB and ID: with a null behind the sixth $null; with a 7 $number"
[ "$null" = "0 1 2 1 2 0 1 wall" ] && [ "${number%% *}" != 0 ]
