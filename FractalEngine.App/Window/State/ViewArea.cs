using FractalEngine.Render.Ui;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window.State;

/// <summary>The part of a window that panels leave to the scene, in whose middle the view is centred.</summary>
internal sealed class ViewArea(RenderWindow window)
{
    private double _widthFraction = 1;

    /// <summary>How far the middle is to the right of that of the frame, see <see cref="Render.Views.View.HorizontalShift"/>.</summary>
    public double HorizontalShift { get; private set; }

    /// <summary>Width divided by height of the area, for which scenes are framed.</summary>
    public double Aspect => _widthFraction * window.Aspect;

    /// <summary>Takes over where the panels are.</summary>
    /// <returns>True when the view must be drawn anew.</returns>
    public bool Update(UserInterface ui)
    {
        // A scene that is loaded at once may be drawn before the panels are built for the first time.
        var area = ui.ViewArea;
        var shift = area.Width > 0 ? ((area.X + (0.5 * area.Width)) / ui.Width) - 0.5 : 0;
        var hasChanged = shift != HorizontalShift;
        HorizontalShift = shift;
        _widthFraction = area.Width > 0 ? (double)area.Width / ui.Width : 1;
        return hasChanged;
    }
}
