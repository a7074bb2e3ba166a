using System.Collections.Immutable;

namespace FractalEngine.Tests.Oracles.Graphs.Models;

/// <summary>An expression for an object.</summary>
internal abstract record ObjectTerm
{
    /// <summary>The file of a mesh.</summary>
    internal sealed record Mesh(OracleMesh Value) : ObjectTerm;

    /// <summary>The result of another file.</summary>
    internal sealed record File(GraphFile Value) : ObjectTerm;

    /// <summary>An object that is declared above, a shape, or a recursive call.</summary>
    internal sealed record Named(string Name) : ObjectTerm;

    /// <summary>A recursive at a depth; null for the infinite one.</summary>
    internal sealed record AtDepth(string Name, int? Depth) : ObjectTerm;

    /// <summary>A recursive that ends by its size.</summary>
    internal sealed record Until(string Name, double Size) : ObjectTerm;

    /// <summary>One of several objects by chance, each with its weight.</summary>
    internal sealed record Choice(ImmutableArray<(double Weight, ObjectTerm Term)> Alternatives) : ObjectTerm;

    /// <summary>An object for each map of a set.</summary>
    internal sealed record Mapped(ImmutableArray<MapProduct> Set, ObjectTerm Term) : ObjectTerm;

    /// <summary>Several objects at one place.</summary>
    internal sealed record Sum(ImmutableArray<ObjectTerm> Terms) : ObjectTerm;
}
