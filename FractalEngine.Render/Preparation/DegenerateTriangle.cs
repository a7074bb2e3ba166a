using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Preparation;

/// <summary>Detects triangles without area, which cover no pixel however near they are.</summary>
internal static class DegenerateTriangle
{
    // The cross product of two edges is exact to about three units in the last place of the product of their lengths.
    private const double CrossProductError = 4 * 1.1102230246251565e-16;

    /// <summary>Tests whether two corners coincide or all three are collinear, up to rounding.</summary>
    /// <returns>
    /// True where the cross product of two edges is at most its own rounding, |(b − a) × (c − a)| ≤ 4·2⁻⁵³·|b − a|·|c − a|. False where a
    /// corner is not finite.
    /// </returns>
    public static bool Test(Vector a, Vector b, Vector c)
    {
        var edge1 = b - a;
        var edge2 = c - a;
        var scale1 = edge1.MaxAbsComponent();
        var scale2 = edge2.MaxAbsComponent();
        if (scale1 == 0 || scale2 == 0)
        {
            return true;
        }

        // Scaled to a length of about 1, so that nothing under- or overflows.
        edge1 /= scale1;
        edge2 /= scale2;
        return Vector.Cross(edge1, edge2).LengthSquared()
            <= CrossProductError * CrossProductError * edge1.LengthSquared() * edge2.LengthSquared();
    }
}
