using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Exports.Ply;

/// <summary>The vertices of a mesh as a PLY file has them: each with one colour, so that it is there for each group it is in.</summary>
internal sealed class PlyVertices
{
    private readonly ExportedPart _part;
    private readonly ExportedCorners _corners;

    /// <summary>Finds the vertices that faces of a mesh use.</summary>
    public PlyVertices(ExportedPart part)
    {
        _part = part;
        _corners = new(part.Mesh, hasSurface: false);
        Indices = [.. part.Groups.SelectMany((group, index) => _corners.Add(group.FirstFace, group.FaceCount, index))];
        Positions = [.. Enumerable.Range(0, _corners.All.Count).Select(_corners.PositionAt)];
    }

    /// <summary>The positions in the mesh.</summary>
    public Vector[] Positions { get; }

    /// <summary>The vertices of the faces, [faces × 3].</summary>
    public int[] Indices { get; }

    /// <summary>Computes the colours of an instance, a byte each for red, green and blue.</summary>
    /// <param name="tint">What maps mix into its colour.</param>
    /// <param name="colours">Receives the colours, [vertices × 3].</param>
    public void Fill(Tint tint, Span<byte> colours)
    {
        var ofGroups = _part.Groups.Select(group => _part.ColourOf(group.Material, tint)).ToArray();
        for (var i = 0; i < Positions.Length; i++)
        {
            var colour = ofGroups[_corners.All[i].Batch];
            if (_corners.HasColours)
            {
                // As light, as they are drawn.
                var light = colour.ToLinearVector().Stretch(_corners.ColourAt(i).ToLinearVector());
                colour = new Colour(light.X, light.Y, light.Z).FromLinear();
            }

            (colours[3 * i], colours[(3 * i) + 1], colours[(3 * i) + 2]) = ExportedPart.ToBytes(colour);
        }
    }
}
