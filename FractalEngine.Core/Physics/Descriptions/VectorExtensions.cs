using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Descriptions;

/// <summary>Directions of vectors that may be zero.</summary>
internal static class VectorExtensions
{
    /// <summary>Scales a vector to length 1 and leaves the zero vector as it is.</summary>
    public static Vector UnitVectorOrZero(this Vector vector) => vector == Vector.Zero ? vector : vector.UnitVector();
}
