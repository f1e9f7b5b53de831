#!/usr/bin/env bash
# Installs what is missing, builds, and tests.
#   test/run.sh [-DVARIABLE=VALUE ...]        everything, in build/, warnings being errors
#   test/run.sh --preset NAME [--short] [-DVARIABLE=VALUE ...]
#       the fast tests, as a preset of CMakePresets.json has them; --short: without those
#       that take minutes under sanitizers
set -euo pipefail
cd "$(dirname "$0")/.."

# the Python package has the same objects: compiled once
export CCACHE_BASEDIR=${CCACHE_BASEDIR-$PWD} CCACHE_NOHASHDIR=1

cmake/install_dependencies.sh
if [ "${1:-}" = --preset ]; then
  preset=${2:?name a preset: release, debug, sanitize, tsan or fuzz}
  shift 2
  targets=fast_tests without=()
  if [ "${1:-}" = --short ]; then
    targets=short_tests without=(--label-exclude long)
    shift
  fi
  cmake --fresh --preset "$preset" "$@"
  cmake --build --preset "$preset" --target "$targets"
  ctest --preset "$preset" --parallel 2 "${without[@]}"
else
  cmake --fresh -S . -B build -G Ninja -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
    -DPCL_KSS_ICP_BUILD_BENCHMARKS=ON -DCMAKE_COMPILE_WARNING_AS_ERROR=ON "$@"
  ctest --test-dir build --output-on-failure --no-tests=error -L text # in a second
  cmake --build build --target all docs
  ctest --test-dir build --output-on-failure --no-tests=error
fi
