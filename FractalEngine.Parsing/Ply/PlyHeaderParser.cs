using System.Collections.Immutable;
using System.Text;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Ply;

/// <summary>Parses the header of a PLY file: its format, and its elements with their properties.</summary>
internal sealed class PlyHeaderParser(MeshBytes bytes)
{
    private readonly MeshTextReader _text = new(bytes);
    private readonly List<PlyElement> _elements = [];
    private readonly HashSet<string> _names = [];
    private readonly ImmutableArray<PlyProperty>.Builder _properties = ImmutableArray.CreateBuilder<PlyProperty>();
    private PlyFormat? _format;

    /// <summary>Parses the header at the beginning of a file.</summary>
    /// <exception cref="SourceException">The file does not begin with a header of PLY.</exception>
    public static PlyHeader Parse(MeshBytes bytes) => new PlyHeaderParser(bytes).Parse();

    private PlyHeader Parse()
    {
        _text.ReadKeyword("ply");
        _text.ReadEndOfLine();
        while (!_text.TryReadKeyword("end_header"))
        {
            ParseLine();
        }

        EndElement();
        var format = _format ?? throw _text.Error("the header has no line 'format'");
        _text.ReadEndOfLine();
        return new(format, [.. _elements], _text.Position);
    }

    private void ParseLine()
    {
        const string expected = "'format', 'element', 'property', 'comment' or 'end_header'";
        switch (Encoding.UTF8.GetString(_text.ReadWord(expected)))
        {
            case "comment" or "obj_info":
                _text.ReadRestOfLine();
                break;
            case "format":
                ParseFormat();
                break;
            case "element":
                ParseElement();
                break;
            case "property":
                ParseProperty();
                break;
            default:
                throw _text.Unexpected(expected);
        }
    }

    private void ParseFormat()
    {
        _format = Encoding.UTF8.GetString(_text.ReadWord("a format")) switch
        {
            "ascii" => PlyFormat.Text,
            "binary_little_endian" => PlyFormat.LittleEndian,
            "binary_big_endian" => PlyFormat.BigEndian,
            _ => throw _text.Unexpected("'ascii', 'binary_little_endian' or 'binary_big_endian'"),
        };
        _text.ReadKeyword("1.0");
        _text.ReadEndOfLine();
    }

    private void ParseElement()
    {
        var name = Encoding.UTF8.GetString(_text.ReadWord("the name of an element"));
        if (!_names.Add(name))
        {
            throw _text.Error($"element '{name}' is declared above");
        }

        var position = _text.WordStart;
        var count = _text.ReadCount("the number of elements", int.MaxValue);
        _text.ReadEndOfLine();
        EndElement();
        _elements.Add(new(name, count, position, []));
    }

    /// <summary>Gives the element declared last its properties.</summary>
    private void EndElement()
    {
        if (_elements.Count > 0)
        {
            _elements[^1] = _elements[^1] with { Properties = _properties.ToImmutable() };
            _properties.Clear();
        }
    }

    private void ParseProperty()
    {
        if (_elements.Count == 0)
        {
            throw _text.Error("no element is declared above");
        }

        var countType = _text.TryReadKeyword("list") ? ParseType() : null;
        if (countType is { IsInteger: false })
        {
            throw _text.Error("the length of a list is a whole number");
        }

        var type = ParseType();
        var name = Encoding.UTF8.GetString(_text.ReadWord("the name of a property"));
        _text.ReadEndOfLine();
        _properties.Add(new(name, type, countType));
    }

    private PlyType ParseType() =>
        PlyType.Find(Encoding.UTF8.GetString(_text.ReadWord("a type"))) ?? throw _text.Unexpected("a type such as 'float' or 'uchar'");
}
