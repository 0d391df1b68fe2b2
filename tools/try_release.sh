#!/usr/bin/env bash
# Tries each file of dist/ (tools/release.sh) in bare roots of Debian, with nothing installed but what it says it needs:
#   tools/try_release.sh [bookworm|trixie ...]    default: both
# In each: the city with its control program, the viewer's page, a cluster of three processes; the hash is that of this
# computer. Needs root. The .deb is for Debian 12, where its dependencies are.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
releases=("$@")
[[ $# -gt 0 ]] || releases=(bookworm trixie)
expected=$(mktemp)
trap 'rm -f "$expected"' EXIT
build/release/bin/roboss run example:city --headless --duration 5 --speed max --quiet --json "$expected" >/dev/null
hash=$(sed -n 's/.*"state_hash": "\(.*\)".*/\1/p' "$expected")
passed=0 failed=0

# try NAME ROOT COMMAND: the command, in a copy of dist/, and then the same checks with the `roboss` it made.
try() {
    local name=$1 root=$2 command=$3
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
for release in "${releases[@]}"; do
    root=${TMPDIR:-/var/tmp}/roboss_release_$release
    rm -rf --one-file-system "$root"
    tools/bare_root.sh "$release" "$root" >/dev/null
    rm -rf "$root/root/dist"
    cp -r dist "$root/root/dist"
    try archive "$root" 'apt-get update -q; apt-get install -q -y --no-install-recommends xz-utils; tar xf roboss-*.tar.xz -C /opt; PATH=$(echo /opt/roboss-*/bin):$PATH'
    if [[ $release == bookworm ]]; then
        try deb "$root" 'apt-get update -q; apt-get install -q -y --no-install-recommends ./roboss_*.deb'
        tools/bare_root.sh "$release" "$root" apt-get remove -q -y roboss >/dev/null
    fi
    # The wheel is for the Python that it was made with; an abi3 wheel also for later ones.
    [[ $release == bookworm ]] || compgen -G 'dist/*abi3*.whl' >/dev/null || { rm -rf --one-file-system "$root"; continue; }
    try wheel "$root" 'apt-get update -q; apt-get install -q -y --no-install-recommends python3-venv; python3 -m venv /opt/venv; /opt/venv/bin/pip install -q roboss-*.whl; PATH=/opt/venv/bin:$PATH; python -c "import roboss; s = roboss.Simulation(roboss.example(\"pile.sdf\")); s.step(10); print(s.state_hash)"'
    rm -rf --one-file-system "$root"
done
printf 'try_release: %d passed, %d failed\n' "$passed" "$failed"
[[ $failed -eq 0 ]]
