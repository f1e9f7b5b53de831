#!/usr/bin/env bash
# Makes docs/pictures/ with the tool, from a Debian package: two scans that fit, a gear wheel
# that fits in several ways, and two things that do not fit. Debian's python3-pil takes away
# colours that nobody misses.
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

# the same wheel elsewhere, its faces in another order, so that other points show it
awk 'NR == 2 { points = $1 }
     NF == 3 && NR > 2 && points-- > 0 { print $2 + 0.4, $3, $1; next }
     NF == 4 { face[++faces] = $0; next }
     { print }
     END { while (faces > 0) print face[faces--] }' pinion.off >wheel.off

"$tool" hippo2.ply hippo1.ply --rigid --picture right.png
"$tool" wheel.off pinion.off --rigid --picture ambiguous.png
"$tool" camel.off elephant.off --picture refused.png || [ $? -eq 1 ]
for name in right ambiguous refused; do
  python3 - "$name.png" "$pictures/$name.png" <<'END'
import sys
from PIL import Image
picture = Image.open(sys.argv[1]).convert("RGB")
# that keeps the few pixels of the scale of colours
picture.quantize(160, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE).save(
    sys.argv[2], optimize=True)
END
done
