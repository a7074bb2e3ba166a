namespace FractalEngine.Core.Physics.Islands;

/// <summary>A pair that can be sorted by its bodies.</summary>
internal interface IBodyPair
{
    /// <summary>Orders pairs by their first body, and by their second one where that is the same.</summary>
    long Order { get; }
}

/// <summary>Two bodies that are so near that they touch, or may meet within the step.</summary>
/// <param name="First">Index of a body that can move.</param>
/// <param name="Second">Index of the other body.</param>
/// <param name="IsSecondImmovable">True where the other one sleeps or is stuck, and does not give way.</param>
/// <param name="IsTouching">True where they touch.</param>
internal record struct BodyPair(int First, int Second, bool IsSecondImmovable, bool IsTouching) : IBodyPair
{
    /// <summary>True where the pair is a contact of the present islands.</summary>
    public bool IsRow { get; set; }

    /// <summary>True where they have just been found to meet in the step.</summary>
    public bool IsMeeting { get; set; }

    /// <inheritdoc/>
    public readonly long Order => ((long)First << 32) | (uint)Second;
}

/// <summary>Two bodies that do not touch, and that the search for what touches has found as well.</summary>
/// <param name="Pair">The pair.</param>
/// <param name="Gap">Free distance between the spheres that hold them, scene units.</param>
internal record struct NearPair(BodyPair Pair, double Gap) : IBodyPair
{
    /// <summary>True once it is among the pairs that are known, or too far apart for that.</summary>
    public bool IsTaken { get; set; }

    /// <summary>How far each of them may be pushed by the other one; negative for one that is not taken now.</summary>
    public double Push { get; set; } = double.NegativeInfinity;

    /// <inheritdoc/>
    public readonly long Order => Pair.Order;
}
