#!/usr/bin/env bash
# Prints "N passed, N failed[, N skipped]" from ctest's JUnit file.
set -euo pipefail
[[ -f $1 ]] || {
    printf '0 passed, 1 failed\n'
    exit 1
}
count() { grep -c "<testcase .* status=\"$1\"" "$2" || true; }
passed=$(count run "$1")
failed=$(count fail "$1")
skipped=$(($(count notrun "$1") + $(count disabled "$1")))
line="$passed passed, $failed failed"
[[ $skipped -eq 0 ]] || line+=", $skipped skipped"
printf '%s\n' "$line"
