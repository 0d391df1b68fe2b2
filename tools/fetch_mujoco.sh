#!/usr/bin/env bash
# Fetches MuJoCo's current release for the benchmarks: its C headers and library go to build/mujoco. The release is
# pinned and checked by its hash. Where there is no network, or another processor, the benchmarks take Debian's
# libmujoco instead; then this says so and ends with 0.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

version=4.0.1
python=3.11
platform=manylinux_2_28_x86_64
file=mujoco_core-$version-cp311-cp311-manylinux_2_27_x86_64.$platform.whl
hash=be28c0c7587347ef996b4de0487264e9da296282082b092bae211a9163e9aed6
to=build/mujoco

keep_debian() {
    printf 'fetch_mujoco: %s; the benchmarks take the MuJoCo of Debian\n' "$1" >&2
    rm -rf "$to"
    exit 0
}

[[ $(cat "$to/version" 2>/dev/null) != "$version" ]] || exit 0
[[ $(uname -m) == x86_64 ]] || keep_debian "release $version is pinned for x86_64 only"
rm -rf "$to"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m pip download -q --disable-pip-version-check --no-deps --only-binary=:all: --python-version "$python" \
    --platform "$platform" -d "$work" "mujoco-core==$version" || keep_debian "could not download release $version"
printf '%s  %s\n' "$hash" "$work/$file" | sha256sum -c --quiet - || keep_debian "release $version has another hash"
python3 -m zipfile -e "$work/$file" "$work/all"
mkdir -p "$to/lib"
cp -r "$work/all/mujoco/include" "$to/include"
cp "$work/all/mujoco/libmujoco.so.$version" "$to/lib/"
ln -s "libmujoco.so.$version" "$to/lib/libmujoco.so"
printf '%s\n' "$version" >"$to/version"
printf 'fetch_mujoco: MuJoCo %s is in %s\n' "$version" "$to"
