using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Oracles.Graphs.Models;

/// <summary>A map as a file declares it, without powers and products.</summary>
internal abstract record MapLeaf
{
    /// <summary>The map that a set writes as #.</summary>
    internal sealed record Identity : MapLeaf;

    /// <summary>A scale, then a rotation in degrees, then a translation; null for each that is written as #.</summary>
    internal sealed record Placement(Vector? Position, Vector? Rotation, Vector? Scale) : MapLeaf;

    /// <summary>The images of the axes, and that of the origin.</summary>
    internal sealed record Columns(Vector X, Vector Y, Vector Z, Vector Origin) : MapLeaf;
}
