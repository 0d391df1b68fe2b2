#!/usr/bin/env bash
# Runs the tests under sanitizers: `tools/sanitize.sh [asan|ubsan|tsan|fuzz ...] [TARGET ...] [-- ctest arguments]`, each in
# a build folder of its own. Without a name: asan, ubsan, tsan; fuzz is asan and ubsan in one build. With targets only
# these are built, so choose their tests with -R. tsan finds data races; run it over what has threads, e.g. `tsan -- -R pool`.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
presets=() targets=()
while [[ $# -gt 0 && $1 != -- ]]; do
    case $1 in
        asan | ubsan | tsan | fuzz) presets+=("$1") ;;
        *) targets+=("$1") ;;
    esac
    shift
done
[[ $# -eq 0 ]] || shift
[[ ${#presets[@]} -gt 0 ]] || presets=(asan ubsan tsan)
tools/setup.sh build test
# Libraries of the system are not instrumented: what they keep to their end is not ours to free.
export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_leaks=1:strict_string_checks=1}
export LSAN_OPTIONS=${LSAN_OPTIONS:-suppressions=$PWD/tools/lsan.supp:print_suppressions=0}
export UBSAN_OPTIONS=${UBSAN_OPTIONS:-print_stacktrace=1}
export TSAN_OPTIONS=${TSAN_OPTIONS:-suppressions=$PWD/tools/tsan.supp:history_size=7}
failed=()
for preset in "${presets[@]}"; do
    tools/build.sh "$preset" "${targets[@]}"
    # The checks of the source and of the installation need no second run.
    ctest --test-dir "build/$preset" --output-on-failure --no-tests=error -j "$(tools/jobs.sh)" \
        -E '^(source|tools|install)\.' "$@" || failed+=("$preset")
done
printf 'sanitizers: %d passed, %d failed%s\n' "$((${#presets[@]} - ${#failed[@]}))" "${#failed[@]}" "${failed:+ (${failed[*]})}"
[[ ${#failed[@]} -eq 0 ]]
