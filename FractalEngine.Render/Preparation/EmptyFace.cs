using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Preparation;

/// <summary>Tells faces without area, which cover no pixel however near they are.</summary>
internal static class EmptyFace
{
    // A vector product of two edges is exact to about three units in the last place of the product of their lengths.
    private const double Rounding = 4 * 1.1102230246251565e-16;

    /// <summary>
    /// True where the vector product of two edges is at most its own rounding, |(b − a) × (c − a)| ≤ 4·2⁻⁵³·|b − a|·|c − a|: corners that meet, or lie on a line. False
    /// where a corner is not finite.
    /// </summary>
    public static bool Is(Vector a, Vector b, Vector c)
    {
        var (edge1, edge2) = (b - a, c - a);
        var (size1, size2) = (edge1.MaximumComponent(), edge2.MaximumComponent());
        if (size1 == 0 || size2 == 0)
        {
            return true;
        }

        // Both of about length 1, so that nothing under- or overflows.
        (edge1, edge2) = (edge1 / size1, edge2 / size2);
        return Vector.Cross(edge1, edge2).LengthSquared() <= Rounding * Rounding * edge1.LengthSquared() * edge2.LengthSquared();
    }
}
