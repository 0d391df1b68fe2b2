#!/usr/bin/env bash
# Sets up, builds, and runs all tests: ./test.sh [ctest arguments, e.g. -R physics]. The checks of layers, sizes and
# format and the install test are tests like the others. Ends with "N passed, N failed".
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
tools/setup.sh build test
tools/build.sh release -DROBOSS_TESTS=ON
results=$PWD/build/release/test_results.xml
rm -f "$results"
status=0
ctest --test-dir build/release --output-on-failure --no-tests=error -j "$(tools/jobs.sh)" --output-junit "$results" "$@" || status=$?
tools/count_tests.sh "$results"
exit "$status"
