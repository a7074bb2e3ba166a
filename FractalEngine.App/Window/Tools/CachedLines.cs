using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.Tools;

/// <summary>Lines that are computed again only when what they show has changed, since frames ask for them all the time.</summary>
internal sealed class CachedLines<T>(Func<T, IReadOnlyList<LineSegment>> create)
    where T : struct
{
    private T? _shown;
    private IReadOnlyList<LineSegment> _lines = [];

    /// <summary>Returns the lines of something, such as a scene and a level in it.</summary>
    public IReadOnlyList<LineSegment> Of(T shown)
    {
        if (_shown is not { } before || !EqualityComparer<T>.Default.Equals(before, shown))
        {
            _lines = create(shown);
            _shown = shown;
        }

        return _lines;
    }
}
