#!/usr/bin/env bash
# Measures, and draws what was measured: docs/benchmarks/*.csv and *.svg. `./bench.sh quick` takes smaller shapes, and some
# minutes. Names of commands after that measure those only; all pictures are drawn.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/eng/setup.sh"

quick=
if [ "${1:-}" = quick ]; then
    quick=yes
    shift
fi

commands=(front growth loading precision frames skips physics window paper classes)
[ $# = 0 ] || commands=("$@")

classes='*'
[ -z "$quick" ] || classes='*.MeshColliderBenchmarks.* *.LoadingBenchmarks.* *.PrecisionBenchmarks.* --job short --inProcess --iterationTime 100'

# Prints the words that a command is called with.
words() {
    case "$1" in
        front | growth | loading | precision) echo "$1 ${quick:+--quick}" ;;
        frames) echo "frames ${quick:+menger:5:afar menger:5:inside --rounds 1 --no-truth}" ;;
        skips | physics) echo "$1 ${quick:+--rounds 1}" ;;
        # The paper's models have one size, and a window one cost.
        window | paper) echo "$1" ;;
        # Of BenchmarkDotNet: all, or three with few iterations.
        classes) echo "--artifacts out/benchmarkdotnet --filter $classes" ;;
        *) fail "unknown command '$1'" 2 ;;
    esac
}

install_packages plots
# The window that is measured is the program's own.
build FractalEngine.App
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

set -f # Stars are for BenchmarkDotNet.
for command in "${commands[@]}"; do
    words="$(words "$command")" || exit 2
    read -ra line <<<"$words"
    "${benchmarks[@]}" "${line[@]}" --output docs/benchmarks </dev/null || fail "the command '$command' failed"
done
set +f

for plot in eng/plots/*.gp; do
    gnuplot "$plot" || fail "gnuplot can't draw $plot"
done
