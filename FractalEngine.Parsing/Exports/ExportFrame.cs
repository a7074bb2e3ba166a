using FractalEngine.Core;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;

namespace FractalEngine.Parsing.Exports;

/// <summary>How a format has coordinates by its specification, or by custom.</summary>
/// <param name="Handedness">Its handedness; null for numbers as they are.</param>
/// <param name="Up">The axis that points up.</param>
public sealed record ExportFrame(Handedness? Handedness, UpAxis Up)
{
    /// <summary>Coordinates as scenes have them.</summary>
    public static ExportFrame Unchanged { get; } = new(null, UpAxis.Y);

    /// <summary>Right-handed coordinates with y up.</summary>
    public static ExportFrame Right { get; } = new(Core.Scenes.Cameras.Handedness.Right, UpAxis.Y);

    /// <summary>Right-handed coordinates with z up, as programs for printing have them.</summary>
    public static ExportFrame Printing { get; } = new(Core.Scenes.Cameras.Handedness.Right, UpAxis.Z);

    /// <summary>
    /// Makes the map from world space to a file. A scene that is shown with the other handedness is mirrored, so that the file shows what
    /// was on the screen.
    /// </summary>
    /// <exception cref="FractalEngineException">The scene has no height that could be scaled to the one wanted.</exception>
    public AffineMap From(LoadedScene scene, ExportSettings settings)
    {
        ArgumentNullException.ThrowIfNull(scene);
        ArgumentNullException.ThrowIfNull(settings);
        var shown = scene.Scene.Handedness;
        var isMirrored = (settings.Handedness ?? Handedness ?? shown) != shown;
        var linear = Matrix.Diagonal(new(1, 1, isMirrored ? -1 : 1));
        // A quarter turn about x takes y to z.
        linear = (settings.Up ?? Up) == UpAxis.Z ? new Matrix(Vector.I, Vector.K, -Vector.J) * linear : linear;
        var scale = settings.UnitLength ?? 1;
        if (settings.Height is { } height)
        {
            scale = height / scene.Bounds.Size.Y;
            if (!(scale > 0) || !double.IsFinite(scale))
            {
                throw new FractalEngineException("the scene has no height that could be scaled to the one wanted");
            }
        }

        return new(scale * linear, Vector.Zero);
    }
}
