using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>A map of a recursive, and what it is applied to: a recursive of the same group, or an earlier part of the graph.</summary>
/// <param name="Map">From the frame of the target to that of the caller.</param>
/// <param name="Target">Index of the recursive that is called; of an earlier part where the call is a constant.</param>
/// <param name="LevelsLess">
/// By how much fewer levels the target has. Where the caller has fewer, the target's base takes its place. Null for a constant: an earlier
/// part, which stands at every level of the caller but 0.
/// </param>
public readonly record struct RecursiveCall(AffineMap Map, int Target, int? LevelsLess = 1)
{
    /// <summary>What the map mixes into the colours of all that it makes.</summary>
    public MapColour Colour { get; init; }

    /// <summary>True where the target stands as it is: where it is, and in its colours.</summary>
    public bool IsPlain => Map == AffineMap.Identity && Colour.IsNone;

    /// <summary>Tells whether this is another map of the same set as another call: one of the same target.</summary>
    public bool HasTargetOf(RecursiveCall other) => Target == other.Target && LevelsLess == other.LevelsLess;

    /// <summary>True where the target is an earlier part of the graph.</summary>
    public bool IsConstant => LevelsLess is null;

    /// <summary>Makes a constant: an earlier part under a map.</summary>
    public static RecursiveCall ToPart(AffineMap map, int part) => new(map, part, null);

    /// <summary>Makes a constant: an earlier part as it is.</summary>
    public static RecursiveCall ToPart(int part) => ToPart(AffineMap.Identity, part);
}
