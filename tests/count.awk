# Counts test cases in meson's testlog.json, one line of JSON a test: the cases of a cmocka program and those
# of a TAP script one by one, any other test as one. A program that ends badly without naming a failed case
# (a crash, a sanitizer, a time limit) counts as one failure.
# Prints "passed failed skipped".

function number(line) {
    gsub(/[^0-9]/, "", line)
    return line + 0
}

{
    match($0, /"result": "[A-Z]*"/)
    result = substr($0, RSTART + 11, RLENGTH - 12)
    ok = result == "OK" || result == "EXPECTEDFAIL"
    cases = good = bad = left = 0

    lines = split($0, line, /\\n|"stdout": "|"stderr": "/)
    for (i = 1; i <= lines; i++) {
        if (line[i] ~ /^\[==========\] [0-9]+ test\(s\) run\./) { cases = 1 }
        else if (line[i] ~ /^\[  PASSED  \] [0-9]+ test\(s\)/) good += number(line[i])
        else if (line[i] ~ /^\[  FAILED  \] [0-9]+ test\(s\)/) bad += number(line[i])
        else if (line[i] ~ /^\[  SKIPPED \] [0-9]+ test\(s\)/) left += number(line[i])
        else if (line[i] ~ /^ok [0-9]+ .*# SKIP/) { cases = 1; left++ }
        else if (line[i] ~ /^ok [0-9]+/) { cases = 1; good++ }
        else if (line[i] ~ /^not ok [0-9]+/) { cases = 1; bad++ }
    }
    if (!cases) {
        good = ok
        left = result == "SKIP"
        bad = !good && !left
    } else if (!ok && result != "SKIP" && bad == 0) {
        bad = 1
    }
    passed += good
    failed += bad
    skipped += left
}

END { print passed + 0, failed + 0, skipped + 0 }
