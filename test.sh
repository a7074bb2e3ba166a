#!/usr/bin/env bash
# Runs all tests; `./test.sh soak` runs those with long counts. Further arguments go to `dotnet test`.
# The last line is "N passed, N failed, N skipped".
set -uo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/eng/setup.sh"

filter='Category!=Soak'
if [ "${1:-}" = soak ]; then
    filter='Category=Soak'
    shift
fi

install_packages tests
build FractalEngine.Tests

results="$(mktemp -d)"
trap 'rm -rf "$results"' EXIT
command=(dotnet test "$root/FractalEngine.Tests" -c "$configuration" --no-build --nologo --filter "$filter"
    --logger "trx;LogFileName=tests.trx" --logger "console;verbosity=minimal" --results-directory "$results" "$@")
# Tests draw on a display of their own, so that windows and the user's keyboard don't meet. It must not reset between two
# programs (-noreset): who connects just then is turned away.
if command -v xvfb-run >/dev/null; then
    command=(xvfb-run -a -s '-screen 0 1280x960x24 -noreset' "${command[@]}")
fi
"${command[@]}" </dev/null
status=$?

count() {
    grep -o '<UnitTestResult [^>]*outcome="[^"]*"' "$results/tests.trx" 2>/dev/null | grep -c "outcome=\"$1\"" || true
}

passed="$(count Passed)"
failed="$(count Failed)"
skipped="$(count NotExecuted)"
# A test host that crashed leaves no results, or results without the failure.
if [ "$status" != 0 ] && [ "$failed" = 0 ]; then
    failed=1
fi
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" = 0 ] && [ "$passed" != 0 ]
