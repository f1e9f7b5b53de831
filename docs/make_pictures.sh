#!/usr/bin/env bash
# Makes docs/pictures/ with the tool: two scans that fit, a gear wheel that fits in several
# ways, and two things that do not fit, all of a Debian package; then fewer colours, by
# Debian's python3-pil.
#
#   docs/make_pictures.sh [BUILD]      the folder of a build; otherwise build
set -euo pipefail
cd "$(dirname "$0")/.."
tool=$(realpath "${1:-build}/tools/pcl_kss_icp")
pictures=$(realpath docs/pictures)

folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cd "$folder"
apt-get -q -o APT::Sandbox::User=root download libcgal-demo
dpkg -x libcgal-demo_*.deb package
tar -xzf package/usr/share/doc/libcgal-dev/data.tar.gz --strip-components=2 \
  data/points_3/hippo{1,2}.ply data/meshes/{pinion,elephant,camel}.off

# the same thing elsewhere, turned about (1, 1, 1)
awk 'NR == 2 { points = $1 }
     NR > 2 && NF == 3 && points-- > 0 { print $2 + 0.4, $3, $1; next }
     { print }' pinion.off >turned.off

"$tool" hippo2.ply hippo1.ply --rigid --picture right.png
"$tool" turned.off pinion.off --rigid --picture ambiguous.png
"$tool" camel.off elephant.off --picture refused.png || [ $? -eq 1 ]
for name in right ambiguous refused; do
  python3 - "$name.png" "$pictures/$name.png" <<'END'
import sys
from PIL import Image
Image.open(sys.argv[1]).quantize(200, dither=Image.Dither.NONE).save(sys.argv[2], optimize=True)
END
done
