namespace FractalEngine.Core.Scenes;

/// <summary>What the colour of an instance depends on.</summary>
public enum GradientKind
{
    /// <summary>All instances have the same colour.</summary>
    None,

    /// <summary>How many maps other than the identity lead to it; there and back every twelve levels where there are more.</summary>
    Level,

    /// <summary>
    /// Which maps lead to it: the place of the outermost one in its set counts half, that of the next one a quarter, and so on.
    /// </summary>
    Path,
}
