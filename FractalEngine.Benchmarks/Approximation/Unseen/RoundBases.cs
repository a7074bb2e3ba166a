using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Base meshes that are round, open or flat.</summary>
internal static class RoundBases
{
    /// <summary>Makes a ball of 320 faces, stretched in half of the cases, and with bumps in the others.</summary>
    public static Mesh Ball(SeededRandom random)
    {
        var ball = Icosphere(2);
        var stretch = new Vector(random.Written(0.3, 0.5), 0.5, random.Written(0.2, 0.5));
        var bumps = Enumerable.Range(0, 5).Select(_ => (Direction: random.Direction(), Height: random.Between(-0.12, 0.2))).ToArray();
        var hasBumps = random.Chance(0.5);
        return MeshTools.Create(
            [
                .. MeshTools.Positions(ball).Select(direction => new Vector(0, 0.5, 0) + (hasBumps
                    ? (0.4 + bumps.Sum(bump => bump.Height * Math.Exp(4 * (Vector.Dot(direction, bump.Direction) - 1)))) * direction
                    : direction.Stretch(stretch))),
            ],
            ball.VertexIndices);
    }

    /// <summary>Makes a ring around the y axis.</summary>
    public static Mesh Ring(SeededRandom random)
    {
        var (segments, sides) = (random.Integer(6, 12), random.Integer(3, 5));
        var (radius, thickness) = (random.Written(0.3, 0.45), random.Written(0.06, 0.15));
        var builder = new ShapeBuilder();
        var rings = new int[segments][];
        for (var segment = 0; segment < segments; segment++)
        {
            var turn = new Vector(0, 360.0 * segment / segments, 0).LocalAxesFromDegrees();
            rings[segment] = builder.Vertices(ShapeBuilder.Around(sides, _ => thickness)
                .Select(point => turn * new Vector(radius + point.X, thickness + point.Z, 0)));
        }

        for (var segment = 0; segment < segments; segment++)
        {
            builder.Strip(rings[segment], rings[(segment + 1) % segments], isClosed: true);
        }

        return builder.ToSolid();
    }

    /// <summary>Makes a part of a sphere, open below.</summary>
    public static Mesh Dome(SeededRandom random)
    {
        var (segments, rows, steepness) = (random.Integer(7, 10), random.Integer(3, 5), random.Between(60, 130));
        var builder = new ShapeBuilder();
        var apex = builder.Vertex(new(0, 1, 0));
        int[]? above = null;
        for (var row = 1; row <= rows; row++)
        {
            var (sine, cosine) = SineCosine.FromDegrees(steepness * row / rows);
            var ring = builder.Vertices(
                ShapeBuilder.Around(segments, _ => 0.5 * sine).Select(point => new Vector(point.X, 0.5 + (0.5 * cosine), point.Z)));
            if (above is null)
            {
                builder.Cone(apex, ring);
            }
            else
            {
                builder.Strip(ring, above, isClosed: true);
            }

            above = ring;
        }

        return builder.ToMesh();
    }

    /// <summary>Makes an open strip that bends and twists, wider at its end.</summary>
    public static Mesh Gutter(SeededRandom random)
    {
        var (rows, columns) = (random.Integer(3, 6), random.Integer(2, 4));
        var (twist, bend, widening) = (random.Between(10, 70), random.Between(0.1, 0.4), random.Between(0.8, 1.6));
        var builder = new ShapeBuilder();
        int[]? before = null;
        for (var row = 0; row <= rows; row++)
        {
            var along = (double)row / rows;
            var turn = new Vector(0, twist * along, 0).LocalAxesFromDegrees();
            var now = builder.Vertices(Enumerable.Range(0, columns + 1).Select(column => (2.0 * column / columns) - 1)
                .Select(across => turn * new Vector(
                    0.25 * across * (1 + ((widening - 1) * along)), along, (bend * along * along) + (0.2 * across * across))));
            if (before is not null)
            {
                builder.Strip(before, now, isClosed: false);
            }

            before = now;
        }

        return builder.ToMesh();
    }

    /// <summary>Makes a flat leaf from the origin along y, wider on one side of its midrib; its plane leans.</summary>
    public static Mesh Leaf(SeededRandom random)
    {
        var (rows, right, left) = (random.Integer(2, 4), random.Between(0.15, 0.35), random.Between(0.15, 0.35));
        var plane = random.Chance(0.5) ? Matrix.Identity : random.GenericRotation();
        var builder = new ShapeBuilder();
        var midrib = builder.Vertices(Enumerable.Range(0, rows + 2).Select(row => plane * new Vector(0, (double)row / (rows + 1), 0)));
        foreach (var (width, side) in new[] { (right, 1), (-left, -1) })
        {
            var margin = builder.Vertices(Enumerable.Range(1, rows).Select(row => (double)row / (rows + 1))
                .Select(along => plane * new Vector(width * Math.Sin(Math.PI * Math.Pow(along, 0.8)), along, 0)));
            int[] outline = [midrib[0], .. margin, midrib[^1]];
            for (var row = 0; row <= rows; row++)
            {
                var (a, b, c, d) = (midrib[row], outline[row], outline[row + 1], midrib[row + 1]);
                if (row > 0)
                {
                    AddFace(a, b, row < rows ? c : d, side);
                }

                if (row < rows)
                {
                    AddFace(a, c, d, side);
                }
            }
        }

        return builder.ToMesh();

        void AddFace(int a, int b, int c, int side) => builder.Face(a, side > 0 ? b : c, side > 0 ? c : b);
    }

    /// <summary>Makes an irregular flat polygon around the origin.</summary>
    public static Mesh Plate(SeededRandom random)
    {
        var builder = new ShapeBuilder();
        var outline = ShapeBuilder.Around(random.Integer(4, 7), _ => random.Between(0.3, 0.5));
        builder.Fan(builder.Vertices(outline.Select(corner => new Vector(corner.X, 0, corner.Z))));
        return builder.ToMesh();
    }

    /// <summary>Makes one triangle, equilateral in one of three cases.</summary>
    public static Mesh Triangle(SeededRandom random)
    {
        var builder = new ShapeBuilder();
        var (x, y) = random.Chance(1.0 / 3) ? (0.5, Math.Sqrt(0.75)) : (random.Between(-0.2, 0.8), random.Between(0.4, 1));
        builder.Vertices([Vector.Zero, Vector.I, new(x, y, 0)]);
        builder.Face(0, 1, 2);
        return builder.ToMesh();
    }

    /// <summary>Makes a unit sphere of an icosahedron whose faces are divided by four so many times.</summary>
    public static Mesh Icosphere(int divisions)
    {
        var golden = (1 + Math.Sqrt(5)) / 2;
        List<Vector> positions = [];
        foreach (var (a, b) in new[] { (-1.0, golden), (1, golden), (-1, -golden), (1, -golden) })
        {
            positions.AddRange([new(a, b, 0), new(0, a, b), new(b, 0, a)]);
        }

        positions = [.. positions.Select(position => position.UnitVector())];
        // Three corners that are as close as the corners of an icosahedron's face get.
        var side = positions.Skip(1).Min(position => (position - positions[0]).Length()) * 1.01;
        var builder = new List<int>();
        for (var a = 0; a < 12; a++)
        {
            for (var b = a + 1; b < 12; b++)
            {
                for (var c = b + 1; c < 12; c++)
                {
                    var (p, q, r) = (positions[a], positions[b], positions[c]);
                    if ((p - q).Length() < side && (q - r).Length() < side && (r - p).Length() < side)
                    {
                        builder.AddRange(Vector.Dot(p, Vector.Cross(q, r)) > 0 ? [a, b, c] : [a, c, b]);
                    }
                }
            }
        }

        var faces = builder;
        for (var division = 0; division < divisions; division++)
        {
            faces = Divide(positions, faces);
        }

        return MeshTools.Create(positions, faces);
    }

    private static List<int> Divide(List<Vector> positions, List<int> faces)
    {
        var middles = new Dictionary<(int, int), int>();
        var divided = new List<int>(4 * faces.Count);
        for (var i = 0; i < faces.Count; i += 3)
        {
            var (a, b, c) = (faces[i], faces[i + 1], faces[i + 2]);
            var (ab, bc, ca) = (Middle(a, b), Middle(b, c), Middle(c, a));
            divided.AddRange([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca]);
        }

        return divided;

        int Middle(int vertex1, int vertex2)
        {
            var edge = (Math.Min(vertex1, vertex2), Math.Max(vertex1, vertex2));
            if (!middles.TryGetValue(edge, out var middle))
            {
                middle = positions.Count;
                positions.Add((positions[vertex1] + positions[vertex2]).UnitVector());
                middles.Add(edge, middle);
            }

            return middle;
        }
    }
}
