using System.Collections.Immutable;
using FractalEngine.Tests.Oracles.Graphs.Models;

namespace FractalEngine.Tests.Oracles.Chance;

/// <summary>What names of a file stand for, without the names. Equal ones are the same node.</summary>
/// <param name="IsPlain">Whether there is no choice, no end by size and no call in it.</param>
/// <param name="HasSizes">Whether something in it ends by its size.</param>
internal abstract record ChanceNode(bool IsPlain, bool HasSizes)
{
    /// <summary>A place where one base mesh stands.</summary>
    internal sealed record Base(OracleMesh Mesh) : ChanceNode(true, false);

    /// <summary>An object for each of some maps.</summary>
    internal sealed record Mapped(ImmutableArray<SetMap> Maps, ChanceNode Inner) : ChanceNode(Inner.IsPlain, Inner.HasSizes);

    /// <summary>Terms at one place: each is an object under some maps.</summary>
    internal sealed record Sum(ImmutableArray<Mapped> Terms)
        : ChanceNode(Terms.All(static term => term.IsPlain), Terms.Any(static term => term.HasSizes));

    /// <summary>One of several objects, in a body of the same file or elsewhere.</summary>
    internal sealed record Choice(ImmutableArray<(double Weight, ChanceNode Node)> Alternatives, int Seed, bool IsByLevel, bool IsInBody)
        : ChanceNode(false, Alternatives.Any(static one => one.Node.HasSizes));

    /// <summary>A set on something as one thing: behind a name, as another file, or within another set.</summary>
    internal sealed record Whole(Mapped Inner) : ChanceNode(Inner.IsPlain, Inner.HasSizes);

    /// <summary>A call of a recursive in the body of one.</summary>
    internal sealed record Call(int Index) : ChanceNode(false, false);

    /// <summary>One of the recursives that are declared together, at a depth or to a size.</summary>
    internal sealed record Recursive(ChanceGroup Group, int Index, int Depth, double? Size)
        : ChanceNode(Size is null && Group.IsPlain, Size is not null || Group.HasSizes);
}
