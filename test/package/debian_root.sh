#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the Debian packages of a build tree in a bare Debian 12, runs the tool, builds
# programs with the library, removes the packages, and compares the files before and
# after. As root, with debootstrap; takes ten minutes and 4 GB, most of it for libpcl-dev.
#   (cd BUILD && cpack -G DEB) && test/package/debian_root.sh BUILD [ROOT]
#     BUILD   a build tree; the Python package, too, if that is put into it
#     ROOT    a folder for the bare Debian, which stays and is used again; otherwise a
#             temporary one
# MIRROR in the environment: of Debian, otherwise http://deb.debian.org/debian
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$(realpath "${1:?name a build tree}")
root=${2:-}
temporary=
[ -n "$root" ] || { root=$(mktemp -d) && temporary=$root; }

tidy_up() {
  if mountpoint -q "$root/proc"; then umount "$root/proc"; fi
  [ -z "$temporary" ] || rm -rf --one-file-system "$temporary"
}
trap tidy_up EXIT

inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/tmp LC_ALL=C.UTF-8 \
  DEBIAN_FRONTEND=noninteractive "$@"; }
apt() { inside apt-get -qq -o Dpkg::Use-Pty=0 \
  -o Dpkg::Options::=--force-unsafe-io --no-install-recommends "$@" > "$root/tmp/apt.log" 2>&1 ||
  { cat "$root/tmp/apt.log"; exit 1; }; }
fail() { echo "FAILED: $*"; exit 1; }

# but for what dpkg, apt and ldconfig keep of their own
files() {
  find "$root" -xdev '(' -path "$root/tmp" -o -path "$root/var/lib/dpkg" \
    -o -path "$root/var/lib/apt" -o -path "$root/var/cache" -o -path "$root/var/log" \
    -o -path "$root/proc" ')' -prune -o -print | sort
}

# packages NAME...: the files of packages, as they lie inside
packages() { for name in "$@"; do (cd "$root" && ls ./tmp/"$name"_*.deb) | cut -c 2-; done; }

# needs NAME...: what packages need that is not ours
needs() {
  for name in "$@"; do
    dpkg-deb --field "$root/tmp/$name"_*.deb Depends
  done | sed -E 's/, */\n/g' | grep -v pcl-kss-icp | sort -u | paste -sd ,
}

# goes WORD NAME...: removes or purges packages, and compares with before.txt
goes() {
  apt "$@"
  files > "$root/tmp/after.txt"
  diff "$root/tmp/before.txt" "$root/tmp/after.txt" || fail "files after apt-get $*"
  echo "$*: nothing is left"
}

echo "== Debian in $root"
[ -e "$root/etc/debian_version" ] ||
  debootstrap --variant=minbase bookworm "$root" "${MIRROR:-http://deb.debian.org/debian}" \
    > /dev/null
mountpoint -q "$root/proc" || mount -t proc proc "$root/proc"
rm -f "$root"/tmp/*.deb
cp "$build"/*pcl-kss-icp*.deb "$root/tmp"
apt update

echo "== The tool"
library=$(cd "$root/tmp" && echo libpcl-kss-icp[0-9]*.deb)
library=${library%%_*}
libraries=("$library") # all that there are: many scans may go without
for file in "$root"/tmp/libpcl-kss-icp-multiview*.deb; do
  [ ! -e "$file" ] || libraries+=("$(basename "${file%%_*}")")
done
apt satisfy "$(needs "$library" pcl-kss-icp)"
files > "$root/tmp/before.txt"
mapfile -t debs < <(packages "$library" pcl-kss-icp)
apt install "${debs[@]}"
inside ldconfig -p | grep libpcl_kss_icp > /dev/null || fail "the loader's cache"
inside pcl_kss_icp --version
inside pcl_kss_icp --help | grep -- --transform > /dev/null || fail "--help"
# a helix that widens, and the same one turned by a quarter and twice as large
awk 'BEGIN { for (i = 0; i < 600; ++i) { t = 0.02 * i
  x = t * cos(t); y = t * sin(t); z = 0.5 * t * t
  print x, y, z > "'"$root"'/tmp/source.xyz"
  print 3 - 2 * y, 2 * x, 2 * z > "'"$root"'/tmp/target.xyz" } }'
inside pcl_kss_icp /tmp/source.xyz /tmp/target.xyz --transform /tmp/pose.txt --quiet
awk 'function off(a, b) { return a - b > 0.01 || b - a > 0.01 }
  NR == 1 { bad += off($1, 0) + off($2, -2) + off($3, 0) + off($4, 3) }
  NR == 2 { bad += off($1, 2) + off($2, 0) + off($3, 0) + off($4, 0) }
  NR == 3 { bad += off($1, 0) + off($2, 0) + off($3, 2) + off($4, 0) }
  END { exit bad || NR != 4 }' "$root/tmp/pose.txt" || fail "the pose"
goes remove pcl-kss-icp "$library"
apt install "${debs[@]}"
goes purge pcl-kss-icp "$library"

echo "== Programs that use the library"
apt satisfy "$(needs "${libraries[@]}" libpcl-kss-icp-dev), g++, cmake, make, pkg-config"
files > "$root/tmp/before.txt"
mapfile -t debs < <(packages "${libraries[@]}" libpcl-kss-icp-dev)
apt install "${debs[@]}"
rm -rf "$root/tmp/consumer" "$root/tmp/build"
mkdir "$root/tmp/consumer"
cp "$here/CMakeLists.txt" "$here"/*.cpp "$root/tmp/consumer"
inside cmake -S /tmp/consumer -B /tmp/build -DCMAKE_BUILD_TYPE=Release > "$root/tmp/cmake.log" 2>&1 ||
  { cat "$root/tmp/cmake.log"; fail "find_package()"; }
inside cmake --build /tmp/build > /dev/null
inside /tmp/build/consumer > /dev/null || fail "the program that CMake has built"
[ "${#libraries[@]}" -eq 1 ] || inside /tmp/build/many_scans > /dev/null ||
  fail "the program with many scans"
# shellcheck disable=SC2016 # expanded inside
inside sh -c 'g++ -std=c++17 -O1 /tmp/consumer/consumer.cpp -o /tmp/consumer/program \
  $(pkg-config --cflags --libs pcl_kss_icp)'
inside /tmp/consumer/program > /dev/null || fail "the program that pkg-config helped to build"
goes purge libpcl-kss-icp-dev "${libraries[@]}"

if ls "$root"/tmp/pcl-kss-icp-batch_*.deb > /dev/null 2>&1; then
  echo "== Many pairs, many scans"
  apt satisfy "$(needs "${libraries[@]}" pcl-kss-icp-batch)"
  files > "$root/tmp/before.txt"
  mapfile -t debs < <(packages "${libraries[@]}" pcl-kss-icp-batch)
  apt install "${debs[@]}"
  printf '%s\n' source,target /tmp/source.xyz,/tmp/target.xyz > "$root/tmp/pairs.csv"
  inside pcl_kss_icp_batch /tmp/pairs.csv --out /tmp/pairs --quiet || fail "many pairs"
  if [ "${#libraries[@]}" -gt 1 ]; then
    awk '{ print -$2, $1, $3 }' "$root/tmp/source.xyz" > "$root/tmp/turned.xyz"
    inside pcl_kss_icp_multiview /tmp/source.xyz /tmp/turned.xyz --out /tmp/scans --quiet ||
      fail "many scans"
  fi
  goes purge pcl-kss-icp-batch "${libraries[@]}"
fi

if ls "$root"/tmp/pcl-kss-icp-view_*.deb > /dev/null 2>&1; then
  echo "== The viewer"
  apt satisfy "$(needs "$library" pcl-kss-icp-view)"
  files > "$root/tmp/before.txt"
  mapfile -t debs < <(packages "$library" pcl-kss-icp-view)
  apt install "${debs[@]}"
  inside pcl_kss_icp_view --help > /dev/null || fail "the viewer"
  goes purge pcl-kss-icp-view "$library"
fi

if ls "$root"/tmp/python3-pcl-kss-icp_*.deb > /dev/null 2>&1; then
  echo "== Python"
  apt satisfy "$(needs python3-pcl-kss-icp)"
  files > "$root/tmp/before.txt"
  mapfile -t debs < <(packages python3-pcl-kss-icp)
  apt install "${debs[@]}"
  inside python3 -c 'import pcl_kss_icp' || fail "import"
  goes purge python3-pcl-kss-icp
fi
