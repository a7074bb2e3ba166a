using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation;

/// <summary>A place on a wall: two perpendicular unit vectors along it, and <see cref="Out"/> away from it.</summary>
/// <param name="Origin">World space.</param>
/// <param name="Right">Along the wall.</param>
/// <param name="Up">Along the wall, perpendicular to the first.</param>
internal readonly record struct WallFrame(Vector Origin, Vector Right, Vector Up)
{
    /// <summary>Away from the wall, into the room.</summary>
    public Vector Out => Vector.Cross(Right, Up);

    /// <summary>A point by its coordinates along the wall and its height above it.</summary>
    public Vector At(double x, double y, double height = 0) => Origin + (x * Right) + (y * Up) + (height * Out);

    /// <summary>The frame moved along the wall and away from it.</summary>
    public WallFrame Translated(double x, double y, double height = 0) => this with { Origin = At(x, y, height) };
}

/// <summary>A rectangle on a wall.</summary>
internal readonly record struct WallArea(double X0, double Y0, double X1, double Y1)
{
    public double Width => X1 - X0;

    public double Height => Y1 - Y0;

    /// <summary>The rectangle without a margin.</summary>
    public WallArea Inset(double margin) => new(X0 + margin, Y0 + margin, X1 - margin, Y1 - margin);

    /// <summary>Two parts along the longer side, the first with a given share.</summary>
    public (WallArea First, WallArea Second) Split(double share) => Width > Height
        ? (this with { X1 = X0 + (share * Width) }, this with { X0 = X0 + (share * Width) })
        : (this with { Y1 = Y0 + (share * Height) }, this with { Y0 = Y0 + (share * Height) });

    /// <summary>Equal cells, row by row.</summary>
    public IEnumerable<WallArea> Cells(int columns, int rows)
    {
        for (var row = 0; row < rows; row++)
        {
            for (var column = 0; column < columns; column++)
            {
                yield return new(
                    X0 + (Width * column / columns), Y0 + (Height * row / rows),
                    X0 + (Width * (column + 1) / columns), Y0 + (Height * (row + 1) / rows));
            }
        }
    }
}
