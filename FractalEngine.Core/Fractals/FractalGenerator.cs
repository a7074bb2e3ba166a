using System.Collections.Immutable;
using System.Runtime.InteropServices;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// The paper's generator (§4.2.4): expands the levels of a fractal into one list of instances, or into one mesh, for callers that need
/// them all.
/// </summary>
public static class FractalGenerator
{
    /// <summary>Expands a fractal into its distinct instances, as maps from the base mesh's frame to the fractal's.</summary>
    /// <param name="fractal">Fractal with finitely many levels.</param>
    /// <param name="maxInstances">
    /// Maximum number of instances: repeated ones are counted in affine composition, only distinct ones in componentwise composition. More
    /// than <see cref="Array.MaxLength"/> are always refused.
    /// </param>
    /// <exception cref="FractalLimitException">The fractal has more instances.</exception>
    /// <remarks>
    /// Two instances are the same when their images of the base mesh differ by rounding only (see <see cref="DistinctMaps"/>); the first in
    /// the order of the file is kept. Time and memory are proportional to the instances, 120 bytes each.
    /// </remarks>
    public static ImmutableArray<AffineMap> Expand(this Fractal fractal, long maxInstances)
    {
        ArgumentNullException.ThrowIfNull(fractal);
        if (fractal.InstanceCount is { IsZero: true })
        {
            return [];
        }

        // What no array holds is refused at once, whatever the caller allows.
        maxInstances = Math.Min(maxInstances, Array.MaxLength);
        if (fractal.Description.Composition == Composition.Componentwise)
        {
            return ExpandDistinctSums(fractal, maxInstances);
        }

        if (!fractal.Description.Parts.IsEmpty || fractal.HasColours)
        {
            return [.. ExpandByParts(fractal, maxInstances).Select(static instance => instance.Map)];
        }

        return FractalSteps.HasAtMostInstances(fractal.Description.Steps, maxInstances) && !fractal.Description.IsInfinite
            && TryExpandLevels(fractal, maxInstances, long.MaxValue) is { } instances
            ? instances
            : throw LimitError(fractal, maxInstances);
    }

    /// <summary>
    /// Expands a fractal into its distinct instances, as <see cref="Expand"/> does, also where few of many chains are distinct.
    /// </summary>
    /// <param name="fractal">Fractal with finitely many levels.</param>
    /// <param name="maxInstances">
    /// Maximum number of instances. Where there are more chains, each level is limited to
    /// <see cref="FractalLimits.EnumeratedInstances"/> distinct ones as well.
    /// </param>
    /// <exception cref="FractalLimitException">The fractal has more instances, or takes too long to enumerate.</exception>
    /// <remarks>
    /// Time is proportional to the distinct instances of all levels times the maps of a level, whatever the number of chains:
    /// <see cref="FractalLimits.ComparedProducts"/> at most.
    /// </remarks>
    public static ImmutableArray<AffineMap> ExpandDistinct(this Fractal fractal, long maxInstances)
    {
        if (fractal.Description.Composition == Composition.Componentwise
            || fractal.Description is not { Parts.IsEmpty: true, IsInfinite: false }
            || FractalSteps.HasAtMostInstances(fractal.Description.Steps, maxInstances))
        {
            return Expand(fractal, maxInstances);
        }

        var maxDistinct = Math.Min(maxInstances, FractalLimits.EnumeratedInstances.Value);
        return TryExpandLevels(fractal, maxDistinct, FractalLimits.ComparedProducts.Value)
            ?? throw LimitError(fractal, maxInstances);
    }

    /// <summary>Expands a fractal into its instances, with what maps mix into their colours.</summary>
    /// <param name="fractal">Fractal with finitely many levels.</param>
    /// <param name="maxInstances">Maximum number of instances.</param>
    /// <returns>The maps, as those of <see cref="ExpandDistinct"/>, and for each its tint; no tints where no map has a colour.</returns>
    /// <exception cref="FractalLimitException">The fractal has more instances, or takes too long to enumerate.</exception>
    public static (ImmutableArray<AffineMap> Maps, ImmutableArray<Tint> Tints) ExpandTinted(this Fractal fractal, long maxInstances)
    {
        ArgumentNullException.ThrowIfNull(fractal);
        if (!fractal.HasColours)
        {
            return (ExpandDistinct(fractal, maxInstances), []);
        }

        var instances = ExpandByParts(fractal, Math.Min(maxInstances, Array.MaxLength));
        return ([.. instances.Select(static instance => instance.Map)], [.. instances.Select(static instance => instance.Tint)]);
    }

    /// <summary>Expands a fractal of several parts that shows one mesh.</summary>
    private static ImmutableArray<MeshInstance> ExpandByParts(Fractal fractal, long maxInstances)
    {
        // One that shows several meshes is expanded by these.
        _ = fractal.BaseMesh;
        return fractal.Description.IsInfinite
            ? throw LimitError(fractal, maxInstances)
            : fractal.Description.CountsWays
                ? [.. StateExpansion.Walk(fractal.HierarchyBySets, maxInstances)]
                : GraphExpansion.Expand(fractal.Graph, maxInstances);
    }

    /// <summary>Expands a fractal level by level, and removes the repeated instances of each level before the next.</summary>
    /// <param name="fractal">In affine composition, with finitely many levels and at least one instance.</param>
    /// <param name="maxInstances">Maximum number of distinct instances of each level.</param>
    /// <param name="maxProducts">Maximum number of products of maps on all levels together.</param>
    /// <returns>The distinct instances, as those of <see cref="Expand"/>; null if they are too many, or take too long.</returns>
    internal static ImmutableArray<AffineMap>? TryExpandLevels(Fractal fractal, long maxInstances, long maxProducts)
    {
        var isProvedDistinct = DistinctInstances.AreProvedDistinct(fractal);
        var hasFewChains = FractalSteps.HasAtMostInstances(fractal.Description.Steps, maxInstances);
        if (isProvedDistinct && !hasFewChains)
        {
            return null;
        }

        ReadOnlyMemory<AffineMap> instances = new[] { AffineMap.Identity };
        var (products, comparisonCost) = (0L, 0L);
        using var level = LevelsOf(fractal).GetEnumerator();
        for (var exists = level.MoveNext(); exists;)
        {
            var maps = level.Current.Maps.AsSpan();
            exists = level.MoveNext();
            products += instances.Length * (long)maps.Length;
            if (isProvedDistinct || (hasFewChains && exists))
            {
                instances = ConcatenatePair(instances.Span, maps, static (m1, m2) => m1 * m2);
                continue;
            }

            if (products > maxProducts || comparisonCost > maxProducts
                || DistinctMaps.Products(instances.Span, maps, exists ? null : fractal, maxInstances) is not { } distinct)
            {
                return null;
            }

            instances = distinct.Items;
            comparisonCost += distinct.ComparisonCost;
        }

        return MemoryMarshal.TryGetArray(instances, out var segment) && segment.Array!.Length == instances.Length
            ? ImmutableCollectionsMarshal.AsImmutableArray(segment.Array)
            : [.. instances.Span];
    }

    /// <summary>
    /// Lists the levels, outermost first, but those that change nothing: a recursion of a million levels may consist of them.
    /// </summary>
    private static IEnumerable<TransformationSet> LevelsOf(Fractal fractal)
    {
        for (var level = 0L; level < fractal.LevelCount; level++)
        {
            var set = fractal.LevelAt(level);
            if (!set.IsIdentity)
            {
                yield return set;
            }
        }
    }

    private static ImmutableArray<AffineMap> ExpandDistinctSums(Fractal fractal, long maxInstances)
    {
        var sums = ExpandSums(fractal, maxInstances);
        var images = DistinctMaps.Images(fractal, sums.Length);
        foreach (ref readonly var sum in sums.Span)
        {
            if (!images.TryAdd(sum.ToAffineMap(), sums.Length))
            {
                throw LimitError(fractal, maxInstances);
            }
        }

        return [.. images.Items.Span];
    }

    private static FractalLimitException LimitError(Fractal fractal, long maxInstances)
    {
        var count = DecimalText.FormatApproximately(fractal.InstanceCount);
        var limit = DecimalText.FormatApproximately(maxInstances);
        return new($"the fractal has {count} instances, more than the limit of {limit}");
    }

    /// <summary>Expands a fractal into one mesh of all its faces.</summary>
    /// <param name="fractal">Fractal with finitely many levels.</param>
    /// <param name="maxFaces">Maximum number of faces.</param>
    /// <exception cref="FractalLimitException">
    /// The fractal has more faces, or more vertices or faces than an array holds. Nothing is expanded then.
    /// </exception>
    /// <remarks>Mirrored instances are inside out: the normal of a face is that of its image.</remarks>
    public static Mesh Flatten(this Fractal fractal, long maxFaces)
    {
        ArgumentNullException.ThrowIfNull(fractal);
        if (fractal.HasSeveralMeshes)
        {
            return fractal.FaceCount > maxFaces
                ? throw LimitError(fractal, maxFaces)
                : Flatten([.. fractal.ByMesh.Select(part => (part.BaseMesh, ExpandFaces(part, maxFaces)))]);
        }

        return Flatten(fractal.BaseMesh, ExpandFaces(fractal, maxFaces));
    }

    private static ImmutableArray<AffineMap> ExpandFaces(Fractal fractal, long maxFaces) => Expand(fractal, Math.Min(
        maxFaces / Math.Max(1, fractal.BaseMesh.FaceCount),
        Array.MaxLength / Math.Max(1, Math.Max(fractal.BaseMesh.Positions.Length, fractal.BaseMesh.VertexIndices.Length))));

    /// <summary>Joins instances of a mesh into one mesh.</summary>
    /// <param name="mesh">Mesh whose vertices and faces are repeated for each instance.</param>
    /// <param name="instances">Maps from the mesh's frame to that of the result.</param>
    /// <exception cref="FractalLimitException">
    /// There are more vertices or faces than an array holds, or a vertex is beyond the range of a double.
    /// </exception>
    public static Mesh Flatten(this Mesh mesh, ImmutableArray<AffineMap> instances)
    {
        return Flatten([(mesh, instances)]);
    }

    /// <summary>Joins instances of several meshes into one mesh, those of one mesh after those of another.</summary>
    /// <param name="groups">The meshes, each with its instances.</param>
    /// <exception cref="FractalLimitException">As <see cref="Flatten(Mesh, ImmutableArray{AffineMap})"/>.</exception>
    internal static Mesh Flatten(params ReadOnlySpan<(Mesh Mesh, ImmutableArray<AffineMap> Instances)> groups)
    {
        var (positionCount, indexCount) = (0L, 0L);
        foreach (var (mesh, instances) in groups)
        {
            positionCount += instances.Length * (long)mesh.Positions.Length;
            indexCount += instances.Length * (long)mesh.VertexIndices.Length;
            if (Math.Max(positionCount, indexCount) > Array.MaxLength)
            {
                throw new FractalLimitException($"{instances.Length} instances of {mesh.VertexCount} vertices and {mesh.FaceCount} "
                    + "faces are more than one mesh can hold");
            }
        }

        var positions = new double[positionCount];
        var indices = new int[indexCount];
        var nextPosition = 0;
        var nextIndex = 0;
        foreach (var (mesh, instances) in groups)
        {
            foreach (ref readonly var instance in instances.AsSpan())
            {
                var firstVertex = nextPosition / 3;
                for (var vertex = 0; vertex < mesh.VertexCount; vertex++)
                {
                    var image = instance * mesh.Vertex(vertex);
                    if (!image.IsFinite())
                    {
                        throw new FractalLimitException("a vertex of an instance is beyond the range of a double");
                    }

                    var (x, y, z) = image;
                    (positions[nextPosition], positions[nextPosition + 1], positions[nextPosition + 2]) = (x, y, z);
                    nextPosition += 3;
                }

                foreach (var vertex in mesh.VertexIndices)
                {
                    indices[nextIndex++] = firstVertex + vertex;
                }
            }
        }

        return new(ImmutableCollectionsMarshal.AsImmutableArray(positions), ImmutableCollectionsMarshal.AsImmutableArray(indices));
    }

    /// <summary>Expands a fractal in componentwise composition into its distinct sums.</summary>
    /// <param name="fractal">Fractal with finitely many levels.</param>
    /// <param name="maxInstances">
    /// Maximum number of distinct sums, at most <see cref="FractalLimits.ComponentwiseSums"/>.
    /// </param>
    /// <remarks>Since this composition commutes, the number of sums grows like a power of the depth only.</remarks>
    /// <exception cref="FractalLimitException">There are more than <paramref name="maxInstances"/>, or the fractal is infinite.</exception>
    public static ImmutableArray<Transformation> ExpandComponentwise(this Fractal fractal, long maxInstances) =>
        [.. ExpandSums(fractal, maxInstances).Span];

    private static ReadOnlyMemory<Transformation> ExpandSums(Fractal fractal, long maxInstances)
    {
        if (fractal.Description.IsInfinite)
        {
            throw new FractalLimitException("an infinite fractal can't be composed componentwise: its positions don't shrink");
        }

        maxInstances = Math.Min(maxInstances, FractalLimits.ComponentwiseSums.Value);
        ReadOnlyMemory<Transformation> sums = new[] { Transformation.Identity };
        var compared = 0L;
        foreach (var set in LevelsOf(fractal).Select(static set => set.Transformations))
        {
            compared += sums.Length * (long)set.Length;
            if (compared > FractalLimits.ComparedProducts.Value)
            {
                throw new FractalLimitException(
                    $"the sums of all levels are more than the limit of {FractalLimits.ComparedProducts.Value} compared ones");
            }

            sums = DistinctMaps.Sums(set.AsSpan(), sums.Span, maxInstances)?.Items ?? throw new FractalLimitException(
                $"componentwise composition of the fractal has more than {maxInstances} distinct sums");
        }

        return sums;
    }

    /// <summary>Composes all pairs of two sets, the paper's concatPair: [m1·m2 | ∀ m1 ∈ set1, ∀ m2 ∈ set2], in that order.</summary>
    public static T[] ConcatenatePair<T>(ReadOnlySpan<T> set1, ReadOnlySpan<T> set2, Func<T, T, T> compose)
    {
        var pairs = new T[set1.Length * set2.Length];
        var next = 0;
        foreach (var m1 in set1)
        {
            foreach (var m2 in set2)
            {
                pairs[next++] = compose(m1, m2);
            }
        }

        return pairs;
    }
}
