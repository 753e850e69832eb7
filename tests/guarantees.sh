#!/bin/sh
# Every promise of doc/guarantees.md names what holds it: a test that the build files know, or a file of the tests that
# is there. From meson: SNOW_SOURCE.
set -eu
. "$SNOW_SOURCE/tests/support/tap.sh"
page=$SNOW_SOURCE/doc/guarantees.md
tests=$SNOW_SOURCE/tests

# The rows of all tables but their heads: the promise, and in the last cell who holds it.
awk -F'|' '
    !/^\|/ { head = 1; next }
    head { head = 0; next }
    !/^\|---/ { print $2 "|" $(NF - 1) }' "$page" >"$tap_folder/rows"

# What stands in backticks, a line each.
named() {
    printf '%s\n' "$1" | awk -F'`' '{ for (i = 2; i <= NF; i += 2) print $i }'
}

# A C test needs its file and its place in a list; a script its test() call; a fuzz target its file and its place.
is_test() {
    case $1 in
    fuzz_*) [ -f "$tests/fuzz/$1.c" ] && grep -q "'${1#fuzz_}'" "$tests/fuzz/meson.build" ;;
    */*) [ -e "$SNOW_SOURCE/$1" ] ;;
    *)
        { [ -f "$tests/test_$1.c" ] && grep -q "'$1'" "$tests/meson.build"; } ||
            grep -q "test('$1'," "$tests/meson.build" "$SNOW_SOURCE/doc/meson.build"
        ;;
    esac
}

# holds CELL: it names something, and all that it names is there.
holds() {
    count=0
    for name in $(named "$1"); do
        count=$((count + 1))
        is_test "$name" || { echo "there is no $name"; return 1; }
    done
    [ "$count" -gt 0 ] || { echo "no test is named"; return 1; }
}

check 'the page has promises' [ "$(wc -l <"$tap_folder/rows")" -ge 30 ]
while IFS='|' read -r promise cell; do
    check "$(printf '%s' "$promise" | tr -d '#\`' | cut -c 2-70)" holds "$cell"
done <"$tap_folder/rows"
refuse 'a test that does not exist is noticed' holds '`no_such_test`'
refuse 'a promise without a test is noticed' holds 'trust us'
finish
