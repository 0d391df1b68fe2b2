#!/usr/bin/env bash
# Tries each file of dist/ (tools/release.sh) in bare roots of Debian, with nothing installed but what it says it needs:
#   tools/try_release.sh [bookworm|trixie[-arm64] ...]    default: bookworm trixie
# In each: the city with its control program, the viewer's page, a cluster of three processes, a run with the commands of
# a bag of ROS 2, whose hashes are those of this computer; a run with nodes for ROS 2 and a server for Foxglove. Then,
# with a compiler, a control program against the headers of the archive and the .deb. Needs root. The .deb is for
# Debian 12, where its dependencies are; without Fast DDS, which it only recommends, it says what to install.
# bookworm-arm64: the files for aarch64, in a root of that processor (tools/bare_root.sh).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
releases=("$@")
[[ $# -gt 0 ]] || releases=(bookworm trixie)
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
passed=0 failed=0

# hash_of WORDS...: the state hash of a run on this computer.
hash_of() {
    build/release/bin/roboss run "$@" --headless --speed max --quiet --json "$work/summary.json" >/dev/null
    sed -n 's/.*"state_hash": "\(.*\)".*/\1/p' "$work/summary.json"
}
# A bag with commands in chunks of both kinds.
"$(tools/python_env.sh)" - "$work/drive" <<'END'
import struct, sys
from pathlib import Path
from mcap.writer import CompressionType, Writer
folder = Path(sys.argv[1])
folder.mkdir()
for number, packing in enumerate((CompressionType.ZSTD, CompressionType.LZ4)):
    with (folder / f"drive_{number}.mcap").open("wb") as file:
        writer = Writer(file, compression=packing)
        writer.start(profile="ros2")
        twist = writer.register_schema("geometry_msgs/msg/Twist", "ros2msg", b"Vector3 linear")
        topic = writer.register_channel(f"/turtle_{number}/cmd_vel", "cdr", twist)
        message = b"\0\1\0\0" + struct.pack("<6d", 0.2, 0, 0, 0, 0, 0.5)
        for time in (0, 10**9):
            writer.add_message(topic, time, message, time)
        writer.finish()
END
city=(example:city --duration 5)
drive=(example:fleet --until 2 --orders)
city_hash=$(hash_of "${city[@]}") drive_hash=$(hash_of "${drive[@]}" "$work/drive")
cat >"$work/bridge.yaml" <<'END'
- {ros_topic_name: /scan, gz_topic_name: /world/fleet/model/turtle_0/link/base_link/sensor/lidar/scan,
   ros_type_name: sensor_msgs/msg/LaserScan, gz_type_name: gz.msgs.LaserScan, direction: GZ_TO_ROS}
END

# try NAME ROOT COMMAND CHECKS: the command, in a copy of dist/, and then the checks with the `roboss` it made.
try() {
    local name=$1 root=$2 command=$3 checks=$4
    if tools/bare_root.sh "$release" "$root" bash -c "set -e; face_s=$face_s; cd /root/dist; $command; $checks" >"$root.log" 2>&1; then
        passed=$((passed + 1))
        printf 'ok    %-14s %s\n' "$release" "$name"
    else
        failed=$((failed + 1))
        printf 'WRONG %-14s %s: the log is %s, its last lines:\n' "$release" "$name" "$root.log"
        tail -5 "$root.log"
    fi
}

# Checks in the root, with `roboss` in the PATH.
checks='
cd /tmp
roboss --version
roboss examples >/dev/null
for options in "" "--processes 3"; do
    roboss run '"${city[*]}"' --headless --speed max --quiet --json city.json $options
    grep -q "\"state_hash\": \"'$city_hash'\"" city.json
done
roboss run '"${drive[*]}"' /root/drive --headless --speed max --quiet --json drive.json
grep -q "\"state_hash\": \"'$drive_hash'\"" drive.json
roboss run example:city --view 8123 --duration 5 --stay >page.log 2>&1 & run=$!
for try in $(seq 100); do sleep .2; grep -q http page.log && break; done
exec 3<>/dev/tcp/127.0.0.1/8123; printf "GET / HTTP/1.0\r\n\r\n" >&3; grep -q "<html" <&3
kill $run; wait $run || true
'
# Both faces, which join the run when they serve.
faces='
roboss run example:fleet --ros2 --ros2-bridge /root/bridge.yaml --foxglove --foxglove-bridge /root/bridge.yaml --headless \
    --duration $face_s >faces.log 2>&1
for face in ros2 foxglove; do grep "client .$face. joined" faces.log; done
'
no_face='
! roboss run example:fleet --ros2 --headless --duration 10 >faces.log 2>&1
grep "apt install libfastrtps" faces.log
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
    processor=$(uname -m) architecture=$(dpkg --print-architecture)
    face_s=10  # within which faces join
    [[ $release != *-arm64 ]] || processor=aarch64 architecture=arm64 face_s=60
    root=${TMPDIR:-/var/tmp}/roboss_release_$release
    rm -rf --one-file-system "$root"
    tools/bare_root.sh "$release" "$root" >/dev/null
    rm -rf "$root/root/dist"
    cp -r dist "$root/root/dist"
    cp -r "$work/drive" "$work/bridge.yaml" "$root/root"
    try archive "$root" 'apt-get update -q; apt-get install -q -y --no-install-recommends xz-utils; tar xf roboss-*-'$processor'.tar.xz -C /opt; '"$archive" "$checks$faces"
    deb='apt-get update -q; apt-get install -q -y --no-install-recommends ./roboss_*_'$architecture.deb
    if [[ $release == bookworm* ]]; then
        try deb "$root" "$deb" "$checks$no_face"
        try "deb: nodes of ROS 2" "$root" "$(sed -n 's/^run \(libfastrtps[^ ]*\) .*/apt-get install -q -y --no-install-recommends \1/p' tools/packages.txt)" "$faces"
        tools/bare_root.sh "$release" "$root" apt-get remove -q -y roboss >/dev/null
    fi
    wheel=cp311  # of Python 3.11, which Debian 12 has; later releases take the one for all later Pythons
    [[ $release == bookworm* ]] || wheel=abi3
    try wheel "$root" 'apt-get update -q; apt-get install -q -y --no-install-recommends python3-venv; python3 -m venv /opt/venv; /opt/venv/bin/pip install -q roboss-*-'$wheel-*_$processor'.whl; PATH=/opt/venv/bin:$PATH; python -c "import roboss; s = roboss.Simulation(roboss.example(\"pile.sdf\")); s.step(10); print(s.state_hash)"' "$checks$faces"
    # Last, for it installs a compiler, and with it much else.
    try "archive: control program" "$root" "$archive" "$build_client"
    [[ $release != bookworm* ]] || try "deb: control program" "$root" "$deb" "$build_client"
    rm -rf --one-file-system "$root"
done
printf 'try_release: %d passed, %d failed\n' "$passed" "$failed"
[[ $failed -eq 0 ]]
