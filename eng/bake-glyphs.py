#!/usr/bin/python3
"""Bakes FractalEngine.Render/Ui/mono.atlas from DejaVu Sans Mono (Debian: python3-pil fonts-dejavu-core).

Layout, little-endian. Four bytes "FGA1", then a raw deflate stream of:
    u16 number of glyphs, then that many u16 code points, ascending
    u16 number of sizes, then for each size, ascending:
        u16 cell width, u16 cell height, u16 baseline (pixels from the cell's top)
        glyphs x height x width bytes of coverage, glyphs in the order above, rows from the top
All glyphs are one cell wide: the font is monospaced.
"""
import struct
import sys
import zlib
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf"
SIZES = [13, 16, 20, 26, 34, 46]
EXTRA = "‐–—‘’“”•…→←↑↓↔↵⇧−∞≈≠≤≥√∆πφθ∑∏²³⁵⁸⁴⁶⁷⁹⁰¹✓✗▲▼◀▶█░"


def characters():
    codes = set(range(0x20, 0x7F)) | set(range(0xA0, 0x100)) | {ord(c) for c in EXTRA}
    codes.discard(0xAD)  # the soft hyphen shows nothing
    return sorted(codes)


def bake(size, codes):
    font = ImageFont.truetype(FONT, size)
    ascent, descent = font.getmetrics()
    width = round(font.getlength("M"))
    height = ascent + descent
    cells = bytearray()
    for code in codes:
        cell = Image.new("L", (width, height), 0)
        ImageDraw.Draw(cell).text((0, ascent), chr(code), font=font, fill=255, anchor="ls")
        cells += cell.tobytes()
    return struct.pack("<HHH", width, height, ascent) + bytes(cells)


def main():
    codes = characters()
    body = struct.pack("<H", len(codes)) + b"".join(struct.pack("<H", code) for code in codes)
    body += struct.pack("<H", len(SIZES)) + b"".join(bake(size, codes) for size in SIZES)
    deflate = zlib.compressobj(9, zlib.DEFLATED, -15)
    target = Path(__file__).resolve().parent.parent / "FractalEngine.Render" / "Ui" / "mono.atlas"
    target.write_bytes(b"FGA1" + deflate.compress(body) + deflate.flush())
    print(f"{target.name}: {len(codes)} glyphs, sizes {SIZES}, {target.stat().st_size} bytes")


if __name__ == "__main__":
    sys.exit(main())
