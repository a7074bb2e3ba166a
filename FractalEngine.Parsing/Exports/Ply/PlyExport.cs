using System.Text;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Parsing.Exports.Ply;

/// <summary>Binary PLY: vertices of doubles, with colours where the scene has any, then triangles; right-handed with y up.</summary>
/// <remarks>Streamed at some 300 MB/s, in two passes over the instances; memory as <see cref="ExportedScene"/>.</remarks>
public sealed class PlyExport : SceneExport
{
    private const int FaceLength = 1 + (3 * sizeof(uint));

    /// <inheritdoc/>
    public override string Ending => ".ply";

    /// <inheritdoc/>
    protected override ExportSummary WriteCore(LoadedScene scene, ExportSettings settings, Stream stream)
    {
        var exported = ExportedScene.Of(scene, settings, ExportFrame.Right.From(scene, settings));
        var parts = exported.Parts.Select(static part => (Part: part, Vertices: new PlyVertices(part))).ToArray();
        var vertexCount = parts.Sum(static one => one.Part.Count * one.Vertices.Positions.Length);
        if (vertexCount > int.MaxValue)
        {
            throw new FractalLimitException($"{vertexCount} vertices are more than a PLY file can count: {int.MaxValue}");
        }

        var hasColours = exported.Parts.Any(static part => part.HasColour);
        var header = Encoding.ASCII.GetBytes(
            FormattableString.Invariant($"ply\nformat binary_little_endian 1.0\ncomment FractalEngine\nelement vertex {vertexCount}\n")
            + "property double x\nproperty double y\nproperty double z\n"
            + (hasColours ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "")
            + FormattableString.Invariant($"element face {exported.FaceCount}\nproperty list uchar int vertex_indices\nend_header\n"));
        var vertexLength = (3 * sizeof(double)) + (hasColours ? 3 : 0);
        var writer = new LittleEndianWriter(
            stream, settings.Progress, header.Length + (vertexCount * vertexLength) + (exported.FaceCount * FaceLength));
        writer.WriteBytes(header);
        foreach (var (part, vertices) in parts)
        {
            WriteVertices(part, vertices, hasColours, writer);
        }

        var first = 0u;
        foreach (var (part, vertices) in parts)
        {
            first = WriteFaces(part, vertices, first, writer);
        }

        writer.Flush();
        return new(exported.Contents) { Losses = ExportedScene.LossesOf(scene) };
    }

    private static void WriteVertices(ExportedPart part, PlyVertices vertices, bool hasColours, LittleEndianWriter writer)
    {
        var colours = new byte[3 * vertices.Positions.Length];
        var coloured = (Tint?)null;
        foreach (var instance in part.Instances)
        {
            if (hasColours && coloured != instance.Tint)
            {
                vertices.Fill(instance.Tint, colours);
                coloured = instance.Tint;
            }

            for (var i = 0; i < vertices.Positions.Length; i++)
            {
                writer.WriteDouble(instance.Map * vertices.Positions[i]);
                if (hasColours)
                {
                    writer.WriteBytes(colours.AsSpan(3 * i, 3));
                }
            }
        }
    }

    private static uint WriteFaces(ExportedPart part, PlyVertices vertices, uint first, LittleEndianWriter writer)
    {
        var indices = vertices.Indices;
        foreach (var instance in part.Instances)
        {
            // A mirror turns faces inside out; exchanging two corners turns them back.
            var (second, third) = instance.Map.Linear.Determinant() < 0 ? (2, 1) : (1, 2);
            for (var i = 0; i < indices.Length; i += 3)
            {
                writer.WriteTriangle(first + (uint)indices[i], first + (uint)indices[i + second], first + (uint)indices[i + third]);
            }

            first += (uint)vertices.Positions.Length;
        }

        return first;
    }
}
