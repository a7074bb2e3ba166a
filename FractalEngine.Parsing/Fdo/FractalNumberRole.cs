namespace FractalEngine.Parsing.Fdo;

/// <summary>What a number of a fractal file means.</summary>
public enum FractalNumberRole
{
    /// <summary>A component of a vector that no transformation uses, or that several use in different ways.</summary>
    Vector,

    /// <summary>A component of a position, scene units.</summary>
    Position,

    /// <summary>An angle in degrees.</summary>
    Rotation,

    /// <summary>A factor along an axis.</summary>
    Scale,

    /// <summary>The depth of a recursive, an integer.</summary>
    Depth,

    /// <summary>An argument of a call in a set: the number of a vector, from 1.</summary>
    Argument,

    /// <summary>A number with a name, whatever expressions make of it.</summary>
    Named,
}
