#!/bin/sh
# The library as others meet it: installed, found by pkg-config or meson, linked
# shared and static, opened at run time; and what they must not be able to do.
# From meson: SNOW_SOURCE, SNOW_BUILD, SNOW_PREFIX, SNOW_LIBDIR, CC, CXX (empty without a C++ compiler).
set -eu
. "$SNOW_SOURCE/tests/support/tap.sh"

here=$SNOW_SOURCE/tests/consumer
work=$tap_folder
root=$work/root
static_root=$work/static_root
include=$root$SNOW_PREFIX/include
libdir=$root$SNOW_PREFIX/$SNOW_LIBDIR

install_library() {
    meson install -C "$SNOW_BUILD" --no-rebuild --quiet --destdir "$root" &&
        mkdir "$static_root" && cp -R "$root/." "$static_root" &&
        rm -f "$static_root$SNOW_PREFIX/$SNOW_LIBDIR"/libsnowgrowth.so*
}

# pkg-config, as the packages below the root $1 tell it and no others.
package() {
    sysroot=$1
    shift
    PKG_CONFIG_LIBDIR=$sysroot$SNOW_PREFIX/$SNOW_LIBDIR/pkgconfig PKG_CONFIG_SYSROOT_DIR=$sysroot \
        PKG_CONFIG_ALLOW_SYSTEM_CFLAGS=1 PKG_CONFIG_ALLOW_SYSTEM_LIBS=1 pkg-config "$@" snowgrowth
}

# build COMPILER SOURCE NAME FLAGS...; the flags are split at blanks.
build() {
    compiler=$1 source=$2 name=$3
    shift 3
    # shellcheck disable=SC2048,SC2086
    $compiler -Wall -Wextra -Wpedantic -Werror "$source" -o "$work/$name" $*
}

run_shared() {
    LD_LIBRARY_PATH=$libdir "$work/$1" "$libdir/libsnowgrowth.so.0"
}

same_headers() {
    (cd "$SNOW_SOURCE/include/snowgrowth" && ls ./*.h) >"$work/source_headers"
    (cd "$include/snowgrowth" && ls .) | sed 's,^,./,' | diff "$work/source_headers" -
}

has_version() {
    [ "$(package "$root" --modversion)" = "$(sed -n 's/^#define SNOW_VERSION_TEXT "\(.*\)"/\1/p' \
        "$include/snowgrowth/version.h")" ]
}

needs() {
    readelf -d "$work/$1" | grep NEEDED | grep -q libsnowgrowth
}

check 'meson install into an empty root' install_library
check 'installed headers are the public ones and no others' same_headers
check 'pkg-config tells the version of the headers' has_version

check 'shared, through pkg-config' build "$CC" "$here/program.c" shared "$(package "$root" --cflags --libs)"
check 'shared: runs' run_shared shared
check 'shared: needs the library' needs shared

check 'a plain compile line' build "$CC" "$here/program.c" plain -std=c99 -I"$include" -L"$libdir" -lsnowgrowth
check 'plain: runs' run_shared plain

check 'static, through pkg-config' build "$CC" "$here/program.c" static \
    "$(package "$static_root" --static --cflags --libs)"
check 'static: runs' "$work/static"
refuse 'static: needs no library' needs static

printf 'int main(void) { return 0; }\n' >"$work/empty.c"
if build "$CC" "$work/empty.c" empty -static 2>/dev/null; then
    check 'all static' build "$CC" "$here/program.c" all_static "-static $(package "$root" --static --cflags --libs)"
    check 'all static: runs' "$work/all_static"
else
    skip 'all static' 'the C library has no archive here'
fi

if [ -n "$CXX" ]; then
    check 'C++, shared' build "$CXX -x c++" "$here/program.c" cxx "-x none $(package "$root" --cflags --libs)"
    check 'C++, shared: runs' run_shared cxx
    check 'C++, static' build "$CXX -x c++" "$here/program.c" cxx_static \
        "-x none $(package "$static_root" --static --cflags --libs)"
    check 'C++, static: runs' "$work/cxx_static"
else
    skip 'C++' 'no C++ compiler'
fi

check 'at run time' build "$CC" "$here/plugin.c" plugin "$(package "$root" --cflags) -ldl"
check 'at run time: opens, finds, closes' run_shared plugin

# An internal function is global in the archive, for that is how its objects meet; the shared library hides it.
internal=$(nm -g --defined-only "$SNOW_BUILD"/lib/libsnowgrowth.a 2>/dev/null | awk '$2 == "T" { print $3 }' |
    while read -r name; do
        grep -q "^ *$name;" "$SNOW_SOURCE/lib/snowgrowth.map" || echo "$name"
    done | sed 1q)
if [ -n "$internal" ]; then
    printf 'void %s(void);\nint main(void) { %s(); return 0; }\n' "$internal" "$internal" >"$work/internal.c"
    check "$internal can be linked from the archive" build "$CC" "$work/internal.c" internal \
        "$(package "$static_root" --static --cflags --libs)"
    refuse "$internal cannot be linked from the shared library" build "$CC" "$work/internal.c" internal \
        "$(package "$root" --cflags --libs)"
else
    skip 'an internal function cannot be linked' 'no archive was built'
fi
for header in base/structs.h snowgrowth/base/structs.h structs.h; do
    printf '#include <%s>\nint main(void) { return 0; }\n' "$header" >"$work/private.c"
    refuse "<$header> cannot be included" build "$CC" "$work/private.c" private "$(package "$root" --cflags --libs)"
done

subproject() {
    kind=$1
    mkdir -p "$work/app/subprojects" &&
        cp "$here/subproject/meson.build" "$here/program.c" "$work/app" &&
        ln -sfn "$SNOW_SOURCE" "$work/app/subprojects/snowgrowth" &&
        CC=$CC meson setup "$work/app-$kind" "$work/app" --wrap-mode=forcefallback \
            "-Dsnowgrowth:default_library=$kind" -Dsnowgrowth:werror=true &&
        meson compile -C "$work/app-$kind" && "$work/app-$kind/by_fallback" && "$work/app-$kind/by_name"
}

# What a parent project gets: the library and nothing else of ours.
only_the_library() {
    [ -f "$work/app-shared/by_name" ] &&
        ! find "$work/app-shared" -name '*.c.o' | grep -E 'subprojects/snowgrowth/(examples|tests|bench|doc)/'
}

installed_project() {
    CC=$CC LD_LIBRARY_PATH=$libdir PKG_CONFIG_LIBDIR=$libdir/pkgconfig PKG_CONFIG_SYSROOT_DIR=$root \
        meson setup "$work/app-installed" "$work/app" --wrap-mode=nofallback &&
        meson compile -C "$work/app-installed" && LD_LIBRARY_PATH=$libdir "$work/app-installed/by_name"
}

if command -v meson >/dev/null 2>&1; then
    check 'meson subproject, shared' subproject shared
    check 'meson subproject, static' subproject static
    check 'meson subproject: only the library is built' only_the_library
    check 'meson project, library installed' installed_project
else
    skip 'meson subproject' 'meson is not on the path'
fi
finish
