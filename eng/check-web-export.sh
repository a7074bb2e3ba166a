#!/usr/bin/env bash
# Checks pages of `export X.html` in a headless Chromium that draws on the processor (Debian's package chromium): how close they are to
# what `render` draws, that nothing is an error, how many frames a second one drags, sliders, and a zoom into many levels.
# The time is that of SwiftShader, minutes on two cores; a graphics card takes seconds.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
if ! command -v chromium >/dev/null; then
    echo "skipped: chromium is not installed (sudo apt install chromium)"
    exit 0
fi

out=$root/out/web
mkdir -p "$out"
program=$root/FractalEngine.App/bin/$configuration/net10.0/FractalEngine.App.dll
engine() { xvfb-run -a -s '-screen 0 1280x960x24 -noreset' dotnet "$program" "$@"; }
page() { python3 "$root/eng/web-page.py" "$@"; }
limit() {
    size=$(stat -c %s "$1")
    echo "$1: $size bytes"
    [ "$size" -le "$2" ] || { echo "more than $2 bytes"; exit 1; }
}

build FractalEngine.App
for name in fractals/menger.fdo fractals/fern.fdo fractals/tree.fdo scenes/gallery.sdo; do
    base=$out/$(basename "${name%.*}")
    engine export "$root/assets/$name" --output "$base.html"
    engine render "$root/assets/$name" --output "$base.png" --resolution 640x360
    # The gallery has surfaces that mirror, and pages have not.
    case $name in *gallery*) least=22 ;; *) least=25 ;; esac
    page "$base.html" 640x360 wait shot "$base-page.png" compare "$base.png" "$least"
done
limit "$out/menger.html" 60000
limit "$out/gallery.html" 200000
page "$out/menger.html" 640x360 drag 320,180 480,240 drag 480,240 300,150
engine render "$root/assets/fractals/fern.fdo" --output "$out/fern-lean.png" --resolution 640x360 --set lean=66
page "$out/fern.html" 640x360 slide lean 66 wait shot "$out/fern-moved.png" compare "$out/fern-lean.png" 20
engine export "$root/assets/fractals/infinite-menger.fdo" --output "$out/infinite.html"
page "$out/infinite.html" 640x360 wheel 265,165 8 wheel 320,180 12 wait shot "$out/deep.png" print viewer.nearest
