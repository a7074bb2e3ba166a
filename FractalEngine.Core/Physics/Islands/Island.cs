namespace FractalEngine.Core.Physics.Islands;

/// <summary>Bodies that touch, directly or through others, as ranges of the lists of a <see cref="ContactGraph"/>.</summary>
/// <param name="FirstRow">Index of its first contact.</param>
/// <param name="RowCount">Number of its contacts.</param>
/// <param name="FirstBody">Place of its first body.</param>
/// <param name="BodyCount">Number of its bodies, at least two.</param>
internal readonly record struct Island(int FirstRow, int RowCount, int FirstBody, int BodyCount)
{
    /// <summary>Number of parts that share no body, see <see cref="IslandParts"/>.</summary>
    public int PartCount { get; init; } = 1;

    /// <summary>Place of the end of its first part's contacts, where it has several.</summary>
    public int FirstPartEnd { get; init; }

    /// <summary>True where it touches nothing immovable, so that its momentum is its own.</summary>
    public bool IsFree { get; init; }

    /// <summary>True where a surface that it touches, or may meet, has any velocity: it moves, turns, or is a belt.</summary>
    public bool HasMovingSurface { get; init; }

    /// <summary>True where one of its bodies is a compound.</summary>
    public bool HasCompound { get; init; }
}
