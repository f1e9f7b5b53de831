#!/usr/bin/env bash
# Registers two partial scans of a hippopotamus, from a Debian package: each shows what
# the scanner saw from one side, 43 degrees apart. Everything is in build-demo/.
set -euo pipefail
cd "$(dirname "$0")/.."

cmake/install_dependencies.sh
cmake -S . -B build-demo -G Ninja -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
  -DPCL_KSS_ICP_BUILD_EXAMPLES=OFF -DBUILD_TESTING=OFF
cmake --build build-demo

cd build-demo
if [ ! -e hippo2.ply ]; then
  as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  fetch=(apt-get -q -o APT::Sandbox::User=root download libcgal-demo)
  "${fetch[@]}" || { "${as_root[@]}" apt-get -q update && "${fetch[@]}"; }
  dpkg -x libcgal-demo_*.deb package
  tar -xzf package/usr/share/doc/libcgal-dev/data.tar.gz --strip-components=2 \
    data/points_3/hippo1.ply data/points_3/hippo2.ply
fi

tools/pcl_kss_icp hippo2.ply hippo1.ply aligned.ply --rigid --transform transform.txt
echo "In build-demo/: aligned.ply, which is hippo2.ply placed upon hippo1.ply, and"
echo "transform.txt, the transformation"
python=/usr/bin/python3 # Debian's, whatever other ones there are: it has the packages
if "$python" -c "import matplotlib, PIL" 2>/dev/null; then
  "$python" ../docs/make_picture.py hippo2.ply hippo1.ply transform.txt hippos.png
  echo "hippos.png, a picture of them"
fi
