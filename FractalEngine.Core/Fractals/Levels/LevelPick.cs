using System.Numerics;
using FractalEngine.Core.Fractals.Descriptions;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>Decides which one of the edges of a level stands at a place. A search goes on there at once, and never visits the level.</summary>
/// <param name="choice">Decides by chance.</param>
/// <param name="number">The number of the choice among those of its recursives.</param>
/// <param name="firstLevel">The lowest level of the recursives.</param>
/// <param name="period">Number of recursives.</param>
/// <param name="rounds">Number of levels of the recursives.</param>
internal sealed class LevelPick(Choice choice, int number, long firstLevel, int period, long rounds)
{
    /// <summary>The index of the edge that stands at a place.</summary>
    public int Select(in LevelState state) => choice.Select(choice.IsByLevel
        ? WrittenWay.Of(rounds - 1 - ((state.Level - firstLevel) / period), number).After(0)
        : state.Way);

    /// <summary>True where the way to a place decides, and not only its level.</summary>
    public bool DependsOnWay => !choice.IsByLevel;

    /// <summary>How often an edge stands there, of 2⁶⁴.</summary>
    public BigInteger ProbabilityOf(int index) => choice.ProbabilityOf(index);

    /// <summary>The index of the likeliest edge, the first of such.</summary>
    public int Likeliest => choice.Weights.IndexOf(choice.Weights.Max());
}
