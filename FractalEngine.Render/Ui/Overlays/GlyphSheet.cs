namespace FractalEngine.Render.Ui.Overlays;

/// <summary>All glyphs of a font at one size, in cells of the same width and height.</summary>
/// <param name="CellWidth">Width of a cell in pixels, which is also the advance.</param>
/// <param name="CellHeight">Height of a cell in pixels, which is also the line height.</param>
/// <param name="Baseline">Pixels from the top of a cell to the baseline.</param>
/// <param name="Coverage">Opacity of each pixel, cell after cell, [glyphs × height × width].</param>
internal sealed record GlyphSheet(int CellWidth, int CellHeight, int Baseline, byte[] Coverage)
{
    /// <summary>Number of cells side by side in <see cref="ToTexels"/>.</summary>
    public const int Columns = 16;

    /// <summary>Number of rows of cells in <see cref="ToTexels"/>.</summary>
    public int Rows => ((Coverage.Length / (CellWidth * CellHeight)) + Columns - 1) / Columns;

    /// <summary>Arranges the cells in rows of <see cref="Columns"/>, so that no driver finds the texture too tall.</summary>
    /// <returns>One byte a texel, [rows × cell height × columns × cell width].</returns>
    public byte[] ToTexels()
    {
        var stride = Columns * CellWidth;
        var cellSize = CellWidth * CellHeight;
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
