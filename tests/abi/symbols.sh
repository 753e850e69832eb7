#!/bin/sh
# The functions that the headers declare, those that the version script names and those that the shared
# library exports are the same; and whatever the archive defines begins with snow_.
# From meson: SNOW_SOURCE, SNOW_SHARED and SNOW_STATIC (the libraries; empty where one is not built).
set -eu
. "$SNOW_SOURCE/tests/support/tap.sh"

declared=$tap_folder/declared
named=$tap_folder/named
exported=$tap_folder/exported

# SNOW_API begins a declaration; the first name before a parenthesis is the function's.
cat "$SNOW_SOURCE"/include/snowgrowth/*.h | awk '
    /^SNOW_API/ { wanted = 1 }
    wanted && match($0, /[A-Za-z0-9_]+\(/) { print substr($0, RSTART, RLENGTH - 1); wanted = 0 }' | sort >"$declared"
awk '/global:/ { wanted = 1; next } /local:/ { wanted = 0 } wanted { sub(/;/, ""); print $1 }' \
    "$SNOW_SOURCE/lib/snowgrowth.map" | sort >"$named"

prefixed() {
    ! grep -v '^snow_' "$1"
}

check 'the headers declare functions' test -s "$declared"
check 'every public name begins with snow_' prefixed "$declared"
check 'headers and version script agree' diff "$declared" "$named"

if [ -n "$SNOW_SHARED" ]; then
    # What a symbol's line ends with is its name and node; the nodes themselves are absolute symbols.
    nm -D --defined-only "$SNOW_SHARED" | awk '$2 != "A" { print $3 }' >"$tap_folder/dynamic"
    sed 's/@.*//' "$tap_folder/dynamic" | sort >"$exported"
    check 'headers and shared library agree' diff "$declared" "$exported"
    refuse 'every exported function has a version' grep -v '@@SNOWGROWTH_' "$tap_folder/dynamic"
else
    skip 'headers and shared library agree' 'no shared library was built'
fi

if [ -n "$SNOW_STATIC" ]; then
    nm -g --defined-only "$SNOW_STATIC" | awk 'NF == 3 { print $3 }' | sort -u >"$tap_folder/archive"
    check 'the archive defines symbols' test -s "$tap_folder/archive"
    check 'all that the archive defines begins with snow_' prefixed "$tap_folder/archive"
    # What it takes from outside: memory from one place only, and nothing that prints, ends the program or looks about.
    nm -u -A "$SNOW_STATIC" 2>/dev/null | awk '{ print $1, $NF }' >"$tap_folder/wanted"
    refuse 'the archive prints nothing, ends nothing, asks no environment' \
        grep -E ' (printf|fprintf|vfprintf|puts|putchar|fputs|fwrite|perror|stdout|stderr|abort|exit|_exit|getenv|signal|raise|time|rand|srand|random|setlocale|fopen|open)$' "$tap_folder/wanted"
    grep -E ' (malloc|calloc|realloc|free|posix_memalign|aligned_alloc|strdup|mmap|qsort)$' "$tap_folder/wanted" |
        grep -v 'base_heap\.c\.o' >"$tap_folder/allocators" || :
    refuse 'only base/heap.c knows malloc()' test -s "$tap_folder/allocators"
    # Data that can change would be shared by grids.
    nm -A "$SNOW_STATIC" 2>/dev/null | grep -E ' [bBC] ' >"$tap_folder/writable" || :
    size -A "$SNOW_STATIC" | awk '$1 ~ /^\.(data|tdata|tbss)$/ && $2 > 0' >>"$tap_folder/writable"
    refuse 'the archive has no data that change' test -s "$tap_folder/writable"
else
    skip 'all that the archive defines begins with snow_' 'no archive was built'
fi
finish
