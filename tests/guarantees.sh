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

# A declaration a line, from SNOW_API to the semicolon; then the names of the functions that have to do with a grid.
declarations() {
    cat "$SNOW_SOURCE"/include/snowgrowth/*.h | awk '
        /^SNOW_API/ { wanted = 1; line = "" }
        wanted { line = line $0 }
        wanted && /;/ { print line; wanted = 0 }'
}
declarations | grep 'snow_grid' | sed 's/(.*//; s/.*[ *]//' >"$tap_folder/functions"

# The structs that say their own size.
sed -n 's/^} \(snow_[a-z_]*\);$/\1/p; /size_t struct_size;/s/.*/sized/p' "$SNOW_SOURCE"/include/snowgrowth/*.h |
    awk '/^sized$/ { sized = 1; next } sized { print } { sized = 0 }' >"$tap_folder/structs"

# named_in FILES...: each line of standard input is a word of one of them.
named_in() {
    missing=0
    while read -r name; do
        grep -q -w "$name" "$@" || { echo "$name is not in $*"; missing=1; }
    done
    return "$missing"
}

takes_part() {
    named_in "$tests/support/lives.c" "$tests/test_guarantee_memory.c" <"$tap_folder/functions"
}

is_tested() {
    named_in "$tests/test_options.c" <"$tap_folder/structs"
}

invented() {
    echo snow_no_such_function | named_in "$tests/support/lives.c"
}

check 'the headers have functions of a grid' [ "$(wc -l <"$tap_folder/functions")" -ge 50 ]
check 'each of them takes part in the tests of all models' takes_part
check 'the headers have structs with a size' [ "$(wc -l <"$tap_folder/structs")" -ge 9 ]
check 'each of them is tried too small, too long and uninitialised' is_tested
refuse 'a function that takes no part is noticed' invented
check 'the page has promises' [ "$(wc -l <"$tap_folder/rows")" -ge 30 ]
while IFS='|' read -r promise cell; do
    check "$(printf '%s' "$promise" | tr -d '#\`' | cut -c 2-70)" holds "$cell"
done <"$tap_folder/rows"
refuse 'a test that does not exist is noticed' holds '`no_such_test`'
refuse 'a promise without a test is noticed' holds 'trust us'
finish
