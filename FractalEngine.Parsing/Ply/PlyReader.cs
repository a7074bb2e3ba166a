using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Ply;

/// <summary>
/// Reads meshes of the Polygon File Format, <c>.ply</c>, as text or binary: vertices with normals, texture
/// coordinates and colours, and polygons.
/// </summary>
/// <remarks>
/// All other properties are ignored. Coordinates are used as written. Memory: the file and twice the arrays of the mesh. Cost:
/// about a second per 100 MB.
/// </remarks>
public sealed class PlyReader
{
    private readonly MeshBytes _bytes;
    private readonly PlyHeader _header;
    private readonly PlyValues _values;
    private readonly PlyMeshBuilder _mesh = new();
    private PlyElement? _firstIgnored;

    private PlyReader(MeshBytes bytes)
    {
        _bytes = bytes;
        _header = PlyHeaderParser.Parse(bytes);
        _values = PlyValues.Create(bytes, _header);
    }

    /// <summary>Reads a PLY file as a mesh.</summary>
    /// <param name="path">Path of the file, absolute or relative to the current directory.</param>
    /// <param name="fileName">Name of the file in messages.</param>
    /// <exception cref="SourceException">
    /// The file can't be read, is not a PLY file, or refers to vertices that don't exist. In text the error has a line and a column, among
    /// binary numbers the offset of a byte.
    /// </exception>
    public static ParsedObj Read(string path, string fileName) => Read(MeshBytes.Read(path, fileName));

    /// <summary>Reads the contents of a PLY file.</summary>
    internal static ParsedObj Read(MeshBytes bytes) => new PlyReader(bytes).Read();

    private ParsedObj Read()
    {
        _mesh.VertexCount = _header.Elements.FirstOrDefault(element => element.Name == "vertex")?.Count
            ?? throw _bytes.TextError(0, "the header declares no element 'vertex'");
        foreach (var element in _header.Elements)
        {
            RequireRoom(element);
            switch (element.Name)
            {
                case "vertex":
                    ReadVertices(element);
                    break;
                case "face":
                    ReadFaces(element);
                    break;
                default:
                    Ignore(element);
                    break;
            }
        }

        return new(_mesh.Complete(), [.. CreateWarnings()]) { ByteCount = _bytes.Length };
    }

    /// <summary>Requires the rest of the file to be long enough, so that no memory is taken for what a header merely claims.</summary>
    private void RequireRoom(PlyElement element)
    {
        var size = element.Properties.Sum(property => (long)_values.MinSize(property.CountType ?? property.Type));
        if (size > 0 && element.Count > _values.RemainingBytes / size)
        {
            throw _bytes.TextError(element.Position, FormattableString.Invariant(
                $"the file ends before {element.Count} elements '{element.Name}': {_values.RemainingBytes} bytes are left"));
        }
    }

    private void ReadVertices(PlyElement element)
    {
        int[] roles = [.. element.Properties.Select(property => property.IsList ? PlyVertex.Ignored : PlyVertex.RoleOf(property.Name))];
        if (PlyVertex.MissingCoordinate(roles) is { } missing)
        {
            throw _bytes.TextError(element.Position, $"the vertices have no property '{missing}'");
        }

        _mesh.BeginVertices(roles);
        Span<double> vertex = stackalloc double[PlyVertex.RoleCount];
        for (var i = 0; i < element.Count; i++)
        {
            for (var property = 0; property < roles.Length; property++)
            {
                if (roles[property] == PlyVertex.Ignored)
                {
                    Skip(element.Properties[property]);
                    continue;
                }

                var value = _values.Read(element.Properties[property].Type)
                    * PlyVertex.FactorOf(roles[property], element.Properties[property].Type);
                if (roles[property] <= PlyVertex.Z && !double.IsFinite(value))
                {
                    throw _values.Error("a coordinate is not finite");
                }

                vertex[roles[property]] = value;
            }

            _mesh.AddVertex(vertex);
        }
    }

    private void ReadFaces(PlyElement element)
    {
        if (element.Count > 0 && !element.Properties.Any(IsVertexList))
        {
            throw _bytes.TextError(element.Position, "the faces have no list 'vertex_indices'");
        }

        for (var i = 0; i < element.Count; i++)
        {
            foreach (var property in element.Properties)
            {
                if (IsVertexList(property))
                {
                    ReadFace(property);
                }
                else
                {
                    Skip(property);
                }
            }
        }
    }

    private static bool IsVertexList(PlyProperty property) => property.IsList && property.Name is "vertex_indices" or "vertex_index";

    private void ReadFace(PlyProperty property)
    {
        var cornerCount = ReadLength(property);
        if (cornerCount > ParsingLimits.PolygonCorners.Value)
        {
            var limit = ParsingLimits.PolygonCorners.Value;
            throw _values.Error(FormattableString.Invariant(
                $"the polygon has {cornerCount} corners, more than the limit of {limit}"), isLimitExceeded: true);
        }

        for (var corner = 0; corner < cornerCount; corner++)
        {
            var index = _values.Read(property.Type);
            if (!(index >= 0 && index < _mesh.VertexCount && Math.Truncate(index).Equals(index)))
            {
                throw _values.Error(FormattableString.Invariant($"vertex {index} of {_mesh.VertexCount}: numbers start at 0"));
            }

            _mesh.AddCorner((int)index);
        }

        if (!_mesh.TryEndPolygon())
        {
            throw _values.Error("the file has more triangles than an array can hold", isLimitExceeded: true);
        }
    }

    private void Ignore(PlyElement element)
    {
        // Edges are lines, which are ignored in OBJ files too.
        _firstIgnored ??= element.Name == "edge" ? null : element;
        for (var i = 0; i < element.Count && element.Properties.Length > 0; i++)
        {
            foreach (var property in element.Properties)
            {
                Skip(property);
            }
        }
    }

    private void Skip(PlyProperty property)
    {
        for (var count = property.IsList ? ReadLength(property) : 1; count > 0; count--)
        {
            _values.Read(property.Type);
        }
    }

    private uint ReadLength(PlyProperty property)
    {
        var length = _values.Read(property.CountType!);
        return length >= 0 && length <= uint.MaxValue && Math.Truncate(length).Equals(length)
            ? (uint)length
            : throw _values.Error(FormattableString.Invariant($"{length} is not the length of a list"));
    }

    private IEnumerable<Diagnostic> CreateWarnings()
    {
        if (_firstIgnored is not null)
        {
            yield return _bytes.Diagnose(_firstIgnored.Position, $"element '{_firstIgnored.Name}' skipped", DiagnosticSeverity.Warning);
        }

        if (_mesh.ShortFaceCount > 0)
        {
            yield return _bytes.Warn(FormattableString.Invariant(
                $"a face needs at least three corners: skipped ({_mesh.ShortFaceCount} such faces in all)"));
        }

        if (_mesh.UndefinedCount > 0)
        {
            yield return _bytes.Warn(FormattableString.Invariant(
                $"a normal or texture coordinate is not finite: it counts as 0 ({_mesh.UndefinedCount} such numbers in all)"));
        }
    }
}
