namespace FractalEngine.Core.Generation;

/// <summary>A rectangle on a wall, in the coordinates of its <see cref="WallFrame"/>.</summary>
internal readonly record struct WallArea(double X0, double Y0, double X1, double Y1)
{
    /// <summary>Extent along the frame's right axis.</summary>
    public double Width => X1 - X0;

    /// <summary>Extent along the frame's up axis.</summary>
    public double Height => Y1 - Y0;

    /// <summary>Removes a margin from all four sides.</summary>
    public WallArea Inset(double margin) => new(X0 + margin, Y0 + margin, X1 - margin, Y1 - margin);

    /// <summary>Splits the rectangle in two along its longer side.</summary>
    /// <param name="share">Share of the first part, from 0 to 1.</param>
    public (WallArea First, WallArea Second) Split(double share) => Width > Height
        ? (this with { X1 = X0 + (share * Width) }, this with { X0 = X0 + (share * Width) })
        : (this with { Y1 = Y0 + (share * Height) }, this with { Y0 = Y0 + (share * Height) });

    /// <summary>Divides the rectangle into equal cells, row by row.</summary>
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
