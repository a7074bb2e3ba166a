using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Generation;

/// <summary>Small smooth shapes to test and decorate with.</summary>
internal static class RoundShapes
{
    private const int MostDivisions = 9;

    /// <summary>A sphere of radius 1: an icosahedron whose faces are divided in four. Closed.</summary>
    /// <param name="faceCount">The nearest of 20, 80, 320, … is taken.</param>
    public static Mesh Icosphere(int faceCount)
    {
        var divisions = Enumerable.Range(0, MostDivisions + 1).MinBy(count => Math.Abs((20L << (2 * count)) - faceCount));
        var mesh = new MeshBuilder { Smoothing = 1 };
        var golden = (1 + Math.Sqrt(5)) / 2;
        var corners = new MeshCorner[12];
        for (var corner = 0; corner < corners.Length; corner++)
        {
            var (a, b) = ((corner & 1) == 0 ? 1.0 : -1.0, (corner & 2) == 0 ? golden : -golden);
            corners[corner] = OnSphere(mesh, (corner / 4) switch { 0 => new(a, b, 0), 1 => new(0, a, b), _ => new(b, 0, a) });
        }

        // The icosahedron's faces are the triples of corners at the shortest distance.
        for (var i = 0; i < 12; i++)
        {
            for (var j = i + 1; j < 12; j++)
            {
                for (var k = j + 1; k < 12; k++)
                {
                    if (AreNear(i, j) && AreNear(j, k) && AreNear(k, i))
                    {
                        AddOutwards(mesh, corners[i], corners[j], corners[k]);
                    }
                }
            }
        }

        for (var division = 0; division < divisions; division++)
        {
            Divide(mesh);
        }

        return mesh.Build();

        bool AreNear(int i, int j) => (mesh.Positions[i] - mesh.Positions[j]).Length() < 1.2;
    }

    /// <summary>A tube along a (2, 3) torus knot, about 3 units across. Closed.</summary>
    /// <param name="faceCount">At least 200; an odd number gives one face less.</param>
    public static Mesh TorusKnot(int faceCount)
    {
        var sides = Math.Max(3, (int)Math.Sqrt(faceCount / 24.0));
        var pieces = faceCount / (2 * sides);
        var corners = new MeshCorner[pieces + 1, sides + 1];
        var mesh = new MeshBuilder { Smoothing = 1 };
        for (var piece = 0; piece <= pieces; piece++)
        {
            for (var side = 0; side <= sides; side++)
            {
                var (u, v) = ((double)piece / pieces, (double)side / sides);
                var position = piece == pieces ? corners[0, side].Position
                    : side == sides ? corners[piece, 0].Position
                    : mesh.Position(OnKnot(2 * Math.PI * u, 2 * Math.PI * v));
                corners[piece, side] = new(position, mesh.Coordinate(6 * u, v));
            }
        }

        mesh.Grid(corners);
        EdgeSplitting.SplitTo(mesh, faceCount);
        return mesh.Build();
    }

    private static Vector OnKnot(double along, double around)
    {
        const double thickness = 0.27;
        var along2 = (Knot(along + 1e-4) - Knot(along - 1e-4)).UnitVector();
        // Away from the torus's own middle line: it turns smoothly and closes with the knot.
        var (s, c) = Math.SinCos(2 * along);
        var away = Knot(along) - new Vector(c, 0, s);
        var right = (away - (Vector.Dot(away, along2) * along2)).UnitVector();
        var (height, width) = Math.SinCos(around);
        return Knot(along) + (thickness * ((width * right) + (height * Vector.Cross(along2, right))));
    }

    private static Vector Knot(double along)
    {
        var (s, c) = Math.SinCos(2 * along);
        var (height, reach) = Math.SinCos(3 * along);
        var distance = 1 + (0.45 * reach);
        return new(distance * c, 0.45 * height, distance * s);
    }

    private static void AddOutwards(MeshBuilder mesh, MeshCorner a, MeshCorner b, MeshCorner c)
    {
        var (va, vb, vc) = (mesh.Positions[a.Position], mesh.Positions[b.Position], mesh.Positions[c.Position]);
        var outwards = Vector.Dot(va, Vector.Cross(vb - va, vc - va)) > 0;
        mesh.Triangle(a, outwards ? b : c, outwards ? c : b);
    }

    private static void Divide(MeshBuilder mesh)
    {
        var middles = new Dictionary<(int, int), MeshCorner>();
        var faces = mesh.Triangles.ToArray();
        mesh.Triangles.Clear();
        foreach (var (a, b, c, _) in faces)
        {
            MeshCorner ab = Middle(a, b), bc = Middle(b, c), ca = Middle(c, a);
            mesh.Triangle(a, ab, ca);
            mesh.Triangle(ab, b, bc);
            mesh.Triangle(ca, bc, c);
            mesh.Triangle(ab, bc, ca);
        }

        MeshCorner Middle(MeshCorner one, MeshCorner other)
        {
            var edge = (Math.Min(one.Position, other.Position), Math.Max(one.Position, other.Position));
            return middles.TryGetValue(edge, out var known) ? known
                : middles[edge] = OnSphere(mesh, mesh.Positions[one.Position] + mesh.Positions[other.Position]);
        }
    }

    /// <summary>A corner in a direction, with longitude and latitude as its texture coordinate.</summary>
    private static MeshCorner OnSphere(MeshBuilder mesh, Vector direction)
    {
        var (x, y, z) = direction.UnitVector();
        return new(
            mesh.Position(new(x, y, z)),
            mesh.Coordinate(0.5 + (Math.Atan2(x, z) / (2 * Math.PI)), 0.5 + (Math.Asin(Math.Clamp(y, -1, 1)) / Math.PI)));
    }
}
