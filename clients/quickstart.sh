#!/bin/sh
# Installs the packages, builds sluice, runs the rising gate. Leaves out/rising_gate.h5 and out/rising_gate.png.
# Safe to repeat: what is installed and built already is kept, the run is done again.
set -eu
cd "$(dirname "$0")/.."
sh clients/install_packages.sh

cmake --preset release -DSLUICE_TESTS=OFF --log-level=WARNING
cmake --build --preset release --parallel "$(nproc)"

sluice=build/release/bin/sluice
mkdir -p out
"$sluice" run clients/scenes/rising_gate.scene -o out/rising_gate.h5 --force
"$sluice" plot out/rising_gate.h5 --times 0.012,0.036,0.056,0.068,0.084,0.096 -o out/rising_gate.png
echo "recording: out/rising_gate.h5"
echo "picture:   out/rising_gate.png"
