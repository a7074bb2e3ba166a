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

    /// <summary>The height of its centre within the whole fractal: of the boxes of both, along y of the fractal's frame.</summary>
    Height,

    /// <summary>
    /// The distance of its centre from that of the whole fractal, as a part of half the diagonal of the box: 1 at a corner.
    /// </summary>
    Distance,

    /// <summary>
    /// The nearest approach of the path to it: the maps on the path carry the centre of the whole fractal along, and of all the places
    /// where it comes by, the nearest to the centre counts, as a part of half the diagonal. Identities do not count.
    /// </summary>
    Trap,
}
