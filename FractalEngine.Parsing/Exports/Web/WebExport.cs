using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Parsing.Exports.Web;

/// <summary>Writes one page that shows a scene in a browser, with nothing to install: levels, base meshes and a viewer.</summary>
/// <remarks>
/// Fractals stay levels, so that the page has kilobytes at any depth, and one goes into it without end. The page refers to nothing
/// outside of itself.
/// </remarks>
public sealed class WebExport : SceneExport
{
    /// <inheritdoc/>
    public override string Ending => ".html";

    /// <inheritdoc/>
    public override bool IsStaged => true;

    /// <inheritdoc/>
    protected override ExportSummary WriteCore(LoadedScene scene, ExportSettings settings, Stream stream)
    {
        var faces = scene.ByParts().Models.Sum(static model => (long)model.Mesh.FaceCount);
        if (faces > settings.MaxFaces)
        {
            throw new FractalLimitException(
                FormattableString.Invariant($"the base meshes have {faces} faces, more than the limit of {settings.MaxFaces}"));
        }

        var losses = new HashSet<string>();
        var data = new WebScene(scene, settings, losses);
        var page = WebPage.Assemble(data.Title, data.Write());
        settings.Cancellation.ThrowIfCancellationRequested();
        stream.Write(page);
        return new(data.Describe()) { Losses = [.. losses] };
    }
}
