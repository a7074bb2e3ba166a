using System.Globalization;
using System.Xml;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
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
    /// <param name="colours">The colours of the file, to which new ones are added; null for none.</param>
    public ThreeMfMesh(ExportedPart part, bool isMirrored, List<string>? colours)
    {
        _part = part;
        _isMirrored = isMirrored;
        _colours = colours is null ? [] : [.. part.Groups.Select(group => NumberOf(part.ColourOf(group.Material, Tint.None), colours))];
    }

    /// <summary>Writes the content of an object.</summary>
    public void Write(XmlWriter xml, string space)
    {
        if (_colours.Length > 0)
        {
            xml.WriteAttributeString("pid", Format(MaterialsId));
            xml.WriteAttributeString("pindex", Format(_colours[0]));
        }

        var mesh = _part.Mesh;
        var representatives = VertexWelding.FindRepresentatives(mesh);
        var numbers = new int[mesh.VertexCount];
        var count = 0;
        xml.WriteStartElement("mesh", space);
        xml.WriteStartElement("vertices", space);
        for (var vertex = 0; vertex < mesh.VertexCount; vertex++)
        {
            numbers[vertex] = representatives[vertex] == vertex ? count++ : numbers[representatives[vertex]];
            if (representatives[vertex] == vertex)
            {
                var (x, y, z) = _isMirrored ? LevelGraph.Mirror * mesh.Vertex(vertex) : mesh.Vertex(vertex);
                xml.WriteStartElement("vertex", space);
                xml.WriteAttributeString("x", Format(x));
                xml.WriteAttributeString("y", Format(y));
                xml.WriteAttributeString("z", Format(z));
                xml.WriteEndElement();
            }
        }

        xml.WriteEndElement();
        xml.WriteStartElement("triangles", space);
        foreach (var (index, group) in _part.Groups.Index())
        {
            for (var i = 3 * group.FirstFace; i < 3 * (group.FirstFace + group.FaceCount); i += 3)
            {
                WriteTriangle(xml, space, index, [.. mesh.VertexIndices.AsSpan(i, 3).ToArray().Select(vertex => numbers[vertex])]);
            }
        }

        xml.WriteEndElement();
        xml.WriteEndElement();
    }

    private void WriteTriangle(XmlWriter xml, string space, int group, int[] corners)
    {
        // A face without an area, of which the format knows none.
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
        {
            return;
        }

        xml.WriteStartElement("triangle", space);
        xml.WriteAttributeString("v1", Format(corners[0]));
        xml.WriteAttributeString("v2", Format(corners[_isMirrored ? 2 : 1]));
        xml.WriteAttributeString("v3", Format(corners[_isMirrored ? 1 : 2]));
        if (_colours.Length > 0 && _colours[group] != _colours[0])
        {
            xml.WriteAttributeString("pid", Format(MaterialsId));
            xml.WriteAttributeString("p1", Format(_colours[group]));
        }

        xml.WriteEndElement();
    }

    private static int NumberOf(Colour colour, List<string> colours)
    {
        var text = $"#{ToByte(colour.Red):X2}{ToByte(colour.Green):X2}{ToByte(colour.Blue):X2}";
        if (!colours.Contains(text))
        {
            colours.Add(text);
        }

        return colours.IndexOf(text);
    }

    private static byte ToByte(double component) => (byte)Math.Round(byte.MaxValue * Math.Clamp(component, 0, 1));

    private static string Format<T>(T number)
        where T : IFormattable => number.ToString(null, CultureInfo.InvariantCulture);
}
