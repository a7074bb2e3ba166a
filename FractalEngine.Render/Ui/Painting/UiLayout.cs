using FractalEngine.Render.Ui.Overlays;

namespace FractalEngine.Render.Ui.Painting;

/// <summary>Places widgets in rows and columns, from the upper edge of an area.</summary>
internal sealed class UiLayout(UiPainter painter)
{
    private readonly List<int> _columnWidths = [];
    private int _rowHeight;
    private int _column;

    public UiRect Area { get; private set; }

    /// <summary>Upper edge of the row.</summary>
    public int Y { get; private set; }

    /// <summary>Width of the place of the next widget.</summary>
    public int NextWidth => ColumnPlace(_column == _columnWidths.Count ? 0 : _column).Width;

    /// <summary>Adds rows of widgets to an area, which may be lower than these.</summary>
    /// <param name="area">Place of the rows.</param>
    /// <param name="hidden">Height of what is scrolled out above.</param>
    /// <param name="build">Adds the widgets.</param>
    /// <param name="columns">Widths of the columns at first, as <see cref="Row"/> takes them.</param>
    /// <returns>Height of all rows, with the gap below each.</returns>
    public int Build(UiRect area, int hidden, Action build, params ReadOnlySpan<double> columns)
    {
        var top = area.Y - hidden;
        Area = area;
        Y = top;
        Row(columns);
        build();
        FinishRow();
        return Y - top;
    }

    public void Row(params ReadOnlySpan<double> widths)
    {
        FinishRow();
        _columnWidths.Clear();
        var fixedWidth = 0;
        var shares = 0.0;
        foreach (var width in widths)
        {
            fixedWidth += width > 1 ? FixedWidth(width) : 0;
            shares += width > 1 ? 0 : width;
        }

        var free = Math.Max(0, Area.Width - (painter.Gap * (widths.Length - 1)) - fixedWidth);
        foreach (var width in widths)
        {
            _columnWidths.Add(width > 1 ? FixedWidth(width) : (int)(free * width / shares));
        }
    }

    public void Rows(int count, Action<int> build)
    {
        FinishRow();
        var top = Y;
        var pitch = painter.RowPitch;
        var first = Math.Clamp((painter.Clip.Y + painter.Gap - top) / pitch, 0, count);
        var end = Math.Clamp(((painter.Clip.Bottom - top) / pitch) + 1, first, count);
        for (var i = first; i < end; i++)
        {
            FinishRow();
            Y = top + (i * pitch);
            build(i);
        }

        FinishRow();
        Y = top + (count * pitch);
    }

    /// <summary>Returns the place of the next widget.</summary>
    public UiRect Next(int rows = 1)
    {
        if (_column == _columnWidths.Count)
        {
            FinishRow();
        }

        var (x, width) = ColumnPlace(_column);
        var height = (rows * painter.RowPitch) - painter.Gap;
        _rowHeight = Math.Max(_rowHeight, height);
        _column++;
        return new(x, Y, Math.Max(0, width), height);
    }

    /// <summary>Goes on below the row, if it has a widget.</summary>
    public void FinishRow()
    {
        if (_column > 0)
        {
            Y += _rowHeight + painter.Gap;
        }

        _column = 0;
        _rowHeight = 0;
    }

    private int FixedWidth(double characters) => (int)(characters * painter.CellWidth) + (2 * painter.Gap);

    private (int X, int Width) ColumnPlace(int column)
    {
        var x = Area.X;
        for (var i = 0; i < column; i++)
        {
            x += _columnWidths[i] + painter.Gap;
        }

        return (x, column == _columnWidths.Count - 1 ? Area.Right - x : _columnWidths[column]);
    }
}
