#!/usr/bin/env bash
# Sets up, builds and runs the benchmarks: ./bench.sh [NAME] [flags]; without a name it lists them.
# A name is a program of its own (peers, accuracy, table1, bus, ros2, viewer, learning, cameras_beside_mujoco, smallest), or a Google Benchmark of roboss-bench; flags go on to it.
# Rows carry commit, compiler, CPU, world and number of robots; the same rows as JSON go to build/bench/NAME.json.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
ROBOSS_COMMIT=$(git describe --always --dirty 2>/dev/null || printf 'unknown')
export ROBOSS_COMMIT
mkdir -p build/bench

# Builds the benchmark program given.
build() {
    tools/build.sh release -DROBOSS_BENCHMARKS=ON "$1"
}

# RoBOSS beside other engines. Only a whole run, without flags, changes docs/performance.md and its plot.
peers() {
    tools/setup.sh build bench peers
    tools/fetch_mujoco.sh
    tools/fetch_peers.sh
    build roboss-peers
    local rows=build/bench/peers.json
    build/release/bin/roboss-peers --check-engines  # a second: an adapter that means something else would spoil it all
    build/release/bin/roboss-peers --json "$rows" "$@"
    if [[ $# -eq 0 ]]; then
        tools/peers_report "$rows" --page docs/performance.md --plot docs/images/peers.svg
    else
        tools/peers_report "$rows" --plot build/bench/peers.svg
    fi
    printf 'rows as JSON: %s\n' "$rows"
}

# RoBOSS and other engines against motions whose truth is known. Only a whole run, without flags, changes
# docs/accuracy.md and its picture; its exit code tells whether RoBOSS keeps every bound.
accuracy() {
    tools/setup.sh build bench peers
    tools/fetch_mujoco.sh
    tools/fetch_peers.sh
    build roboss-accuracy
    local outputs=(--json build/bench/accuracy.json)
    [[ $# -gt 0 ]] || outputs+=(--markdown docs/accuracy.md --picture docs/images/arm_energy.svg)
    build/release/bin/roboss-accuracy "${outputs[@]}" "$@"
}

# One world on 1 to 12 Simulators: the paper's experiment. Only a whole run, without flags, changes
# docs/cluster-efficiency.md and its plot.
table1() {
    tools/setup.sh build bench peers
    tools/build.sh release -DROBOSS_BENCHMARKS=ON roboss-table1 roboss roboss-world roboss_city_driver
    local rows=build/bench/table1.json wall=build/bench/wall_clock.json driver=build/release/lib/roboss_city_driver.so
    build/release/bin/roboss-table1 --driver "$driver" --pile worlds/pile.sdf --json "$rows" "$@"
    if [[ $# -eq 0 ]]; then
        bench/cluster/wall_clock.py build/release/bin "$driver" "$wall"
        tools/table1_report "$rows" --wall "$wall" --page docs/cluster-efficiency.md --plot docs/images/table1.svg
    else
        tools/table1_report "$rows" --plot build/bench/table1.svg
    fi
    printf 'rows as JSON: %s\n' "$rows"
}

# The Bus over TLS by itself: round trips, joins, barriers, idle CPU time (docs/decisions/0042-the-cluster-over-tls.md).
bus() {
    tools/setup.sh build bench
    build roboss-bus
    build/release/bin/roboss-bus --json build/bench/bus.json "$@"
    printf 'rows as JSON: build/bench/bus.json\n'
}

# Fleets with a node of ROS 2 that drives them all: rates, CPU time, real-time factor (docs/ros2.md).
ros2() {
    tools/setup.sh build bench
    tools/build.sh release -DROBOSS_BENCHMARKS=ON roboss roboss_fastdds roboss-fleet-peer
    bench/ros2/scale.py build/release/bin build/bench/ros2.json "$@"
    printf 'rows as JSON: build/bench/ros2.json\n'
}

# What browsers cost a run of 2000 moving cars: bytes, CPU of the gateway, speed of the simulation (docs/viewer.md).
viewer() {
    tools/setup.sh build bench
    build roboss-viewer-cost
    build/release/bin/roboss-viewer-cost --json build/bench/viewer.json "$@"
    printf 'rows as JSON: build/bench/viewer.json\n'
}

# Agents of roboss.envs beside the same ones in MuJoCo, in Python: agent-steps a second. Only a whole run, without flags,
# changes docs/learning.md.
learning() {
    tools/build_wheel.sh
    build roboss-world
    local python
    python=$(tools/python_env.sh)
    local rows=build/bench/learning.json
    OPENBLAS_NUM_THREADS=1 "$python" -B bench/learning/learning.py --json "$rows" "$@"
    [[ $# -gt 0 ]] || "$python" -B tools/learning_report "$rows" --page docs/learning.md
    printf 'rows as JSON: %s\n' "$rows"
}

# Images of cameras beside MuJoCo's renderer with Mesa's software OpenGL (docs/sensors.md).
cameras_beside_mujoco() {
    tools/setup.sh build bench cameras
    build roboss-bench
    local venv=build/bench/osmesa rows=build/bench/cameras_beside_mujoco.json
    [[ -x $venv/bin/python ]] || python3 -m venv "$venv"
    "$venv/bin/python" -m pip install -q --disable-pip-version-check mujoco-core==4.0.1 numpy pillow pyopengl glfw
    "$venv/bin/python" -B bench/cameras/beside_mujoco.py --json "$rows" "$@"
    printf 'rows as JSON: %s\n' "$rows"
}

# Google Benchmarks whose names match.
google_benchmark() {
    tools/setup.sh build bench
    build roboss-bench
    local program=build/release/bin/roboss-bench
    if [[ $# -eq 0 ]]; then
        printf 'benchmarks (./bench.sh NAME runs one, ./bench.sh all runs all but these):\n'
        printf 'peers  (RoBOSS beside ODE, Bullet, MuJoCo, DART: about half an hour; --quick: two; --help)\n'
        printf 'accuracy  (RoBOSS and the same engines against known truths: some minutes; --list; --help)\n'
        printf 'table1  (one world on 1 to 12 Simulators, the paper'"'"'s experiment: about 20 minutes; --help)\n'
        printf 'bus  (messages and joins over TLS, processes of this computer: a minute; --help)\n'
        printf 'viewer  (what browsers cost a run of 2000 cars: a minute; --help)\n'
        printf 'learning  (agents in Python, beside MuJoCo: a quarter of an hour; --only 64: one; --help)\n'
        printf 'smallest  (all of them at their smallest sizes, only to see them end: some minutes)\n'
        printf 'cameras_beside_mujoco  (images beside its renderer with software OpenGL: some minutes; --help)\n'
        exec "$program" --benchmark_list_tests
    fi
    local name=$1
    local rows=build/bench/${name//\//_}.json filter=$name
    shift
    [[ $name != all ]] || filter=.
    "$program" --benchmark_filter="$filter" --benchmark_counters_tabular=true \
        --benchmark_out="$rows" --benchmark_out_format=json "$@"
    printf 'rows as JSON: %s\n' "$rows"
}

# All benchmarks at their smallest sizes, with all engines that are installed: do they come to their ends?
smallest() {
    tools/setup.sh build bench peers
    tools/fetch_mujoco.sh
    tools/fetch_peers.sh
    tools/build.sh release -DROBOSS_BENCHMARKS=ON roboss-peers roboss-accuracy roboss-table1 roboss-bus roboss-viewer-cost roboss-bench \
        roboss_city_driver
    bench/smallest.py build/release/bin "$@"
}

case ${1:-} in
    smallest | peers | accuracy | table1 | bus | ros2 | viewer | learning | cameras_beside_mujoco) "$@" ;;
    *) google_benchmark "$@" ;;
esac
