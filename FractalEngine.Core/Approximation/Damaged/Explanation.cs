namespace FractalEngine.Core.Approximation.Damaged;

/// <summary>
/// What a description of the elements is worth: the length of the message that it saves, in nats. An element costs as much as a map; where
/// elements are predicted, it costs to say which of them are missing.
/// </summary>
internal static class Explanation
{
    // Twelve numbers of three digits or so: what a placement costs that nothing explains.
    private const double PlacementCost = 30;

    /// <summary>Computes the worth of a description.</summary>
    /// <param name="explained">How many elements it explains.</param>
    /// <param name="predicted">How many elements it predicts, present or not.</param>
    /// <param name="maps">How many maps and placements it consists of.</param>
    public static double Worth(double explained, double predicted, int maps)
    {
        var part = predicted > 0 ? Math.Min(1, explained / predicted) : 1;
        var missing = part is > 0 and < 1 ? -(part * Math.Log(part)) - ((1 - part) * Math.Log(1 - part)) : 0;
        return (PlacementCost * (explained - maps)) - (predicted * missing);
    }
}
