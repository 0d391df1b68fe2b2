#!/usr/bin/env bash
# Sets up, builds, and runs the tests: ./test.sh [ctest arguments, e.g. -R physics]. The checks of layers, sizes and
# format and the install test are tests like the others. Ends with "N passed, N failed".
# ./test.sh --browser runs all tests of the viewer's page, which take a quarter of an hour; without it a part of them runs.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
labels=(-LE browser)
if [[ ${1:-} == --browser ]]; then
    labels=(-L browser)
    shift
fi
tools/setup.sh build test python
tools/build.sh release -DROBOSS_TESTS=ON
results=$PWD/build/release/test_results.xml
rm -f "$results"
status=0
jobs=$(($(tools/jobs.sh) + 1))  # tests of processes, devices and the page wait more than they compute
ctest --test-dir build/release --output-on-failure --no-tests=error -j "$jobs" --output-junit "$results" "${labels[@]}" "$@" || status=$?
tools/count_tests.sh "$results"
exit "$status"
