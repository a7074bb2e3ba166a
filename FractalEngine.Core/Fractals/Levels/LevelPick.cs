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

    /// <summary>True where the size at a place decides. Paths don't tell of that.</summary>
    public virtual bool DependsOnSize => false;

    /// <summary>The index of the likeliest edge, the first of such.</summary>
    public virtual int Likeliest => 0;

    /// <summary>The index of the edge that stands at a place.</summary>
    public abstract int Select(in LevelState state);

    /// <summary>How often an edge stands there, of 2⁶⁴; null where that is no chance.</summary>
    public virtual BigInteger? ProbabilityOf(int index) => null;

    /// <summary>The share of places at which an edge stands, about.</summary>
    public double ShareOf(int index) => ProbabilityOf(index) is { } probability ? Math.ScaleB((double)probability, -64)
        : index == 0 ? 1
        : 1e-9;

    /// <summary>Decides by chance, with weights.</summary>
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
        public override int Likeliest => choice.Weights.IndexOf(choice.Weights.Max());

        /// <inheritdoc/>
        public override int Select(in LevelState state) => choice.Select(choice.IsByLevel
            ? WrittenWay.Of(((TopLevel - firstLevel) / period) - ((state.Level - firstLevel) / period), 0).After(0)
            : state.Way);

        /// <inheritdoc/>
        public override BigInteger? ProbabilityOf(int index) => choice.ProbabilityOf(index);
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
