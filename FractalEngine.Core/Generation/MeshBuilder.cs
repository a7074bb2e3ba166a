using System.Collections.Immutable;
using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation;

/// <summary>Collects the faces of a generated mesh; smoothing and exact face counts are taken care of at the end.</summary>
internal sealed class MeshBuilder
{
    private readonly List<Vector> _positions = [];
    private readonly List<(double U, double V)> _coordinates = [];
    private readonly List<MeshTriangle> _triangles = [];
    private readonly List<(int FirstFace, string Name)> _groups = [];

    /// <summary>How many faces there are so far.</summary>
    public int FaceCount => _triangles.Count;

    /// <summary>
    /// The smoothing group of the faces to come: those of one group share normals where they share corners; 0 is flat.
    /// </summary>
    public int SmoothingGroup { get; set; }

    /// <summary>All faces, for those who look at them or split them.</summary>
    internal List<MeshTriangle> Triangles => _triangles;

    /// <summary>All positions.</summary>
    internal List<Vector> Positions => _positions;

    /// <summary>The faces to come belong to a part of this name.</summary>
    public void BeginGroup(string name) => _groups.Add((_triangles.Count, name));

    /// <summary>A new vertex.</summary>
    public int AddPosition(Vector position)
    {
        _positions.Add(position);
        return _positions.Count - 1;
    }

    /// <summary>A new texture coordinate.</summary>
    public int AddTextureCoordinate(double u, double v)
    {
        _coordinates.Add((u, v));
        return _coordinates.Count - 1;
    }

    /// <summary>The coordinate half-way between two.</summary>
    public int AddCoordinateMidpoint(int coordinate1, int coordinate2) =>
        (_coordinates[coordinate1], _coordinates[coordinate2]) switch
        {
            var ((u1, v1), (u2, v2)) => AddTextureCoordinate((u1 + u2) / 2, (v1 + v2) / 2),
        };

    /// <summary>A face; <c>Cross(b − a, c − a)</c> points outwards.</summary>
    public void AddTriangle(MeshCorner a, MeshCorner b, MeshCorner c) => _triangles.Add(new(a, b, c, SmoothingGroup));

    /// <summary>Two faces, wound as a triangle of the first three corners.</summary>
    public void AddQuad(MeshCorner a, MeshCorner b, MeshCorner c, MeshCorner d)
    {
        AddTriangle(a, b, c);
        AddTriangle(a, c, d);
    }

    /// <summary>Two faces with corners of their own, the texture once across them.</summary>
    public void AddQuad(Vector a, Vector b, Vector c, Vector d) => AddQuad(
        new MeshCorner(AddPosition(a), AddTextureCoordinate(0, 0)), new MeshCorner(AddPosition(b), AddTextureCoordinate(1, 0)),
        new MeshCorner(AddPosition(c), AddTextureCoordinate(1, 1)), new MeshCorner(AddPosition(d), AddTextureCoordinate(0, 1)));

    /// <summary>A grid of corners [rows, columns] joined by quads, outside where <c>Cross(next column, next row)</c> points.</summary>
    public void AddGrid(MeshCorner[,] corners)
    {
        for (var row = 0; row + 1 < corners.GetLength(0); row++)
        {
            for (var column = 0; column + 1 < corners.GetLength(1); column++)
            {
                AddQuad(corners[row, column], corners[row, column + 1], corners[row + 1, column + 1], corners[row + 1, column]);
            }
        }
    }

    /// <summary>The mesh. Smooth faces have normals, flat ones none.</summary>
    public Mesh Build()
    {
        var mesh = new Mesh([.. _positions.SelectMany(ToArray)], CollectIndices(corner => corner.PositionIndex))
            .WithTextureCoordinates([.. _coordinates.SelectMany(ToArray)], CollectIndices(corner => corner.CoordinateIndex));
        mesh = VertexNormals.Compute(_positions, _triangles) is ({ Length: > 0 } normals, var faces)
            ? mesh.WithNormals(normals, faces)
            : mesh;
        return _groups.Count == 0 ? mesh : mesh.WithGroups(BuildGroups(), []);
    }

    private static double[] ToArray(Vector v) => [v.X, v.Y, v.Z];

    private static double[] ToArray((double U, double V) coordinate) => [coordinate.U, coordinate.V];

    private ImmutableArray<int> CollectIndices(Func<MeshCorner, int> indexOf)
    {
        var indices = new int[3 * _triangles.Count];
        for (var face = 0; face < _triangles.Count; face++)
        {
            var (a, b, c, _) = _triangles[face];
            (indices[3 * face], indices[(3 * face) + 1], indices[(3 * face) + 2]) = (indexOf(a), indexOf(b), indexOf(c));
        }

        return ImmutableCollectionsMarshal.AsImmutableArray(indices);
    }

    /// <summary>The named runs, in order.</summary>
    private ImmutableArray<MeshGroup> BuildGroups()
    {
        var groups = ImmutableArray.CreateBuilder<MeshGroup>();
        for (var i = 0; i < _groups.Count; i++)
        {
            var end = i + 1 < _groups.Count ? _groups[i + 1].FirstFace : _triangles.Count;
            if (end > _groups[i].FirstFace)
            {
                groups.Add(new(_groups[i].FirstFace, end - _groups[i].FirstFace, "", _groups[i].Name, "", 0));
            }
        }

        return groups.ToImmutable();
    }
}
