#!/usr/bin/env bash
# Configures and builds one preset: `tools/build.sh PRESET [-DNAME=VALUE ...] [TARGET ...]`. Everything lands in
# build/PRESET. Says where the log is when the build fails, and prints only the compiler's own words.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${1:?usage: tools/build.sh PRESET [-DNAME=VALUE ...] [TARGET ...]}
shift
options=() targets=()
for argument in "$@"; do
    if [[ $argument == -D* ]]; then options+=("$argument"); else targets+=("$argument"); fi
done
[[ ${#targets[@]} -gt 0 ]] || targets=(all)

# A build folder that was moved or copied from elsewhere knows other paths: start it afresh.
cache=build/$preset/CMakeCache.txt
if [[ -f $cache ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD" "$cache"; then
    printf 'build: build/%s belongs to another folder, starting it afresh\n' "$preset"
    rm -rf "build/$preset"
fi
mkdir -p "build/$preset"
log=build/$preset/configure.log
if ! cmake --preset "$preset" "${options[@]}" >"$log" 2>&1; then
    cat "$log" >&2
    printf 'build: cmake could not configure the preset %s (the log above is in %s)\n' "$preset" "$log" >&2
    exit 1
fi
cmake --build "build/$preset" --target "${targets[@]}" -j "$(tools/jobs.sh)"
