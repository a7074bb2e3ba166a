using FractalEngine.Core.Generation.Building;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation;

/// <summary>Generates small smooth shapes for tests and decoration.</summary>
internal static class RoundShapes
{
    private const int MaxDivisions = 9;

    /// <summary>Generates a closed sphere of radius 1: an icosahedron whose faces are divided in four.</summary>
    /// <param name="faceCount">Number of faces; the closest of 20, 80, 320, … is taken.</param>
    public static Mesh Icosphere(int faceCount)
    {
        var divisions = Enumerable.Range(0, MaxDivisions + 1).MinBy(count => Math.Abs((20L << (2 * count)) - faceCount));
        var mesh = new MeshBuilder { SmoothingGroup = 1 };
        var golden = (1 + Math.Sqrt(5)) / 2;
        var corners = new MeshCorner[12];
        for (var corner = 0; corner < corners.Length; corner++)
        {
            var a = (corner & 1) == 0 ? 1.0 : -1.0;
            var b = (corner & 2) == 0 ? golden : -golden;
            corners[corner] = AddSphereVertex(mesh, (corner / 4) switch { 0 => new(a, b, 0), 1 => new(0, a, b), _ => new(b, 0, a) });
        }

        // The icosahedron's faces are the triples of corners at the shortest distance.
        for (var i = 0; i < 12; i++)
        {
            for (var j = i + 1; j < 12; j++)
            {
                for (var k = j + 1; k < 12; k++)
                {
                    if (AreAdjacent(i, j) && AreAdjacent(j, k) && AreAdjacent(k, i))
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

        bool AreAdjacent(int i, int j) => (mesh.Positions[i] - mesh.Positions[j]).Length() < 1.2;
    }

    /// <summary>Generates a closed tube along a (2, 3) torus knot, about 3 units across.</summary>
    /// <param name="faceCount">Number of faces, at least 200; an odd number gives one face less.</param>
    public static Mesh TorusKnot(int faceCount)
    {
        var sides = Math.Max(3, (int)Math.Sqrt(faceCount / 24.0));
        var segments = faceCount / (2 * sides);
        var corners = new MeshCorner[segments + 1, sides + 1];
        var mesh = new MeshBuilder { SmoothingGroup = 1 };
        mesh.AddCorners(
            corners, GridClosure.RowsAndColumns,
            (segment, side) => PointOnTube(2 * Math.PI * ((double)segment / segments), 2 * Math.PI * ((double)side / sides)),
            (segment, side) => (6 * ((double)segment / segments), (double)side / sides));
        mesh.AddGrid(corners);
        EdgeSplitting.SplitTo(mesh, faceCount);
        return mesh.Build();
    }

    private static Vector PointOnTube(double along, double around)
    {
        const double Thickness = 0.27;
        var tangent = (PointOnKnot(along + 1e-4) - PointOnKnot(along - 1e-4)).UnitVector();
        // The direction away from the torus's own centre line turns smoothly and closes with the knot.
        var (s, c) = Math.SinCos(2 * along);
        var away = PointOnKnot(along) - new Vector(c, 0, s);
        var right = (away - (Vector.Dot(away, tangent) * tangent)).UnitVector();
        var (height, width) = Math.SinCos(around);
        return PointOnKnot(along) + (Thickness * ((width * right) + (height * Vector.Cross(tangent, right))));
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

    /// <summary>Divides each face into four, with new vertices on the unit sphere.</summary>
    private static void Subdivide(MeshBuilder mesh)
    {
        var midpoints = new Dictionary<(int, int), MeshCorner>();
        var faces = mesh.Triangles.ToArray();
        mesh.Triangles.Clear();
        foreach (var (a, b, c, _) in faces)
        {
            var ab = AddMidpoint(a, b);
            var bc = AddMidpoint(b, c);
            var ca = AddMidpoint(c, a);
            mesh.AddTriangle(a, ab, ca);
            mesh.AddTriangle(ab, b, bc);
            mesh.AddTriangle(ca, bc, c);
            mesh.AddTriangle(ab, bc, ca);
        }

        MeshCorner AddMidpoint(MeshCorner one, MeshCorner other)
        {
            var edge = (Math.Min(one.PositionIndex, other.PositionIndex), Math.Max(one.PositionIndex, other.PositionIndex));
            return midpoints.TryGetValue(edge, out var known) ? known : midpoints[edge] = AddSphereVertex(
                mesh, mesh.Positions[one.PositionIndex] + mesh.Positions[other.PositionIndex]);
        }
    }

    /// <summary>Adds a vertex of the unit sphere, with longitude and latitude as its texture coordinate.</summary>
    private static MeshCorner AddSphereVertex(MeshBuilder mesh, Vector direction)
    {
        var (x, y, z) = direction.UnitVector();
        return new(
            mesh.AddPosition(new(x, y, z)),
            mesh.AddTextureCoordinate(0.5 + (Math.Atan2(x, z) / (2 * Math.PI)), 0.5 + (Math.Asin(Math.Clamp(y, -1, 1)) / Math.PI)));
    }
}
