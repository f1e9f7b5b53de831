#!/usr/bin/env bash
# Registers two bunnies, both from Debian packages: meshes of one scan, made by different
# people, in different units; and turns one of them first. Everything is in build-demo/.
set -euo pipefail
cd "$(dirname "$0")/.."

cmake/install_dependencies.sh
cmake -S . -B build-demo -G Ninja -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
  -DPCL_KSS_ICP_BUILD_EXAMPLES=OFF -DBUILD_TESTING=OFF
cmake --build build-demo

cd build-demo
if [ ! -e turned.obj ] || [ ! -e bunny00.off ]; then
  as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  fetch=(apt-get -q -o APT::Sandbox::User=root download glmark2-data libcgal-demo)
  "${fetch[@]}" || { "${as_root[@]}" apt-get -q update && "${fetch[@]}"; }
  for package in glmark2-data_*.deb libcgal-demo_*.deb; do
    dpkg -x "$package" packages
  done
  tar -xzf packages/usr/share/doc/libcgal-dev/data.tar.gz --strip-components=2 \
    data/meshes/bunny00.off
  # (x, y, z) becomes (z, -x, -y), then turns by 50 degrees about x
  awk '$1 == "v" {
         y = -$2; z = -$3; c = cos(0.8727); s = sin(0.8727)
         printf "v %.6f %.6f %.6f\n", $4, c * y - s * z, s * y + c * z
         next
       }
       { print }' packages/usr/share/glmark2/models/bunny.obj >turned.obj
fi

tools/pcl_kss_icp turned.obj bunny00.off aligned.obj --transform transform.txt
echo "In build-demo/: aligned.obj, which is turned.obj placed upon bunny00.off, and"
echo "transform.txt, the transformation"
if python3 -c "import matplotlib, numpy" 2>/dev/null; then
  python3 ../docs/make_picture.py turned.obj bunny00.off transform.txt bunnies.png
  echo "bunnies.png, a picture of them"
fi
