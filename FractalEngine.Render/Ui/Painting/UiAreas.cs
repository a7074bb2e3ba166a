using FractalEngine.Render.Ui.Overlays;

namespace FractalEngine.Render.Ui.Painting;

/// <summary>What the menu bar and docked panels leave of the frame.</summary>
internal sealed class UiAreas(UiPainter painter)
{
    private UiRect _view;

    public UiRect Free { get; private set; }

    public UiRect Scene { get; private set; }

    public UiRect View => HasRoomIn(_view) ? _view : painter.Bounds;

    public UiRect Overlay => HasRoomIn(Free) || Free.Height <= 0 ? Free : painter.Bounds with { Y = Free.Y, Height = Free.Height };

    public void Begin()
    {
        Free = painter.Bounds;
        _view = painter.Bounds;
    }

    /// <summary>Takes rows of pixels at the upper edge.</summary>
    public void TakeTop(int height) => Free = Free with { Y = height, Height = Math.Max(0, Free.Height - height) };

    /// <summary>Takes columns of pixels at the left and right edge; folded ones are so low that the scene is seen below them.</summary>
    public void TakeColumn(int left, int right, bool isFolded)
    {
        Free = Free with { X = Free.X + left, Width = Free.Width - left - right };
        if (!isFolded)
        {
            _view = painter.Bounds with { X = Free.X, Width = Free.Width };
        }
    }

    /// <summary>Returns whether what was added before the panels has to be built again, since these leave another area.</summary>
    public bool Finish()
    {
        var isNew = Scene != Free;
        Scene = Free;
        return isNew;
    }

    private bool HasRoomIn(UiRect area) => area.Width >= 0.4 * painter.Bounds.Width;
}
