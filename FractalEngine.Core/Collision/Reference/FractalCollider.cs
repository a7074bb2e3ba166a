using System.Collections.Immutable;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Reference;

/// <summary>
/// The paper's descent (§4.4.3): at each level every transformation is looked at as if the base object stood there alone, and the search
/// goes on in the nearest one only. Approximate: a copy of the base can be farther away while the sub-fractal that stands on it is nearer.
/// </summary>
/// <remarks>
/// A round of a recursion is one level, its sets concatenated; sets below the last recursion belong to the base object. So a query costs
/// exactly b·t face tests a level, b·t·d in all; it keeps t maps and the base object.
/// </remarks>
public sealed partial class FractalCollider : Collider
{
    // A copy that is smaller than the last place of a coordinate has no parts that could be told apart.
    private const double MinScale = 1e-15;

    private readonly List<(MapSet Set, int Rounds)> _levels = [];
    private readonly bool _hasOnlySimilarities;
    private readonly Mesh _baseMesh;
    private readonly TriangleBvh _baseBvh;
    private readonly bool _hasNoLevels;
    private readonly int _beamWidth;

    /// <summary>Prepares a fractal in affine composition.</summary>
    /// <param name="fractal">Of any depth.</param>
    /// <param name="beamWidth">
    /// In how many of the nearest copies of each level the search goes on: 1 is the paper's descent; more cost up to as many times as much
    /// and err less, but are not exact either.
    /// </param>
    /// <exception cref="ArgumentOutOfRangeException">The width is less than 1.</exception>
    /// <exception cref="ArgumentException">The fractal is composed componentwise.</exception>
    /// <exception cref="SingularMatrixException">
    /// A map flattens what it maps, as a scale of 0 does; fractal files with one are refused.
    /// </exception>
    /// <exception cref="FractalLimitException">A round, or the base object, has more than a million instances of its own.</exception>
    public FractalCollider(Fractal fractal, int beamWidth = 1)
    {
        ArgumentOutOfRangeException.ThrowIfLessThan(beamWidth, 1);
        if (fractal.Description.Composition != Composition.Affine)
        {
            throw new ArgumentException("expected affine composition: the descent follows maps", nameof(fractal));
        }

        var steps = fractal.Description.Steps;
        var lastRepetition = steps.Select((step, index) => step is Repetition ? index : -1).Append(-1).Max();
        // Without a recursion all sets are levels, over the base mesh itself.
        var levelSteps = lastRepetition < 0 ? steps.Length : lastRepetition + 1;
        foreach (var step in steps[..levelSteps])
        {
            _levels.Add(step is Repetition repetition
                ? (new(Concatenate(repetition.Body)), repetition.Count ?? int.MaxValue)
                : (new(Concatenate([step])), 1));
        }

        var baseMaps = Concatenate(steps[levelSteps..]);
        _baseMesh = baseMaps is [var only] && only == AffineMap.Identity
            ? fractal.BaseMesh
            : FractalGenerator.Flatten(fractal.BaseMesh, [.. baseMaps]);
        _baseBvh = new(_baseMesh);
        _hasOnlySimilarities = _levels.All(level => level.Set.AreSimilarities);
        _hasNoLevels = _levels.All(level => level.Rounds == 0);
        _beamWidth = beamWidth;
    }

    /// <inheritdoc/>
    public override bool IsExact => false;

    /// <inheritdoc/>
    public override long StorageBytes =>
        _levels.Sum(level => level.Set.StorageBytes) + (sizeof(double) * (long)_baseMesh.Positions.Length)
        + (sizeof(int) * (long)_baseMesh.VertexIndices.Length) + _baseBvh.StorageBytes;

    /// <inheritdoc/>
    protected override bool FindClosestCore(Vector position, double maxDistance, double epsilon, QueryContext context,
        out ClosestPoint closest)
    {
        context.ClearPath();
        if (_beamWidth > 1)
        {
            return FindWithBeam(position, maxDistance, context, out closest);
        }

        var (map, localPosition, closestFace) = (AffineMap.Identity, position, -1);
        var faceTests = 0L;
        if (_hasNoLevels)
        {
            var distanceSquared = double.PositiveInfinity;
            _baseBvh.TestAllTriangles(position, ref distanceSquared, ref closestFace, ref faceTests);
        }

        foreach (var (set, rounds) in _levels)
        {
            for (var round = 0; round < rounds && !(round > 0 && BoundingSphere.OperatorNormBound(map.Linear) < MinScale); round++)
            {
                var childIndex = ClosestChild(set, position, localPosition, map, ref closestFace, ref faceTests);
                if (childIndex < 0)
                {
                    context.FaceTests += faceTests;
                    closest = default;
                    return false;
                }

                map *= set.Maps[childIndex];
                localPosition = _hasOnlySimilarities ? set.Inverses[childIndex] * localPosition : localPosition;
                context.AppendToPath(childIndex);
            }
        }

        context.FaceTests += faceTests;
        closest = closestFace < 0 ? default : ClosestPointFactory.Create(_baseMesh, closestFace, map, position);
        return closestFace >= 0 && closest.Distance <= maxDistance;
    }

    /// <summary>
    /// Looks at all faces of the base under each map of a set, and says under which the nearest is; −1 where there are no faces.
    /// </summary>
    private int ClosestChild(MapSet set, Vector position, Vector localPosition, in AffineMap map, ref int closestFace, ref long faceTests)
    {
        var (closestDistanceSquared, closestChild) = (double.PositiveInfinity, -1);
        for (var childIndex = 0; childIndex < set.Maps.Length; childIndex++)
        {
            var candidateFace = -1;
            // Where distances scale, the position goes into the copy's frame; else the base goes into the position's.
            if (_hasOnlySimilarities)
            {
                var distanceSquared = closestDistanceSquared / set.ScalesSquared[childIndex];
                _baseBvh.TestAllTriangles(set.Inverses[childIndex] * localPosition, ref distanceSquared, ref candidateFace, ref faceTests);
                closestDistanceSquared = candidateFace < 0 ? closestDistanceSquared : distanceSquared * set.ScalesSquared[childIndex];
            }
            else
            {
                _baseBvh.TestAllTransformedTriangles(position, map * set.Maps[childIndex], ref closestDistanceSquared, ref candidateFace,
                    ref faceTests);
            }

            if (candidateFace >= 0)
            {
                (closestChild, closestFace) = (childIndex, candidateFace);
            }
        }

        return closestChild;
    }

    /// <summary>All maps of some steps, one after the other, as one set.</summary>
    private static AffineMap[] Concatenate(ImmutableArray<FractalStep> steps)
    {
        const int maxMaps = 1_000_000;
        if (!FractalSteps.HasAtMostInstances(steps, maxMaps))
        {
            throw new FractalLimitException($"one level of the fractal, its sets concatenated, has more than {maxMaps} transformations");
        }

        AffineMap[] maps = [AffineMap.Identity];
        for (var level = 0L; level < FractalSteps.LevelCount(steps); level++)
        {
            maps = FractalGenerator.ConcatenatePair(maps, FractalSteps.LevelAt(steps, level).Maps.AsSpan(), static (m1, m2) => m1 * m2);
        }

        return maps;
    }
}
