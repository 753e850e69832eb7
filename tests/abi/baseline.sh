#!/bin/sh
# Compares the library's ABI with the committed baseline: layouts of public structs, values of enumerations,
# signatures, exported symbols. With --update it writes the baseline instead. Paths of sources are cut down to
# those inside the project, so that the baseline is the same wherever it is made.
# From meson: SNOW_SOURCE, SNOW_SHARED. Exit status 77: cannot be told here.
set -eu
baseline=$SNOW_SOURCE/tests/abi/snowgrowth-0.abi

cannot() {
    echo "skipped: $*"
    exit 77
}

command -v abidw >/dev/null 2>&1 || cannot 'abidw is not installed (Debian: abigail-tools)'
command -v abidiff >/dev/null 2>&1 || cannot 'abidiff is not installed (Debian: abigail-tools)'

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM

abidw --headers-dir "$SNOW_SOURCE/include" --drop-private-types --no-corpus-path --no-comp-dir-path \
    --no-show-locs --no-elf-needed --drop-undefined-syms --exported-interfaces-only --type-id-style hash \
    "$SNOW_SHARED" | sed "s,path='[^']*/lib/,path='lib/," >"$work/now.abi"

# Without debug information a dump holds no types, and nothing would ever differ.
grep -q "name='snow_reiter_params'" "$work/now.abi" || cannot 'the library was built without debug information'

if [ "${1:-}" = --update ]; then
    cp "$work/now.abi" "$baseline"
    echo "wrote $baseline"
    exit
fi

if ! abidiff --harmless "$baseline" "$work/now.abi"; then
    echo 'The ABI differs from the baseline. doc/versioning.md says what may change and when;'
    echo 'if the change is meant: meson compile -C BUILD abi-baseline'
    exit 1
fi
