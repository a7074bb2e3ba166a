using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation;

/// <summary>Small smooth shapes to test and decorate with.</summary>
internal static class RoundShapes
{
    private const int MaxDivisions = 9;

    /// <summary>A sphere of radius 1: an icosahedron whose faces are divided in four. Closed.</summary>
    /// <param name="faceCount">The nearest of 20, 80, 320, … is taken.</param>
    public static Mesh Icosphere(int faceCount)
    {
        var divisions = Enumerable.Range(0, MaxDivisions + 1).MinBy(count => Math.Abs((20L << (2 * count)) - faceCount));
        var mesh = new MeshBuilder { SmoothingGroup = 1 };
        var golden = (1 + Math.Sqrt(5)) / 2;
        var corners = new MeshCorner[12];
        for (var corner = 0; corner < corners.Length; corner++)
        {
            var (a, b) = ((corner & 1) == 0 ? 1.0 : -1.0, (corner & 2) == 0 ? golden : -golden);
            corners[corner] = AddSphereVertex(mesh, (corner / 4) switch { 0 => new(a, b, 0), 1 => new(0, a, b), _ => new(b, 0, a) });
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
                        AddOutwardTriangle(mesh, corners[i], corners[j], corners[k]);
                    }
                }
            }
        }

        for (var division = 0; division < divisions; division++)
        {
            Subdivide(mesh);
        }

        return mesh.Build();

        bool AreNear(int i, int j) => (mesh.Positions[i] - mesh.Positions[j]).Length() < 1.2;
    }

    /// <summary>A tube along a (2, 3) torus knot, about 3 units across. Closed.</summary>
    /// <param name="faceCount">At least 200; an odd number gives one face less.</param>
    public static Mesh TorusKnot(int faceCount)
    {
        var sides = Math.Max(3, (int)Math.Sqrt(faceCount / 24.0));
        var segments = faceCount / (2 * sides);
        var corners = new MeshCorner[segments + 1, sides + 1];
        var mesh = new MeshBuilder { SmoothingGroup = 1 };
        for (var segment = 0; segment <= segments; segment++)
        {
            for (var side = 0; side <= sides; side++)
            {
                var (u, v) = ((double)segment / segments, (double)side / sides);
                var position = segment == segments ? corners[0, side].PositionIndex
                    : side == sides ? corners[segment, 0].PositionIndex
                    : mesh.AddPosition(PointOnTube(2 * Math.PI * u, 2 * Math.PI * v));
                corners[segment, side] = new(position, mesh.AddTextureCoordinate(6 * u, v));
            }
        }

        mesh.AddGrid(corners);
        EdgeSplitting.SplitTo(mesh, faceCount);
        return mesh.Build();
    }

    private static Vector PointOnTube(double along, double around)
    {
        const double thickness = 0.27;
        var tangent = (PointOnKnot(along + 1e-4) - PointOnKnot(along - 1e-4)).UnitVector();
        // Away from the torus's own middle line: it turns smoothly and closes with the knot.
        var (s, c) = Math.SinCos(2 * along);
        var away = PointOnKnot(along) - new Vector(c, 0, s);
        var right = (away - (Vector.Dot(away, tangent) * tangent)).UnitVector();
        var (height, width) = Math.SinCos(around);
        return PointOnKnot(along) + (thickness * ((width * right) + (height * Vector.Cross(tangent, right))));
    }

    private static Vector PointOnKnot(double along)
    {
        var (s, c) = Math.SinCos(2 * along);
        var (height, radialOffset) = Math.SinCos(3 * along);
        var distance = 1 + (0.45 * radialOffset);
        return new(distance * c, 0.45 * height, distance * s);
    }

    private static void AddOutwardTriangle(MeshBuilder mesh, MeshCorner a, MeshCorner b, MeshCorner c)
    {
        var (va, vb, vc) = (mesh.Positions[a.PositionIndex], mesh.Positions[b.PositionIndex], mesh.Positions[c.PositionIndex]);
        var outwards = Vector.Dot(va, Vector.Cross(vb - va, vc - va)) > 0;
        mesh.AddTriangle(a, outwards ? b : c, outwards ? c : b);
    }

    private static void Subdivide(MeshBuilder mesh)
    {
        var midpoints = new Dictionary<(int, int), MeshCorner>();
        var faces = mesh.Triangles.ToArray();
        mesh.Triangles.Clear();
        foreach (var (a, b, c, _) in faces)
        {
            MeshCorner ab = AddMidpoint(a, b), bc = AddMidpoint(b, c), ca = AddMidpoint(c, a);
            mesh.AddTriangle(a, ab, ca);
            mesh.AddTriangle(ab, b, bc);
            mesh.AddTriangle(ca, bc, c);
            mesh.AddTriangle(ab, bc, ca);
        }

        MeshCorner AddMidpoint(MeshCorner one, MeshCorner other)
        {
            var edge = (Math.Min(one.PositionIndex, other.PositionIndex), Math.Max(one.PositionIndex, other.PositionIndex));
            return midpoints.TryGetValue(edge, out var known) ? known
                : midpoints[edge] = AddSphereVertex(mesh, mesh.Positions[one.PositionIndex] + mesh.Positions[other.PositionIndex]);
        }
    }

    /// <summary>A corner in a direction, with longitude and latitude as its texture coordinate.</summary>
    private static MeshCorner AddSphereVertex(MeshBuilder mesh, Vector direction)
    {
        var (x, y, z) = direction.UnitVector();
        return new(
            mesh.AddPosition(new(x, y, z)),
            mesh.AddTextureCoordinate(0.5 + (Math.Atan2(x, z) / (2 * Math.PI)), 0.5 + (Math.Asin(Math.Clamp(y, -1, 1)) / Math.PI)));
    }
}
