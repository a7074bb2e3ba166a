# Shared by run.sh, test.sh and bench.sh; sourced, not run. Brings a machine with the .NET SDK to where the engine builds and draws:
# packages (Debian and its relatives only), restore, build. Says nothing on stdout, and does nothing when all is there.

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
configuration=Release
export DOTNET_NOLOGO=1 DOTNET_CLI_TELEMETRY_OPTOUT=1 DOTNET_SKIP_FIRST_TIME_EXPERIENCE=1 DOTNET_GENERATE_ASPNET_CERTIFICATE=false
# Servers that outlive a build keep memory, and the pipe of whoever waits for the script's output.
export MSBUILDDISABLENODEREUSE=1

fail() {
    printf 'error: %s\n' "$1" >&2
    exit "${2:-1}"
}

has_library() {
    # Debian keeps libraries below the machine's triplet; ldconfig knows them wherever they are.
    ldconfig -p 2>/dev/null | grep -q "$1" || ls /usr/lib/*/"$1"* >/dev/null 2>&1
}

# Prints the Debian packages that are missing; looks for files and commands, since asking apt takes a second.
missing_packages() {
    [ -e /usr/lib/cli/OpenTK-1.1/OpenTK.dll ] || echo libopentk1.1-cil
    has_library libGL.so.1 || echo libgl1
    { ls /usr/lib/*/dri/swrast_dri.so || ls /usr/lib/*/libgallium*; } >/dev/null 2>&1 || echo libgl1-mesa-dri
    command -v Xvfb >/dev/null || echo xvfb
    command -v xauth >/dev/null || echo xauth
    if [ "${1:-}" = tests ] || [ "${1:-}" = soak ]; then
        command -v xdotool >/dev/null || echo xdotool
        command -v script >/dev/null || echo bsdutils
    fi
    if [ "${1:-}" = soak ]; then
        command -v openbox >/dev/null || echo openbox
        command -v ffmpeg >/dev/null || echo ffmpeg
        # What exported files are opened with.
        command -v chromium >/dev/null || echo chromium
        command -v assimp >/dev/null || echo assimp-utils
        command -v admesh >/dev/null || echo admesh
        command -v g++ >/dev/null || echo g++
        [ -d /usr/include/lib3mf ] || echo lib3mf-dev
    fi
    if [ "${1:-}" = plots ]; then
        command -v gnuplot >/dev/null || echo gnuplot-nox
    fi
}

install_packages() {
    command -v apt-get >/dev/null || return 0
    local packages log
    packages="$(missing_packages "$@")"
    [ -n "$packages" ] || return 0
    local sudo=()
    if [ "$(id -u)" != 0 ]; then
        command -v sudo >/dev/null || fail "missing packages, and no root or sudo to install them: $(echo $packages)"
        sudo=(sudo)
    fi
    log="$(mktemp)"
    # shellcheck disable=SC2086
    if ! { "${sudo[@]}" apt-get install -y --no-install-recommends $packages \
        || { "${sudo[@]}" apt-get update && "${sudo[@]}" apt-get install -y --no-install-recommends $packages; }; } \
        >"$log" 2>&1 </dev/null; then
        cat "$log" >&2
        rm -f "$log"
        fail "can't install $(echo $packages)"
    fi
    rm -f "$log"
}

# Tells whether no source is newer than a file.
is_up_to_date() {
    [ -e "$1" ] && [ -z "$(find "$root" -mindepth 1 \
        \( -name bin -o -name obj -o -name .git -o -name out -o -name assets -o -name docs \) -prune -o \
        \( -name '*.cs' -o -name '*.csproj' -o -name '*.props' -o -name '*.json' -o -name '.editorconfig' \
        -o -name '*.vert' -o -name '*.frag' -o -name '*.glsl' -o -name '*.atlas' -o -path '*/Templates/*' \) -newer "$1" -print -quit)" ]
}

# Runs a command of dotnet on a project, with further options.
run_dotnet() {
    local command="$1" project="$2"
    shift 2
    command -v dotnet >/dev/null || fail "the .NET SDK 10 is missing: see https://dotnet.microsoft.com/download"
    dotnet "$command" "$root/$project" -p:Configuration="$configuration" -v quiet -nodeReuse:false --disable-build-servers "$@" </dev/null
}

# Says so on a terminal where a build takes more than two seconds. Stop it by stop_announcing.
announcer=
announce_build() {
    [ -t 2 ] || return 0
    { sleep 2 && printf 'building %s, which takes up to two minutes the first time ...\n' "$1" >&2; } </dev/null >/dev/null &
    announcer=$!
}

stop_announcing() {
    [ -z "$announcer" ] || kill "$announcer" 2>/dev/null || true
    announcer=
}

# Builds a project if a source is newer than its last build; further arguments go to `dotnet build`.
build() {
    local project="$1" stamp="$root/$1/obj/built.stamp" log
    shift
    is_up_to_date "$stamp" && return 0
    log="$(mktemp)"
    touch "$log"
    announce_build "$project"
    if ! run_dotnet build "$project" "$@" >"$log" 2>&1; then
        stop_announcing
        cat "$log" >&2
        rm -f "$log"
        fail "the build of $project failed"
    fi
    stop_announcing
    mkdir -p "$(dirname "$stamp")"
    touch -r "$log" "$stamp"
    rm -f "$log"
}

# Builds a program with code that is compiled ahead of time, in its folder bin/ready: most commands then take half as long. The
# compiler for that is a package. Where it can't be had there is no such folder, but the ordinary build. Who only runs it waits a third
# of the time without the analyzers, which tests build with.
ready_options=(--use-current-runtime -p:SelfContained=false -p:PublishReadyToRun=true -p:RunAnalyzers=false)
build_ready() {
    local project="$1" stamp="$root/$1/obj/ready.stamp" ready="$root/$1/bin/ready" start
    is_up_to_date "$stamp" && return 0
    start="$(mktemp)"
    announce_build "$project"
    if ! { rm -rf "$ready" && run_dotnet publish "$project" "${ready_options[@]}" -o "$ready" >/dev/null 2>&1; }; then
        stop_announcing
        rm -rf "$ready"
        build "$project" -p:RunAnalyzers=false
    fi
    stop_announcing
    mkdir -p "$(dirname "$stamp")"
    touch -r "$start" "$stamp"
    rm -f "$start"
}

# Downloads what build_ready needs, before a first build.
restore_ready() {
    [ -e "$root/$1/obj/ready.stamp" ] || run_dotnet restore "$1" "${ready_options[@]}" >/dev/null 2>&1
}

# Gives the tests the program as run.sh starts it, compiled ahead of time: they start it hundreds of times.
use_ready_program() {
    local assembly ready="$root/FractalEngine.App/bin/ready" tests="$root/FractalEngine.Tests/bin/$configuration/net10.0"
    build_ready FractalEngine.App
    for assembly in "$ready"/*.dll; do
        if [ -e "$assembly" ] && ! cmp -s "$assembly" "$tests/${assembly##*/}"; then
            cp "$assembly" "$tests/"
        fi
    done
}

# Runs the tests of a filter, built before; further arguments go to `dotnet test`. Leaves a protocol in the folder, and sets
# $passed, $failed and $skipped.
run_tests() {
    local results="$1" filter="$2" status=0
    shift 2
    local command=(dotnet test "$root/FractalEngine.Tests" -c "$configuration" --no-build --nologo --filter "$filter"
        --logger "trx;LogFileName=tests.trx" --logger "console;verbosity=minimal" --results-directory "$results" "$@")
    # Tests draw on a display of their own, so that windows and the user's keyboard don't meet. It must not reset between two
    # programs (-noreset): who connects just then is turned away.
    if command -v xvfb-run >/dev/null; then
        command=(xvfb-run -a -s '-screen 0 1280x960x24 -noreset' "${command[@]}")
    fi
    # What a shell starts in the background ignores interrupts, and so would the programs that tests interrupt.
    if env --default-signal=INT true 2>/dev/null; then
        command=(env --default-signal=INT "${command[@]}")
    fi
    # Profiles for the compiler cost tests more than they gain: most code runs for a moment.
    # So does compiling well what runs some dozens of times: programs that tests start live for a second.
    # And new objects have 64 MB before a collection, where the caches of a virtual machine, which may not be told, would give them
    # one: a fifth of the processor time of all tests.
    DOTNET_TieredPGO=0 DOTNET_TC_CallCountThreshold=100 DOTNET_GCgen0size=0x4000000 "${command[@]}" </dev/null || status=$?
    passed="$(count_results "$results" Passed)"
    failed="$(count_results "$results" Failed)"
    skipped="$(count_results "$results" NotExecuted)"
    # A test host that crashed leaves no results, or results without the failure.
    if [ "$status" != 0 ] && [ "$failed" = 0 ]; then
        failed=1
    fi
}

count_results() {
    grep -o '<UnitTestResult [^>]*outcome="[^"]*"' "$1/tests.trx" 2>/dev/null | grep -c "outcome=\"$2\"" || true
}

# How the reasons of tests begin that are not meant for the machine, as in FractalEngine.Tests/Support/Elsewhere.cs.
elsewhere='not meant for this system: '

# Prints each reason of skipped tests with their number before it, the most frequent first.
skip_reasons() {
    awk 'BEGIN { RS = "<UnitTestResult " } /^[^>]*outcome="NotExecuted"/ {
        reason = "no reason is given"
        if (match($0, /<(Message|StdOut)>[^<]*/)) {
            reason = substr($0, RSTART, RLENGTH)
            sub(/^<[A-Za-z]*>/, "", reason)
            gsub(/[\r\n]+/, " ", reason)
        }
        gsub(/&amp;/, "\\&", reason); gsub(/&quot;/, "\"", reason); gsub(/&apos;|&#39;/, "\047", reason)
        gsub(/^ +| +$/, "", reason)
        print reason
    }' "$1/tests.trx" 2>/dev/null | sort | uniq -c | sort -rn
}

# Tells what was skipped and why. Fails where a test was skipped that is meant for the machine.
report_skips() {
    local count reason status=0
    while read -r count reason; do
        case "$reason" in
            "$elsewhere"*) echo "skipped $count: $reason" ;;
            *)
                echo "skipped $count that could run: $reason"
                status=1
                ;;
        esac
    done < <(skip_reasons "$1")
    return "$status"
}
