#!/usr/bin/env bash
# Measures, and draws what was measured: docs/benchmarks/*.csv and *.svg. `./bench.sh quick` takes smaller shapes, and a few
# minutes. Names of commands after that measure those only; all pictures are drawn.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/eng/setup.sh"

options=()
if [ "${1:-}" = quick ]; then
    options=(--quick)
    shift
fi

commands=(front growth paper)
[ $# = 0 ] || commands=("$@")

install_packages plots
build FractalEngine.Benchmarks
command -v gnuplot >/dev/null || fail 'gnuplot is missing'

benchmarks=("$root/FractalEngine.Benchmarks/bin/$configuration/net10.0/FractalEngine.Benchmarks")
[ -x "${benchmarks[0]}" ] || benchmarks=(dotnet "${benchmarks[0]}.dll")
# What draws needs a display.
if [ -z "${DISPLAY:-}" ] && command -v xvfb-run >/dev/null; then
    benchmarks=(xvfb-run -a -s '-screen 0 1280x720x24 -noreset' "${benchmarks[@]}")
fi

cd "$root"
FRACTALENGINE_COMMIT="$(git rev-parse --short HEAD 2>/dev/null || echo unknown)"
export FRACTALENGINE_COMMIT
# What the compiler learns from the first shapes would make the order of rows count.
export DOTNET_TieredPGO=0

for command in "${commands[@]}"; do
    # The paper's models have one size.
    sized=("${options[@]}")
    [ "$command" != paper ] || sized=()
    "${benchmarks[@]}" "$command" "${sized[@]}" --output docs/benchmarks </dev/null || fail "the command '$command' failed"
done

for plot in eng/plots/*.gp; do
    gnuplot "$plot" || fail "gnuplot can't draw $plot"
done
