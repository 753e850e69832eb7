# shellcheck shell=sh
# The Test Anything Protocol for tests that are shell scripts. Sourced.
#
#   check WHAT COMMAND...     ok when the command succeeds
#   refuse WHAT COMMAND...    ok when the command fails
#   skip WHAT WHY             counts as skipped
#   finish                    ends the test
#
# What a command prints is shown only where its test fails.

tap_count=0
tap_folder=$(mktemp -d)
trap 'rm -rf "$tap_folder"' EXIT
trap 'exit 1' HUP INT TERM

report() {
    tap_count=$((tap_count + 1))
    printf '%s %d - %s\n' "$1" "$tap_count" "$2"
    [ "$1" = ok ] || sed 's/^/# /' "$tap_folder/output"
}

check() {
    what=$1
    shift
    if "$@" >"$tap_folder/output" 2>&1; then report ok "$what"; else report 'not ok' "$what"; fi
}

refuse() {
    what=$1
    shift
    if "$@" >"$tap_folder/output" 2>&1; then report 'not ok' "$what"; else report ok "$what"; fi
}

skip() {
    report ok "$1 # SKIP $2"
}

finish() {
    printf '1..%d\n' "$tap_count"
}
