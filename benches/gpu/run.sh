#!/bin/bash
# Measures a GPU in one call, in at most six minutes: the kernels' tests, and the work a second of methods
# `iteration`, `hierarchy` and `certified`, and of closest points, beside the CPU of the same machine.
#
#     benches/gpu/run.sh OUT.csv COMMAND [TEST …]
#
# COMMAND is the built `nurbs-hausdorff`; each TEST a built binary of tests of kernels, as
# `cargo test --release --no-run --test gpu` and `--lib` name them (of the latter, the tests of `gpu::` run). Nothing is
# built and nothing is fetched: bash, awk and timeout are needed. Tests that need files of the checkout run in it.
#
# OUT.csv has a line for each measurement, with the name of the adapter, so that lines of several machines may follow
# each other. The models of the first two methods are sheets of 9,025 bicubic patches, one above the other. Method
# `certified` uses a GPU only while thousands of cells wait, as for the exact offsets among the tests, which print
# their cells and seconds on both processors: its lines are taken from there. Closest points are timed by the clock,
# with the command's start, of points about the lower sheet; `decided` has those that the GPU decided as its work.
#
# Exit status: 0 if all was measured, 1 if a test failed or a measurement is missing, 2 for bad usage, 3 without an adapter.
set -u

# Seconds for all, for the tests, and for one measurement.
TOTAL=350
FOR_TESTS=150
FOR_ONE=60

# The number of points of which the closest ones are measured.
POINTS=200000

if [ $# -lt 2 ]; then
  sed -n '2,/^set/p' "$0" | sed '$d; s/^# \{0,1\}//' >&2
  exit 2
fi
out=$1 command=$2
shift 2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
status=0
SECONDS=0

# The seconds left for a step that may take this many.
left() {
  local rest=$((TOTAL - SECONDS))
  echo $((rest < $1 ? (rest > 1 ? rest : 1) : $1))
}

# The value of a name in the JSON of standard input: a number, text without quotes, or the sum of a list.
value() {
  grep -oE "\"$1\":(\"[^\"]*\"|\[[^]]*\]|[^,}]*)" | head -n 1 | sed 's/^[^:]*://; s/"//g' |
    awk '/^\[/ { gsub(/[][]/, ""); count = split($0, all, ","); for (k = 1; k <= count; k++) sum += all[k]; print sum; next } 1'
}

# A sheet of 98 x 98 control points over a square of side 100, at a height, with noise of its own seed about it.
sheet() { # height noise seed
  awk -v height="$1" -v noise="$2" -v seed="$3" 'BEGIN {
    n = 98
    knots = "0,0,0,0"
    for (k = 1; k < n - 3; k++) knots = knots "," k
    knots = knots "," (n - 3) "," (n - 3) "," (n - 3) "," (n - 3)
    printf "{\"surfaces\":[{\"degree\":[3,3],\"knots_u\":[%s],\"knots_v\":[%s],\"ctrl\":[", knots, knots
    state = seed
    for (i = 0; i < n; i++) {
      printf "%s[", i ? "," : ""
      for (j = 0; j < n; j++) {
        # Park and Miller, which every awk computes exactly.
        state = (state * 16807) % 2147483647
        wave = 3 * sin(0.21 * i) * cos(0.17 * j)
        printf "%s[%.17g,%.17g,%.17g,1]", j ? "," : "", i * 100 / (n - 1), j * 100 / (n - 1), height + wave + noise * state / 2147483647
      }
      printf "]"
    }
    print "]}]}"
  }' /dev/null
}

# Adds a line: what was measured, on which processor, its unit, the work, seconds, and the work a second.
record() { # measurement processor unit work seconds
  awk -v adapter="$adapter" -v what="$1" -v on="$2" -v unit="$3" -v work="$4" -v seconds="$5" 'BEGIN {
    gsub(/"/, "\"\"", adapter)
    rate = work > 0 && seconds > 0 ? sprintf("%.6g", work / seconds) : ""
    printf "\"%s\",%s,%s,%s,%s,%s,%s\n", adapter, what, on, unit, work, seconds, rate
  }' >> "$out"
}

missing() {
  echo "missing: $1" >&2
  status=1
}

# Measures one method on one processor.
measure() { # method processor unit name-of-the-work arguments…
  local method=$1 on=$2 unit=$3 work=$4 json
  shift 4
  json=$(timeout "$(left $FOR_ONE)" "$command" distance "$folder/a.json" "$folder/b.json" --method "$method" \
    --backend "$on" --json "$@" 2> "$folder/error") || {
    missing "$method on $on: $(tail -n 1 "$folder/error")"
    return
  }
  [ "$on" = gpu ] && [ "$(value backend <<< "$json")" != gpu ] && missing "$method ran without the GPU"
  record "$method" "$on" "$unit" "$(value "$work" <<< "$json")" "$(value solve <<< "$json")"
}

sheet 0 0.5 1 > "$folder/a.json"
sheet 10 0.5 7 > "$folder/b.json"

first=$(timeout "$(left $FOR_ONE)" "$command" distance "$folder/a.json" "$folder/b.json" --method iteration --backend gpu \
  --samples 2 --json 2> "$folder/error") || {
  tail -n 1 "$folder/error" >&2
  exit 3
}
adapter=$(value adapter <<< "$first")
echo "adapter: $adapter"
[ -s "$out" ] || echo "adapter,measurement,processor,unit,work,seconds,per_second" > "$out"
record compile gpu kernels "" "$(value compile <<< "$first")"

# `seconds.solve` leaves out what compiling the kernels takes.
for on in gpu cpu; do
  measure iteration $on samples samples --samples 256
  measure hierarchy $on pairs pairs --grid 64
done
# So few samples do not fill hardware, and a software adapter takes long for more.
if awk -v seconds="$(awk -F, '/,iteration,gpu,/ { print $(NF - 1) }' "$out" | tail -n 1)" 'BEGIN { exit !(seconds < 2) }'; then
  for on in gpu cpu; do measure iteration $on samples samples --samples 1024; done
fi

# Random points in the box of the lower sheet and as far above it as the other one.
points() { # count
  awk -v count="$1" 'BEGIN {
    state = 11
    for (k = 0; k < count; k++) {
      for (axis = 0; axis < 3; axis++) { state = (state * 16807) % 2147483647; at[axis] = state / 2147483647 }
      printf "%.17g %.17g %.17g\n", 100 * at[0], 100 * at[1], 20 * at[2] - 5
    }
  }' /dev/null
}

points $POINTS > "$folder/points.xyz"
for on in gpu cpu; do
  began=$(date +%s.%N)
  timeout "$(left $FOR_ONE)" "$command" closest-points "$folder/a.json" "$folder/points.xyz" --relative-tolerance 1e-6 \
    --backend "$on" > "$folder/text" 2> "$folder/error" || {
    missing "closest points on $on: $(tail -n 1 "$folder/error")"
    continue
  }
  seconds=$(awk -v began="$began" -v ended="$(date +%s.%N)" 'BEGIN { print ended - began }')
  record closest-points $on points $POINTS "$seconds"
  decided=$(grep -oE '[0-9]+ decided on the GPU' "$folder/text" | cut -d ' ' -f 1)
  [ "$on" = cpu ] || record closest-points $on decided "${decided:-0}" "$seconds"
done

for test in "$@"; do
  name=$(basename "$test" | sed 's/-[0-9a-f]*$//')
  # The library's own tests are many; those of kernels are in one folder.
  filter=()
  [ "$name" = gpu ] || filter=(gpu::)
  began=$SECONDS
  # One after another, since they share the adapter and some are timed.
  timeout "$(left $FOR_TESTS)" "$test" --nocapture --test-threads 1 ${filter[@]+"${filter[@]}"} > "$folder/tests" 2>&1 || {
    missing "tests of $name"
    grep -E '^test .* FAILED|panicked' "$folder/tests" | head -n 20 >&2
  }
  # "NAME, Gpu: [LOWER, UPPER], N cells, M of them on the CPU, L levels, S s", with commas in names too.
  sed -nE 's/^(test .* \.\.\. )?(.*), (Gpu|Cpu): \[.*\], ([0-9]+) cells, .* levels, ([0-9.]+) s$/\2;\3;\4;\5/p' \
    "$folder/tests" > "$folder/cells"
  while IFS=';' read -r pair on cells seconds; do
    record "certified ${pair//,/}" "$(tr '[:upper:]' '[:lower:]' <<< "$on")" cells "$cells" "$seconds"
  done < "$folder/cells"
  counts=$(grep -E '^test result' "$folder/tests" | tail -n 1)
  for outcome in passed failed; do
    count=$(grep -o "[0-9]* $outcome" <<< "$counts" | cut -d ' ' -f 1)
    record "tests-$name" gpu "$outcome" "${count:-0}" "$((SECONDS - began))"
  done
done

echo "$SECONDS s, $out:"
cat "$out"
exit $status
