using System.Collections.Immutable;
using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Fractals;

/// <summary>
/// A transformation function: vectors in, a transformation out. Each output is already resolved to a function of the
/// arguments, so that calling it needs no names.
/// </summary>
/// <param name="ParameterCount">0 to 3.</param>
/// <param name="Position">From the arguments.</param>
/// <param name="Rotation">From the arguments.</param>
/// <param name="Scale">From the arguments.</param>
internal sealed record TransformationFunction(
    int ParameterCount,
    Func<ImmutableArray<Vector>, Vector> Position,
    Func<ImmutableArray<Vector>, Vector> Rotation,
    Func<ImmutableArray<Vector>, Vector> Scale)
{
    /// <summary>The transformation for the given arguments, one a parameter.</summary>
    public Transformation Apply(ImmutableArray<Vector> arguments) =>
        new(Position(arguments), Rotation(arguments), Scale(arguments));
}
