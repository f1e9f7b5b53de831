#!/usr/bin/env bash
# Installs what is missing, builds everything in build/, and runs all tests.
#   test/run.sh [-DVARIABLE=VALUE ...]
set -euo pipefail
cd "$(dirname "$0")/.."

cmake/install_dependencies.sh
cmake --fresh -S . -B build -G Ninja -DCMAKE_CXX_COMPILER_LAUNCHER=ccache \
  -DPCL_KSS_ICP_BUILD_BENCHMARKS=ON "$@"
cmake --build build
ctest --test-dir build --output-on-failure --no-tests=error
