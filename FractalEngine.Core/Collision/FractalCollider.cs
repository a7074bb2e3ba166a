using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>
/// The paper's descent (§4.4.3): at each level every transformation is looked at as if the base object stood there alone, and the search goes on
/// in the nearest one only. Approximate: a copy of the base can be farther away while the sub-fractal that stands on it is nearer.
/// </summary>
/// <remarks>
/// A round of a recursion is one level, its sets concatenated; sets below the last recursion belong to the base object. So a query costs exactly
/// b·t face tests a level, b·t·d in all; it keeps t maps and the base object.
/// </remarks>
public sealed class FractalCollider : Collider
{
    private readonly List<(CopySet Set, int Rounds)> _levels = [];
    private readonly bool _isSimilar;
    private readonly Mesh _base;
    private readonly bool _hasNoLevels;

    /// <summary>Prepares a fractal in affine composition.</summary>
    /// <exception cref="ArgumentException">The fractal is composed componentwise.</exception>
    /// <exception cref="FractalLimitException">A round, or the base object, has more than a million instances of its own.</exception>
    public FractalCollider(Fractal fractal)
    {
        if (fractal.Description.Composition != Composition.Affine)
        {
            throw new ArgumentException("expected affine composition: the descent follows maps", nameof(fractal));
        }

        var steps = fractal.Description.Steps;
        var last = steps.Select((step, index) => step is Repetition ? index : -1).Append(-1).Max();
        // Without a recursion all sets are levels, over the base mesh itself.
        var levels = last < 0 ? steps.Length : last + 1;
        foreach (var step in steps[..levels])
        {
            _levels.Add(step is Repetition repetition
                ? (new(Concatenate(repetition.Body)), repetition.Count ?? int.MaxValue)
                : (new(Concatenate([step])), 1));
        }

        var inner = Concatenate(steps[levels..]);
        _base = inner is [var only] && only == AffineMap.Identity ? fractal.BaseMesh : FractalGenerator.Flatten(fractal.BaseMesh, [.. inner]);
        _isSimilar = _levels.All(level => level.Set.AreSimilar);
        _hasNoLevels = _levels.All(level => level.Rounds == 0);
    }

    /// <inheritdoc/>
    public override bool IsExact => false;

    /// <inheritdoc/>
    public override long StorageBytes =>
        _levels.Sum(level => level.Set.StorageBytes) + (sizeof(double) * (long)_base.Positions.Length) + (sizeof(int) * (long)_base.Faces.Length);

    /// <inheritdoc/>
    private protected override bool Find(Vector position, double within, double epsilon, QueryRecord record, out ClosestPoint closest)
    {
        record.ClearPath();
        var (map, local, face) = (AffineMap.Identity, position, -1);
        if (_hasNoLevels)
        {
            NearestFace(position, map, 1, double.PositiveInfinity, record, out face);
        }

        foreach (var (set, rounds) in _levels)
        {
            // A copy that is smaller than the last place of a coordinate has no parts that could be told apart.
            for (var round = 0; round < rounds && !(round > 0 && BoundingSphere.LengtheningBound(map.Linear) < 1e-15); round++)
            {
                var (nearest, nearestCopy) = (double.PositiveInfinity, -1);
                for (var copy = 0; copy < set.Maps.Length; copy++)
                {
                    // Where distances scale, the position goes into the copy's frame; else the base goes into the position's.
                    var squared = _isSimilar
                        ? NearestFace(set.Inverses[copy] * local, AffineMap.Identity, set.ScaleSquared[copy], nearest, record, out var nearestFace)
                        : NearestFace(position, map * set.Maps[copy], 1, nearest, record, out nearestFace);
                    if (nearestFace >= 0)
                    {
                        (nearest, nearestCopy, face) = (squared, copy, nearestFace);
                    }
                }

                if (nearestCopy < 0)
                {
                    closest = default;
                    return false;
                }

                map *= set.Maps[nearestCopy];
                local = _isSimilar ? set.Inverses[nearestCopy] * local : local;
                record.AppendToPath(nearestCopy);
            }
        }

        closest = face < 0 ? default : FaceAnswer.Of(_base, face, map, position);
        return face >= 0 && closest.Distance <= within;
    }

    /// <summary>Looks at all faces of the base.</summary>
    /// <param name="position">Anywhere.</param>
    /// <param name="map">From the base's frame to that of the position.</param>
    /// <param name="scaleSquared">What squared distances are multiplied by.</param>
    /// <param name="nearest">The nearest so far, squared.</param>
    /// <param name="record">Counts the faces.</param>
    /// <param name="nearestFace">The nearest face, −1 if none is nearer than before.</param>
    private double NearestFace(Vector position, AffineMap map, double scaleSquared, double nearest, QueryRecord record, out int nearestFace)
    {
        nearestFace = -1;
        record.FaceTests += _base.FaceCount;
        var isIdentity = map == AffineMap.Identity;
        for (var face = 0; face < _base.FaceCount; face++)
        {
            var (a, b, c) = _base.Face(face);
            (a, b, c) = isIdentity ? (a, b, c) : (map * a, map * b, map * c);
            var squared = scaleSquared * FaceKernel.ClosestPoint(position, a, b, c).DistanceSquared;
            if (squared < nearest)
            {
                (nearest, nearestFace) = (squared, face);
            }
        }

        return nearest;
    }

    /// <summary>All maps of some steps, one after the other, as one set.</summary>
    private static AffineMap[] Concatenate(ImmutableArray<FractalStep> steps)
    {
        const int limit = 1_000_000;
        if (!FractalSteps.HasAtMost(steps, limit))
        {
            throw new FractalLimitException($"one level of the fractal, its sets concatenated, has more than {limit} transformations");
        }

        AffineMap[] maps = [AffineMap.Identity];
        for (var level = 0L; level < FractalSteps.LevelCount(steps); level++)
        {
            maps = FractalGenerator.ConcatenatePair(maps, FractalSteps.LevelAt(steps, level).Maps.AsSpan(), static (m1, m2) => m1 * m2);
        }

        return maps;
    }
}
