using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Fractals;
namespace FractalEngine.Core.Fractals.Hierarchy;

/// <summary>The part of a repetition that one edge stands for, where a level of the hierarchy is many levels of the fractal.</summary>
/// <param name="MapIndex">Index of the map in the set of the repetition.</param>
/// <param name="IdentityIndex">Index of the identity in the set; −1 for none.</param>
/// <param name="Exponent">How often the edge applies the map.</param>
/// <param name="Count">Number of levels of the whole repetition.</param>
/// <param name="LevelBelow">Remaining levels below the repetition.</param>
internal sealed record MapPower(int MapIndex, int IdentityIndex, long Exponent, long Count, long LevelBelow)
{
    /// <summary>Appends the map indices of the edge to the path of a result and, below the repetition, those of the identities.</summary>
    /// <param name="context">Receives the indices.</param>
    /// <param name="exponent">How often the edges before have applied the map.</param>
    /// <param name="childLevels">Remaining levels below the edge.</param>
    /// <returns>How often the map is applied after the edge; 0 below the repetition.</returns>
    public long AppendToPath(QueryContext context, long exponent, long childLevels)
    {
        for (var i = 0L; i < Exponent; i++)
        {
            context.AppendToPath(MapIndex);
        }

        exponent += Exponent;
        if (childLevels != LevelBelow)
        {
            return exponent;
        }

        // A path that ends early goes on with identities.
        for (var i = exponent; i < Count && Count <= (LevelBelow > 0 ? FractalLimits.MaxDepth : FractalSearchState.MaxDepth); i++)
        {
            context.AppendToPath(IdentityIndex);
        }

        return 0;
    }
}
