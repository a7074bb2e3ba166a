using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Vertices and faces of a mesh that is being made, with the few ways to add faces that the shapes here need.</summary>
internal sealed class ShapeBuilder
{
    private readonly List<Vector> _positions = [];
    private readonly List<int> _indices = [];

    /// <summary>Adds a vertex, and returns its index.</summary>
    public int Vertex(Vector position)
    {
        _positions.Add(position);
        return _positions.Count - 1;
    }

    /// <summary>Adds several vertices, and returns their indices.</summary>
    public int[] Vertices(IEnumerable<Vector> positions) => [.. positions.Select(Vertex)];

    /// <summary>Adds a face by the indices of its corners.</summary>
    public void Face(int corner1, int corner2, int corner3) => _indices.AddRange([corner1, corner2, corner3]);

    /// <summary>Adds the two faces of a quadrangle, whose corners are given around it.</summary>
    public void Quad(int corner1, int corner2, int corner3, int corner4)
    {
        Face(corner1, corner2, corner3);
        Face(corner1, corner3, corner4);
    }

    /// <summary>Adds the faces from the first corner of a polygon to all edges of it that do not meet there.</summary>
    public void Fan(params ReadOnlySpan<int> corners)
    {
        for (var i = 1; i + 1 < corners.Length; i++)
        {
            Face(corners[0], corners[i], corners[i + 1]);
        }
    }

    /// <summary>Adds the faces from a vertex to all edges of a closed ring.</summary>
    public void Cone(int apex, int[] ring, bool reversed = false)
    {
        for (var i = 0; i < ring.Length; i++)
        {
            var next = ring[(i + 1) % ring.Length];
            Face(apex, reversed ? next : ring[i], reversed ? ring[i] : next);
        }
    }

    /// <summary>Adds quadrangles between two rows of as many vertices.</summary>
    /// <param name="row1">Indices of the first row.</param>
    /// <param name="row2">Indices of the second row.</param>
    /// <param name="isClosed">Whether the last of each row is joined with its first.</param>
    public void Strip(int[] row1, int[] row2, bool isClosed)
    {
        for (var i = 0; i < (isClosed ? row1.Length : row1.Length - 1); i++)
        {
            var next = (i + 1) % row1.Length;
            Quad(row1[i], row1[next], row2[next], row2[i]);
        }
    }

    /// <summary>Makes the mesh of all that was added.</summary>
    public Mesh ToMesh() => MeshTools.Create(_positions, _indices);

    /// <summary>Makes the mesh, with its front faces outwards where it is closed and all faces are wound alike.</summary>
    public Mesh ToSolid()
    {
        var mesh = ToMesh();
        return MeshTools.SignedVolume(mesh) < 0 ? MeshTools.TurnFaces(mesh) : mesh;
    }

    /// <summary>Makes a solid of a polygon in the plane of x and z, from one height to another.</summary>
    /// <param name="outline">Corners (x, z) around the polygon.</param>
    /// <param name="height">Where it ends; it begins at height 0.</param>
    /// <param name="taper">The size of the upper end beside that of the lower one.</param>
    /// <param name="hasCentres">
    /// Whether both ends are made of faces around the origin; else around the first corner. All corners must see it.
    /// </param>
    public static Mesh Extrude(IReadOnlyList<(double X, double Z)> outline, double height, double taper = 1, bool hasCentres = false)
    {
        var builder = new ShapeBuilder();
        var lower = builder.Vertices(outline.Select(corner => new Vector(corner.X, 0, corner.Z)));
        var upper = builder.Vertices(outline.Select(corner => new Vector(taper * corner.X, height, taper * corner.Z)));
        builder.Strip(lower, upper, isClosed: true);
        if (hasCentres)
        {
            builder.Cone(builder.Vertex(Vector.Zero), lower, reversed: true);
            builder.Cone(builder.Vertex(new(0, height, 0)), upper);
        }
        else
        {
            builder.Fan([.. lower.Take(1), .. lower.Skip(1).Reverse()]);
            builder.Fan(upper);
        }

        return builder.ToSolid();
    }

    /// <summary>Lists points around a circle or a star in the plane of x and z.</summary>
    /// <param name="count">How many there are.</param>
    /// <param name="radius">The radius of each, by its index.</param>
    public static ImmutableArray<(double X, double Z)> Around(int count, Func<int, double> radius)
    {
        var points = ImmutableArray.CreateBuilder<(double, double)>(count);
        for (var i = 0; i < count; i++)
        {
            var (sine, cosine) = SineCosine.FromDegrees(360.0 * i / count);
            points.Add((radius(i) * cosine, radius(i) * sine));
        }

        return points.MoveToImmutable();
    }
}
