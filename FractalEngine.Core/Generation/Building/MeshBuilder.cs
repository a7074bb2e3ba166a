using System.Collections.Immutable;
using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation.Building;

/// <summary>Collects the faces of a generated mesh, and computes the normals of smooth faces at the end.</summary>
internal sealed class MeshBuilder
{
    private readonly List<(double U, double V)> _coordinates = [];
    private readonly List<(int FirstFace, string Name)> _groups = [];

    /// <summary>Number of faces so far.</summary>
    public int FaceCount => Triangles.Count;

    /// <summary>
    /// Smoothing group of the next faces: those of one group share normals where they share positions; 0 is flat.
    /// </summary>
    public int SmoothingGroup { get; set; }

    /// <summary>All faces, for reading and for splitting.</summary>
    internal List<MeshTriangle> Triangles { get; } = [];

    /// <summary>Positions of all vertices.</summary>
    internal List<Vector> Positions { get; } = [];

    /// <summary>Begins a named group, which the next faces belong to.</summary>
    public void BeginGroup(string name) => _groups.Add((Triangles.Count, name));

    /// <summary>Adds a vertex, and returns its index.</summary>
    public int AddPosition(Vector position)
    {
        Positions.Add(position);
        return Positions.Count - 1;
    }

    /// <summary>Adds a texture coordinate, and returns its index.</summary>
    public int AddTextureCoordinate(double u, double v)
    {
        _coordinates.Add((u, v));
        return _coordinates.Count - 1;
    }

    /// <summary>Adds the texture coordinate half-way between two, and returns its index.</summary>
    public int AddCoordinateMidpoint(int coordinate1, int coordinate2)
    {
        var (u1, v1) = _coordinates[coordinate1];
        var (u2, v2) = _coordinates[coordinate2];
        return AddTextureCoordinate((u1 + u2) / 2, (v1 + v2) / 2);
    }

    /// <summary>Adds a face, wound so that <c>Cross(b − a, c − a)</c> points outwards.</summary>
    public void AddTriangle(MeshCorner a, MeshCorner b, MeshCorner c) => Triangles.Add(new(a, b, c, SmoothingGroup));

    /// <summary>Adds two faces, wound as a triangle of the first three corners.</summary>
    public void AddQuad(MeshCorner a, MeshCorner b, MeshCorner c, MeshCorner d)
    {
        AddTriangle(a, b, c);
        AddTriangle(a, c, d);
    }

    /// <summary>Adds two faces with vertices of their own and the whole texture across them.</summary>
    public void AddQuad(Vector a, Vector b, Vector c, Vector d) => AddQuad(
        new MeshCorner(AddPosition(a), AddTextureCoordinate(0, 0)), new MeshCorner(AddPosition(b), AddTextureCoordinate(1, 0)),
        new MeshCorner(AddPosition(c), AddTextureCoordinate(1, 1)), new MeshCorner(AddPosition(d), AddTextureCoordinate(0, 1)));

    /// <summary>Adds the corners of a grid, row by row.</summary>
    /// <param name="corners">Receives the corners, [rows, columns].</param>
    /// <param name="closure">
    /// Directions in which the grid is closed: the last row or column shares the positions of the first, but not its texture coordinates.
    /// </param>
    /// <param name="positionAt">Computes the position at a row and column.</param>
    /// <param name="coordinateAt">Computes the texture coordinate at a row and column.</param>
    /// <param name="firstRow">First row to add; those before have been filled.</param>
    public void AddCorners(
        MeshCorner[,] corners, GridClosure closure, Func<int, int, Vector> positionAt, Func<int, int, (double U, double V)> coordinateAt,
        int firstRow = 0)
    {
        var lastRow = corners.GetLength(0) - 1;
        var lastColumn = corners.GetLength(1) - 1;
        for (var row = firstRow; row <= lastRow; row++)
        {
            for (var column = 0; column <= lastColumn; column++)
            {
                var position = closure == GridClosure.RowsAndColumns && row == lastRow ? corners[0, column].PositionIndex
                    : closure != GridClosure.Open && column == lastColumn ? corners[row, 0].PositionIndex
                    : AddPosition(positionAt(row, column));
                var (u, v) = coordinateAt(row, column);
                corners[row, column] = new(position, AddTextureCoordinate(u, v));
            }
        }
    }

    /// <summary>Adds the faces of a grid, two for each cell.</summary>
    /// <param name="corners">Corners, [rows, columns].</param>
    /// <param name="isMirrored">
    /// False where <c>Cross(next column, next row)</c> points outwards, true where it points inwards.
    /// </param>
    public void AddGrid(MeshCorner[,] corners, bool isMirrored = false)
    {
        for (var row = 0; row + 1 < corners.GetLength(0); row++)
        {
            for (var column = 0; column + 1 < corners.GetLength(1); column++)
            {
                var nextInRow = corners[row, column + 1];
                var nextInColumn = corners[row + 1, column];
                AddQuad(
                    corners[row, column],
                    isMirrored ? nextInColumn : nextInRow,
                    corners[row + 1, column + 1],
                    isMirrored ? nextInRow : nextInColumn);
            }
        }
    }

    /// <summary>Builds the mesh; smooth faces have normals, flat ones none.</summary>
    public Mesh Build()
    {
        var mesh = new Mesh([.. Positions.SelectMany(ToArray)], CollectIndices(corner => corner.PositionIndex))
            .WithTextureCoordinates([.. _coordinates.SelectMany(ToArray)], CollectIndices(corner => corner.CoordinateIndex));
        var (normals, normalIndices) = VertexNormals.Compute(Positions, Triangles);
        if (normals.Length > 0)
        {
            mesh = mesh.WithNormals(normals, normalIndices);
        }

        return _groups.Count == 0 ? mesh : mesh.WithGroups(BuildGroups(), []);
    }

    private static double[] ToArray(Vector v) => [v.X, v.Y, v.Z];

    private static double[] ToArray((double U, double V) coordinate) => [coordinate.U, coordinate.V];

    private ImmutableArray<int> CollectIndices(Func<MeshCorner, int> indexOf)
    {
        var indices = new int[3 * Triangles.Count];
        for (var face = 0; face < Triangles.Count; face++)
        {
            var (a, b, c, _) = Triangles[face];
            indices[3 * face] = indexOf(a);
            indices[(3 * face) + 1] = indexOf(b);
            indices[(3 * face) + 2] = indexOf(c);
        }

        return ImmutableCollectionsMarshal.AsImmutableArray(indices);
    }

    /// <summary>Builds the named groups that have faces, in order.</summary>
    private ImmutableArray<MeshGroup> BuildGroups()
    {
        var ends = _groups.Skip(1).Select(static group => group.FirstFace).Append(Triangles.Count);
        var groups = _groups.Zip(ends, static (group, end) => new MeshGroup(group.FirstFace, end - group.FirstFace, "", group.Name, "", 0));
        return [.. groups.Where(static group => group.FaceCount > 0)];
    }
}
