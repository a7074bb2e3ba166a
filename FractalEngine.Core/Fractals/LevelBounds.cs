using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// A bounding volume of the sub-fractal at each of the outermost levels, in that sub-fractal's own frame, for the box of fractals whose
/// maps keep boxes axis-aligned, and of those that have no <see cref="Hierarchy.FractalHierarchy"/>.
/// </summary>
internal sealed class LevelBounds
{
    // Deeper levels are never visited one by one: each halving of the scale uses up one of a double's 53 bits, so that a search ends long
    // before.
    private const int MaxKeptLevels = 4096;
    private const int MaxRounds = 100_000;

    // The maps of a round are also bounded together if they are no more than this.
    private const int MaxComposedMaps = 256;

    private readonly SphereAndBox[] _levels;

    private LevelBounds(SphereAndBox[] levels, bool hasExactBoxes)
    {
        _levels = levels;
        HasExactBoxes = hasExactBoxes;
    }

    /// <summary>Whether the boxes are exact, as all maps keep boxes axis-aligned.</summary>
    public bool HasExactBoxes { get; }

    /// <summary>The volume of the sub-fractal at a level; infinite below the levels that are kept.</summary>
    /// <param name="level">0 is the whole fractal, the number of levels the base mesh.</param>
    public SphereAndBox At(long level) => level < _levels.Length ? _levels[level] : SphereAndBox.Unbounded;

    /// <summary>Computes the bounds of a fractal in affine composition.</summary>
    /// <remarks>
    /// One pass from the innermost level outwards; a repetition ends early once its bounds have converged. Cost: one step for each map and
    /// level until then.
    /// </remarks>
    public static LevelBounds Compute(Fractal fractal)
    {
        var builder = new Builder(SphereAndBox.FromMesh(fractal.BaseMesh));
        foreach (var step in fractal.Description.Steps.Reverse())
        {
            if (!builder.TryAdd(step as Repetition ?? new([step], 1)))
            {
                // Beyond a double: all that is known of the levels above is that they are no smaller.
                return new([SphereAndBox.Unbounded], false);
            }
        }

        return builder.Build();
    }

    private sealed class Builder(SphereAndBox baseVolume)
    {
        private readonly List<SphereAndBox> _kept = [baseVolume];
        private SphereAndBox _volume = baseVolume;
        private bool _isExact = true;
        private bool _isComplete = true;

        public LevelBounds Build()
        {
            _kept.Reverse();
            return new(_isComplete ? [.. _kept] : [.. _kept.Take(MaxKeptLevels)], _isExact);
        }

        /// <summary>Adds the levels of a repetition above those added before.</summary>
        /// <returns>False when the bounds leave the range of a double.</returns>
        public bool TryAdd(Repetition repetition)
        {
            var rounds = repetition.Count ?? MaxRounds;
            var composedMaps = ComposeRound(repetition);
            for (var round = 0; round < rounds; round++)
            {
                var previous = _volume;
                AddRound(repetition, composedMaps);
                if (!_volume.IsFinite())
                {
                    return false;
                }

                if (HasConverged(previous, _volume))
                {
                    AddConvergedLevels((rounds - round - 1) * repetition.LevelsPerRound, (int)repetition.LevelsPerRound);
                    return true;
                }

                DropInnermostLevels(repetition.LevelsPerRound);
            }

            if (repetition.Count is null)
            {
                // The maps don't shrink, or by so little that there is no limit within reach.
                _volume = SphereAndBox.Unbounded;
                _kept.Add(_volume);
            }

            return true;
        }

        private void AddRound(Repetition repetition, AffineMap[] composedMaps)
        {
            var previous = _volume;
            for (var level = repetition.LevelsPerRound - 1; level >= 0; level--)
            {
                var set = repetition.LevelAt(level);
                _isExact &= set.Maps.All(map => map.Linear.KeepsBoxesAxisAligned());
                _volume = _volume.UnionOfTransformed(set.Maps.AsSpan());
                _kept.Add(_volume);
            }

            if (composedMaps.Length > 0)
            {
                // Rotated boxes and stretched spheres grow from set to set, where the maps of a whole round may shrink.
                _volume = SphereAndBox.Tighter(_volume, previous.UnionOfTransformed(composedMaps));
                _kept[^1] = _volume;
            }
        }

        /// <summary>Adds levels whose bounds are those of the last round, as many as are ever visited.</summary>
        private void AddConvergedLevels(long count, int levelsPerRound)
        {
            _isComplete &= count <= MaxKeptLevels;
            for (var remaining = Math.Min(count, MaxKeptLevels); remaining > 0; remaining--)
            {
                _kept.Add(_kept[^levelsPerRound]);
            }
        }

        private void DropInnermostLevels(long levelsPerRound)
        {
            if (_kept.Count > (4 * MaxKeptLevels) + levelsPerRound)
            {
                _kept.RemoveRange(0, _kept.Count - MaxKeptLevels);
                _isComplete = false;
            }
        }

        /// <summary>Composes the maps of one round of several sets.</summary>
        /// <returns>No maps where the boxes of each set are exact, or where there are too many.</returns>
        private static AffineMap[] ComposeRound(Repetition repetition)
        {
            if (repetition.LevelsPerRound == 1)
            {
                return [];
            }

            AffineMap[] maps = [AffineMap.Identity];
            var isExact = true;
            for (var level = 0L; level < repetition.LevelsPerRound; level++)
            {
                var set = repetition.LevelAt(level).Maps;
                if ((long)maps.Length * set.Length > MaxComposedMaps)
                {
                    return [];
                }

                isExact &= set.All(map => map.Linear.KeepsBoxesAxisAligned());
                maps = [.. from outer in maps from inner in set select outer * inner];
            }

            return isExact ? [] : maps;
        }

        private static bool HasConverged(in SphereAndBox previous, in SphereAndBox current)
        {
            var minimumChange = (previous.Box.Minimum - current.Box.Minimum).MaxAbsComponent();
            var maximumChange = (previous.Box.Maximum - current.Box.Maximum).MaxAbsComponent();
            var radiusChange = Math.Abs(previous.Sphere.Radius - current.Sphere.Radius);
            return Math.Max(radiusChange, Math.Max(minimumChange, maximumChange)) <= 1e-15 * current.Box.Size.MaxAbsComponent();
        }
    }
}
