using System.Globalization;
using System.Text;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Simulation;

namespace FractalEngine.Parsing.Exports.Csv;

/// <summary>
/// Comma-separated values (RFC 4180, lines end in a line feed), a row an instance: object, path through the levels, mesh, the rows of the
/// matrix from the mesh to the world, and the colour, sRGB. Coordinates are those of the scene unless the settings say otherwise.
/// </summary>
/// <remarks>Numbers read back to the same bits. Limits count the faces of each instance.</remarks>
public sealed class CsvExport : SceneExport
{
    /// <summary>The names of the columns.</summary>
    public const string Header = "object,path,mesh,xx,xy,xz,x,yx,yy,yz,y,zx,zy,zz,z,red,green,blue";

    /// <inheritdoc/>
    public override string Ending => ".csv";

    /// <inheritdoc/>
    protected override ExportSummary WriteCore(LoadedScene scene, ExportSettings settings, Stream stream)
    {
        var exported = ExportedScene.Of(scene, settings, ExportFrame.Unchanged.From(scene, settings), hasPaths: true);
        using var writer = new StreamWriter(stream, new UTF8Encoding(false), bufferSize: 1 << 16, leaveOpen: true);
        writer.Write($"{Header}\n");
        var (written, count) = (0L, exported.Parts.Sum(static part => part.Count));
        foreach (var part in exported.Parts)
        {
            var name = BodyCsvWriter.Quote(part.ObjectName);
            var mesh = BodyCsvWriter.Quote(scene.Objects[part.ObjectIndex].Model.MeshNameAt(part.MeshIndex));
            foreach (var instance in part.Instances)
            {
                var colour = part.ColourOf(part.Groups is [var first, ..] ? first.Material : "", instance.Tint);
                writer.Write($"{name},{instance.Path},{mesh},");
                foreach (var number in TransformRows.Of(instance.Map))
                {
                    writer.Write(string.Create(CultureInfo.InvariantCulture, $"{number:R},"));
                }

                writer.Write(string.Create(CultureInfo.InvariantCulture, $"{colour.Red:R},{colour.Green:R},{colour.Blue:R}\n"));
                settings.Progress?.Report((double)++written / count);
            }
        }

        return new(count == 1 ? "1 instance" : FormattableString.Invariant($"{count} instances"))
        {
            Losses = ExportedScene.LossesOf(scene),
        };
    }
}
