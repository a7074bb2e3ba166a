using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Lights;

/// <summary>
/// The part of light that mirroring facets (GGX, Smith's shadowing) send out after one reflection, for each angle and roughness: what is
/// missing to 1 is reflected by several facets.
/// </summary>
/// <remarks>
/// A facet of the reflectance F at normal incidence reflects F + (1 − F)·(1 − c)⁵ after Schlick. Its part of the light is linear in F, so
/// that the table has two numbers: <see cref="Normal"/> and <see cref="Grazing"/>, for F times the one and the other
/// (Karis, "Real Shading in Unreal Engine 4", SIGGRAPH 2013). Within 0.1 % of the integrals.
/// </remarks>
/// <param name="Normal">What F multiplies.</param>
/// <param name="Grazing">What is reflected in any case, by Fresnel's law at grazing angles.</param>
internal readonly record struct FacetAlbedo(double Normal, double Grazing)
{
    /// <summary>The smoothest facets: a smoother mirror's highlight of a point of light would never be hit.</summary>
    public const double MinRoughness = 0.02;

    /// <summary>Number of angles, and of roughnesses, in the table.</summary>
    public const int TableSize = 32;

    private static readonly Lazy<FacetAlbedo[]> Entries = new(Tabulate);
    private static readonly Lazy<FacetAlbedo[]> Means = new(Average);

    // Facets that are seen from within their own plane show nothing.
    private const double MinCosine = 1e-4;

    /// <summary>The part of white light that white facets send out after one reflection.</summary>
    public double White => Normal + Grazing;

    /// <summary>Looks up light that leaves by an angle.</summary>
    /// <param name="cosine">Cosine of the angle with the normal.</param>
    /// <param name="roughness">α of GGX, from <see cref="MinRoughness"/> to 1.</param>
    public static FacetAlbedo At(double cosine, double roughness)
    {
        var row = Position(RoughnessPosition(roughness), out var rowPart);
        var column = Position(Math.Sqrt(Math.Clamp(cosine, 0, 1)), out var columnPart);
        var entries = Entries.Value.AsSpan((row * TableSize) + column);
        return Mix(
            Mix(entries[0], entries[1], columnPart), Mix(entries[TableSize], entries[TableSize + 1], columnPart), rowPart);
    }

    /// <summary>The mean over all angles, by their cosine.</summary>
    /// <param name="roughness">α of GGX, from <see cref="MinRoughness"/> to 1.</param>
    public static FacetAlbedo MeanOf(double roughness)
    {
        var row = Position(RoughnessPosition(roughness), out var part);
        return Mix(Means.Value[row], Means.Value[row + 1], part);
    }

    /// <summary>The table for shaders: both numbers and a zero, by the root of the cosine, and rows by the root of the roughness.</summary>
    public static float[] ToTexels() =>
        [.. Entries.Value.SelectMany(static entry => (float[])[(float)entry.Normal, (float)entry.Grazing, 0])];

    /// <summary>The part of facets that others don't hide, by Smith.</summary>
    public static double Shadowing(double cosine, double alphaSquared) =>
        2 * cosine / (cosine + Math.Sqrt(alphaSquared + ((1 - alphaSquared) * cosine * cosine)));

    /// <summary>Samples the normal of a facet that is visible from a direction, after E. Heitz, JCGT 2018.</summary>
    /// <param name="toEye">Unit direction, in axes whose third is the normal.</param>
    /// <param name="alpha">α of GGX.</param>
    /// <param name="point">A point of the unit square.</param>
    public static Vector VisibleFacet(Vector toEye, double alpha, (double U, double V) point)
    {
        var stretched = new Vector(alpha * toEye.X, alpha * toEye.Y, toEye.Z).UnitVector();
        var radius = Math.Sqrt(point.U);
        var (sine, cosine) = Math.SinCos(2 * Math.PI * point.V);
        var x = radius * cosine;
        var share = 0.5 * (1 + stretched.Z);
        var y = ((1 - share) * Math.Sqrt(Math.Max(0, 1 - (x * x)))) + (share * radius * sine);
        // The second axis lies in the plane of the stretched direction and of the normal.
        var first = stretched.Z < 0.9999 ? Vector.Cross(Vector.K, stretched).UnitVector() : Vector.I;
        var second = Vector.Cross(stretched, first);
        var normal = (x * first) + (y * second) + (Math.Sqrt(Math.Max(0, 1 - (x * x) - (y * y))) * stretched);
        return new Vector(alpha * normal.X, alpha * normal.Y, Math.Max(1e-9, normal.Z)).UnitVector();
    }

    /// <summary>Orthonormal axes whose third is a unit vector, after Duff and others, JCGT 2017.</summary>
    public static Matrix AxesAround(Vector normal)
    {
        var sign = double.CopySign(1, normal.Z);
        var a = -1 / (sign + normal.Z);
        var b = normal.X * normal.Y * a;
        return new(
            new(1 + (sign * normal.X * normal.X * a), sign * b, -sign * normal.X),
            new(b, sign + (normal.Y * normal.Y * a), -normal.Y),
            normal);
    }

    // Even steps of √α: of what people call roughness.
    private static double RoughnessPosition(double roughness) =>
        (Math.Sqrt(roughness) - Math.Sqrt(MinRoughness)) / (1 - Math.Sqrt(MinRoughness));

    private static double RoughnessOf(int row) =>
        Math.Pow(Math.Sqrt(MinRoughness) + (row * (1 - Math.Sqrt(MinRoughness)) / (TableSize - 1)), 2);

    private static int Position(double unit, out double part)
    {
        var position = Math.Clamp(unit, 0, 1) * (TableSize - 1);
        var index = Math.Min((int)position, TableSize - 2);
        part = position - index;
        return index;
    }

    private static FacetAlbedo Mix(FacetAlbedo a, FacetAlbedo b, double part) =>
        new(a.Normal + (part * (b.Normal - a.Normal)), a.Grazing + (part * (b.Grazing - a.Grazing)));

    private static FacetAlbedo[] Tabulate()
    {
        var entries = new FacetAlbedo[TableSize * TableSize];
        Parallel.For(0, entries.Length, i =>
        {
            var (row, column) = Math.DivRem(i, TableSize);
            entries[i] = Integrate(Math.Max(Math.Pow(column / (TableSize - 1.0), 2), MinCosine), RoughnessOf(row));
        });
        return entries;
    }

    /// <summary>Integrates over visible facets, which reflect what others don't hide.</summary>
    private static FacetAlbedo Integrate(double cosine, double alpha)
    {
        const int Rings = 64;
        const int Spokes = 16;
        var toEye = new Vector(Math.Sqrt(1 - (cosine * cosine)), 0, cosine);
        var (normal, grazing, sum) = (0.0, 0.0, 0.0);
        for (var i = 0; i < Rings * Spokes; i++)
        {
            var (ring, spoke) = Math.DivRem(i, Spokes);
            // Half of the facets, as the others mirror them; denser towards those that lean most, which hide most.
            var rest = 1 - ((ring + 0.5) / Rings);
            var square = rest * rest;
            sum += square * rest;
            var facet = VisibleFacet(toEye, alpha, (1 - (square * square), ((spoke + 0.5) / Spokes / 2) - 0.25));
            var seen = Vector.Dot(toEye, facet);
            var height = (2 * seen * facet.Z) - cosine;
            if (height > 0)
            {
                var visible = square * rest * Shadowing(height, alpha * alpha);
                var rise = 1 - Math.Min(seen, 1);
                var fresnel = rise * rise * rise * rise * rise;
                normal += visible * (1 - fresnel);
                grazing += visible * fresnel;
            }
        }

        return new(normal / sum, grazing / sum);
    }

    private static FacetAlbedo[] Average()
    {
        const int Steps = 1024;
        var means = new FacetAlbedo[TableSize];
        for (var row = 0; row < TableSize; row++)
        {
            for (var i = 0; i < Steps; i++)
            {
                var cosine = (i + 0.5) / Steps;
                var (normal, grazing) = At(cosine, RoughnessOf(row));
                var weight = 2 * cosine / Steps;
                means[row] = new(means[row].Normal + (weight * normal), means[row].Grazing + (weight * grazing));
            }
        }

        return means;
    }
}
