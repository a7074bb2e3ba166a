using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>Directions of what may have none.</summary>
internal static class VectorExtensions
{
    /// <summary>The vector at length 1; zero for zero.</summary>
    public static Vector UnitVectorOrZero(this Vector vector) => vector == Vector.Zero ? vector : vector.UnitVector();
}
