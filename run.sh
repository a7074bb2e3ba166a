#!/usr/bin/env bash
# Runs FractalEngine; does all the set-up that a machine with the .NET SDK needs. See README.md, or --help.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/eng/setup.sh"

# Help and messages name the program as it was called.
export FRACTALENGINE_PROGRAM="$0"

# What NuGet has is fetched while Debian's packages install.
restore_ready FractalEngine.App &
install_packages
wait
build_ready FractalEngine.App

app=("$root/FractalEngine.App/bin/ready/FractalEngine.App")
[ -e "${app[0]}.dll" ] || app=("$root/FractalEngine.App/bin/$configuration/net10.0/FractalEngine.App")
[ -x "${app[0]}" ] || app=(dotnet "${app[0]}.dll")

# Drawing needs OpenGL, and OpenGL needs a display. Without one, a virtual one serves for images; a window on it would
# be seen by nobody, so the program is told to draw that into a file.
if [ -z "${DISPLAY:-}" ] && command -v xvfb-run >/dev/null; then
    case "${1:-}" in
        info | count | export | check | save | generate | sky | query | simulate | limits | --help | -h | '-?' | --version) ;;
        *) FRACTALENGINE_NO_WINDOW=1 exec xvfb-run -a -s '-screen 0 1280x720x24 -noreset' "${app[@]}" "$@" ;;
    esac
fi
exec "${app[@]}" "$@"
