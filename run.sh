#!/usr/bin/env bash
# Sets up, builds, and drives the city: fifty cars for 60 s of simulated time. Arguments go on to `roboss run`, after
# ours, e.g. ./run.sh --simulators 4 --threads 2. Ends with the summary and a picture of where the cars drove.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
tools/setup.sh build
# A folder that ./test.sh configured keeps its tests; a fresh one does without them.
if [[ -f build/release/CMakeCache.txt ]]; then
    tools/build.sh release
else
    tools/build.sh release -DROBOSS_TESTS=OFF
fi
build/release/bin/roboss run worlds/city.sdf --client build/release/lib/libcity_driver.so --duration 60 \
    --trace build/city_trace.csv --trace-every 0.25 --json build/city.json "$@"
tools/draw_paths build/city_trace.csv --world worlds/city.sdf --out build/city_paths.svg
printf 'picture of the paths: build/city_paths.svg\n'
