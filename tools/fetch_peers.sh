#!/usr/bin/env bash
# Fetches and builds Box3D and Rapier for the benchmarks: build/peers/box3d has headers and library, build/peers/rapier the
# library of our crate (bench/engines/rapier). Releases are pinned: Box3D by the hash of the source package that carries
# it, Rapier by Cargo.lock. Where one cannot be had, the benchmarks leave it out; then this says so and ends with 0.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
to=$PWD/build/peers
mkdir -p "$to"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

leave_out() {
    printf 'fetch_peers: %s; the benchmarks leave it out\n' "$1" >&2
    return 0
}

# Box3D: its C sources are in the source package of robox3d.
box3d() {
    local version=0.1.0 hash=b63b0a53857a80693415c1c1b3c9211209b9bfaa7758a01132114e4248b6dfc9
    local file=robox3d-$version.tar.gz sources=$work/robox3d-$version/external/box3d
    [[ $(cat "$to/box3d/version" 2>/dev/null) != "robox3d $version" ]] || return 0
    rm -rf "$to/box3d"
    python3 -m pip download -q --disable-pip-version-check --no-deps --no-binary=robox3d -d "$work" \
        "robox3d==$version" || { leave_out "could not download robox3d $version, which carries Box3D"; return; }
    printf '%s  %s\n' "$hash" "$work/$file" | sha256sum -c --quiet - ||
        { leave_out "robox3d $version has another hash"; return; }
    tar -xzf "$work/$file" -C "$work"
    cmake -S "$sources" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF -DBOX3D_SAMPLES=OFF \
        -DBOX3D_UNIT_TESTS=OFF -DBOX3D_VALIDATE=OFF >"$to/box3d.log" 2>&1 &&
        cmake --build "$work/build" -j "$(tools/jobs.sh)" --target box3d >>"$to/box3d.log" 2>&1 ||
        { leave_out "could not build Box3D ($to/box3d.log)"; return; }
    mkdir -p "$to/box3d/lib"
    cp -r "$sources/include" "$to/box3d/include"
    cp "$(find "$work/build" -name 'libbox3d*.a' | head -1)" "$to/box3d/lib/libbox3d.a"
    printf 'robox3d %s\n' "$version" >"$to/box3d/version"
}

rapier() {
    local crate=bench/engines/rapier version
    version=$(sed -nE 's/^rapier3d-f64 = "=(.*)"/\1/p' "$crate/Cargo.toml")
    command -v cargo >/dev/null || { leave_out "Rapier needs cargo (Debian: cargo-web)"; return; }
    cargo build --quiet --release --locked --manifest-path "$crate/Cargo.toml" --target-dir "$to/rapier/target" \
        -j "$(tools/jobs.sh)" || { leave_out "could not build Rapier $version"; return; }
    cp "$to/rapier/target/release/libroboss_bench_rapier.a" "$to/rapier/"
    printf '%s\n' "$version" >"$to/rapier/version"
}

box3d
rapier
