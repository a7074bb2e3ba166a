using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Exports.Ply;

/// <summary>The vertices of a mesh as a PLY file has them: each with one colour, so that it is there for each group it is in.</summary>
internal sealed class PlyVertices
{
    private readonly ExportedPart _part;
    private readonly (int Vertex, int Group)[] _sources;

    /// <summary>Finds the vertices that faces of a mesh use.</summary>
    public PlyVertices(ExportedPart part)
    {
        _part = part;
        Indices = new uint[part.Mesh.VertexIndices.Length];
        var numbers = new Dictionary<(int Vertex, int Group), uint>();
        foreach (var (index, group) in part.Groups.Index())
        {
            for (var i = 3 * group.FirstFace; i < 3 * (group.FirstFace + group.FaceCount); i++)
            {
                var source = (part.Mesh.VertexIndices[i], index);
                numbers.TryAdd(source, (uint)numbers.Count);
                Indices[i] = numbers[source];
            }
        }

        _sources = [.. numbers.OrderBy(static pair => pair.Value).Select(static pair => pair.Key)];
        Positions = Array.ConvertAll(_sources, source => part.Mesh.Vertex(source.Vertex));
    }

    /// <summary>The positions in the mesh.</summary>
    public Vector[] Positions { get; }

    /// <summary>The vertices of the faces, [faces × 3].</summary>
    public uint[] Indices { get; }

    /// <summary>Computes the colours of an instance, a byte each for red, green and blue.</summary>
    /// <param name="tint">What maps mix into its colour.</param>
    /// <param name="colours">Receives the colours, [vertices × 3].</param>
    public void Fill(Tint tint, Span<byte> colours)
    {
        var ofGroups = _part.Groups.Select(group => _part.ColourOf(group.Material, tint)).ToArray();
        for (var i = 0; i < _sources.Length; i++)
        {
            var (vertex, group) = _sources[i];
            var colour = ofGroups[group];
            if (!_part.Mesh.Colours.IsEmpty)
            {
                // As light, as they are drawn.
                var own = _part.Mesh.Colours.AsSpan(3 * vertex, 3);
                var (red, green, blue) = new Colour(own[0], own[1], own[2]).ToLinear();
                var (tintRed, tintGreen, tintBlue) = colour.ToLinear();
                colour = new Colour(red * tintRed, green * tintGreen, blue * tintBlue).FromLinear();
            }

            (colours[3 * i], colours[(3 * i) + 1], colours[(3 * i) + 2]) = ExportedPart.ToBytes(colour);
        }
    }
}
