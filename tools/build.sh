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
# Says so if a disk that a build writes to is full: the compiler's own words stand far above, or are missing.
look_at_disks() {
    local folder free
    for folder in "build/$preset" "${TMPDIR:-/tmp}"; do
        free=$(df --output=avail -m "$folder" 2>/dev/null | tail -1)
        [[ ${free:-9999} -ge 50 ]] || printf 'build: the disk of %s is full (%d MiB left)\n  remedy: %s\n' "$folder" "$free" \
            "free some space (a build without tests takes 1 GB, with tests 2 GB), and start again" >&2
    done
}

mkdir -p "build/$preset" || {
    printf 'build: the folder build/%s cannot be made\n  remedy: is this folder yours, and its disk not full?\n' "$preset" >&2
    exit 1
}
log=build/$preset/configure.log
if ! cmake --preset "$preset" "${options[@]}" >"$log" 2>&1; then
    cat "$log" >&2
    look_at_disks
    printf 'build: cmake could not configure the preset %s (the log above is in %s)\n' "$preset" "$log" >&2
    exit 1
fi
cmake --build "build/$preset" --target "${targets[@]}" -j "$(tools/jobs.sh)" || {
    status=$?
    look_at_disks
    exit "$status"
}
