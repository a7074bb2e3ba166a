using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Preparation;

/// <summary>Tells faces without area, which cover no pixel however near they are.</summary>
internal static class DegenerateTriangle
{
    // A vector product of two edges is exact to about three units in the last place of the product of their lengths.
    private const double CrossProductError = 4 * 1.1102230246251565e-16;

    /// <summary>
    /// True where the vector product of two edges is at most its own rounding, |(b − a) × (c − a)| ≤ 4·2⁻⁵³·|b − a|·|c − a|: corners that
    /// meet, or lie on a line. False where a corner is not finite.
    /// </summary>
    public static bool Test(Vector a, Vector b, Vector c)
    {
        var (edge1, edge2) = (b - a, c - a);
        var (scale1, scale2) = (edge1.MaxAbsComponent(), edge2.MaxAbsComponent());
        if (scale1 == 0 || scale2 == 0)
        {
            return true;
        }

        // Both of about length 1, so that nothing under- or overflows.
        (edge1, edge2) = (edge1 / scale1, edge2 / scale2);
        return Vector.Cross(edge1, edge2).LengthSquared() <= CrossProductError * CrossProductError * edge1.LengthSquared()
            * edge2.LengthSquared();
    }
}
