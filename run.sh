#!/usr/bin/env bash
# Sets up, builds, and drives the city: fifty cars for 60 s of simulated time. Arguments go on to `roboss run`,
# e.g. ./run.sh --simulators 4 --threads 2. Ends with the summary and a picture of where the cars drove.
# ./run.sh --live: the same in real time until Ctrl-C, to be watched, steered and rewound in a browser; it says where.
# Its journal keeps the last 10 min (another --journal-keep changes that).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
tools/setup.sh build
# A folder that ./test.sh configured keeps its tests; a fresh one does without them.
if [[ -f build/release/CMakeCache.txt ]]; then
    tools/build.sh release roboss roboss-world roboss_city_driver web
else
    tools/build.sh release -DROBOSS_TESTS=OFF roboss roboss-world roboss_city_driver web
fi

city=(build/release/bin/roboss run worlds/city.sdf --client build/release/lib/roboss_city_driver.so)
if [[ ${1:-} == --live ]]; then
    shift
    rm -f build/city.journal build/city.journal-*
    exec "${city[@]}" --journal build/city.journal --journal-keep 10min "$@"
fi

# Ours, unless the same option was given.
options=()
default() { [[ " $given " == *" $1 "* || " $given " == *" $1="* ]] || options+=("$1" "$2"); }
given=$*
default --duration 60
default --speed max
default --json build/city.json
default --picture build/city_paths.svg
"${city[@]}" "${options[@]}" "$@"
[[ " $given " == *" --picture"* ]] || printf 'picture of the paths: build/city_paths.svg\n'
