using FractalEngine.Core.Geometry;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.State;

/// <summary>The lines over the scene of a document.</summary>
internal static class DocumentLines
{
    /// <summary>Adds the lines of what is selected, measured, cut, moved by handles and filmed to those of the bodies.</summary>
    /// <param name="document">The document, whose renderer draws the lines.</param>
    /// <param name="view">The present view in world space.</param>
    public static void Update(Document document, View view)
    {
        var lines = document.Tool.WorldLines();
        document.Section.AddLines(document.File.Scene.Bounds, lines);
        HandleLines.AddLines(document, view, lines);
        lines.AddRange(document.Renderer.Lines);
        IReadOnlyList<LineSegment> path = document.Film?.Lines ?? [];
        lines.AddRange(path);
        document.Renderer.LineBounds = document.VisibleDepth > 0 ? BoundingBox.Empty
            : path.Aggregate(BoundingBox.Empty, static (box, line) => box.Including(line.From).Including(line.To));
        if (document.VisibleDepth > 0 && document.MapToDrawnFrame(null) is { } map)
        {
            lines = lines.ConvertAll(line => line with { From = map(line.From), To = map(line.To) });
        }

        document.Tool.AddDrawnLines(lines);
        if (lines.Count > 0 || document.Renderer.Lines.Count > 0)
        {
            document.Renderer.Lines = lines;
        }
    }
}
