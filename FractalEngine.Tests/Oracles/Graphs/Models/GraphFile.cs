using System.Collections.Immutable;

namespace FractalEngine.Tests.Oracles.Graphs.Models;

/// <summary>A file of the model: declarations in their order, and the result.</summary>
/// <param name="Path">Path from the folder of the model, with slashes.</param>
/// <param name="Declarations">All declarations of objects; those of maps and vectors follow from their uses.</param>
/// <param name="Result">What the file stands for.</param>
internal sealed record GraphFile(string Path, ImmutableArray<GraphDeclaration> Declarations, ObjectTerm Result)
{
    /// <summary>Finds what declares a name; null for a shape.</summary>
    public GraphDeclaration? Find(string name) => Declarations.FirstOrDefault(declaration => declaration.Names.Contains(name));
}
