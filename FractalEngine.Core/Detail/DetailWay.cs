using System.Runtime.CompilerServices;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Detail;

/// <summary>What the colour of a sub-fractal follows from, see <see cref="GradientKind"/>: what is known of the maps that lead to it, identities left out.</summary>
/// <param name="Count">How many they are.</param>
/// <param name="Place">Between 0 and 1: the place of the outermost one in its set counts half, that of the next one a quarter, and so on.</param>
/// <param name="Weight">What the next one counts, twice.</param>
public readonly record struct DetailWay(int Count, float Place, float Weight)
{
    private const int MostLevels = 12;

    /// <summary>Of the whole fractal.</summary>
    public static DetailWay Start => new(0, 0, 1);

    /// <summary>One map further.</summary>
    /// <param name="index">Its number in its set; −1 for the identity.</param>
    /// <param name="child">Its place among the copies.</param>
    /// <param name="count">Of the copies.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal DetailWay Then(int index, int child, int count) => index < 0 ? this
        : new(Count + 1, Place + (0.5f * Weight * child / Math.Max(1, count - 1)), 0.5f * Weight);

    /// <summary>From 0 to 1, between two colours.</summary>
    /// <param name="gradient">What decides.</param>
    /// <param name="levels">Of the whole fractal.</param>
    internal float Tint(GradientKind gradient, long levels)
    {
        if (gradient == GradientKind.Path)
        {
            return Place;
        }

        var most = (int)Math.Clamp(levels, 1, MostLevels);
        var turn = Count % (2 * most) / (float)most;
        return turn <= 1 ? turn : 2 - turn;
    }
}
