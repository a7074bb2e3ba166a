namespace FractalEngine.Render.Ui;

/// <summary>All glyphs at one size, each in a cell of the same width and height.</summary>
/// <param name="CellWidth">Pixels; also the advance.</param>
/// <param name="CellHeight">Pixels; also the line height.</param>
/// <param name="Baseline">Pixels from the cell's top.</param>
/// <param name="Coverage">One cell under the other, [glyphs × height × width].</param>
internal sealed record GlyphSheet(int CellWidth, int CellHeight, int Baseline, byte[] Coverage)
{
    /// <summary>Cells side by side in <see cref="ToTexels"/>.</summary>
    public const int Columns = 16;

    /// <summary>Rows of cells in <see cref="ToTexels"/>.</summary>
    public int Rows => ((Coverage.Length / (CellWidth * CellHeight)) + Columns - 1) / Columns;

    /// <summary>The cells in rows of <see cref="Columns"/>, as a texture that no driver finds too tall.</summary>
    public byte[] ToTexels()
    {
        var (stride, cellSize) = (Columns * CellWidth, CellWidth * CellHeight);
        var texels = new byte[stride * Rows * CellHeight];
        for (var glyph = 0; glyph < Coverage.Length / cellSize; glyph++)
        {
            var corner = (glyph / Columns * CellHeight * stride) + (glyph % Columns * CellWidth);
            for (var y = 0; y < CellHeight; y++)
            {
                Coverage.AsSpan((glyph * cellSize) + (y * CellWidth), CellWidth).CopyTo(texels.AsSpan(corner + (y * stride)));
            }
        }

        return texels;
    }
}
