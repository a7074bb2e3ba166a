using System.Collections.Immutable;

namespace FractalEngine.Core.Images;

/// <summary>The pixels that come together in a file: all of them, or one of the seven passes of Adam7 (PNG, third edition, §8.1).</summary>
/// <param name="Left">The column of the first pixel.</param>
/// <param name="Top">The row of the first pixel.</param>
/// <param name="StepX">From one column to the next.</param>
/// <param name="StepY">From one row to the next.</param>
internal readonly record struct PngPass(int Left, int Top, int StepX, int StepY)
{
    private static readonly ImmutableArray<PngPass> Whole = [new(0, 0, 1, 1)];

    private static readonly ImmutableArray<PngPass> Adam7 =
        [new(0, 0, 8, 8), new(4, 0, 8, 8), new(0, 4, 4, 8), new(2, 0, 4, 4), new(0, 2, 2, 4), new(1, 0, 2, 2), new(0, 1, 1, 2)];

    /// <summary>The passes of an image, in the order of the file. Small images have passes without pixels.</summary>
    public static ImmutableArray<PngPass> Of(PngHeader header) => header.IsInterlaced ? Adam7 : Whole;

    /// <summary>Pixels of one row of the pass.</summary>
    public int Columns(int width) => Count(width, Left, StepX);

    /// <summary>Rows of the pass.</summary>
    public int Rows(int height) => Count(height, Top, StepY);

    // Written so that no sum goes beyond the range of int.
    private static int Count(int size, int first, int step) => size <= first ? 0 : ((size - first - 1) / step) + 1;
}
