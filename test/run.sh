#!/usr/bin/env bash
# Installs what is missing, builds, and tests.
#   test/run.sh [-DVARIABLE=VALUE ...]                 everything, in build/
#   test/run.sh --preset NAME [-DVARIABLE=VALUE ...]   the fast tests, as a preset of
#                                                      CMakePresets.json has them
set -euo pipefail
cd "$(dirname "$0")/.."

cmake/install_dependencies.sh
if [ "${1:-}" = --preset ]; then
  preset=${2:?name a preset: release, debug, sanitize, tsan or fuzz}
  shift 2
  cmake --fresh --preset "$preset" "$@"
  cmake --build --preset "$preset"
  ctest --preset "$preset" --parallel 2
else
  cmake --fresh -S . -B build -G Ninja -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
    -DPCL_KSS_ICP_BUILD_BENCHMARKS=ON "$@"
  cmake --build build
  ctest --test-dir build --output-on-failure --no-tests=error
fi
