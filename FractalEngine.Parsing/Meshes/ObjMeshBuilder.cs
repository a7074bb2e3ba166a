using System.Collections.Immutable;
using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Meshes;

/// <summary>Collects the elements of an OBJ file into the flat arrays of a mesh; polygons become triangles on the way in.</summary>
internal sealed class ObjMeshBuilder
{
    private readonly List<double> _positions = [];
    private readonly List<double> _textureCoordinates = [];
    private readonly List<double> _normals = [];
    private readonly List<int> _faces = [];
    private readonly List<int> _textureFaces = [];
    private readonly List<int> _normalFaces = [];
    private readonly List<MeshGroup> _groups = [];
    private readonly List<string> _materialLibraries = [];
    private readonly HashSet<string> _knownLibraries = [];
    private readonly PolygonTriangulator _triangulator = new();
    private readonly List<int> _triangles = [];
    private readonly List<Vector> _polygon = [];
    private (string Object, string Group, string Material, int Smoothing) _names = ("", "", "", 0);
    private int _groupStart;

    public int PositionCount => _positions.Count / 3;

    public int TextureCoordinateCount => _textureCoordinates.Count / 2;

    public int NormalCount => _normals.Count / 3;

    public string ObjectName
    {
        set => ChangeNames(_names with { Object = value });
    }

    public string GroupName
    {
        set => ChangeNames(_names with { Group = value });
    }

    public string Material
    {
        set => ChangeNames(_names with { Material = value });
    }

    public int SmoothingGroup
    {
        set => ChangeNames(_names with { Smoothing = value });
    }

    /// <summary>Returns false where the file was named before, or has no name.</summary>
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

        _polygon.Clear();
        _triangles.Clear();
        foreach (var corner in corners)
        {
            _polygon.Add(Position(corner.Position));
        }

        _triangulator.Triangulate(CollectionsMarshal.AsSpan(_polygon), _triangles);
        for (var i = 0; i < _triangles.Count; i += 3)
        {
            AddTriangle(corners[_triangles[i]], corners[_triangles[i + 1]], corners[_triangles[i + 2]]);
        }
    }

    public Mesh Build()
    {
        EndGroup();
        var mesh = new Mesh(ToImmutable(_positions), ToImmutable(_faces));
        if (_textureFaces.Count > 0)
        {
            mesh = mesh.WithTextureCoordinates(ToImmutable(_textureCoordinates), ToImmutable(_textureFaces));
        }

        if (_normalFaces.Count > 0)
        {
            mesh = mesh.WithNormals(ToImmutable(_normals), ToImmutable(_normalFaces));
        }

        return mesh.WithGroups([.. _groups], [.. _materialLibraries]);
    }

    private static ImmutableArray<T> ToImmutable<T>(List<T> list) => ImmutableCollectionsMarshal.AsImmutableArray(list.ToArray());

    private static void Add(List<double> list, Vector v)
    {
        list.Add(v.X);
        list.Add(v.Y);
        list.Add(v.Z);
    }

    private Vector Position(int number) =>
        new(_positions[3 * number], _positions[(3 * number) + 1], _positions[(3 * number) + 2]);

    private void AddTriangle(ObjCorner a, ObjCorner b, ObjCorner c)
    {
        AddOptional(_textureFaces, a.TextureCoordinate, b.TextureCoordinate, c.TextureCoordinate);
        AddOptional(_normalFaces, a.Normal, b.Normal, c.Normal);
        Add(_faces, a.Position, b.Position, c.Position);
    }

    /// <summary>The list stays empty until a face has such numbers; then the faces before it get none.</summary>
    private void AddOptional(List<int> list, int a, int b, int c)
    {
        if (list.Count == 0)
        {
            if (a == ObjCorner.None && b == ObjCorner.None && c == ObjCorner.None)
            {
                return;
            }

            list.AddRange(Enumerable.Repeat(ObjCorner.None, _faces.Count));
        }

        Add(list, a, b, c);
    }

    private static void Add(List<int> list, int a, int b, int c)
    {
        list.Add(a);
        list.Add(b);
        list.Add(c);
    }

    private void ChangeNames((string Object, string Group, string Material, int Smoothing) names)
    {
        if (names != _names)
        {
            EndGroup();
            _names = names;
        }
    }

    private void EndGroup()
    {
        var end = _faces.Count / 3;
        if (end > _groupStart)
        {
            _groups.Add(new(_groupStart, end - _groupStart, _names.Object, _names.Group, _names.Material, _names.Smoothing));
            _groupStart = end;
        }
    }
}
