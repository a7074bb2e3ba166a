using System.Collections.Immutable;
using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Generation;

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
    public int Smoothing { get; set; }

    /// <summary>All faces, for those who look at them or split them.</summary>
    internal List<MeshTriangle> Triangles => _triangles;

    /// <summary>All positions.</summary>
    internal List<Vector> Positions => _positions;

    /// <summary>The faces to come belong to a part of this name.</summary>
    public void Group(string name) => _groups.Add((_triangles.Count, name));

    /// <summary>A new vertex.</summary>
    public int Position(Vector position)
    {
        _positions.Add(position);
        return _positions.Count - 1;
    }

    /// <summary>A new texture coordinate.</summary>
    public int Coordinate(double u, double v)
    {
        _coordinates.Add((u, v));
        return _coordinates.Count - 1;
    }

    /// <summary>The coordinate half-way between two.</summary>
    public int CoordinateBetween(int coordinate1, int coordinate2) =>
        (_coordinates[coordinate1], _coordinates[coordinate2]) switch
        {
            var ((u1, v1), (u2, v2)) => Coordinate((u1 + u2) / 2, (v1 + v2) / 2),
        };

    /// <summary>A face; <c>Cross(b − a, c − a)</c> points outwards.</summary>
    public void Triangle(MeshCorner a, MeshCorner b, MeshCorner c) => _triangles.Add(new(a, b, c, Smoothing));

    /// <summary>Two faces, wound as a triangle of the first three corners.</summary>
    public void Quad(MeshCorner a, MeshCorner b, MeshCorner c, MeshCorner d)
    {
        Triangle(a, b, c);
        Triangle(a, c, d);
    }

    /// <summary>Two faces with corners of their own, the texture once across them.</summary>
    public void Quad(Vector a, Vector b, Vector c, Vector d) => Quad(
        new MeshCorner(Position(a), Coordinate(0, 0)), new MeshCorner(Position(b), Coordinate(1, 0)),
        new MeshCorner(Position(c), Coordinate(1, 1)), new MeshCorner(Position(d), Coordinate(0, 1)));

    /// <summary>A grid of corners [rows, columns] joined by quads, outside where <c>Cross(next column, next row)</c> points.</summary>
    public void Grid(MeshCorner[,] corners)
    {
        for (var row = 0; row + 1 < corners.GetLength(0); row++)
        {
            for (var column = 0; column + 1 < corners.GetLength(1); column++)
            {
                Quad(corners[row, column], corners[row, column + 1], corners[row + 1, column + 1], corners[row + 1, column]);
            }
        }
    }

    /// <summary>The mesh. Smooth faces have normals, flat ones none.</summary>
    public Mesh Build()
    {
        var mesh = new Mesh([.. _positions.SelectMany(ToArray)], Corners(corner => corner.Position))
            .WithTextureCoordinates([.. _coordinates.SelectMany(ToArray)], Corners(corner => corner.Coordinate));
        mesh = VertexNormals.Of(_positions, _triangles) is ({ Length: > 0 } normals, var faces) ? mesh.WithNormals(normals, faces) : mesh;
        return _groups.Count == 0 ? mesh : mesh.WithGroups(Groups(), []);
    }

    private static double[] ToArray(Vector v) => [v.X, v.Y, v.Z];

    private static double[] ToArray((double U, double V) coordinate) => [coordinate.U, coordinate.V];

    private ImmutableArray<int> Corners(Func<MeshCorner, int> number)
    {
        var numbers = new int[3 * _triangles.Count];
        for (var face = 0; face < _triangles.Count; face++)
        {
            var (a, b, c, _) = _triangles[face];
            (numbers[3 * face], numbers[(3 * face) + 1], numbers[(3 * face) + 2]) = (number(a), number(b), number(c));
        }

        return ImmutableCollectionsMarshal.AsImmutableArray(numbers);
    }

    /// <summary>The named runs, in order.</summary>
    private ImmutableArray<MeshGroup> Groups()
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
