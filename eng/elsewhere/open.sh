#!/usr/bin/env bash
# Opens exported files in other programs and keeps what they show: three.js in a headless Chromium, and Blender.
# open.sh FILE FOLDER writes three.png and blender.png of a scene that has a camera. Needs blender, chromium, npm and python3.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
scene="$1"
out="$(mkdir -p "$2" && cd "$2" && pwd)"
site="$(mktemp -d)"
server=
trap '[ -z "$server" ] || kill "$server"; rm -rf "$site"' EXIT

"$here/../../run.sh" export "$scene" --output "$site/levels.glb"
"$here/../../run.sh" export "$scene" --output "$site/flat.glb" --flat
(cd "$site" && npm install --silent --no-save three >/dev/null && mv node_modules/three three)
cp "$here/three.html" "$site/"
python3 -m http.server --bind 127.0.0.1 --directory "$site" 8137 >/dev/null 2>&1 &
server=$!
sleep 1
# A minute of the page's time: it loads, draws and ends.
chromium --headless --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader --hide-scrollbars \
    --window-size=480,400 --virtual-time-budget=60000 --enable-logging=stderr --screenshot="$out/three.png" \
    'http://127.0.0.1:8137/three.html?file=levels.glb' 2>&1 | grep -oE 'faces: [0-9]+'
blender -b --python "$here/blender.py" -- "$site/flat.glb" "$out/blender.png" 2>&1 | grep -E '^faces:'
