using System.Collections.Immutable;
using System.Numerics;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing;
using FractalEngine.Tests.Oracles.Graphs;
using FractalEngine.Tests.Oracles.Graphs.Expansion;
using FractalEngine.Tests.Support;
using static FractalEngine.Tests.Oracles.Graphs.GraphMismatch;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Oracles.Chance;

/// <summary>Compares counts, instances, the box and the written file of a fractal with an expansion.</summary>
internal static class ChanceStructureChecker
{
    /// <summary>Checks counts, instances and the written file of a fractal.</summary>
    /// <exception cref="GraphMismatch">Something differs.</exception>
    public static void Check(Fractal fractal, ChanceNode node, TriangleSoup soup)
    {
        CheckWritten(fractal);
        if (!PlainParts.HaveEqualInstances(node))
        {
            CheckCounts(fractal, node, soup);
            CheckInstances(fractal, soup);
        }

        if (!soup.Triangles.IsEmpty)
        {
            CheckBounds(fractal, soup);
        }
    }

    private static void CheckCounts(Fractal fractal, ChanceNode node, TriangleSoup soup)
    {
        if (fractal.CountRange() is not { } range)
        {
            throw new GraphMismatch("count", $"there is none");
        }

        ThrowUnless(range.Exact == soup.Instances.Length, "exact", $"{range.Exact} instances, not {soup.Instances.Length}");
        if (ChanceCounts.Of(node) is not { } counts)
        {
            // What ends by its size has bounds.
            ThrowUnless(range.Least <= range.Exact && range.Exact <= range.Most, "bounds of counts", $"{range}");
            ThrowUnless(fractal.InstanceCount == range.Exact, "chains", $"{fractal.InstanceCount} chains, not {range.Exact}");
            return;
        }

        ThrowUnless(range.Least == counts.Least, "least", $"{range.Least} instances, not {counts.Least}");
        ThrowUnless(range.Most == counts.Most, "most", $"{range.Most} instances, not {counts.Most}");
        // The sum of the most of each mesh, with alternatives that never stand.
        ThrowUnless(fractal.InstanceCount >= counts.Most, "chains", $"{fractal.InstanceCount} chains, not {counts.Most}");
        // The sums are rounded on both sides, and then down.
        var error = 1e-12 * counts.Expected;
        ThrowUnless(
            range.Expected >= (BigInteger)Math.Floor(counts.Expected - error) && (double)range.Expected.Value <= counts.Expected + error,
            "expected", $"{range.Expected} instances, not {counts.Expected:R}");
    }

    private static void CheckInstances(Fractal fractal, TriangleSoup soup)
    {
        var meshes = new HitTriangles(fractal, soup).Meshes;
        for (var i = 0; i < meshes.Length; i++)
        {
            var placed = soup.Instances.Where(instance => ReferenceEquals(instance.Mesh, meshes[i])).ToArray();
            var found = fractal.ByMesh[i].Expand(soup.Instances.Length);
            ThrowUnless(found.Length == placed.Length, "expanded", $"{found.Length} instances of mesh {i}, not {placed.Length}");
            CheckSame(found, placed, i);
        }
    }

    /// <summary>Pairs each map that is found with one that is not paired yet; both come in much the same order.</summary>
    private static void CheckSame(ImmutableArray<AffineMap> found, PlacedMesh[] placed, int mesh)
    {
        LinkedList<(AffineMap Map, double Reach)> left = new(placed.Select(static one => (one.Map.ToAffineMap(), one.Reach)));
        foreach (var map in found)
        {
            var node = left.First;
            while (node is not null && !IsSame(node.Value.Map, map, 1e-11 * Math.Max(1, node.Value.Reach)))
            {
                node = node.Next;
            }

            ThrowUnless(node is not null, "expanded", $"{map} of mesh {mesh} is none of the instances left");
            left.Remove(node!);
        }
    }

    private static bool IsSame(AffineMap a, AffineMap b, double tolerance) => ((ReadOnlySpan<Vector>)
        [Vector.Zero, Vector.I, Vector.J, Vector.K]).ToArray().All(v => ((a * v) - (b * v)).Length() <= tolerance);

    /// <summary>By chance the box may be larger.</summary>
    private static void CheckBounds(Fractal fractal, TriangleSoup soup)
    {
        var margin = 1e-12 * soup.Reach * Vector.One;
        var (low, high) = (fractal.Bounds.Minimum - margin, fractal.Bounds.Maximum + margin);
        ThrowUnless(
            Vector.Min(low, soup.Minimum) == low && Vector.Max(high, soup.Maximum) == high,
            "bounds", $"{fractal.Bounds}, not {soup.Minimum} to {soup.Maximum}");
    }

    /// <summary>What is read of a written file is equal when that is written and read.</summary>
    /// <remarks>The first time parts that mean the same may become one.</remarks>
    private static void CheckWritten(Fractal fractal)
    {
        using TemporaryFolder folder = new();
        var first = Rewrite(fractal, folder);
        var second = Rewrite(first, folder);
        var text = File.ReadAllText(folder["written.fdo"]);
        ThrowUnless(first.Description == second.Description, "written", $"another description is read from\n{text}");
        ThrowUnless(
            first.BaseMeshes.Select(static mesh => mesh.FaceCount).SequenceEqual(second.BaseMeshes.Select(static mesh => mesh.FaceCount)),
            "written", $"other meshes are read from\n{text}");
    }

    private static Fractal Rewrite(Fractal fractal, TemporaryFolder folder)
    {
        FractalFile.Write(folder["written.fdo"], fractal);
        try
        {
            return FractalFile.Read(folder["written.fdo"]);
        }
        catch (Exception exception)
        {
            throw new GraphMismatch("written", $"{exception.Message} of\n{File.ReadAllText(folder["written.fdo"])}");
        }
    }
}
