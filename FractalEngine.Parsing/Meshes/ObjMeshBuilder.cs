using System.Collections.Immutable;
using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Meshes;

/// <summary>Collects the elements of an OBJ file into the flat arrays of a mesh, and triangulates polygons on the way.</summary>
internal sealed class ObjMeshBuilder
{
    private readonly List<double> _positions = [];
    private readonly List<double> _textureCoordinates = [];
    private readonly List<double> _normals = [];
    private readonly List<int> _positionIndices = [];
    private readonly List<int> _textureIndices = [];
    private readonly List<int> _normalIndices = [];
    private readonly List<MeshGroup> _groups = [];
    private readonly List<string> _materialLibraries = [];
    private readonly HashSet<string> _knownLibraries = [];
    private readonly PolygonTriangulator _triangulator = new();
    private readonly List<int> _triangleCorners = [];
    private readonly List<Vector> _polygonPositions = [];
    private (string Object, string Group, string Material, int Smoothing) _groupState = ("", "", "", 0);
    private int _firstGroupFace;

    public int PositionCount => _positions.Count / 3;

    public int TextureCoordinateCount => _textureCoordinates.Count / 2;

    public int NormalCount => _normals.Count / 3;

    public string ObjectName
    {
        set => ChangeGroupState(_groupState with { Object = value });
    }

    public string GroupName
    {
        set => ChangeGroupState(_groupState with { Group = value });
    }

    public string Material
    {
        set => ChangeGroupState(_groupState with { Material = value });
    }

    public int SmoothingGroup
    {
        set => ChangeGroupState(_groupState with { Smoothing = value });
    }

    /// <summary>Adds a material file; returns false if its name is empty or was added before.</summary>
    public bool AddMaterialLibrary(string file)
    {
        if (file.Length == 0 || !_knownLibraries.Add(file))
        {
            return false;
        }

        _materialLibraries.Add(file);
        return true;
    }

    public void AddPosition(Vector position) => Add(_positions, position);

    public void AddNormal(Vector normal) => Add(_normals, normal);

    public void AddTextureCoordinate(double u, double v)
    {
        _textureCoordinates.Add(u);
        _textureCoordinates.Add(v);
    }

    public void AddPolygon(ReadOnlySpan<ObjCorner> corners)
    {
        if (corners.Length == 3)
        {
            AddTriangle(corners[0], corners[1], corners[2]);
            return;
        }

        _polygonPositions.Clear();
        _triangleCorners.Clear();
        foreach (var corner in corners)
        {
            _polygonPositions.Add(Position(corner.PositionIndex));
        }

        _triangulator.Triangulate(CollectionsMarshal.AsSpan(_polygonPositions), _triangleCorners);
        for (var i = 0; i < _triangleCorners.Count; i += 3)
        {
            AddTriangle(corners[_triangleCorners[i]], corners[_triangleCorners[i + 1]], corners[_triangleCorners[i + 2]]);
        }
    }

    public Mesh Build()
    {
        EndGroup();
        var mesh = new Mesh(ToImmutable(_positions), ToImmutable(_positionIndices));
        if (_textureIndices.Count > 0)
        {
            mesh = mesh.WithTextureCoordinates(ToImmutable(_textureCoordinates), ToImmutable(_textureIndices));
        }

        if (_normalIndices.Count > 0)
        {
            mesh = mesh.WithNormals(ToImmutable(_normals), ToImmutable(_normalIndices));
        }

        // A file that names no group has none.
        var isUngrouped = _groups is [{ ObjectName: "", GroupName: "", Material: "", SmoothingGroup: 0 }];
        return mesh.WithGroups(isUngrouped ? [] : [.. _groups], [.. _materialLibraries]);
    }

    private static ImmutableArray<T> ToImmutable<T>(List<T> list) => ImmutableCollectionsMarshal.AsImmutableArray(list.ToArray());

    private static void Add(List<double> list, Vector v)
    {
        list.Add(v.X);
        list.Add(v.Y);
        list.Add(v.Z);
    }

    private Vector Position(int index) =>
        new(_positions[3 * index], _positions[(3 * index) + 1], _positions[(3 * index) + 2]);

    private void AddTriangle(ObjCorner a, ObjCorner b, ObjCorner c)
    {
        AddOptionalIndices(_textureIndices, a.TextureCoordinateIndex, b.TextureCoordinateIndex, c.TextureCoordinateIndex);
        AddOptionalIndices(_normalIndices, a.NormalIndex, b.NormalIndex, c.NormalIndex);
        Add(_positionIndices, a.PositionIndex, b.PositionIndex, c.PositionIndex);
    }

    /// <summary>
    /// Adds the indices of a triangle. The list stays empty until a face has any; earlier faces then get <see cref="ObjCorner.None"/>.
    /// </summary>
    private void AddOptionalIndices(List<int> indices, int a, int b, int c)
    {
        if (indices.Count == 0)
        {
            if (a == ObjCorner.None && b == ObjCorner.None && c == ObjCorner.None)
            {
                return;
            }

            indices.AddRange(Enumerable.Repeat(ObjCorner.None, _positionIndices.Count));
        }

        Add(indices, a, b, c);
    }

    private static void Add(List<int> list, int a, int b, int c)
    {
        list.Add(a);
        list.Add(b);
        list.Add(c);
    }

    private void ChangeGroupState((string Object, string Group, string Material, int Smoothing) state)
    {
        if (state != _groupState)
        {
            EndGroup();
            _groupState = state;
        }
    }

    private void EndGroup()
    {
        var end = _positionIndices.Count / 3;
        if (end > _firstGroupFace)
        {
            _groups.Add(new(_firstGroupFace, end - _firstGroupFace, _groupState.Object, _groupState.Group, _groupState.Material,
                _groupState.Smoothing));
            _firstGroupFace = end;
        }
    }
}
