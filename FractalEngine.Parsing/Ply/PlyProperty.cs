namespace FractalEngine.Parsing.Ply;

/// <summary>A property that each element of a list in a PLY file has: one number, or a list of them.</summary>
/// <param name="Name">Name as written.</param>
/// <param name="Type">Type of its numbers.</param>
/// <param name="CountType">Type of the length before a list; null for one number.</param>
internal sealed record PlyProperty(string Name, PlyType Type, PlyType? CountType)
{
    /// <summary>Whether the property is a list of numbers.</summary>
    public bool IsList => CountType is not null;
}
