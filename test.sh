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
run_tests "$results" "$filter" "$@"
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" = 0 ] && [ "$passed" != 0 ]
