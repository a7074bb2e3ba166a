#!/usr/bin/env bash
# Draws the images of README.md and docs/ again: docs/images/*.png. Names after that draw those only: `eng/make-images.sh menger`.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

images="$root/docs/images"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
install_packages tests
build FractalEngine.App
cd "$root"

app=(dotnet "$root/FractalEngine.App/bin/$configuration/net10.0/FractalEngine.App.dll")

# Runs a command of the program where it can draw.
run() {
    if [ -z "${DISPLAY:-}" ]; then
        xvfb-run -a "${app[@]}" "$@" --quiet
    else
        "${app[@]}" "$@" --quiet
    fi
}

# draw NAME FILE SIZE [OPTION ...]
draw() { run render "$2" --output "$images/$1.png" --resolution "$3" "${@:4}"; }

# classic NAME CAMERA: one of the ten classics of the manual.
classic() { draw "classic-$1" "assets/classics/$1.fdo" 480x360 --background '(0.92, 0.93, 0.95)' --camera "$2"; }

# Shows a window of 1280 x 720 on a file, sends it what xdotool understands, and keeps what is seen.
window() {
    local name="$1" file="$2"
    shift 2
    # With the panels of a first start, and none that are remembered.
    XDG_CONFIG_HOME="$work/$name" xvfb-run -a -s '-screen 0 1280x720x24' bash -c '
        out="$1" file="$2"; shift 2
        "${@:1:2}" view "$file" --no-trace --resolution 1280x720 >/dev/null 2>&1 & pid=$!
        shift 2
        until xdotool search --onlyvisible --pid $pid >/dev/null 2>&1; do sleep 0.2; done
        sleep 8
        while [ $# != 0 ]; do eval "xdotool $1"; sleep 1.5; shift; done
        sleep 3
        import -window root "$out"
        kill $pid
    ' _ "$images/$name.png" "$file" "${app[@]}" "$@"
}

playground() {
    local time
    for time in 0 0.6 1.2 2.4 5 9; do
        run render assets/scenes/playground.sdo --time "$time" --output "$work/$time.png" --resolution 480x270
    done
    montage "$work"/{0,0.6,1.2,2.4,5,9}.png -tile 3x2 -geometry 480x270+2+2 -background white "$images/playground.png"
}

film() {
    local time
    for time in 0 3 5 6.5; do
        run render assets/scenes/dragon.sdo --time "$time" --output "$work/$time.png" --resolution 480x270
    done
    montage "$work"/{0,3,5,6.5}.png -tile 2x2 -geometry 480x270+2+2 -background white "$images/film.png"
}

planet() {
    local time
    for time in 0 3 6 10; do
        run render assets/scenes/planet.sdo --time "$time" --output "$work/$time.png" --resolution 480x270
    done
    montage "$work"/{0,3,6,10}.png -tile 2x2 -geometry 480x270+2+2 -background white "$images/planet.png"
}

# A row for each scene: without shadows and occlusion, with shadows, with both, traced.
light() {
    local scene tiles=()
    for scene in menger playground gallery; do
        draw_tile() { run render "assets/scenes/$scene.sdo" --output "$work/$scene-$1.png" --resolution 400x225 "${@:2}"; }
        draw_tile 1 --no-shadows --no-ambient-occlusion
        draw_tile 2 --no-ambient-occlusion
        draw_tile 3
        draw_tile 4 --trace 64
        tiles+=("$work/$scene"-{1,2,3,4}.png)
    done
    montage "${tiles[@]}" -tile 4x3 -geometry 400x225+2+2 -background white "$images/light.png"
}

# approximated NAME MODEL: mesh, fractal and distance side by side, at half the size. Code 6 says that there is no fractal.
approximated() {
    run approximate "$2" --output "$work/$1.fdo" --image "$work/$1.png" >/dev/null || [ $? = 6 ]
    convert "$work/$1.png" -scale 50% "$images/approximate-$1.png"
}

# approximated_asset NAME FOLDER [OPTION ...]: the same for an expanded fractal of the assets.
approximated_asset() {
    run export "assets/$2/$1.fdo" --no-materials --output "$work/models/$1.obj" "${@:3}"
    approximated "$1" "$work/models/$1.obj"
}

# approximated_sample NAME: the same for a model of the benchmarks.
approximated_sample() {
    [ -d "$work/samples" ] \
        || dotnet run -c "$configuration" --project FractalEngine.Benchmarks -- approximate samples "$work/samples" >/dev/null
    approximated "$1" "$work/samples/$1.obj"
}

make_image() {
    case "$1" in
        angles) draw "$1" assets/examples/angles.sdo 720x200 ;;
        tree-0[1-8]) draw "$1" "assets/examples/$1.fdo" 360x240 ;;
        tree-09) draw "$1" assets/examples/tree-09.sdo 360x240 ;;
        tree-10) draw "$1" assets/examples/tree-10.sdo 360x240 --time 0.9 ;;
        nave) draw "$1" assets/scenes/nave.sdo 640x360 --trace 64 ;;
        fireflies) draw "$1" assets/scenes/fireflies.sdo 640x360 --trace 24 ;;
        forest) draw "$1" assets/scenes/forest.sdo 880x495 ;;
        gallery) draw "$1" "assets/scenes/$1.sdo" 1280x720 ;;
        gradients | palettes) draw "$1" "assets/scenes/$1.sdo" 960x480 ;;
        appendix-b | inside | menger | textured | reef | cathedral | winter | wood | city) draw "$1" "assets/scenes/$1.sdo" 720x405 ;;
        conifer | coral | tower) draw "$1" "assets/scenes/$1.sdo" 480x320 ;;
        flake) draw "$1" "assets/scenes/$1.sdo" 320x320 ;;
        classic-bush) classic bush '(3.69, 2, -6.85) look-at (0.29, 1.18, -0.05) 25' ;;
        classic-context-tree) classic context-tree '(0, 6.16, -30.5) look-at (0, 6.16, 0) 27' ;;
        classic-arch) classic arch '(2.55, 2.04, -4.25) look-at (0.02, 0.73, 0) 28' ;;
        classic-synth-tree) classic synth-tree '(11.4, 7.6, -24.4) look-at (-1.2, 5.1, 0.8) 25' ;;
        classic-dragon) classic dragon '(0.42, 0.17, -3) look-at (0.42, 0.17, 0) 24' ;;
        classic-koch) classic koch '(3.25, 2.9, -4.8) look-at (0, 0, 0) 21' ;;
        classic-jerusalem) classic jerusalem '(1.5, 1.1, -3.4) look-at (0, -0.02, 0) 24' ;;
        classic-vicsek) classic vicsek '(1.3, 1.9, -4) look-at (0, 0.01, 0) 14' ;;
        classic-cantor) classic cantor '(1.7, 1.4, -4.4) look-at (0, -0.02, 0) 18' ;;
        classic-pythagoras) classic pythagoras '(6.14, 4.04, -9.83) look-at (0, 1.28, 0) 25' ;;
        traced-*) draw "$1" "assets/scenes/${1#traced-}.sdo" 640x360 --trace 64 ;;
        rowan) draw "$1" assets/examples/rowan.fdo 480x480 ;;
        agate) draw "$1" assets/scenes/agate.sdo 720x405 --section 1,1,1,0 --gather 16 ;;
        chrome) draw "$1" assets/scenes/chrome.sdo 720x405 --time 3 --trace 64 ;;
        playground | film | planet | light) "$1" ;;
        approximate-tree) approximated_asset tree fractals --depth 5 ;;
        approximate-romanesco) approximated_asset romanesco fractals --depth 2 ;;
        approximate-snowflake) approximated_asset snowflake fractals --depth 3 ;;
        approximate-menger-3) approximated_asset menger-3 fractals ;;
        approximate-arch) approximated_asset arch classics ;;
        approximate-*) approximated_sample "${1#approximate-}" ;;
        zoom)
            run animate assets/examples/zoom.sdo --zoom 1 --output "$work/zoom.apng" --frames 36 --fps 24 --resolution 320x180
            mv "$work/zoom.apng" "$images/zoom.png"
            ;;
        stair)
            run animate assets/scenes/stair.sdo --simulate --output "$work/stair.apng" --frames 48 --fps 12 --resolution 320x180
            mv "$work/stair.apng" "$images/stair.png"
            ;;
        window-fractal) window "$1" FractalEngine.Parsing/Templates/tree.fdo 'key F4' ;;
        window-keys) window "$1" assets/scenes/gallery.sdo 'key h' 'type view' ;;
        window-selection)
            window "$1" assets/scenes/playground.sdo 'key F6' 'key m' 'mousemove 300 575 click 1' 'mousemove 662 430 click 1' \
                'key m' 'mousemove 690 391 click 1' 'key BackSpace' 'key BackSpace'
            ;;
        *) fail "unknown image '$1'" 2 ;;
    esac
    echo "$1"
}

all=(
    forest nave fireflies gallery cathedral reef menger inside appendix-b gradients palettes textured winter chrome agate rowan playground film planet angles
    wood city conifer coral tower flake
    classic-bush classic-context-tree classic-arch classic-synth-tree classic-dragon
    classic-koch classic-jerusalem classic-vicsek classic-cantor classic-pythagoras
    tree-01 tree-02 tree-03 tree-04 tree-05 tree-06 tree-07 tree-08 tree-09 tree-10
    approximate-tree approximate-romanesco approximate-snowflake approximate-menger-3 approximate-arch
    approximate-spiral-stairs approximate-temple approximate-ruined-tree approximate-strange-tree approximate-creature
    approximate-terrain approximate-decimated-tree approximate-small-ruin
    traced-gallery traced-menger traced-playground light zoom stair window-fractal window-keys window-selection
)
[ $# != 0 ] || set -- "${all[@]}"
for name in "$@"; do
    make_image "$name"
done
