using System.Collections.Immutable;
using FractalEngine.Core.Bvh;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Core.Colliders;

/// <summary>
/// Finds a close point of a fractal by the paper's descent (§4.4.3). At each level, every transformation is tested as if the base mesh were
/// there alone, and the search descends into the closest instance only.
/// </summary>
/// <remarks>
/// Approximate: an instance of the base mesh can be farther away while its sub-fractal is closer. A round of a recursion is one level, its
/// sets concatenated; sets below the last recursion belong to the base mesh. So a query costs exactly b·t face tests a level, b·t·d in all;
/// the collider keeps t maps and the base mesh.
/// </remarks>
public sealed class FractalCollider : Collider
{
    // An instance smaller than the last place of a coordinate has no parts that could be told apart.
    private const double MinScale = 1e-15;

    private const int EndlessRounds = int.MaxValue;

    private readonly List<(MapSet Set, int Rounds)> _levels = [];
    private readonly bool _hasOnlySimilarities;
    private readonly Mesh _baseMesh;
    private readonly TriangleBvh _baseBvh;
    private readonly bool _hasOwnMesh;
    private readonly bool _hasNoLevels;
    private readonly int _beamWidth;

    /// <summary>Prepares a fractal in affine composition for queries.</summary>
    /// <param name="fractal">A fractal of any depth.</param>
    /// <param name="beamWidth">
    /// Number of the closest instances of each level that the search descends into; 1 is the paper's descent. A larger beam costs up to so
    /// many times as much and errs less, but is not exact either.
    /// </param>
    /// <exception cref="ArgumentOutOfRangeException">The width is less than 1.</exception>
    /// <exception cref="ArgumentException">The fractal is composed componentwise, or made of several parts.</exception>
    /// <exception cref="SingularMatrixException">
    /// A map has no inverse, as with a scale of 0. The parser refuses fractal files with such a map.
    /// </exception>
    /// <exception cref="FractalLimitException">
    /// A round, or the base mesh, has more than a million instances of its own, or coordinates of the fractal are beyond 1e40.
    /// </exception>
    public FractalCollider(Fractal fractal, int beamWidth = 1)
    {
        ArgumentOutOfRangeException.ThrowIfLessThan(beamWidth, 1);
        if (fractal.Description is not { Composition: Composition.Affine, Parts.IsEmpty: true })
        {
            throw new ArgumentException("expected steps on one mesh in affine composition: the descent follows maps", nameof(fractal));
        }

        ScaledQuery.ThrowIfTooLarge(fractal.Bounds.IsEmpty ? 0 : fractal.Bounds.MaxAbsCoordinate());
        var steps = fractal.Description.Steps;
        var lastRepetition = steps.Select((step, index) => step is Repetition ? index : -1).Append(-1).Max();
        // Without a recursion all sets are levels, over the base mesh itself.
        var levelSteps = lastRepetition < 0 ? steps.Length : lastRepetition + 1;
        foreach (var step in steps[..levelSteps])
        {
            _levels.Add(step is Repetition repetition
                ? (new(Concatenate(repetition.Round)), repetition.Count ?? EndlessRounds)
                : (new(Concatenate([step])), 1));
        }

        var baseMaps = Concatenate(steps[levelSteps..]);
        _baseMesh = baseMaps is [var only] && only == AffineMap.Identity
            ? fractal.BaseMesh
            : FractalGenerator.Flatten(fractal.BaseMesh, [.. baseMaps]);
        _hasOwnMesh = !ReferenceEquals(_baseMesh, fractal.BaseMesh);
        _baseBvh = TriangleBvh.For(_baseMesh);
        _hasOnlySimilarities = _levels.All(level => level.Set.AreSimilarities);
        _hasNoLevels = _levels.All(level => level.Rounds == 0);
        _beamWidth = beamWidth;
    }

    /// <inheritdoc/>
    public override bool IsExact => false;

    /// <inheritdoc/>
    public override long StorageBytes =>
        _levels.Sum(level => level.Set.StorageBytes) + _baseBvh.StorageBytes
        + (_hasOwnMesh ? (sizeof(double) * (long)_baseMesh.Positions.Length) + (sizeof(int) * (long)_baseMesh.VertexIndices.Length) : 0);

    /// <inheritdoc/>
    protected override bool FindClosestCore(Vector position, double maxDistance, double epsilon, QueryContext context,
        out ClosestPoint closest)
    {
        ScaledQuery.ThrowIfTooLarge(position.MaxAbsComponent());
        context.ClearPath();
        if (_beamWidth > 1)
        {
            return FindWithBeam(position, maxDistance, context, out closest);
        }

        var map = AffineMap.Identity;
        var localPosition = position;
        var closestFace = TestBaseWithoutLevels(position, context).FaceIndex;
        var testsBefore = context.Statistics.FaceTests;
        foreach (var (set, rounds) in _levels)
        {
            for (var round = 0; round < rounds && !(round > 0 && BoundingSphere.OperatorNormBound(map.Linear) < MinScale); round++)
            {
                var childIndex = FindClosestChild(set, position, localPosition, in map, ref closestFace, context);
                if (childIndex < 0)
                {
                    closest = default;
                    return false;
                }

                RequireAllowedTests(context.Statistics.FaceTests - testsBefore);
                var childMap = map * set.Maps[childIndex];
                if (rounds == EndlessRounds && childMap == map)
                {
                    // The identity is chosen for ever.
                    break;
                }

                map = childMap;
                localPosition = _hasOnlySimilarities ? set.Inverses[childIndex] * localPosition : localPosition;
                context.AppendToPath(childIndex);
            }
        }

        closest = closestFace < 0 ? default : ClosestPointFactory.OnInstance(_baseMesh, closestFace, map, position);
        return closestFace >= 0 && closest.Distance <= maxDistance;
    }

    // Differs from §4.4.3: the paper descends into one instance.
    private bool FindWithBeam(Vector position, double maxDistance, QueryContext context, out ClosestPoint closest)
    {
        var beam = context.DescentBeam;
        var testsBefore = context.Statistics.FaceTests;
        var baseTriangle = TestBaseWithoutLevels(position, context);
        beam.Begin(_beamWidth, new(AffineMap.Identity, position, 1, baseTriangle.DistanceSquared, baseTriangle.FaceIndex, -1));
        foreach (var (set, rounds) in _levels)
        {
            for (var round = 0; round < rounds; round++)
            {
                var hasChildren = false;
                for (var parent = 0; parent < beam.Entries.Count; parent++)
                {
                    hasChildren |= OfferChildren(beam, parent, set, round > 0, position, context);
                }

                RequireAllowedTests(context.Statistics.FaceTests - testsBefore);
                beam.AdvanceLevel(set, _hasOnlySimilarities);
                if (!hasChildren)
                {
                    break;
                }
            }
        }

        if (beam.Entries.Count == 0 || beam.Entries[0].ClosestFace < 0)
        {
            closest = default;
            return false;
        }

        beam.WritePath(context);
        closest = ClosestPointFactory.OnInstance(_baseMesh, beam.Entries[0].ClosestFace, beam.Entries[0].Map, position);
        return closest.Distance <= maxDistance;
    }

    /// <summary>Offers the children of an entry to the beam.</summary>
    /// <returns>False when the entry is too small for children, and is offered itself.</returns>
    private bool OfferChildren(DescentBeam beam, int parent, MapSet set, bool canTerminate, Vector position, QueryContext context)
    {
        var entry = beam.Entries[parent];
        if (canTerminate && BoundingSphere.OperatorNormBound(entry.Map.Linear) < MinScale)
        {
            beam.InsertIfCloser(entry.DistanceSquared, parent, -1, entry.ClosestFace);
            return false;
        }

        for (var childIndex = 0; childIndex < set.Maps.Length; childIndex++)
        {
            var closest = TestChild(
                set, childIndex, position, entry.LocalPosition, entry.Map, entry.ScaleSquared, beam.CutoffSquared, context);
            if (closest.FaceIndex >= 0)
            {
                beam.InsertIfCloser(closest.DistanceSquared, parent, childIndex, closest.FaceIndex);
            }
        }

        return true;
    }

    private static void RequireAllowedTests(long count)
    {
        if (count > FractalLimits.DescentTests.Value)
        {
            throw new FractalLimitException(
                $"the descent of a query tests more than the limit of {FractalLimits.DescentTests.Value} faces: "
                + "its cost grows with the depth");
        }
    }

    /// <summary>Tests the base mesh itself, if there are no levels.</summary>
    private ClosestTriangle TestBaseWithoutLevels(Vector position, QueryContext context)
    {
        var closest = new ClosestTriangle(double.PositiveInfinity);
        if (_hasNoLevels)
        {
            ClosestTriangleSearch.TestAll(_baseBvh, position, ref closest);
            context.Statistics.FaceTests += closest.FaceTests;
        }

        return closest;
    }

    /// <summary>Tests all triangles of the base mesh under one map of a set.</summary>
    /// <param name="set">The set.</param>
    /// <param name="childIndex">Index of the map.</param>
    /// <param name="position">In the frame of the query.</param>
    /// <param name="localPosition">In the frame of the set; only where all maps are similarities.</param>
    /// <param name="map">From the frame of the set to that of the query.</param>
    /// <param name="scaleSquared">Square of the factor between the units of <paramref name="cutoffSquared"/> and of the set.</param>
    /// <param name="cutoffSquared">Only what is closer counts.</param>
    /// <param name="context">Receives the costs.</param>
    private ClosestTriangle TestChild(
        MapSet set, int childIndex, Vector position, Vector localPosition, in AffineMap map, double scaleSquared, double cutoffSquared,
        QueryContext context)
    {
        ClosestTriangle closest;
        // Where distances scale, the position is taken into the child's frame; else the base is taken into the query's.
        if (_hasOnlySimilarities)
        {
            var childScaleSquared = scaleSquared * set.ScalesSquared[childIndex];
            closest = new(cutoffSquared / childScaleSquared);
            ClosestTriangleSearch.TestAll(_baseBvh, set.Inverses[childIndex] * localPosition, ref closest);
            closest.DistanceSquared *= childScaleSquared;
        }
        else
        {
            closest = new(cutoffSquared);
            TransformedTriangleSearch.TestAll(_baseBvh, position, map * set.Maps[childIndex], ref closest);
        }

        context.Statistics.FaceTests += closest.FaceTests;
        return closest;
    }

    /// <summary>Tests all triangles of the base mesh under each map of a set.</summary>
    /// <returns>Index of the map with the closest triangle; −1 where the base mesh has no faces.</returns>
    private int FindClosestChild(
        MapSet set, Vector position, Vector localPosition, in AffineMap map, ref int closestFace, QueryContext context)
    {
        var closestDistanceSquared = double.PositiveInfinity;
        var closestChild = -1;
        for (var childIndex = 0; childIndex < set.Maps.Length; childIndex++)
        {
            var closest = TestChild(set, childIndex, position, localPosition, in map, 1, closestDistanceSquared, context);
            if (closest.FaceIndex >= 0)
            {
                closestDistanceSquared = closest.DistanceSquared;
                closestChild = childIndex;
                closestFace = closest.FaceIndex;
            }
        }

        return closestChild;
    }

    /// <summary>Concatenates all maps of some steps to one set.</summary>
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
