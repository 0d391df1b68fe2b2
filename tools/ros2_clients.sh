#!/usr/bin/env bash
# Makes environments with clients of ROS 2 that nobody here wrote, from PyPI: DIR/kilted and DIR/jazzy with rclpy,
# DIR/cyclone with Cyclone DDS. The versions stand in tests/ros2/clients. Nothing happens where they are up to date.
#   tools/ros2_clients.sh DIR        needs 550 MB there, and Python 3.11 to 3.13 (PYTHON names another program)
#   tools/ros2_clients.sh DIR rust   makes DIR/rust alone: a node of ros2-client (tests/ros2/rust_client); needs 450 MB,
#                                    cargo of Rust 1.88 or later (Debian: cargo-web), and five minutes of a core
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
[[ $# -eq 1 || ($# -eq 2 && $2 == rust) ]] || { printf 'usage: tools/ros2_clients.sh DIR [rust]\n' >&2; exit 2; }
# rclpy has wheels for these; fits PROGRAM: it is one of them.
versions=(3.13 3.12 3.11)
fits() { [[ " ${versions[*]} " == *" $("$1" -c 'import sys; print("%d.%d" % sys.version_info[:2])' 2>/dev/null || true) "* ]]; }

fail() {
    printf 'ros2_clients: %s\n  remedy: %s\n' "$1" "$2" >&2
    exit 1
}

if [[ ${2:-} == rust ]]; then
    command -v cargo >/dev/null || fail "there is no cargo" "apt install cargo-web rustc-web"
    cargo build --quiet --release --locked --manifest-path "$here/tests/ros2/rust_client/Cargo.toml" --target-dir "$1/rust" ||
        fail "the node of ros2-client could not be built (cargo's message is above)" "no network, or a Rust before 1.88?"
    touch "$1/rust/stamp"
    exit
fi

for python in "${PYTHON:-python3}" "${versions[@]/#/python}"; do
    if fits "$python"; then break; fi
done
fits "$python" || fail "there is no Python of the versions ${versions[*]}, for which rclpy has wheels" "PYTHON=... names one"
mkdir -p "$1"
exec 9>"$1/lock"
flock 9  # another start may be making them
for name in kilted jazzy cyclone; do
    packages=$here/tests/ros2/clients/$name.txt venv=$1/$name
    cmp -s "$packages" "$venv/stamp" && continue
    rm -rf "$venv"
    "$python" -m venv "$venv" || fail "$python cannot make an environment" "apt install python3-venv"
    "$venv/bin/python" -m pip install --quiet --disable-pip-version-check --no-deps -r "$packages" ||
        fail "pip could not install the packages of $packages (its message is above)" "no network, or a full disk?"
    cp "$packages" "$venv/stamp"
done
