using System.Numerics;
using FractalEngine.Core.Fractals.Descriptions;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>
/// Decides which one of the edges of a level stands at a place: by chance, or by size. A search goes on there at once, and never visits
/// the level.
/// </summary>
internal abstract class LevelPick
{
    /// <summary>True where the way to a place decides.</summary>
    public virtual bool DependsOnWay => false;

    /// <summary>True where the level alone decides, whatever the seed.</summary>
    public virtual bool IsFixed => false;

    /// <summary>True where the size at a place decides. Paths don't tell of that.</summary>
    public virtual bool DependsOnSize => false;

    /// <summary>The index of the likeliest edge at a level, the first of such.</summary>
    /// <param name="level">Remaining levels.</param>
    public virtual int LikeliestAt(long level) => 0;

    /// <summary>The index of the edge that stands at a place.</summary>
    public abstract int Select(in LevelState state);

    /// <summary>How often an edge stands there, of 2⁶⁴; null where that is no chance.</summary>
    public virtual BigInteger? ProbabilityOf(int index) => null;

    /// <summary>The share of places at which an edge stands, about; never 0 where size or level decides.</summary>
    /// <param name="level">Remaining levels.</param>
    /// <param name="index">Index of the edge.</param>
    public double ShareOf(long level, int index) => ProbabilityOf(index) is { } probability ? Math.ScaleB((double)probability, -64)
        : index == LikeliestAt(level) ? 1
        : 1e-9;

    /// <summary>Decides by chance, with weights, or by the level.</summary>
    /// <param name="choice">The weights and the seed.</param>
    /// <param name="firstLevel">The lowest level of the recursives.</param>
    /// <param name="period">Number of recursives.</param>
    internal sealed class ByChance(Choice choice, long firstLevel, int period) : LevelPick
    {
        /// <summary>The weights and the seed.</summary>
        public Choice Choice => choice;

        /// <summary>The lowest level of the recursives.</summary>
        public long FirstLevel => firstLevel;

        /// <summary>Number of recursives that take turns.</summary>
        public int Period => period;

        /// <summary>The highest level of the recursives.</summary>
        public long TopLevel { get; set; }

        /// <inheritdoc/>
        public override bool DependsOnWay => !choice.IsByLevel;

        /// <inheritdoc/>
        public override bool IsFixed => !choice.FirstLevels.IsEmpty;

        /// <inheritdoc/>
        public override int LikeliestAt(long level) =>
            choice.IsByLevel ? Select(new(level)) : choice.Weights.IndexOf(choice.Weights.Max());

        /// <inheritdoc/>
        public override int Select(in LevelState state) => choice.IsByLevel
            ? choice.SelectAt(((TopLevel - firstLevel) / period) - ((state.Level - firstLevel) / period))
            : choice.Select(state.Way);

        /// <inheritdoc/>
        public override BigInteger? ProbabilityOf(int index) => IsFixed ? null : choice.ProbabilityOf(index);
    }

    /// <summary>Goes on by the first edge down to a size, and ends by the second one.</summary>
    /// <param name="limit">The largest number of a size that is not too small yet.</param>
    internal sealed class BySize(long limit) : LevelPick
    {
        /// <summary>The largest number of a size that is not too small yet.</summary>
        public long Limit => limit;

        /// <inheritdoc/>
        public override bool DependsOnSize => true;

        /// <inheritdoc/>
        public override int Select(in LevelState state) => state.Size <= limit ? 0 : 1;
    }
}
