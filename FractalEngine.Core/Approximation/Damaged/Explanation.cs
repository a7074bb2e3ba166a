namespace FractalEngine.Core.Approximation.Damaged;

/// <summary>What a hypothesis explains, and what for.</summary>
/// <param name="Explained">How many elements it explains.</param>
/// <param name="Predicted">How many elements it predicts, present or not.</param>
/// <param name="Maps">How many maps and placements it consists of.</param>
internal readonly record struct Explanation(int Explained, int Predicted, int Maps)
{
    // Twelve numbers of three digits or so: what a placement costs that nothing explains.
    private const double PlacementCost = 30;

    // Where so much is there of what so few maps predict, there is nothing better to look for.
    private const double ClearPart = 0.45;
    private const double ClearMaps = 0.1;

    /// <summary>
    /// The length of the message that it saves, in nats: an element costs as much as a map; where elements are predicted, it costs to say
    /// which of them are missing.
    /// </summary>
    public double Worth
    {
        get
        {
            var part = Predicted > 0 ? Math.Min(1, (double)Explained / Predicted) : 1;
            var missing = part is > 0 and < 1 ? -(part * Math.Log(part)) - ((1 - part) * Math.Log(1 - part)) : 0;
            return (PlacementCost * (Explained - Maps)) - (Predicted * missing);
        }
    }

    /// <summary>Whether it explains most of so many elements by few maps that predict few others.</summary>
    public bool IsClear(int elements) =>
        Explained >= ClearPart * elements && Explained >= ClearPart * Predicted && Maps <= ClearMaps * Explained;
}
