#!/usr/bin/env bash
# Compares A with B, writes the job's summary and, if JUNIT names a file, that file. The exit status
# is that of the command.
set -uo pipefail

# The options are words, none of which is a pattern for this shell.
set -f
read -r -a options <<<"$OPTIONS"

compare() {
  npx --yes "nurbs-hausdorff@$VERSION" "$COMMAND" "$A" "$B" "${options[@]}" --reuse "$REUSE" --format "$1"
}

compare markdown >>"$GITHUB_STEP_SUMMARY"
status=$?
# The answers are there already: only their form is another.
if [[ -n "$JUNIT" ]]; then
  compare junit >"$JUNIT"
fi
exit "$status"
