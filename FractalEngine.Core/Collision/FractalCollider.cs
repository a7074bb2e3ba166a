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
public sealed partial class FractalCollider : Collider
{
    // A copy that is smaller than the last place of a coordinate has no parts that could be told apart.
    private const double Smallest = 1e-15;

    private readonly List<(CopySet Set, int Rounds)> _levels = [];
    private readonly bool _isSimilar;
    private readonly Mesh _base;
    private readonly FaceHierarchy _faces;
    private readonly bool _hasNoLevels;
    private readonly int _width;

    /// <summary>Prepares a fractal in affine composition.</summary>
    /// <param name="fractal">Of any depth.</param>
    /// <param name="width">
    /// In how many of the nearest copies of each level the search goes on: 1 is the paper's descent; more cost up to as many times as much and err less, but are not exact either.
    /// </param>
    /// <exception cref="ArgumentOutOfRangeException">The width is less than 1.</exception>
    /// <exception cref="ArgumentException">The fractal is composed componentwise.</exception>
    /// <exception cref="SingularMatrixException">A map flattens what it maps, as a scale of 0 does; fractal files with one are refused.</exception>
    /// <exception cref="FractalLimitException">A round, or the base object, has more than a million instances of its own.</exception>
    public FractalCollider(Fractal fractal, int width = 1)
    {
        ArgumentOutOfRangeException.ThrowIfLessThan(width, 1);
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
        _faces = new(_base);
        _isSimilar = _levels.All(level => level.Set.AreSimilar);
        _hasNoLevels = _levels.All(level => level.Rounds == 0);
        _width = width;
    }

    /// <inheritdoc/>
    public override bool IsExact => false;

    /// <inheritdoc/>
    public override long StorageBytes =>
        _levels.Sum(level => level.Set.StorageBytes) + (sizeof(double) * (long)_base.Positions.Length) + (sizeof(int) * (long)_base.Faces.Length) + _faces.StorageBytes;

    /// <inheritdoc/>
    private protected override bool Find(Vector position, double within, double epsilon, QueryRecord record, out ClosestPoint closest)
    {
        record.ClearPath();
        if (_width > 1)
        {
            return FindWithBeam(position, within, record, out closest);
        }

        var (map, local, face) = (AffineMap.Identity, position, -1);
        var faceTests = 0L;
        if (_hasNoLevels)
        {
            var squared = double.PositiveInfinity;
            _faces.LookAtAll(position, ref squared, ref face, ref faceTests);
        }

        foreach (var (set, rounds) in _levels)
        {
            for (var round = 0; round < rounds && !(round > 0 && BoundingSphere.LengtheningBound(map.Linear) < Smallest); round++)
            {
                var copy = NearestCopy(set, position, local, map, ref face, ref faceTests);
                if (copy < 0)
                {
                    record.FaceTests += faceTests;
                    closest = default;
                    return false;
                }

                map *= set.Maps[copy];
                local = _isSimilar ? set.Inverses[copy] * local : local;
                record.AppendToPath(copy);
            }
        }

        record.FaceTests += faceTests;
        closest = face < 0 ? default : FaceAnswer.Of(_base, face, map, position);
        return face >= 0 && closest.Distance <= within;
    }

    /// <summary>Looks at all faces of the base under each map of a set, and says under which the nearest is; −1 where there are no faces.</summary>
    private int NearestCopy(CopySet set, Vector position, Vector local, in AffineMap map, ref int face, ref long faceTests)
    {
        var (nearest, nearestCopy) = (double.PositiveInfinity, -1);
        for (var copy = 0; copy < set.Maps.Length; copy++)
        {
            var nearestFace = -1;
            // Where distances scale, the position goes into the copy's frame; else the base goes into the position's.
            if (_isSimilar)
            {
                var squared = nearest / set.ScaleSquared[copy];
                _faces.LookAtAll(set.Inverses[copy] * local, ref squared, ref nearestFace, ref faceTests);
                nearest = nearestFace < 0 ? nearest : squared * set.ScaleSquared[copy];
            }
            else
            {
                _faces.LookAtAllImages(position, map * set.Maps[copy], ref nearest, ref nearestFace, ref faceTests);
            }

            if (nearestFace >= 0)
            {
                (nearestCopy, face) = (copy, nearestFace);
            }
        }

        return nearestCopy;
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
