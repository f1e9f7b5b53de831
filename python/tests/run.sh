#!/usr/bin/env bash
# Builds the wheel, installs it in a fresh environment, and tests it there.
#   python/tests/run.sh FOLDER [PYTHON]      FOLDER: for wheel and environments
# Exits with 77 where what that needs cannot be had.
set -euo pipefail
project=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$1"
folder=$(cd "$1" && pwd)
python=${2:-/usr/bin/python3}

skip() {
  echo "skipped: $1"
  exit 77
}

pip() {
  "$1/bin/python" -m pip --quiet --disable-pip-version-check "${@:2}"
}

"$python" -c 'import ensurepip, pytest' ||
  skip "python3-venv or python3-pytest is not installed"
rm -rf "$folder/wheels" "$folder/tested"
[ -x "$folder/builder/bin/python" ] || "$python" -m venv "$folder/builder"
pip "$folder/builder" install scikit-build-core pybind11 ||
  skip "PyPI, which has what builds the wheel, cannot be reached"

# warnings are errors, and the objects those of the library, by ccache: it goes by names, so
# the compiler is called what CMake calls it, not what Python was built with
export CC=${CC-cc} CXX=${CXX-c++} CMAKE_CXX_COMPILER_LAUNCHER
CMAKE_CXX_COMPILER_LAUNCHER=$(command -v ccache || true)
export CCACHE_BASEDIR=${CCACHE_BASEDIR-$project} CCACHE_NOHASHDIR=1
pip "$folder/builder" wheel --no-deps --no-build-isolation --check-build-dependencies \
  --config-settings=cmake.define.CMAKE_COMPILE_WARNING_AS_ERROR=ON \
  --wheel-dir "$folder/wheels" "$project"

"$python" -m venv --system-site-packages "$folder/tested"
pip "$folder/tested" install --no-deps --no-index "$folder"/wheels/*.whl
pip "$folder/tested" install 'laspy[lazrs]' pye57 trimesh mypy ||
  echo "without the libraries that read files: their tests are skipped"
cd "$folder"
exec "$folder/tested/bin/python" -m pytest -q -p no:cacheprovider -rs "$project/python/tests"
