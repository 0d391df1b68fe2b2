#!/usr/bin/env bash
# Tries each file of dist/ (tools/release.sh) in bare roots of Debian, with nothing installed but what it says it needs:
#   tools/try_release.sh [bookworm|trixie ...]    default: both
# In each: the city with its control program, the viewer's page, a cluster of three processes; the hash is that of this
# computer. Then, with a compiler, a control program against the headers of the archive and the .deb. Needs root. The
# .deb is for Debian 12, where its dependencies are.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
releases=("$@")
[[ $# -gt 0 ]] || releases=(bookworm trixie)
expected=$(mktemp)
trap 'rm -f "$expected"' EXIT
build/release/bin/roboss run example:city --headless --duration 5 --speed max --quiet --json "$expected" >/dev/null
hash=$(sed -n 's/.*"state_hash": "\(.*\)".*/\1/p' "$expected")
passed=0 failed=0

# try NAME ROOT COMMAND CHECKS: the command, in a copy of dist/, and then the checks with the `roboss` it made.
try() {
    local name=$1 root=$2 command=$3 checks=$4
    if tools/bare_root.sh "$release" "$root" bash -c "set -e; cd /root/dist; $command; $checks" >"$root.log" 2>&1; then
        passed=$((passed + 1))
        printf 'ok    %-9s %s\n' "$release" "$name"
    else
        failed=$((failed + 1))
        printf 'WRONG %-9s %s: the log is %s, its last lines:\n' "$release" "$name" "$root.log"
        tail -5 "$root.log"
    fi
}

# Checks in the root, with `roboss` in the PATH.
checks='
cd /tmp
roboss --version
roboss examples >/dev/null
for options in "" "--processes 3"; do
    roboss run example:city --headless --duration 5 --speed max --quiet --json city.json $options
    grep -q "\"state_hash\": \"'$hash'\"" city.json
done
roboss run example:city --view 8123 --duration 5 --stay >page.log 2>&1 & run=$!
for try in $(seq 100); do sleep .2; grep -q http page.log && break; done
exec 3<>/dev/tcp/127.0.0.1/8123; printf "GET / HTTP/1.0\r\n\r\n" >&3; grep -q "<html" <&3
kill $run; wait $run || true
'
# The project of `roboss new-client`, built against the folder that has this `roboss`, drives its rover.
build_client='
/root/roboss/tools/setup.sh build >/dev/null
cd /tmp; rm -rf my_driver; roboss new-client my_driver
cmake -S my_driver -B my_driver/build -G Ninja -DCMAKE_PREFIX_PATH=$(dirname $(dirname $(command -v roboss)))
cmake --build my_driver/build
roboss run my_driver/world.sdf --client my_driver/build/my_driver.so --duration 5 --headless --speed max --strict
'
archive='PATH=$(echo /opt/roboss-*/bin):$PATH'
for release in "${releases[@]}"; do
    root=${TMPDIR:-/var/tmp}/roboss_release_$release
    rm -rf --one-file-system "$root"
    tools/bare_root.sh "$release" "$root" >/dev/null
    rm -rf "$root/root/dist"
    cp -r dist "$root/root/dist"
    try archive "$root" 'apt-get update -q; apt-get install -q -y --no-install-recommends xz-utils; tar xf roboss-*.tar.xz -C /opt; '"$archive" "$checks"
    if [[ $release == bookworm ]]; then
        try deb "$root" 'apt-get update -q; apt-get install -q -y --no-install-recommends ./roboss_*.deb' "$checks"
        tools/bare_root.sh "$release" "$root" apt-get remove -q -y roboss >/dev/null
    fi
    wheel=cp311  # of Python 3.11, which Debian 12 has; later releases take the one for all later Pythons
    [[ $release == bookworm ]] || wheel=abi3
    try wheel "$root" 'apt-get update -q; apt-get install -q -y --no-install-recommends python3-venv; python3 -m venv /opt/venv; /opt/venv/bin/pip install -q roboss-*-'$wheel'-*.whl; PATH=/opt/venv/bin:$PATH; python -c "import roboss; s = roboss.Simulation(roboss.example(\"pile.sdf\")); s.step(10); print(s.state_hash)"' "$checks"
    # Last, for it installs a compiler, and with it much else.
    try "archive: control program" "$root" "$archive" "$build_client"
    [[ $release != bookworm ]] || try "deb: control program" "$root" 'apt-get install -q -y --no-install-recommends ./roboss_*.deb' \
        "$build_client"
    rm -rf --one-file-system "$root"
done
printf 'try_release: %d passed, %d failed\n' "$passed" "$failed"
[[ $failed -eq 0 ]]
