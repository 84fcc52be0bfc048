#!/bin/sh
# Runs all benches and prints their medians as Markdown, for RESULTS.md. Arguments go to criterion:
#
#     sh benches/record.sh --warm-up-time 0.5 --measurement-time 2
#
# "continuation" takes five minutes of it and prints, among criterion's messages, the number of steps
# and of factorisations of every curve.
set -eu
cd "$(dirname "$0")/.."
criterion="${CARGO_TARGET_DIR:-target}/criterion"
rm -rf "$criterion"
# Rows and columns in the order in which they were run: criterion keeps none, so it is noted here.
order=$(mktemp)
trap 'rm -f "$order"' EXIT
cargo bench -p benches --benches -- "$@" 2>&1 | tee /dev/stderr |
    sed -n 's/^Benchmarking \([^:]*\): Collecting .*/\1/p' >"$order"

processor=$(lscpu | sed -n 's/^Model name: *//p' | head -n 1)
echo "- machine: $processor, $(nproc) cores"
echo "- compiler: $(rustc --version)"
echo "- date: $(date +%F)"
echo "- command: \`sh benches/record.sh $*\`"

# One line per bench: group, row, column, median in nanoseconds.
field() {
    sed -n "s/.*\"$1\":\"\([^\"]*\)\".*/\1/p" "$2"
}
medians() {
    find "$criterion" -path '*/new/benchmark.json' | while read -r benchmark; do
        estimates="$(dirname "$benchmark")/estimates.json"
        median=$(sed 's/.*"median":{[^}]*},"point_estimate":\([-+.0-9e]*\).*/\1/' "$estimates")
        place=$(grep -n -x -F "$(field full_id "$benchmark")" "$order" | cut -d: -f1 | head -n 1)
        printf '%s\t%s\t%s\t%s\t%s\n' "$place" "$(field group_id "$benchmark")" \
            "$(field function_id "$benchmark")" "$(field value_str "$benchmark")" "$median"
    done
}
medians | sort -n | awk -F '\t' '
    function time(ns) {
        if (ns == "") return "";
        if (ns < 1e6) return sprintf("%.4g µs", ns / 1e3);
        return sprintf("%.4g ms", ns / 1e6);
    }
    function table(    r, c, line, rule) {
        line = "| "; rule = "| ---"
        for (c = 1; c <= columns; c++) { line = line " | " column[c]; rule = rule " | ---:" }
        printf "\n## %s\n\n%s |\n%s |\n", group, line, rule
        for (r = 1; r <= rows; r++) {
            line = "| " row[r]
            for (c = 1; c <= columns; c++) line = line " | " time(median[row[r], column[c]])
            print line " |"
        }
        split("", median); split("", seen); rows = columns = 0
    }
    $2 != group { if (group != "") table(); group = $2 }
    !(("r", $3) in seen) { seen["r", $3] = 1; row[++rows] = $3 }
    !(("c", $4) in seen) { seen["c", $4] = 1; column[++columns] = $4 }
    { median[$3, $4] = $5 }
    END { if (group != "") table() }
'
