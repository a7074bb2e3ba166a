using System.Diagnostics;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Collision.Reference;
using FractalEngine.Core.Fractals;

namespace FractalEngine.Benchmarks.Colliders;

/// <summary>A collider with its knob at one place.</summary>
/// <param name="ColliderName">As scenes call it.</param>
/// <param name="ParameterName">What can be turned; null where nothing can.</param>
/// <param name="ParameterValue">Of the knob.</param>
/// <param name="Collider">The same for all places of ε.</param>
/// <param name="Epsilon">Of its queries.</param>
/// <param name="Bytes">Of the collider, and of the faces it stands on.</param>
/// <param name="BuildMilliseconds">With the expansion, where it needs one.</param>
internal sealed record ColliderVariant(string ColliderName, string? ParameterName, double? ParameterValue, Collider Collider,
    double Epsilon, long Bytes,
    double BuildMilliseconds)
{
    private static readonly double[] Epsilons = [0, 0.01, 0.1, 0.5, 1];
    private static readonly int[] Widths = [1, 2, 4, 8, 16, 32, 64];
    private static readonly int[] Depths = [1, 2, 3, 4, 5, 6];

    /// <summary>All that fit a shape.</summary>
    public static List<ColliderVariant> CreateAll(BenchmarkShape shape)
    {
        var rows = new List<ColliderVariant>();
        if (shape.Fractal is { Description.Composition: Composition.Affine } fractal)
        {
            rows.AddRange(BuildWithEpsilons("exact", 0, 0, () => new ExactFractalCollider(fractal)));
            rows.AddRange(Widths.Select(width => Build("fractal", "width", width, 0, 0, () => new FractalCollider(fractal, width))));
        }

        if (shape.Faces is not { } faces)
        {
            return rows;
        }

        var bytes = (sizeof(double) * (long)faces.Positions.Length) + (sizeof(int) * (long)faces.VertexIndices.Length);
        var expansion = shape.ExpansionMilliseconds;
        rows.AddRange(BuildWithEpsilons("hierarchy", bytes, expansion, () => new HierarchyCollider(faces)));
        rows.AddRange(Depths.Append(BoundingBoxCollider.DefaultDepth(faces.FaceCount)).Distinct()
            .Select(depth => Build("octree", "depth", depth, bytes, expansion, () => new BoundingBoxCollider(faces, depth))));
        rows.Add(Build("simple", null, null, bytes, expansion, () => new SimpleCollider(faces)));
        return rows;
    }

    private static IEnumerable<ColliderVariant> BuildWithEpsilons(string name, long bytes, double milliseconds, Func<Collider> create)
    {
        var first = Build(name, "epsilon", 0, bytes, milliseconds, create);
        return Epsilons.Select(epsilon => first with { ParameterValue = epsilon, Epsilon = epsilon });
    }

    /// <summary>Built twice: the first time may be the compiler's.</summary>
    private static ColliderVariant Build(string colliderName, string? parameterName, double? parameterValue, long bytes,
        double milliseconds, Func<Collider> create)
    {
        var watch = Stopwatch.StartNew();
        var collider = create();
        var first = watch.Elapsed;
        watch.Restart();
        collider = create();
        var time = first < watch.Elapsed ? first : watch.Elapsed;
        return new(colliderName, parameterName, parameterValue, collider, 0, bytes + collider.StorageBytes,
            milliseconds + time.TotalMilliseconds);
    }
}
