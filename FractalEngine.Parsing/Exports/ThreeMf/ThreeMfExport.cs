using System.IO.Compression;
using System.Text;
using FractalEngine.Core;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Parsing.Exports.ThreeMf;

/// <summary>
/// 3MF, for printing: closed meshes, and components of components for the levels of fractals, so that a file does not grow with the
/// instances. Millimetres, right-handed with z up.
/// </summary>
public sealed class ThreeMfExport : SceneExport
{
    private const string ModelPath = "3D/3dmodel.model";

    private const string ContentTypes = """
        <Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
        <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
        <Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>
        """;

    private const string Relationships = $"""
        <Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
        <Relationship Target="/{ModelPath}" Id="model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>
        """;

    // The earliest that archives can tell, so that the same scene always gives the same bytes.
    private static readonly DateTimeOffset Timestamp = new(1980, 1, 1, 0, 0, 0, TimeSpan.Zero);

    /// <inheritdoc/>
    public override string Ending => ".3mf";

    /// <inheritdoc/>
    /// <exception cref="FractalEngineException">A mesh is open, or a fractal is infinite or has too many different parts.</exception>
    protected override ExportSummary WriteCore(LoadedScene scene, ExportSettings settings, Stream stream)
    {
        var isFlat = settings.IsFlat || settings.MaxInstances is not null;
        var losesTints = !isFlat && scene.Objects.Any(static placed => placed.HasTints);
        var frame = ExportFrame.Printing.From(scene, settings);
        var model = new ThreeMfModel(isFlat ? JoinedScene.Of(scene, settings, isWelded: false) : scene, frame);
        using (var archive = new ZipArchive(stream, ZipArchiveMode.Create, leaveOpen: true))
        {
            Add("[Content_Types].xml", part => part.Write(Encoding.UTF8.GetBytes(ContentTypes)));
            Add("_rels/.rels", part => part.Write(Encoding.UTF8.GetBytes(Relationships)));
            Add(ModelPath, part => model.Write(part, settings.Progress));

            void Add(string path, Action<Stream> write)
            {
                settings.Cancellation.ThrowIfCancellationRequested();
                var entry = archive.CreateEntry(path, CompressionLevel.SmallestSize);
                entry.LastWriteTime = Timestamp;
                using var part = entry.Open();
                write(part);
            }
        }

        var faces = scene.Sum(static one => one.DistinctFaceCount);
        var contents = model.ObjectCount == 1 ? "1 object" : FormattableString.Invariant($"{model.ObjectCount} objects");
        return new(isFlat ? contents : $"{contents} for {Core.Maths.DecimalText.FormatApproximately(faces)} faces")
        {
            Losses =
            [
                .. losesTints ? (string[])["colours of maps and gradients are written with --flat only"] : [],
                .. ExportedScene.LossesOf(scene),
            ],
        };
    }
}
