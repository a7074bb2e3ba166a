using System.Collections.Immutable;

namespace FractalEngine.Tests.Oracles.Graphs.Models;

/// <summary>A declaration of a file that names objects.</summary>
internal abstract record GraphDeclaration
{
    /// <summary>A name for an object.</summary>
    internal sealed record Alias(string Name, ObjectTerm Body) : GraphDeclaration;

    /// <summary>Recursives that call each other.</summary>
    internal sealed record Group(ImmutableArray<Recursive> Recursives) : GraphDeclaration;

    /// <summary>A recursive: the object of its base at depth 0, and otherwise its body.</summary>
    internal sealed record Recursive(string Name, string Base, ObjectTerm Body);

    /// <summary>The seed of the choices below, up to the next one.</summary>
    internal sealed record Seed(int Value, bool IsByLevel) : GraphDeclaration;

    /// <summary>All names that the declaration makes.</summary>
    public IEnumerable<string> Names => this switch
    {
        Alias alias => [alias.Name],
        Group group => group.Recursives.Select(static recursive => recursive.Name),
        _ => [],
    };
}
