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
build/release/bin/roboss run worlds/city.sdf --client build/release/lib/roboss_city_driver.so --duration 60 \
    --json build/city.json --picture build/city_paths.svg "$@"
printf 'picture of the paths: build/city_paths.svg\n'
