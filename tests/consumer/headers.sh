#!/bin/sh
# Every public header stands alone, without a warning, in each C and C++ that callers write.
# From meson: SNOW_SOURCE, CC, CXX (empty without a C++ compiler).
set -eu
. "$SNOW_SOURCE/tests/support/tap.sh"

warnings='-Wall -Wextra -Wpedantic -Wundef -Werror'

# The header twice, since a second inclusion must do nothing; ISO C wants a declaration beside it.
compile() {
    header=$1
    shift
    printf '#include <snowgrowth/%s>\n#include <snowgrowth/%s>\nextern int end;\n' "$header" "$header" |
        "$@" -fsyntax-only -I"$SNOW_SOURCE/include" -
}

for path in "$SNOW_SOURCE"/include/snowgrowth/*.h; do
    header=$(basename "$path")
    for standard in c99 c11 c17; do
        # shellcheck disable=SC2086
        check "$header in $standard" compile "$header" $CC -x c -std=$standard $warnings -Wstrict-prototypes
    done
    for standard in c++11 c++20; do
        if [ -n "$CXX" ]; then
            # shellcheck disable=SC2086
            check "$header in $standard" compile "$header" $CXX -x c++ -std=$standard $warnings -Wold-style-cast
        else
            skip "$header in $standard" 'no C++ compiler'
        fi
    done
done
finish
