using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>A source of light. Intensities multiply the linear components of the colour; 1 shows a white surface white.</summary>
/// <param name="Colour">Colour of the light as the scene file writes it, in sRGB components.</param>
/// <param name="Intensity">Factor of the colour's linear components, not negative.</param>
public abstract record Light(Colour Colour, double Intensity)
{
    /// <summary>What kind of light this is, as panels name it.</summary>
    public string Kind => GetType().Name.Replace(nameof(Light), "", StringComparison.Ordinal);

    /// <summary>Linear light: red, green, blue, with the intensity.</summary>
    public Vector Radiance => Intensity * Colour.ToLinearVector();

    /// <summary>The words and numbers that declare the light in a scene file, in their order.</summary>
    public abstract IReadOnlyList<object> Declaration { get; }

    /// <summary>Tells what the light brings to points; null where it comes from all around.</summary>
    public abstract Emitter? ToEmitter();

    /// <summary>Throws for a vector that points nowhere.</summary>
    private protected static Vector RequireDirection(Vector direction, string parameterName) =>
        direction.IsFinite() && direction != Vector.Zero
            ? direction
            : throw new ArgumentException("expected a finite direction that is not (0, 0, 0)", parameterName);
}
