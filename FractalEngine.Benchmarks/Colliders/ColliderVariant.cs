using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals.Descriptions;

namespace FractalEngine.Benchmarks.Colliders;

/// <summary>A collider with one value of its parameter.</summary>
/// <param name="ColliderName">The collider's name as scenes call it.</param>
/// <param name="ParameterName">Name of the parameter, or null for a collider without one.</param>
/// <param name="ParameterValue">Value of the parameter, or null for a collider without one.</param>
/// <param name="Collider">The collider, the same one for all values of ε.</param>
/// <param name="Epsilon">The ε of its queries.</param>
/// <param name="Bytes">Memory of the collider and of the faces that it needs, bytes.</param>
/// <param name="BuildMilliseconds">Time of the build in milliseconds, the expansion included where the collider needs one.</param>
internal sealed record ColliderVariant(
    string ColliderName, string? ParameterName, double? ParameterValue, Collider Collider, double Epsilon, long Bytes,
    double BuildMilliseconds)
{
    private static readonly double[] Epsilons = [0, 0.01, 0.1, 0.5, 1];
    private static readonly int[] Widths = [1, 2, 4, 8, 16, 32, 64];
    private static readonly int[] Depths = [1, 2, 3, 4, 5, 6];

    /// <summary>Creates all variants that suit a shape.</summary>
    public static List<ColliderVariant> CreateAll(BenchmarkShape shape)
    {
        var variants = new List<ColliderVariant>();
        if (shape.Fractal is { Description.Composition: Composition.Affine } fractal)
        {
            variants.AddRange(BuildWithEpsilons("exact", 0, 0, () => new ExactFractalCollider(FractalCase.Copy(fractal))));
            variants.AddRange(Widths.Select(width => Build("fractal", "width", width, 0, 0, () => new FractalCollider(fractal, width))));
        }

        if (shape.Faces is not { } faces)
        {
            return variants;
        }

        var bytes = (sizeof(double) * (long)faces.Positions.Length) + (sizeof(int) * (long)faces.VertexIndices.Length);
        var expansion = shape.ExpansionMilliseconds;
        variants.AddRange(BuildWithEpsilons("hierarchy", bytes, expansion, () => new HierarchyCollider(faces)));
        variants.AddRange(Depths.Append(BoundingBoxCollider.DefaultDepth(faces.FaceCount)).Distinct()
            .Select(depth => Build("octree", "depth", depth, bytes, expansion, () => new BoundingBoxCollider(faces, depth))));
        variants.Add(Build("simple", null, null, bytes, expansion, () => new SimpleCollider(faces)));
        return variants;
    }

    private static IEnumerable<ColliderVariant> BuildWithEpsilons(string name, long bytes, double milliseconds, Func<Collider> create)
    {
        var first = Build(name, "epsilon", 0, bytes, milliseconds, create);
        return Epsilons.Select(epsilon => first with { ParameterValue = epsilon, Epsilon = epsilon });
    }

    /// <summary>Builds a collider twice, as the first time may be the compiler's, and keeps the better time.</summary>
    private static ColliderVariant Build(
        string colliderName, string? parameterName, double? parameterValue, long bytes, double milliseconds, Func<Collider> create)
    {
        Collider? collider = null;
        milliseconds += InterleavedTiming.MeasureBestMilliseconds(() => collider = create(), rounds: 2);
        return new(colliderName, parameterName, parameterValue, collider!, 0, bytes + collider!.StorageBytes, milliseconds);
    }
}
