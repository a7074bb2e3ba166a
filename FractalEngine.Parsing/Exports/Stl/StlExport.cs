using System.Text;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Parsing.Exports.Stl;

/// <summary>Binary STL: triangles of floats with their normals, right-handed with z up, as programs for printing take them.</summary>
/// <remarks>Streamed at some 500 MB/s; memory as <see cref="ExportedScene"/>.</remarks>
public sealed class StlExport : SceneExport
{
    private const int HeaderLength = 80;
    private const int FaceLength = (12 * sizeof(float)) + sizeof(ushort);

    /// <inheritdoc/>
    public override string Ending => ".stl";

    /// <inheritdoc/>
    protected override ExportSummary WriteCore(LoadedScene scene, ExportSettings settings, Stream stream)
    {
        var frame = ExportFrame.Printing.From(scene, settings);
        var exported = ExportedScene.Of(scene, settings, frame);
        if (exported.FaceCount > uint.MaxValue)
        {
            throw new FractalLimitException($"{exported.Contents} are more than an STL file can count: {uint.MaxValue}");
        }

        var writer = new LittleEndianWriter(stream, settings.Progress, HeaderLength + sizeof(uint) + (FaceLength * exported.FaceCount));
        // Other programs take a file for text if it begins with the word "solid".
        writer.WriteBytes(Encoding.ASCII.GetBytes("FractalEngine, binary STL".PadRight(HeaderLength)));
        writer.WriteUInt32((uint)exported.FaceCount);
        foreach (var part in exported.Parts)
        {
            WritePart(part, writer);
        }

        writer.Flush();
        return new(exported.Contents) { Losses = [.. ExportedScene.LossesOf(scene), .. LittleEndianWriter.LossesOf(scene, frame)] };
    }

    private static void WritePart(ExportedPart part, LittleEndianWriter writer)
    {
        var positions = new Vector[part.Mesh.VertexCount];
        var indices = part.Mesh.VertexIndices;
        foreach (var instance in part.Instances)
        {
            for (var vertex = 0; vertex < positions.Length; vertex++)
            {
                positions[vertex] = instance.Map * part.Mesh.Vertex(vertex);
            }

            // A mirror turns faces inside out; exchanging two corners turns them back.
            var (second, third) = instance.Map.Linear.Determinant() < 0 ? (2, 1) : (1, 2);
            for (var i = 0; i < indices.Length; i += 3)
            {
                var (a, b, c) = (positions[indices[i]], positions[indices[i + second]], positions[indices[i + third]]);
                var normal = Vector.Cross(b - a, c - a);
                writer.WriteSingle(normal.MaxAbsComponent() is > 0 and < double.PositiveInfinity ? normal.UnitVector() : Vector.Zero);
                writer.WriteSingle(a);
                writer.WriteSingle(b);
                writer.WriteSingle(c);
                writer.WriteUInt16(0);
            }
        }
    }
}
