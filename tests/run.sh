#!/bin/sh
# Installs the packages, builds sluice with its tests, runs them. Safe to repeat.
set -eu
cd "$(dirname "$0")/.."
sh clients/install_packages.sh

cmake --preset release -DSLUICE_TESTS=ON --log-level=WARNING
cmake --build --preset release --parallel "$(nproc)"
exec ctest --preset release --output-on-failure -j2
