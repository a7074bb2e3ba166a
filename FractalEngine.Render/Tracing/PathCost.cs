using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Queries;

namespace FractalEngine.Render.Tracing;

/// <summary>Refuses images whose paths of light take too long each, before the first of them is traced as a whole.</summary>
/// <remarks>
/// A ray through a fractal whose parts overlap, level within level, enters nearly all of them. Up to a million bounds a ray are tested
/// then, and a small image takes minutes. Paths of a grid of pixels tell so within a second.
/// </remarks>
internal static class PathCost
{
    private const int Columns = 32;
    private const int Rows = 24;

    /// <summary>Traces the pixels of a grid, one after the other, so that the outcome is the same on any number of threads.</summary>
    /// <param name="viewport">Pixels of the image that show the scene.</param>
    /// <param name="trace">Traces one path through the pixel of a column and a row of the image.</param>
    /// <param name="cancellation">Cancels between two rows.</param>
    /// <exception cref="OperationCanceledException">The check was cancelled.</exception>
    /// <exception cref="FractalLimitException">Their mean cost exceeds <see cref="FractalLimits.TracedTests"/>.</exception>
    public static void Check(
        (int Left, int Top, int Width, int Height) viewport, Action<int, int, QueryContext> trace, CancellationToken cancellation)
    {
        var (left, top, width, height) = viewport;
        var columns = Math.Min(width, Columns);
        var rows = Math.Min(height, Rows);
        var allowed = FractalLimits.TracedTests.Value * columns * rows;
        var context = new QueryContext();
        for (var row = 0; row < rows; row++)
        {
            cancellation.ThrowIfCancellationRequested();
            for (var column = 0; column < columns; column++)
            {
                trace(left + Middle(column, columns, width), top + Middle(row, rows, height), context);
                if (context.Statistics.BoundTests + context.Statistics.FaceTests > allowed)
                {
                    throw new FractalLimitException(
                        $"a path of light takes more than the limit of {FractalLimits.TracedTests.Value} tests of bounds and faces "
                        + "(traced-tests): too much of the scene overlaps");
                }
            }
        }
    }

    private static int Middle(int index, int count, int size) => (int)(((2L * index) + 1) * size / (2 * count));
}
