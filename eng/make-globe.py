#!/usr/bin/env python3
"""Makes the models with materials: assets/models/globe.{obj,mtl,png} and bell.{obj,mtl}. Python's own library only.

The map is noise on the sphere, so it has no seam; its random numbers are hashes of grid points, so every run gives the same picture.
"""
import math
import struct
import zlib
from pathlib import Path

MODELS = Path(__file__).resolve().parent.parent / "assets" / "models"
WIDTH, HEIGHT = 512, 256

# Depths of the sea, then heights of the land; the last two are the ice and the lines of latitude and longitude. sRGB.
PALETTE = [
    (16, 52, 96), (24, 74, 124), (38, 100, 150), (72, 140, 178), (206, 192, 140), (108, 146, 74), (74, 118, 60), (122, 112, 72),
    (146, 120, 92), (232, 236, 240), (236, 226, 190),
]
ICE, LINE = 9, 10


def lattice(x, y, z):
    h = (x * 0x8DA6B343 ^ y * 0xD8163841 ^ z * 0xCB1AB31F) & 0xFFFFFFFF
    h = (h ^ h >> 15) * 0x2C1B3C6D & 0xFFFFFFFF
    h = (h ^ h >> 12) * 0x297A2D39 & 0xFFFFFFFF
    return (h ^ h >> 15) / 0xFFFFFFFF


def noise(x, y, z):
    (i, j, k) = (math.floor(x), math.floor(y), math.floor(z))
    (u, v, w) = (t * t * (3 - 2 * t) for t in (x - i, y - j, z - k))
    total = 0.0
    for a in (0, 1):
        for b in (0, 1):
            for c in (0, 1):
                total += (u if a else 1 - u) * (v if b else 1 - v) * (w if c else 1 - w) * lattice(i + a, j + b, k + c)
    return total


def height(x, y, z):
    return sum(noise(f * x + 40 + 9 * n, f * y + 40, f * z + 40) / 2 ** n for n, f in enumerate((1.7, 3.4, 6.8, 13.6, 27.2))) / 1.94


def place(u, v):
    """On the unit sphere: v from the south pole to the north pole, u eastwards as seen from outside (x right, y up, z forward)."""
    (sine, cosine) = (math.sin(math.pi * v), -math.cos(math.pi * v))
    return -sine * math.sin(2 * math.pi * u), cosine, sine * math.cos(2 * math.pi * u)


def index(column, row):
    if column % (WIDTH // 24) == 0 and column < WIDTH // 24 * 24 or row % (HEIGHT // 12) == HEIGHT // 24:
        return LINE
    (x, y, z) = place((column + 0.5) / WIDTH, 1 - (row + 0.5) / HEIGHT)
    value = height(x, y, z)
    if abs(y) > 0.93 - 0.18 * (value - 0.5):
        return ICE
    return sum(value > step for step in (0.38, 0.44, 0.49, 0.52, 0.535, 0.56, 0.62, 0.67))


def write_png(path, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 3, 0, 0, 0)
    pixels = zlib.compress(b"".join(b"\0" + bytes(row) for row in rows), 9)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"PLTE", bytes(sum(PALETTE, ())))
                     + chunk(b"IDAT", pixels) + chunk(b"IEND", b""))


class Mesh:
    def __init__(self):
        self.lines, self.vertices, self.coordinates, self.triangles = [], 0, 0, 0

    def vertex(self, x, y, z):
        self.lines.append(f"v {x:.4f} {y:.4f} {z:.4f}")
        self.vertices += 1
        return self.vertices

    def coordinate(self, u, v):
        self.lines.append(f"vt {u:.5f} {v:.5f}")
        self.coordinates += 1
        return self.coordinates

    def face(self, *corners):
        self.lines.append("f " + " ".join(str(corner) for corner in corners))
        self.triangles += len(corners) - 2

    def write(self, path, comment, library):
        head = [f"# Mesh count: {self.triangles}", f"# {comment}", f"mtllib {library}"]
        path.write_text("\n".join(head + self.lines) + "\n", encoding="utf-8", newline="\n")


def add_ball(mesh, centre, radius, columns, rows):
    """With a map: the vertices of the seam and of the poles have one position and many places in it."""
    def corner(i, j):
        return f"{points[j][0] if j in (0, rows) else points[j][i % columns]}/{coordinates[j][i]}"

    points = []
    for j in range(rows + 1):
        ring = [place(i / columns, j / rows) for i in range(1 if j in (0, rows) else columns)]
        points.append([mesh.vertex(*(c + radius * p for c, p in zip(centre, point))) for point in ring])
    coordinates = [[mesh.coordinate(i / columns, j / rows) for i in range(columns + 1)] for j in range(rows + 1)]
    for j in range(rows):
        for i in range(columns):
            corners = [corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j)]
            if j == 0:
                corners = corners[:3]
            elif j == rows - 1:
                corners = [corners[0], corners[1], corners[3]]
            mesh.face(*corners)


def add_turned(mesh, profile, columns):
    """A body of revolution about the y axis; the profile runs upwards, (radius, y), and begins and ends on the axis."""
    rings = []
    for radius, y in profile:
        angles = [2 * math.pi * i / columns for i in range(1 if radius == 0 else columns)]
        rings.append([mesh.vertex(-radius * math.sin(a), y, radius * math.cos(a)) for a in angles])
    for lower, upper in zip(rings, rings[1:]):
        for i in range(columns):
            (a, b, c, d) = (ring[k % len(ring)] for ring, k in ((lower, i), (upper, i), (upper, i + 1), (lower, i + 1)))
            mesh.face(*([a, b, c] if a == d else [a, b, d] if b == c else [a, b, c, d]))


def add_ring(mesh, centre, radius, thickness, columns, rows):
    """A torus in the plane of x and y."""
    points = []
    for i in range(columns):
        for j in range(rows):
            (a, b) = (2 * math.pi * i / columns, 2 * math.pi * j / rows)
            reach = radius + thickness * math.cos(b)
            points.append(mesh.vertex(centre[0] + reach * math.cos(a), centre[1] + reach * math.sin(a), centre[2] + thickness * math.sin(b)))
    for i in range(columns):
        for j in range(rows):
            (k, m) = ((i + 1) % columns, (j + 1) % rows)
            mesh.face(points[i * rows + j], points[k * rows + j], points[k * rows + m], points[i * rows + m])


def make_globe():
    mesh = Mesh()
    mesh.lines += ["o Ball", "usemtl map"]
    add_ball(mesh, (0, 1.05, 0), 0.6, 32, 16)
    mesh.lines += ["o Stand", "usemtl brass"]
    add_turned(mesh, [(0, 0), (0.46, 0), (0.46, 0.06), (0.3, 0.11), (0.1, 0.17), (0.06, 0.24), (0.06, 0.36), (0, 0.36)], 24)
    add_ring(mesh, (0, 1.05, 0), 0.68, 0.03, 36, 8)
    mesh.write(MODELS / "globe.obj", "A globe on a stand: a map on a ball, and brass.", "globe.mtl")
    (MODELS / "globe.mtl").write_text(
        "# The map is varnished: small bright highlights.\nnewmtl map\nKd 1 1 1\nKs 0.35 0.35 0.35\nNs 80\nmap_Kd globe.png\n\n"
        "newmtl brass\nKd 0.72 0.55 0.26\nKs 0.8 0.65 0.35\nNs 40\n", encoding="utf-8", newline="\n")
    write_png(MODELS / "globe.png", [[index(x, y) for x in range(WIDTH)] for y in range(HEIGHT)])


def make_bell():
    mesh = Mesh()
    mesh.lines += ["o Bell", "usemtl glass"]
    steps = [math.pi / 2 * k / 8 for k in range(9)]
    dome = [(0.7 * math.cos(a), 0.75 + 0.7 * math.sin(a)) for a in steps]
    add_turned(mesh, [(0, 0), (0.7, 0), *dome[:-1], (0, 1.45)], 32)
    mesh.lines.append("usemtl knob")
    add_turned(mesh, [(0, 1.45), (0.05, 1.47), (0.09, 1.53), (0.07, 1.6), (0, 1.63)], 16)
    mesh.write(MODELS / "bell.obj", "A bell of glass with a knob of brass.", "bell.mtl")
    (MODELS / "bell.mtl").write_text(
        "newmtl glass\nKd 0.62 0.8 0.86\nKs 0.07 0.07 0.07\nNs 900\nd 0.08\n\nnewmtl knob\nKd 0.72 0.55 0.26\nKs 0.8 0.65 0.35\nNs 40\n",
        encoding="utf-8", newline="\n")


make_globe()
make_bell()
