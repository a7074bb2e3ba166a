#!/usr/bin/env bash
# Measures, and draws what was measured: docs/benchmarks/*.csv and *.svg. `./bench.sh quick` takes smaller shapes, and a few
# minutes. Names of commands after that measure those only; all pictures are drawn.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/eng/setup.sh"

# Runs the tests of a filter, each of which writes a file of the worst that it met, and puts these together as one table.
measure_stability() {
    local table="$1" category="$2" command="$3" fragments="$results/$1"
    FRACTALENGINE_STABILITY="$fragments" run_tests "$results" "FullyQualifiedName~FractalEngine.Tests.Stability.&$category"
    [ "$skipped" = 0 ] || fail "tests of stability were skipped, since there is no display: nothing is written"
    [ "$failed" = 0 ] && [ "$passed" != 0 ] || fail "tests of stability failed: nothing is written"
    # Files in one order everywhere. Machine and header are the same in all.
    local LC_ALL=C file="docs/benchmarks/$table.csv"
    local files=("$fragments"/*.csv)
    if ! { echo "# $command" && sed -n 2,3p "${files[0]}" && tail -qn +4 "${files[@]}"; } >"$file.tmp"; then
        rm -f "$file.tmp"
        fail "can't write $file"
    fi
    mv "$file.tmp" "$file"
}

options=()
if [ "${1:-}" = quick ]; then
    options=(--quick)
    shift
fi

commands=(front growth paper stability)
[ $# = 0 ] || commands=("$@")

install_packages plots
for command in "${commands[@]}"; do
    if [ "$command" = stability ]; then
        build FractalEngine.Tests
    else
        build FractalEngine.Benchmarks
    fi
done
command -v gnuplot >/dev/null || fail 'gnuplot is missing'

benchmarks=("$root/FractalEngine.Benchmarks/bin/$configuration/net10.0/FractalEngine.Benchmarks")
[ -x "${benchmarks[0]}" ] || benchmarks=(dotnet "${benchmarks[0]}.dll")
# What draws needs a display.
if [ -z "${DISPLAY:-}" ] && command -v xvfb-run >/dev/null; then
    benchmarks=(xvfb-run -a -s '-screen 0 1280x720x24 -noreset' "${benchmarks[@]}")
fi

cd "$root"
results="$(mktemp -d)"
trap 'rm -rf "$results"' EXIT
FRACTALENGINE_COMMIT="$(git rev-parse --short HEAD 2>/dev/null || echo unknown)"
export FRACTALENGINE_COMMIT
# What the compiler learns from the first shapes would make the order of rows count.
export DOTNET_TieredPGO=0

for command in "${commands[@]}"; do
    if [ "$command" = stability ]; then
        measure_stability stability 'Category!=Soak' "stability${options[*]:+ ${options[*]}}"
        # The long counts have a table of their own, which the quick ones leave as it is.
        if [ "${#options[@]}" = 0 ]; then
            measure_stability stability-soak 'Category=Soak' stability
        fi
        continue
    fi

    # The paper's models have one size.
    sized=("${options[@]}")
    [ "$command" != paper ] || sized=()
    "${benchmarks[@]}" "$command" "${sized[@]}" --output docs/benchmarks </dev/null || fail "the command '$command' failed"
done

for plot in eng/plots/*.gp; do
    gnuplot "$plot" || fail "gnuplot can't draw $plot"
done
