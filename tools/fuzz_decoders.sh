#!/usr/bin/env bash
# Feeds every decoder (messages, frames, Models, scenes, journals, bags, worlds, meshes, pictures, ROS 2, Foxglove) with changed bytes
# under the address and undefined-behaviour sanitizers: `tools/fuzz_decoders.sh [ROUNDS]`, 100000 if not said. It builds only the
# test programs that it needs (build/fuzz). An input that ends a process is kept in build/fuzz: docs/testing.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export ROBOSS_FUZZ_ROUNDS=${1:-100000}
export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_leaks=1:strict_string_checks=1:abort_on_error=1:max_allocation_size_mb=2048}
export UBSAN_OPTIONS=${UBSAN_OPTIONS:-print_stacktrace=1:abort_on_error=1}
exec tools/sanitize.sh fuzz roboss_wire_test roboss_net_test roboss_scene_test roboss_journal_test roboss_bags_test \
    roboss_decoders_test \
    -- -R 'Codec|Frames|Strangers|LogEntries|JournalBytes|BagBytes|^decoders\.' --timeout 36000
