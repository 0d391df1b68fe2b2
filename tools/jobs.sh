#!/usr/bin/env bash
# Prints how many compilers to run at a time: one a core, but no more than the free memory holds (several files
# compiled as one take up to 1.5 GB). ROBOSS_JOBS overrides.
set -euo pipefail
cores=$(nproc)
free_kib=$(awk '/^MemAvailable:/ {print $2}' /proc/meminfo)
by_memory=$((${free_kib:-1572864} / 1572864))
jobs=$((cores < by_memory ? cores : by_memory))
printf '%s\n' "${ROBOSS_JOBS:-$((jobs > 1 ? jobs : 1))}"
