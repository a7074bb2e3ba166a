#!/usr/bin/env bash
# Checks exports by readers that are not the engine's: assimp counts faces and measures bounds, admesh finds edges without a neighbour
# and volumes, and lib3mf reads 3MF strictly. Needs the packages assimp-utils, admesh, lib3mf-dev and g++; prints a line a file, and
# ends with 1 where one is not as it should be.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
out="$(mktemp -d)"
trap 'rm -rf "$out"' EXIT
failed=0

export_file() {
    dotnet "$root/FractalEngine.App/bin/Release/net10.0/FractalEngine.App.dll" export "$root/assets/fractals/$1.fdo" \
        --output "$out/$2" --quiet "${@:3}"
}

expect() {
    if [ "$2" = "$3" ]; then
        echo "$1: $3"
    else
        echo "$1: $3, not $2"
        failed=1
    fi
}

# Name of the file, number of faces, and the corners of the box, of which assimp prints six digits.
check_assimp() {
    local facts
    facts="$(assimp info "$out/$1" 2>/dev/null)"
    expect "assimp, $1, faces" "$2" "$(sed -n 's/^Faces: *//p' <<<"$facts" | head -n 1)"
    [ -z "${3:-}" ] || expect "assimp, $1, bounds" "$3" "$(sed -n 's/^M[a-z]* point *//p' <<<"$facts" | tr -d '\n')"
}

# Name of the file, volume.
check_admesh() {
    local facts
    facts="$(admesh "$out/$1" 2>/dev/null)"
    expect "admesh, $1, edges without a neighbour" 0 "$(sed -n 's/^Total disconnected facets *: *\([0-9]*\) .*/\1/p' <<<"$facts" | tail -n 1)"
    expect "admesh, $1, volume" "$2" "$(sed -n 's/.*Volume *: *//p' <<<"$facts" | tail -n 1)"
}

cat >"$out/read3mf.cpp" <<'END'
#include <cstdio>
#include "Model/COM/NMR_DLLInterfaces.h"
using namespace NMR;
int main(int, char** arguments)
{
    PLib3MFModel* model;
    PLib3MFModelReader* reader;
    PLib3MFModelResourceIterator* objects;
    DWORD warnings = 0;
    lib3mf_createmodel(&model);
    lib3mf_model_queryreader(model, "3mf", &reader);
    lib3mf_reader_setstrictmodeactive(reader, true);
    if (lib3mf_reader_readfromfileutf8(reader, arguments[1]) != 0)
    {
        puts("not read");
        return 1;
    }

    lib3mf_reader_getwarningcount(reader, &warnings);
    lib3mf_model_getobjects(model, &objects);
    int count = 0, valid = 0;
    BOOL more;
    while (lib3mf_resourceiterator_movenext(objects, &more) == 0 && more)
    {
        PLib3MFModelResource* object;
        BOOL isValid = false;
        lib3mf_resourceiterator_getcurrent(objects, &object);
        lib3mf_object_isvalidobject(object, &isValid);
        count++;
        valid += isValid ? 1 : 0;
    }

    printf("%d of %d objects valid, %u warnings\n", valid, count, (unsigned)warnings);
}
END
g++ -I/usr/include/lib3mf "$out/read3mf.cpp" -o "$out/read3mf" -l3MF

sponge='(-0.500000 -0.500000 -0.500000)(0.500000 0.500000 0.500000)'
for ending in stl ply 3mf; do
    export_file menger-3 "sponge.$ending"
    export_file menger-3 "welded.$ending" --weld
done
# Components are written out by what assimp makes of them.
assimp export "$out/sponge.3mf" "$out/components.stl" >/dev/null 2>&1
check_assimp sponge.stl 96000 "$sponge"
check_assimp sponge.ply 96000 "$sponge"
check_assimp components.stl 96000 "$sponge"
check_assimp welded.stl 36096 "$sponge"
check_assimp welded.ply 36096 "$sponge"
check_admesh welded.stl 0.406437
export_file tree tree.3mf --depth 5
export_file tree tree.stl --depth 5
assimp export "$out/tree.3mf" "$out/tree-components.stl" >/dev/null 2>&1
box="$(assimp info "$out/tree.stl" 2>/dev/null | sed -n 's/^M[a-z]* point *//p' | tr -d '\n')"
check_assimp tree-components.stl 27300 "$box"
expect "lib3mf, sponge.3mf" "4 of 4 objects valid, 0 warnings" "$("$out/read3mf" "$out/sponge.3mf")"
expect "lib3mf, welded.3mf" "1 of 1 objects valid, 0 warnings" "$("$out/read3mf" "$out/welded.3mf")"
expect "lib3mf, tree.3mf" "6 of 6 objects valid, 0 warnings" "$("$out/read3mf" "$out/tree.3mf")"
exit "$failed"
