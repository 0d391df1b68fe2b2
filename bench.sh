#!/usr/bin/env bash
# Sets up, builds and runs the benchmarks: ./bench.sh [NAME] [Google Benchmark flags]; without a name it lists them.
# Rows carry commit, compiler, CPU, world and number of robots; the same rows as JSON go to build/bench/NAME.json.
# ./bench.sh accuracy [options of roboss-accuracy] measures against closed forms and peers; without options it also
# writes docs/accuracy.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
tools/setup.sh build bench
if [[ ${1:-} == accuracy ]]; then
    shift
    tools/build.sh release -DROBOSS_BENCHMARKS=ON roboss-accuracy
    mkdir -p build/bench
    outputs=()
    [[ $# -gt 0 ]] || outputs=(--markdown docs/accuracy.md --picture docs/images/arm_energy.svg --json build/bench/accuracy.json)
    ROBOSS_COMMIT=$(git describe --always --dirty 2>/dev/null || printf 'unknown') \
        exec build/release/bin/roboss-accuracy "${outputs[@]}" "$@"
fi
tools/build.sh release -DROBOSS_BENCHMARKS=ON roboss-bench
mkdir -p build/bench
program=build/release/bin/roboss-bench
if [[ $# -eq 0 ]]; then
    printf 'benchmarks (./bench.sh NAME runs one, ./bench.sh all runs them all; ./bench.sh accuracy measures truth):\n'
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
