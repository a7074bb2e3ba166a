#!/usr/bin/env bash
# Runs all tests; `./test.sh soak` runs those with long counts, opens exported files in other programs, and then runs the tests against
# 50 mutants of the day. Further arguments go to `dotnet test`.
# The last line is "N passed, N failed, N skipped", below what was skipped and why. A skip fails the run where installed packages
# would have run the test; `--allow-skips` is for those who can't have them.
# `./test.sh mutants [--sample N] [--seed S] [--in FOLDER] [--only ID[,ID]] [--faults FILE]` says which small faults in the product
# the tests notice.
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

filter='Category!=Soak'
packages=tests
allow_skips=
while [ "${1:-}" = soak ] || [ "${1:-}" = --allow-skips ]; do
    if [ "$1" = soak ]; then
        filter='Category=Soak'
        packages=soak
    else
        allow_skips=yes
    fi
    shift
done
soak=
[ "$packages" != soak ] || soak=yes

[ -n "$allow_skips" ] && [ "$packages" = soak ] && packages=tests
install_packages "$packages"
build FractalEngine.Tests
use_ready_program

results="$(mktemp -d)"
trap 'rm -rf "$results"' EXIT
run_tests "$results" "$filter" "$@"
if [ -n "$soak" ] && [ $# = 0 ]; then
    # Exported files in programs that are not the engine.
    for check in check-exports check-web-export; do
        "$root/eng/$check.sh" || failed=$((failed + 1))
    done
    # Another draw each day. So few may miss the demanded share by chance, which is allowed for.
    run_mutants --sample 50 --seed "$(date +%F)" --allow-chance || failed=$((failed + 1))
fi

skips=0
report_skips "$results" || skips=1
[ "$skips" = 0 ] || [ -n "$allow_skips" ] \
    || echo "error: tests were skipped that could run here: see the reasons above, or pass --allow-skips" >&2
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" = 0 ] && [ "$passed" != 0 ] && { [ "$skips" = 0 ] || [ -n "$allow_skips" ]; }
