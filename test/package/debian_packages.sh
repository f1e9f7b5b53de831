#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the Debian packages of a build tree and checks what is in them; lintian does, too,
# where it is installed.
#   test/package/debian_packages.sh BUILD FOLDER      FOLDER: for the packages
set -euo pipefail
build=$(realpath "${1:?name a build tree}")
folder=$(realpath -m "${2:?name a folder for the packages}")
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
cpack -G DEB --config "$build/CPackConfig.cmake" -B "$folder" > cpack.log 2>&1 ||
  { cat cpack.log; exit 1; }

result=0
# expect WHAT CONDITION...: a command that succeeds
expect() {
  local what=$1
  shift
  "$@" > /dev/null 2>&1 || { echo "FAILED: $what"; result=1; }
}
# shellcheck disable=SC2317 # expect calls them
{
  has() { [[ $1 =~ $2 ]]; }
  hasnt() { ! has "$@"; }
  binds_at_start() { has "$(readelf -d "$1")" 'FLAGS_1.*NOW'; }
}

libdir=usr/lib/$(gcc -print-multiarch)
so=$(basename "$(ls "$build"/libpcl_kss_icp.so.*.*.*)")
soversion=$(sed -E 's/.*\.so\.([0-9]+\.[0-9]+)\..*/\1/' <<< "$so")
library=libpcl-kss-icp$soversion
names=$(printf '%s\n' *.deb | sed 's/_.*//')
for package in $names; do
  deb=$(ls "$package"_*.deb)
  dpkg-deb -x "$deb" "$package"
  expect "$package: documents" \
    ls "$package/usr/share/doc/$package"/{copyright,changelog.gz,changelog.Debian.gz}
  expect "$package: outside /usr" [ "$(ls "$package")" = usr ]
  expect "$package: owner" \
    [ "$(dpkg-deb -c "$deb" | awk '{ print $2 }' | sort -u)" = root/root ]
  while read -r file; do # programs and libraries
    expect "$file: run path" hasnt "$(objdump -p "$file")" 'R(UN)?PATH'
    expect "$file: not stripped" hasnt "$(file "$file")" 'not stripped'
  done < <(find "$package" -type f -exec sh -c 'head -c 4 "$1" | grep -q ELF' _ {} \; -print)
done

expect "$library: library" [ -f "$library/$libdir/$so" ]
expect "$library: soname" \
  has "$(objdump -p "$library/$libdir/$so")" "SONAME +libpcl_kss_icp.so.$soversion"$'\n'
expect "$library: hardening" binds_at_start "$library/$libdir/$so"
expect "$library: link" [ -L "$library/$libdir/libpcl_kss_icp.so.$soversion" ]
control=$(dpkg-deb -I "$library"_*.deb triggers shlibs control)
expect "$library: trigger" has "$control" 'activate-noawait ldconfig'
expect "$library: shlibs" \
  has "$control" "libpcl_kss_icp $soversion $library \(>= $soversion"
expect "$library: depends" has "$control" 'Depends: .*libpcl-search.*ocl-icd-libopencl1'

version=$(dpkg-deb -f "$library"_*.deb Version)
dev=libpcl-kss-icp-dev
expect "$dev: depends" \
  has "$(dpkg-deb -f "$dev"_*.deb Depends)" "$library \(= $version\), libpcl-dev"
expect "$dev: files" ls "$dev/usr/include/pcl/registration/kss_icp.h" \
  "$dev/usr/include/pcl/registration/kss/export.h" "$dev/$libdir/libpcl_kss_icp.so" \
  "$dev/$libdir/pkgconfig/pcl_kss_icp.pc" \
  "$dev/$libdir/cmake/pcl_kss_icp/pcl_kss_icpConfig.cmake"

if [ -d pcl-kss-icp ]; then
  expect "pcl-kss-icp: depends" \
    has "$(dpkg-deb -f pcl-kss-icp_*.deb Depends)" "$library \(>= "
  expect "pcl-kss-icp: tool" [ -x pcl-kss-icp/usr/bin/pcl_kss_icp ]
  expect "pcl-kss-icp: hardening" binds_at_start pcl-kss-icp/usr/bin/pcl_kss_icp
fi

multiview=libpcl-kss-icp-multiview$soversion
if [ -d "$multiview" ]; then
  so=libpcl_kss_icp_multiview.so.$soversion
  expect "$multiview: link" [ -L "$multiview/$libdir/$so" ]
  expect "$multiview: soname" \
    has "$(objdump -p "$multiview/$libdir/$so")" "SONAME +$so"$'\n'
  expect "$multiview: hardening" binds_at_start "$multiview/$libdir/$so"
  control=$(dpkg-deb -I "$multiview"_*.deb triggers shlibs control)
  expect "$multiview: trigger" has "$control" 'activate-noawait ldconfig'
  expect "$multiview: shlibs" \
    has "$control" "libpcl_kss_icp_multiview $soversion $multiview \(>= $soversion"
  expect "$multiview: depends" has "$control" "Depends: .*$library \(>= "
  expect "$dev: many scans" ls "$dev/usr/include/pcl/registration/kss_multiview.h" \
    "$dev/$libdir/libpcl_kss_icp_multiview.so"
  expect "$dev: depends" \
    has "$(dpkg-deb -f "$dev"_*.deb Depends)" "$multiview \(= $version\)"
fi

if [ -d pcl-kss-icp-batch ]; then
  expect "pcl-kss-icp-batch: program" [ -x pcl-kss-icp-batch/usr/bin/pcl_kss_icp_batch ]
  expect "pcl-kss-icp-batch: many scans" \
    [ -x pcl-kss-icp-batch/usr/bin/pcl_kss_icp_multiview ]
  expect "pcl-kss-icp-batch: depends" \
    has "$(dpkg-deb -f pcl-kss-icp-batch_*.deb Depends)" "$multiview \(>= "
  expect "pcl-kss-icp-batch: hardening" \
    binds_at_start pcl-kss-icp-batch/usr/bin/pcl_kss_icp_batch
  expect "pcl-kss-icp: without MPI" hasnt "$(dpkg-deb -f pcl-kss-icp_*.deb Depends)" mpi
fi

if command -v lintian > /dev/null; then
  lintian --fail-on error,warning ./*.deb || result=1
else
  echo "lintian is not installed"
fi
exit $result
