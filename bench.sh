#!/usr/bin/env bash
# Sets up, builds and runs the benchmarks: ./bench.sh [NAME] [Google Benchmark flags]; without a name it lists them.
# Rows carry commit, compiler, CPU, world and number of robots; the same rows as JSON go to build/bench/NAME.json.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
tools/setup.sh build bench
tools/build.sh release -DROBOSS_BENCHMARKS=ON roboss-bench
mkdir -p build/bench
program=build/release/bin/roboss-bench
if [[ $# -eq 0 ]]; then
    printf 'benchmarks (./bench.sh NAME runs one, ./bench.sh all runs them all):\n'
    exec "$program" --benchmark_list_tests
fi
name=$1
rows=build/bench/${name//\//_}.json
shift
filter=$name
[[ $name != all ]] || filter=.
ROBOSS_COMMIT=$(git describe --always --dirty 2>/dev/null || printf 'unknown') \
    "$program" --benchmark_filter="$filter" --benchmark_counters_tabular=true \
    --benchmark_out="$rows" --benchmark_out_format=json "$@"
printf 'rows as JSON: %s\n' "$rows"
