#!/usr/bin/env bash
# Measures, and draws what was measured: docs/benchmarks/*.csv and *.svg. `./bench.sh quick` takes smaller shapes, and some
# minutes; its tables go to out/benchmarks, and no plots are drawn. With `--runs 5` each command runs five times, and its tables
# have medians, and how far the runs lie apart. Names of commands after that measure those only.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/eng/setup.sh"

# Runs the tests of a filter, each of which writes a file of the worst that it met, and puts these together as one table.
measure_stability() {
    local table="$1" category="$2" command="$3" fragments="$results/$1"
    FRACTALENGINE_STABILITY="$fragments" run_tests "$results" "FullyQualifiedName~FractalEngine.Tests.Stability.&$category"
    [ "$skipped" = 0 ] || fail "tests of stability were skipped, since there is no display: nothing is written"
    [ "$failed" = 0 ] && [ "$passed" != 0 ] || fail "tests of stability failed: nothing is written"
    # Files in one order everywhere. Machine and header are the same in all.
    local - LC_ALL=C file="$folder/$table.csv"
    set +f
    local files=("$fragments"/*.csv)
    if ! { echo "# $command" && sed -n 2,3p "${files[0]}" && tail -qn +4 "${files[@]}"; } >"$file.tmp"; then
        rm -f "$file.tmp"
        fail "can't write $file"
    fi
    mv "$file.tmp" "$file"
}

quick=
folder=docs/benchmarks
if [ "${1:-}" = quick ]; then
    quick=yes
    folder=out/benchmarks
    shift
fi
runs=1
if [ "${1:-}" = --runs ]; then
    [[ "${2:-}" =~ ^[1-9][0-9]?$ ]] || fail "'--runs' expects a number from 1 to 99" 2
    runs="$2"
    shift 2
fi
mkdir -p "$root/$folder"

commands=(front growth loading precision rays trace light frames skips physics window paper approximate stability classes)
[ $# = 0 ] || commands=("$@")

classes='*'
[ -z "$quick" ] || classes='*.MeshColliderBenchmarks.* *.LoadingBenchmarks.*'

# Prints the words that a command is called with.
words() {
    case "$1" in
        front | growth | loading | precision | rays | trace | light) echo "$1 ${quick:+--quick}" ;;
        frames) echo "frames ${quick:+menger:5:afar menger:5:inside --rounds 1 --no-truth}" ;;
        skips) echo "skips ${quick:+--rounds 1} --images $folder/skips" ;;
        physics) echo "physics ${quick:+--rounds 1}" ;;
        # The paper's models have one size, and a window one cost.
        window | paper) echo "$1" ;;
        # BenchmarkDotNet, with few iterations: what has to be told apart is measured in turns, by the commands.
        classes) echo "--artifacts out/benchmarkdotnet --job short --inProcess --iterationTime 100 --filter $classes" ;;
        *) fail "unknown command '$1'" 2 ;;
    esac
}

install_packages plots
for command in "${commands[@]}"; do
    if [ "$command" = stability ]; then
        build FractalEngine.Tests
    else
        words "$command" >/dev/null || exit 2
        # The window that is measured is the program's own.
        build FractalEngine.App
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

set -f # Stars are for BenchmarkDotNet.
for command in "${commands[@]}"; do
    if [ "$command" = stability ]; then
        measure_stability stability 'Category!=Soak' "stability${quick:+ --quick}"
        # The long counts have a table of their own, which the quick ones leave as it is.
        if [ -z "$quick" ]; then
            measure_stability stability-soak 'Category=Soak' stability
        fi
        continue
    fi

    words="$(words "$command")" || exit 2
    read -ra line <<<"$words"
    # Classes of BenchmarkDotNet know their spread.
    if [ "$runs" = 1 ] || [ "$command" = classes ]; then
        "${benchmarks[@]}" "${line[@]}" --output "$folder" </dev/null || fail "the command '$command' failed"
        continue
    fi

    folders=()
    for run in $(seq "$runs"); do
        folders+=("$results/$command/$run")
        "${benchmarks[@]}" "${line[@]}" --output "$results/$command/$run" </dev/null || fail "the command '$command' failed"
    done
    "${benchmarks[@]}" merge --output "$folder" "${folders[@]}" </dev/null || fail "the runs of '$command' can't be merged"
done
set +f

[ -z "$quick" ] || exit 0
for plot in eng/plots/*.gp; do
    gnuplot "$plot" || fail "gnuplot can't draw $plot"
done
