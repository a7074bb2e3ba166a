#!/usr/bin/env bash
# Runs all tests; `./test.sh soak` runs those with long counts, and then the tests against 50 mutants of the day. Further arguments go
# to `dotnet test`. The last line is "N passed, N failed, N skipped".
# `./test.sh mutants [--sample N] [--seed S] [--in FOLDER] [--only ID[,ID]]` says which small faults in the product the tests notice.
set -uo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/eng/setup.sh"

run_mutants() {
    build eng/Mutants
    dotnet "$root/eng/Mutants/bin/$configuration/net10.0/Mutants.dll" "$@"
}

if [ "${1:-}" = mutants ]; then
    shift
    install_packages tests
    run_mutants "$@"
    exit
fi

soak=
filter='Category!=Soak'
if [ "${1:-}" = soak ]; then
    soak=yes
    filter='Category=Soak'
    shift
fi

install_packages tests
build FractalEngine.Tests

results="$(mktemp -d)"
trap 'rm -rf "$results"' EXIT
run_tests "$results" "$filter" "$@"
if [ -n "$soak" ] && [ $# = 0 ]; then
    # Another draw each day. So few may miss the demanded share by chance, which is allowed for.
    run_mutants --sample 50 --seed "$(date +%F)" --allow-chance || failed=$((failed + 1))
fi
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" = 0 ] && [ "$passed" != 0 ]
