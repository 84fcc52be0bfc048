#!/bin/bash
# Times AUTO-07p on the problems in this folder and prints a Markdown table, for RESULTS.md:
#
#     bash benches/auto-07p/run.sh             all problems, 10 minutes
#     bash benches/auto-07p/run.sh bratu swirl only these
#
# Needs AUTO-07p and gfortran: apt-get install auto-07p gfortran. For AUTO built from its sources set
# AUTO_DIR; its objects must be in $AUTO_DIR/lib.
#
# The equations stand at the top of each NAME.f90, AUTO's constants in c.NAME. Time is the user time
# of one thread, less that of the same number of runs of the starting point alone (start of the
# process, constants, first direction): the least of the rounds, divided by the runs.
set -euo pipefail
cd "$(dirname "$0")"
export AUTO_DIR=${AUTO_DIR:-/usr/lib/auto-07p} OMP_NUM_THREADS=1 LC_ALL=C
if ! [ -f "$AUTO_DIR/lib/main.o" ] || ! command -v gfortran >/dev/null; then
    echo "run.sh: no AUTO-07p in $AUTO_DIR or no gfortran: apt-get install auto-07p gfortran" >&2
    exit 1
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for source in *.f90; do
    gfortran -O2 -fopenmp "$source" "$AUTO_DIR"/lib/*.o -o "$work/${source%.f90}"
done

# constants NAME OVERRIDES: AUTO's input; of a constant given twice it takes the last value.
constants() {
    { cat "c.$1"; echo "$2"; } >"$work/fort.2"
}
# run NAME: fort.7 holds the branch, fort.9 the iterations. AUTO's messages are not needed.
run() {
    (cd "$work" && "./$1" >/dev/null 2>&1)
}
# seconds NAME RUNS ROUNDS: least user time of the rounds.
seconds() {
    local TIMEFORMAT=%U round i
    for ((round = 0; round < $3; round++)); do
        { time for ((i = 0; i < $2; i++)); do run "$1"; done; } 2>&1
    done | sort -g | head -n 1
}
# row NAME EQUATIONS INTERVALS TOLERANCE RUNS ROUNDS OVERRIDES: one line of the table.
wanted=" $* "
row() {
    local time=() jac set fastest other start counts points
    [ "$wanted" = "  " ] || [[ $wanted == *" $1 "* ]] || return 0
    set="EPSL = $4, EPSU = $4${7:+, $7}"
    for jac in 0 1; do
        constants "$1" "$set, JAC = $jac, NMX = 1"
        start=$(seconds "$1" "$5" "$6")
        constants "$1" "$set, JAC = $jac"
        time[jac]=$(echo "$(seconds "$1" "$5" "$6") $start $5" | awk '{ print ($1 - $2) / $3 }')
    done
    fastest=$(echo "${time[*]}" | awk '{ print ($2 <= $1) }')
    other=$((1 - fastest))
    constants "$1" "$set, JAC = $fastest, IID = 2"
    run "$1"
    # Lines "branch point iteration parameter norm" of fort.9; "branch point type label parameter"
    # of fort.7, where type 5 (2 in algebraic systems) is a limit point. AUTO stops the search for it
    # by the length of the step; where its fold function is then not small the point is marked "≈".
    counts=$(awk 'NF == 5 && $3 ~ /^[1-9]$/ { n++ } END { print n }' "$work/fort.9")
    points=$(awk '
        FILENAME ~ /9$/ && /Fold Function/ { fold = $NF }
        FILENAME ~ /9$/ && /Convergence/ { at[++found] = fold }
        FILENAME ~ /7$/ && $1 != 0 && ($3 == 5 || $3 == 2) {
            printf "%s%s%.11g", separator, (at[++k]^2 > 1e-8 ? "≈ " : ""), $5
            separator = ", "
        }' "$work/fort.9" "$work/fort.7")
    awk -v cpu="${time[fastest]}" -v cpu_other="${time[other]}" -v n="$counts" -v lp="${points:--}" \
        -v head="| $1 | $2 | $3 | $4 | $fastest" '
        $1 != 0 { steps++ }
        END {
            steps-- # the first point is given
            printf "%s | %d | %d | %.3g | %.3g | %.3g | %.3g | %s |\n", head, steps, n, cpu,
                1e3 * cpu / steps, 1e3 * cpu / n, 1e3 * cpu_other / steps, lp
        }' "$work/fort.7"
}

version=$(dpkg-query -W -f '${Version}' auto-07p 2>/dev/null || echo "of $AUTO_DIR")
echo "- machine: $(lscpu | sed -n 's/^Model name: *//p' | head -n 1), $(nproc --all) cores, one used"
echo "- AUTO-07p: $version, $(gfortran --version | head -n 1)"
echo "- date: $(date +%F)"
echo "- command: \`bash benches/auto-07p/run.sh${*:+ $*}\`"
echo
echo "| problem | equations | NTST | EPSL | JAC | steps | iterations | CPU, s | ms per step |" \
    "ms per iteration | ms per step, other JAC | limit points |"
echo "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- |"
for eps in 1e-7 1e-10; do
    row bratu 2 10 $eps 100 3 "NTST = 10"
    row bratu 2 100 $eps 10 3 "NTST = 100"
    row bratu 2 1000 $eps 1 3 "NTST = 1000"
done
for eps in 1e-7 1e-10; do
    row swirl 5 100 $eps 5 3 ""
done
for eps in 1e-7 1e-10; do
    row copies 4 50 $eps 20 3 "NDIM = 4, NBC = 4, NMX = 100"
    row copies 8 50 $eps 5 3 "NDIM = 8, NBC = 8, NMX = 100"
    row copies 16 50 $eps 1 3 "NDIM = 16, NBC = 16, NMX = 120"
done
row copies 32 50 1e-7 1 3 "NDIM = 32, NBC = 32, NMX = 150"
row copies 64 50 1e-7 1 1 "NDIM = 64, NBC = 64, NMX = 180"
row points 999 - 1e-7 1 1 ""
