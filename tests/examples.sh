#!/bin/sh
# Every example program, run as a user runs it: small scenes, bad options, full
# disks, Ctrl-C. Prints TAP.
#
# usage: examples.sh DIRECTORY    (where the built programs lie)
set -u

programs=$(cd "$1" && pwd) || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
cd "$work" || exit 1

number=0
ok() {
    number=$((number + 1))
    echo "ok $number - $1"
}
not_ok() {
    number=$((number + 1))
    echo "not ok $number - $1"
    sed 's/^/# stdout: /' stdout
    sed 's/^/# stderr: /' stderr
}
skip() {
    number=$((number + 1))
    echo "ok $number - $1 # SKIP $2"
}
# check NAME TEST...: the rest is a command that says whether all is well.
check() {
    name=$1
    shift
    if "$@"; then ok "$name"; else not_ok "$name"; fi
}

# Runs a program; what it prints is in stdout and stderr, its exit code in $code.
run() {
    program=$1
    shift
    "$programs/$program" "$@" >stdout 2>stderr </dev/null
    code=$?
}

built() {
    [ -x "$programs/$1" ]
}

lines() {
    wc -l <"$1" | tr -d ' '
}

silent() {
    [ ! -s "$1" ]
}

# One line of complaint that begins with the program's name, and nothing else.
complained() {
    [ "$code" -eq "$2" ] && silent stdout && [ "$(lines stderr)" -eq 1 ] && grep -q "^$1: " stderr
}

succeeded() {
    [ "$code" -eq 0 ] && silent stderr
}

printed() {
    succeeded && [ "$(lines stdout)" -eq 1 ] && grep -Eq "$1" stdout
}

is_png() {
    if command -v pngcheck >/dev/null 2>&1; then
        pngcheck -q "$1" >/dev/null
    else
        [ "$(head -c 8 "$1" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] &&
            tail -c 8 "$1" | head -c 4 | grep -q IEND
    fi
}

is_gif() {
    [ "$(head -c 6 "$1")" = GIF89a ] && [ "$(tail -c 1 "$1" | od -An -tx1 | tr -d ' \n')" = 3b ]
}

drew() {
    succeeded && is_png "$1"
}

# Nothing called $1, finished or not.
nothing_left() {
    [ -z "$(find . -name "$1*")" ]
}

failed_cleanly() {
    complained "$1" 1 && nothing_left "$2"
}

result_line='^steps=[0-9]+ frozen=[0-9]+ tip=[0-9.e+]+ reason=[a-z]+$'

test_hello() {
    run hello
    check 'hello prints its line' printed '^4304 steps, 18607 cells of ice$'
}

test_help() {
    for program in snowflake table alpha_sweep random_seeds changing_conditions packard packard_figures aggregate animation; do
        if built "$program"; then
            run $program --help
            check "$program --help" helped "$program"
        else
            skip "$program --help" 'it is not built'
        fi
    done
}
helped() {
    succeeded && grep -q "^usage: $1" stdout && grep -q '^Example:' stdout && grep -q -- --out stdout
}

test_line() {
    run snowflake --radius 100 --beta 0.4 --gamma 0.001
    check 'snowflake ends with the known line' printed '^steps=2011 frozen=7975 tip=98(\.[0-9]+)? reason=rim$'
    for option in '--threads 2' '--isa baseline' '--engine reference'; do
        # shellcheck disable=SC2086
        run snowflake --radius 50 $option
        mv stdout with
        run snowflake --radius 50
        check "snowflake $option gives the same line" cmp -s with stdout
    done
    run snowflake --radius 12 --engine quad
    check 'snowflake --engine quad' printed "$result_line"
    run snowflake --max-steps 7
    check 'snowflake --max-steps' printed '^steps=7 .*reason=steps$'
    run snowflake --beta 0 --gamma 0
    check 'snowflake says when nothing grows' printed 'frozen=1 tip=0 reason=still$'
    run snowflake --alpha 4 --allow-unstable --radius 40
    check 'snowflake --allow-unstable' printed "$result_line"
    run snowflake --radius 20 --cluster 5 --random-seed 18446744073709551615 --noise 0.1 --symmetric-noise
    check 'snowflake with random start' printed "$result_line"
    env LC_ALL=de_DE.UTF-8 "$programs/snowflake" --radius 20 --beta .4 >stdout 2>stderr
    code=$?
    check 'numbers do not depend on the locale' printed "$result_line"
}

packard_line='^steps=[0-9]+ population=[0-9]+ engine=(reference|tiles|quadtree)$'

test_packard() {
    run packard --rule 0100000 --steps 1000
    check 'packard ends with the known line' printed '^steps=1000 population=1818877 engine=tiles$'
    run packard --rule b1s0123456h --steps 100 --engine quadtree
    check 'packard --engine quadtree' printed '^steps=100 population=16381 engine=quadtree$'
    run packard --rule 0101010 --steps 1152921504606846976
    check 'packard counts beyond 64 bits' printed 'population=3323069989462289678800753136880320521 engine=quadtree$'
    run packard --rule 0110000 --zone corners:7-8 --zone tips:4 --zone clefts:9-:2.5 --zone clefts:1-3:12d --steps 20
    check 'packard --zone' printed "$packard_line"
    for domain in disc hexagon rectangle rhombus torus; do
        run packard --domain $domain --radius 20 --width 30 --height 25 --cluster 5 --seed 3 --size 50 --out domain.png
        [ "$code" -ne 0 ] || code=$(is_png domain.png; echo $?)
        check "packard --domain $domain" printed "$packard_line"
    done
    for palette in ink age phase; do
        run packard --steps 20 --palette $palette --size 64 --out $palette.png
        [ "$code" -ne 0 ] || code=$(is_png $palette.png; echo $?)
        check "packard --palette $palette" printed "$packard_line"
    done
    run packard --seeds 20 --side 50 --seed 7 --steps 15 --rle part.rle
    check 'packard --rle' printed "$packard_line"
    run packard --load-rle part.rle --steps 15
    mv stdout continued
    run packard --seeds 20 --side 50 --seed 7 --steps 30
    check 'packard --load-rle goes on' cmp -s continued stdout
    run packard_figures --panel 40 --out figures.png
    check 'packard_figures' printed '^panels=10 done=10 seconds=[0-9.]+$'
    run packard_dimension --steps 64
    check 'packard_dimension' [ "$(lines stdout)" -eq 7 ]
}

test_presets() {
    run snowflake --list-presets
    check 'snowflake --list-presets' listed
    run snowflake --radius 20 --preset sector
    mv stdout first
    run snowflake --preset sector --radius 20
    check 'options change a preset in any order' cmp -s first stdout
}
listed() {
    succeeded && grep -q '^thin-dendrite ' stdout && grep -q '^sector ' stdout
}

test_pictures() {
    for palette in paper frost ink age; do
        run snowflake --radius 30 --palette $palette --size 64 --samples 1 --out $palette.png
        check "snowflake --palette $palette" drew $palette.png
    done
    run snowflake --radius 30 --transparent --size 0 --out clear.png
    check 'snowflake --transparent' drew clear.png
    for domain in hexagon 'rectangle --width 40 --height 30' 'rectangle --rim row --width 70 --height 70'; do
        # shellcheck disable=SC2086
        run snowflake --domain $domain --size 50 --out domain.png
        [ "$code" -ne 0 ] || code=$(is_png domain.png; echo $?)
        check "snowflake --domain $domain" printed "$result_line"
    done
    echo old >kept.png
    run snowflake --radius 20 --out kept.png
    check 'a picture replaces the old one' drew kept.png
    ln -s linked.png link.png
    echo old >linked.png
    run snowflake --radius 20 --out link.png
    check 'a picture goes where a link points to' drew linked.png
    check 'the link is still one' [ -h link.png ]
}

test_continue() {
    run snowflake --radius 60 --max-steps 200 --save half.snow
    run snowflake --load half.snow --max-steps 400 --palette age --out continued.png
    mv stdout continued
    run snowflake --radius 60 --max-steps 400 --palette age --out straight.png
    check 'saved and continued: the same line' cmp -s continued stdout
    check 'saved and continued: the same picture' cmp -s continued.png straight.png
    run snowflake --load half.snow --max-steps 400 --save whole.snow
    run snowflake --radius 60 --max-steps 400 --save straight.snow
    check 'saved and continued: the same crystal' cmp -s whole.snow straight.snow
    run snowflake --load half.snow --radius 60
    check 'a crystal that is loaded is not described again' complained snowflake 2
    head -c 1000 half.snow >short.snow
    run snowflake --load short.snow
    check 'an incomplete crystal' complained snowflake 2
    { head -c 1000 half.snow; printf 'frost'; tail -c +1006 half.snow; } >damaged.snow
    run snowflake --load damaged.snow
    check 'a damaged crystal' complained snowflake 2
    run snowflake --load /dev/null
    check 'an empty file' complained snowflake 2
    run snowflake --load nowhere.snow
    check 'a missing file' complained snowflake 2
    run snowflake --load .
    check 'a folder in place of a file' bad_exit snowflake
}
bad_exit() {
    complained "$1" 1 || complained "$1" 2
}

# bad PROGRAM ARGUMENT...: a wrong command.
bad() {
    run "$@"
    check "wrong: $*" complained "$1" 2
}

test_wrong() {
    for value in 1e x '' nan inf 1e999 -5 1.0 ' .4' 0,4; do
        bad snowflake --beta "$value"
    done
    for value in 1e 4.5 x '' 0 -5 99999999999 9999999999999999999999 2000000; do
        bad snowflake --radius "$value"
    done
    bad snowflake --gamma 1.1
    bad snowflake --alpha 2.7
    bad snowflake --alpha 4.1 --allow-unstable
    bad snowflake --max-steps -1
    bad snowflake --threads 1025
    bad snowflake --isa sse9
    bad snowflake --engine steam
    bad snowflake --domain triangle
    bad snowflake --palette plaid --out a.png
    bad snowflake --size 65536 --out a.png
    bad snowflake --samples 0 --out a.png
    bad snowflake --preset nothing
    bad snowflake --cluster -1
    bad snowflake --cluster 1025
    bad snowflake --noise 2
    bad snowflake --random-seed -1
    bad snowflake --random-seed 18446744073709551616
    bad snowflake --rim row
    bad snowflake --radius 50 --domain rectangle
    bad snowflake --width 50
    bad snowflake --symmetric-noise
    bad snowflake --domain rectangle --width 2097152 --height 2097152
    bad snowflake --no-such-option
    bad snowflake -x
    bad snowflake --beta
    bad snowflake --transparent=yes
    bad snowflake argument
    bad packard --rule 01010
    bad packard --rule B3/S23
    bad packard --rule 1000000
    bad packard --zone clefts
    bad packard --zone clefts:x
    bad packard --zone corners:5-4
    bad packard --zone tips:1-2:w
    bad packard --engine quadtree --domain disc
    bad packard --steps -1
    bad packard --seeds 20 --side 3
    bad packard --load-rle nowhere.rle
    bad packard_dimension --steps 3
    bad table --betas 0.1,,0.2
    bad table --betas 0.1,1
    bad table --gammas ,
    bad table --betas 0:0.9
    bad table --betas 0:0.9:1
    bad table --betas 0:0.9:2.5
    bad table --betas 0:0.9:257
    bad table --betas 0:0.9:3logs
    bad table --gammas 0:1:3log
    bad table --polish --radius 50
    bad table --panel 0
    bad table --threads -1
    bad alpha_sweep --alphas 5
    bad alpha_sweep --tip -1
    bad random_seeds --count 0
    bad changing_conditions --radius 0
    if built animation; then
        bad animation
        bad animation --every 0 --out a.gif
        bad animation --out a.gif --beta 2
    else
        skip 'wrong: animation' 'it is not built'
        skip 'wrong: animation --every' 'it is not built'
        skip 'wrong: animation --beta' 'it is not built'
    fi
    check 'wrong commands leave nothing behind' nothing_left a.
}

test_disk() {
    run snowflake --radius 20 --out nowhere/lost.png
    check 'a folder that is not there' failed_cleanly snowflake lost
    mkdir folder
    run snowflake --radius 20 --out folder
    check 'a folder in place of a picture' complained snowflake 1
    if [ -c /dev/full ]; then
        run snowflake --radius 20 --out /dev/full
        check 'a full disk: picture' complained snowflake 1
        run snowflake --radius 20 --save /dev/full
        check 'a full disk: crystal' complained snowflake 1
        run table --betas .4 --gammas .01 --radius 20 --csv /dev/full
        check 'a full disk: numbers' [ "$code" -eq 1 ]
        "$programs/snowflake" --radius 20 >/dev/full 2>stderr
        code=$?
        : >stdout
        check 'a full disk: standard output' complained snowflake 1
        for option in out rle; do
            run packard --steps 20 --$option /dev/full
            check "a full disk: packard --$option" complained packard 1
        done
        for option in out sites ply vtk save; do
            run aggregate --particles 3000 --$option /dev/full
            check "a full disk: aggregate --$option" complained aggregate 1
        done
        check 'the full disk is still there' [ -c /dev/full ]
    else
        for what in picture crystal numbers 'standard output' 'packard --out' 'packard --rle' 'aggregate --out' \
            'aggregate --sites' 'aggregate --ply' 'aggregate --vtk' 'aggregate --save' device; do
            skip "a full disk: $what" 'no /dev/full here'
        done
    fi
    for program in snowflake packard aggregate; do
        {
            sleep 1 # until there is no reader any more
            trap '' PIPE
            "$programs/$program" 2>stderr
            echo $? >code
        } | :
        code=$(cat code)
        : >stdout
        check "a closed pipe: $program" complained $program 1
    done
    # A limit on the size of files is the nearest thing to a disk that fills up while a file is written.
    echo old >small.png
    (
        trap '' XFSZ
        ulimit -f 8
        "$programs/snowflake" --radius 60 --size 900 --palette frost --out small.png >stdout 2>stderr
    )
    code=$?
    check 'a disk that fills up' complained snowflake 1
    check 'then the old picture is still there' [ "$(cat small.png)" = old ]
    check 'and nothing else' [ "$(find . -name 'small.png*' | wc -l)" -eq 1 ]
    if [ "$(id -u)" -eq 0 ]; then
        skip 'a folder that may not be written' 'root may write anywhere'
    else
        mkdir locked
        chmod a-w locked
        run snowflake --radius 20 --out locked/lost.png
        check 'a folder that may not be written' failed_cleanly snowflake lost
        chmod u+w locked
    fi
}

# interrupt SECONDS PROGRAM ARGUMENT...: Ctrl-C after so long, in work that would take hours.
interrupt() {
    seconds=$1
    program=$2
    shift 2
    "$programs/$program" "$@" >stdout 2>stderr &
    job=$!
    sleep "$seconds"
    kill -INT $job
    { sleep 120; kill -KILL $job; } >/dev/null 2>&1 &
    guard=$!
    wait $job
    code=$?
    kill $guard 2>/dev/null
}

test_interrupt() {
    interrupt 1 snowflake --radius 400 --max-steps 100000000 --beta 0.1 --out stopped.png --save stopped.snow
    check 'Ctrl-C: the line' printed 'reason=cancelled$'
    check 'Ctrl-C: the picture' is_png stopped.png
    run snowflake --load stopped.snow --max-steps 0
    check 'Ctrl-C: the crystal' printed "$result_line"
    interrupt 1 packard --steps 100000000 --engine reference --size 100 --out grown.png --rle grown.rle
    check 'packard, Ctrl-C: the message' grep -q '^packard: stopped after step [0-9]*$' stderr
    check 'packard, Ctrl-C: the picture' is_png grown.png
    mv stdout stopped
    run packard --load-rle grown.rle --steps 0
    check 'packard, Ctrl-C: the pattern' same_population stopped stdout
    interrupt 1 aggregate --particles 1000000000 --sites cloud --save cloud.snow
    check 'aggregate, Ctrl-C: the line' printed "$aggregate_line"
    check 'aggregate, Ctrl-C: a line a particle' [ "$(lines cloud)" -eq "$(sed 's/particles=\([0-9]*\) .*/\1/' stdout)" ]
    run aggregate --load cloud.snow --particles 1 --sites again
    check 'aggregate, Ctrl-C: the growth' cmp -s cloud again
    for sheet in alpha_sweep:1000 random_seeds:400 changing_conditions:1000; do
        program=${sheet%:*}
        interrupt 1 "$program" --radius "${sheet#*:}" --max-steps 100000000000 --panel 40 --out sheet.png
        check "$program, Ctrl-C: what is done is drawn" ended_early "$program" sheet.png
    done
    if built animation; then
        interrupt 1 animation --radius 400 --beta 0.1 --max-steps 100000000 --every 1 --size 50 --out growth.gif
        check 'animation, Ctrl-C: the line' printed '^frames=[0-9]+ .*reason=cancelled$'
        check 'animation, Ctrl-C: the film' is_gif growth.gif
    else
        skip 'animation, Ctrl-C: the line' 'it is not built'
        skip 'animation, Ctrl-C: the film' 'it is not built'
    fi
    for seconds in 1 4 16; do # a busy machine needs longer for the first panels
        interrupt $seconds table --betas 0.9,0.05 --gammas 1,0.0001 --max-steps 100000000000 --panel 40 --out part.png
        ! partly_done || break
    done
    check 'Ctrl-C: the finished panels' partly_done
}
same_population() {
    succeeded && [ "$(cut -d ' ' -f 1,2 "$1")" = "$(cut -d ' ' -f 1,2 "$2")" ]
}
# Killed while it writes the crystal: what stands under the name is the old crystal or the new one, and whole.
test_checkpoint() {
    run snowflake --radius 250 --max-steps 50 --out none.png --save point.snow
    "$programs/snowflake" --load point.snow --max-steps 60 --out none.png --save point.snow >stdout 2>stderr &
    job=$!
    part=
    while [ -z "$part" ] && kill -0 $job 2>/dev/null; do
        part=$(find . -name 'point.snow.*.part' -size +0)
    done
    kill -KILL $job 2>/dev/null
    wait $job 2>/dev/null
    run snowflake --load point.snow --max-steps 0
    if [ -n "$part" ]; then
        check 'kill -9 while a crystal is saved: the old one or the new one is there' grep -Eq '^steps=(50|60) ' stdout
    else
        skip 'kill -9 while a crystal is saved' 'it was saved too soon'
    fi
    rm -f point.snow.*.part none.png.*.part
    # A growth that saves itself again and again is killed in the middle of a later checkpoint, if that can be seen.
    "$programs/aggregate" --particles 1000000000 --checkpoint 0.001 --save growth.snow >stdout 2>stderr &
    job=$!
    looks=0
    while [ ! -s growth.snow ] && [ "$looks" -lt 60 ]; do
        looks=$((looks + 1))
        sleep 1
    done
    while [ -z "$(find . -name 'growth.snow.*.part' -size +0)" ] && [ "$looks" -lt 5000 ]; do
        looks=$((looks + 1))
    done
    kill -KILL $job 2>/dev/null
    wait $job 2>/dev/null
    run aggregate --load growth.snow --particles 1
    check 'kill -9 in the middle of a checkpoint: the one before is whole' printed "$aggregate_line"
    rm -f growth.snow*
}
# A sheet is drawn of the panels that are done; none at all is drawn where none is.
ended_early() {
    [ "$code" -eq 0 ] && grep -Eq '^panels=[0-9]+ done=[0-9]+ ' stdout && grep -q "^$1: stopped" stderr &&
        { [ ! -e "$2" ] || is_png "$2"; } && rm -f "$2"
}
partly_done() {
    [ "$code" -eq 0 ] && grep -q '^panels=4 done=[1-3] ' stdout && is_png part.png && grep -q '^table: stopped' stderr
}

test_sheets() {
    run table --betas 0,.4,.9 --gammas 0,.01 --radius 40 --panel 60 --threads 2 --out table.png --csv table.csv
    check 'table: line' printed '^panels=6 done=6 seconds=[0-9.]+$'
    check 'table: picture' is_png table.png
    check 'table: numbers' [ "$(lines table.csv)" -eq 7 ]
    check 'table: nothing grows at beta = gamma = 0' grep -q '^0,0,[0-9]*,1,0,still$' table.csv
    cp table.png threads.png
    run table --betas 0,.4,.9 --gammas 0,.01 --radius 40 --panel 60 --out table.png
    check 'table: the same with one thread' cmp -s table.png threads.png
    run table --polish --betas .6 --gammas .05 --panel 60 --out polish.png
    check 'table --polish' drew polish.png
    run table --betas 0:.9:4,.95 --gammas .0001:1:3log --radius 12 --panel 16 --out ranges.png --csv ranges.csv
    check 'table: ranges have as many numbers as they say' [ "$(lines ranges.csv)" -eq 16 ]
    check 'table: ranges with equal ratios' grep -q '^0.95,0.01,' ranges.csv
    run table --betas .4 --gammas 0.01 --radius 20 --palette age --panel 16 --out age.png
    check 'table --palette age' drew age.png
    run alpha_sweep --radius 40 --tip 30 --panel 60 --out alpha.png
    check 'alpha_sweep' drew alpha.png
    run random_seeds --radius 30 --count 2 --panel 60 --out random.png
    check 'random_seeds' drew random.png
    run changing_conditions --radius 60 --turn 20 --panel 60 --out conditions.png
    check 'changing_conditions' drew conditions.png
}

test_animation() {
    if ! built animation; then
        for what in 'GIF' 'GIF file' 'frames' 'stream' 'ended reader' 'full disk'; do
            skip "animation: $what" 'it is not built'
        done
        return
    fi
    run animation --radius 30 --every 20 --size 50 --out growth.gif --frames growth.ppm
    check 'animation: line' printed '^frames=[0-9]+ steps=[0-9]+ frozen=[0-9]+ reason=rim$'
    check 'animation: GIF' is_gif growth.gif
    check 'animation: as many frames as it says' holds_frames growth.ppm
    run animation --radius 30 --every 20 --size 50 --frames -
    check 'animation: the same frames through a pipe' cmp -s stdout growth.ppm
    { "$programs/animation" --radius 100 --every 1 --frames - 2>stderr; echo $? >code; } | head -c 10 >stdout
    code=$(cat code)
    : >stdout
    check 'animation: a reader that ends' complained animation 1
    if [ -c /dev/full ]; then
        run animation --radius 30 --size 50 --out /dev/full
        check 'animation: a full disk' complained animation 1
    else
        skip 'animation: a full disk' 'no /dev/full here'
    fi
}

# A frame is the three lines "P6", "50 50", "255", then the pixels.
holds_frames() {
    frames=$(sed 's/frames=\([0-9]*\) .*/\1/' stdout)
    [ "$(head -n 1 "$1")" = P6 ] && [ "$(sed -n 2p "$1")" = '50 50' ] &&
        [ "$(wc -c <"$1")" -eq $((frames * (13 + 50 * 50 * 3))) ]
}

aggregate_line='^particles=[0-9]+ rg=[0-9.e+]+ radius=[0-9.e+]+ seconds=[0-9.]+$'

test_aggregate() {
    for scene in witten-sander 'witten-sander --lattice hexagonal --contact entry' 'line --lattice cubic --depth 20' \
        electrolysis 'electrolysis --interaction 5 --cathode 20,40 --launch 10,50' 'shore --hardness 1,5' \
        'chimney --walls 0,39,5,34' snowflake 'laboratory --launch-radius 20 --end-radius 15' off-lattice \
        'cluster-cluster --density 0.1'; do
        # shellcheck disable=SC2086
        run aggregate --particles 60 --width 60 --height 60 --scene $scene --size 64 --out scene.png
        [ "$code" -ne 0 ] || code=$(is_png scene.png; echo $?)
        check "aggregate --scene $scene" printed "$aggregate_line"
    done
    run aggregate --particles 300 --seed 5 --sites sites --ply cloud.ply --vtk cloud.vtk
    check 'aggregate ends with the line' printed "$aggregate_line"
    check 'aggregate --sites: a line a particle' [ "$(lines sites)" -eq 300 ]
    check 'aggregate --sites: the seed comes first' [ "$(head -n 1 sites)" = '0 0' ]
    check 'aggregate --ply' grep -aq '^element vertex 300$' cloud.ply
    check 'aggregate --vtk' grep -q '^POINTS 300 float$' cloud.vtk
    run aggregate --particles 300 --seed 5 --threads 2 --sites threads
    check 'aggregate --threads gives the same sites' cmp -s sites threads
    run aggregate --particles 100 --seed 5 --save half.snow
    run aggregate --load half.snow --particles 300 --sites continued
    check 'aggregate: saved and continued, the same sites' cmp -s sites continued
    awk 'BEGIN { for (y = -9; y <= 9; y++) for (x = -9; x <= 9; x++) if (int(sqrt(x * x + y * y)) == 8) print x, y }' >ring
    run aggregate --start ring --particles 300 --sites grown
    head -n "$(lines ring)" grown >begun
    check 'aggregate --start: a ring comes first' cmp -s ring begun
    check 'aggregate --start: and grows' [ "$(lines grown)" -eq 300 ]
    run aggregate --obstacles ring --particles 300
    check 'aggregate --obstacles: a ring shuts the seed in' complained aggregate 2
    grep -vx '0 -8' ring >gap
    run aggregate --obstacles gap --particles 300 --sites grown --size 64 --out gap.png
    check 'aggregate --obstacles: through a gap' printed "$aggregate_line"
    check 'aggregate --obstacles: a picture' is_png gap.png
    check 'aggregate --obstacles: none is filled' [ -z "$(sort gap grown | uniq -d)" ]
    echo '1 2 x' >wrong
    run aggregate --start wrong
    check 'aggregate --start: not a site' complained aggregate 2
    : >wrong
    run aggregate --start wrong
    check 'aggregate --start: no site' complained aggregate 2
    run aggregate --start nowhere
    check 'aggregate --start: no file' complained aggregate 2
    run aggregate --load half.snow --seed 4
    check 'a growth that is loaded is not described again' complained aggregate 2
    run aggregate --checkpoint 5
    check 'aggregate --checkpoint goes with --save' complained aggregate 2
    for option in '--stick 0' '--stick 1.5' '--scene electrolysis --interaction -1' '--scene shore --hardness 5,2' \
        '--scene electrolysis --launch 300,400' '--scene chimney --walls 9,9,0,9' '--scene nowhere' '--hits 0' \
        '--launch 1' '--scene cluster-cluster --density 2'; do
        # shellcheck disable=SC2086
        run aggregate $option --out wrong.png
        check "aggregate $option" complained aggregate 2
    done
    check 'wrong commands leave nothing' nothing_left wrong.png
}

: >stdout
: >stderr
test_hello
if built snowflake; then
    test_help
    test_line
    test_packard
    test_presets
    test_pictures
    test_continue
    test_wrong
    test_disk
    test_interrupt
    test_checkpoint
    test_sheets
    test_animation
    test_aggregate
else
    skip 'all others' 'built without libpng'
fi
echo "1..$number"
