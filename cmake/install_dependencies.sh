#!/usr/bin/env bash
# Installs what the build and the tests need and this machine lacks: Debian 12 packages.
set -euo pipefail

packages=(
  g++ cmake ninja-build ccache
  libpcl-dev libeigen3-dev
  ocl-icd-opencl-dev opencl-clhpp-headers pocl-opencl-icd
  libboost-program-options-dev nlohmann-json3-dev libceres-dev
  libopenmpi-dev openmpi-bin libboost-mpi-dev libboost-serialization-dev
  pkg-config libcairo2-dev fonts-dejavu-core
  libgtest-dev libbenchmark-dev clang libclang-rt-dev
  python3-matplotlib python3-numpy
  python3-dev python3-pip python3-venv python3-pytest
  clang-format-14 doxygen
  help2man man-db
  dpkg-dev file lintian)

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query --show --showformat='${Status}' "$package" 2>/dev/null || true)
  [ "$status" = "install ok installed" ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

echo "missing: ${missing[*]}"
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "install these packages as root" >&2; exit 1; }
  as_root=(sudo)
fi
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=600)
"${apt[@]}" update
"${apt[@]}" install -y --no-install-recommends "${missing[@]}" </dev/null
