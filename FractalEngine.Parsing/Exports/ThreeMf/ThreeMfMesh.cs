using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry.Surfaces;

namespace FractalEngine.Parsing.Exports.ThreeMf;

/// <summary>Writes a mesh of a 3MF file (§4.1), whose vertices at one position are one, with a colour for each face.</summary>
internal sealed class ThreeMfMesh
{
    /// <summary>The identifier of the list of colours.</summary>
    public const int MaterialsId = 1;

    private readonly ExportedPart _part;
    private readonly bool _isMirrored;

    // The number of the colour of each group; none where there are no colours.
    private readonly int[] _colours;

    /// <summary>Finds the colours of a mesh.</summary>
    /// <param name="part">Has the mesh.</param>
    /// <param name="isMirrored">Whether its mirror image is written.</param>
    /// <param name="colours">The colours of the file with their numbers, to which new ones are added; null for none.</param>
    public ThreeMfMesh(ExportedPart part, bool isMirrored, Dictionary<string, int>? colours)
    {
        _part = part;
        _isMirrored = isMirrored;
        _colours = colours is null ? [] : [.. part.Groups.Select(group =>
        {
            var (red, green, blue) = ExportedPart.ToBytes(part.ColourOf(group.Material, Tint.None));
            var colour = $"#{red:X2}{green:X2}{blue:X2}";
            colours.TryAdd(colour, colours.Count);
            return colours[colour];
        })];
    }

    /// <summary>The attributes of the object, with a blank before them.</summary>
    public string Attributes =>
        _colours is [var first, ..] ? FormattableString.Invariant($" pid=\"{MaterialsId}\" pindex=\"{first}\"") : "";

    /// <summary>Writes the content of the object.</summary>
    /// <param name="text">Receives it.</param>
    /// <param name="progress">Told the written part; null for nobody.</param>
    public void Write(TextWriter text, IProgress<double>? progress)
    {
        var mesh = _part.Mesh;
        var representatives = VertexWelding.FindRepresentatives(mesh);
        var numbers = new int[mesh.VertexCount];
        var count = 0;
        text.Write("<mesh><vertices>\n");
        for (var vertex = 0; vertex < mesh.VertexCount; vertex++)
        {
            numbers[vertex] = representatives[vertex] == vertex ? count++ : numbers[representatives[vertex]];
            if (representatives[vertex] == vertex)
            {
                var (x, y, z) = _isMirrored ? LevelGraph.Mirror * mesh.Vertex(vertex) : mesh.Vertex(vertex);
                text.Write(FormattableString.Invariant($"<vertex x=\"{x:R}\" y=\"{y:R}\" z=\"{z:R}\"/>\n"));
            }
        }

        text.Write("</vertices><triangles>\n");
        foreach (var (index, group) in _part.Groups.Index())
        {
            var colour = _colours.Length > 0 && _colours[index] != _colours[0]
                ? FormattableString.Invariant($" pid=\"{MaterialsId}\" p1=\"{_colours[index]}\"") : "";
            for (var i = 3 * group.FirstFace; i < 3 * (group.FirstFace + group.FaceCount); i += 3)
            {
                var first = numbers[mesh.VertexIndices[i]];
                var second = numbers[mesh.VertexIndices[i + (_isMirrored ? 2 : 1)]];
                var third = numbers[mesh.VertexIndices[i + (_isMirrored ? 1 : 2)]];
                // The format knows no faces without an area.
                if (first != second && second != third && third != first)
                {
                    text.Write(FormattableString.Invariant($"<triangle v1=\"{first}\" v2=\"{second}\" v3=\"{third}\"{colour}/>\n"));
                }

                progress?.Report((i + 3.0) / mesh.VertexIndices.Length);
            }
        }

        text.Write("</triangles></mesh>\n");
    }
}
