using FractalEngine.Render.Ui.Overlays;

namespace FractalEngine.Render.Ui;

/// <content>Places widgets in rows and columns.</content>
public sealed partial class UserInterface
{
    private readonly List<int> _columnWidths = [];
    private UiRect _area;
    private int _cursorY;
    private int _rowHeight;
    private int _column;

    private int RowPitch => RowHeight + Gap;

    /// <summary>Divides the next row. Further rows are divided likewise, until the next call.</summary>
    /// <param name="widths">Width of each column: its number of characters, or its share of what is left where it is 1 or less.</param>
    public void Row(params ReadOnlySpan<double> widths)
    {
        FinishRow();
        _columnWidths.Clear();
        var gaps = Gap * (widths.Length - 1);
        var fixedWidth = 0;
        var shares = 0.0;
        foreach (var width in widths)
        {
            fixedWidth += width > 1 ? (int)(width * CellWidth) + (2 * Gap) : 0;
            shares += width > 1 ? 0 : width;
        }

        foreach (var width in widths)
        {
            var free = Math.Max(0, _area.Width - gaps - fixedWidth);
            _columnWidths.Add(width > 1 ? (int)(width * CellWidth) + (2 * Gap) : (int)(free * width / shares));
        }
    }

    /// <summary>Adds as many rows as a list has entries, of which only those in view are built.</summary>
    /// <param name="count">Number of entries, each of one row.</param>
    /// <param name="build">Adds the row of an entry, by its index from 0.</param>
    public void Rows(int count, Action<int> build)
    {
        ArgumentNullException.ThrowIfNull(build);
        FinishRow();
        var top = _cursorY;
        var first = Math.Clamp((_clip.Y + Gap - top) / RowPitch, 0, count);
        var end = Math.Clamp(((_clip.Bottom - top) / RowPitch) + 1, first, count);
        for (var i = first; i < end; i++)
        {
            FinishRow();
            _cursorY = top + (i * RowPitch);
            Scope(i, () => build(i));
        }

        FinishRow();
        _cursorY = top + (count * RowPitch);
    }

    private void BeginRoot(int root, UiRect bounds, int layer)
    {
        _root = root;
        _layer = layer;
        _clip = new(0, 0, _width, _height);
        _nextRoots.Add((bounds, root, layer));
    }

    /// <summary>Width of the place of the next widget.</summary>
    private int NextWidth => ColumnPlace(_column == _columnWidths.Count ? 0 : _column).Width;

    private (int X, int Width) ColumnPlace(int column)
    {
        var x = _area.X;
        for (var i = 0; i < column; i++)
        {
            x += _columnWidths[i] + Gap;
        }

        return (x, column == _columnWidths.Count - 1 ? _area.Right - x : _columnWidths[column]);
    }

    /// <summary>Returns the place of the next widget.</summary>
    private UiRect Next(int rows = 1)
    {
        if (_column == _columnWidths.Count)
        {
            FinishRow();
        }

        var (x, width) = ColumnPlace(_column);
        var height = (rows * RowPitch) - Gap;
        _rowHeight = Math.Max(_rowHeight, height);
        _column++;
        return new(x, _cursorY, Math.Max(0, width), height);
    }

    private void FinishRow()
    {
        if (_column > 0)
        {
            _cursorY += _rowHeight + Gap;
        }

        _column = 0;
        _rowHeight = 0;
    }
}
