using FractalEngine.Core.Geometry;

namespace FractalEngine.App.Window.Tools;

/// <summary>Measures scenes for tools that need some size, whatever is shown.</summary>
internal static class SceneSize
{
    /// <summary>Returns the diagonal of bounds, or 1 where they are empty, a point or infinite.</summary>
    public static double Of(BoundingBox bounds) =>
        !bounds.IsEmpty && bounds.Size.IsFinite() && bounds.Diagonal > 0 ? bounds.Diagonal : 1;
}
