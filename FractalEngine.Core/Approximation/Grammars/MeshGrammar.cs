using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Approximation.Grammars;

/// <summary>A mesh as what makes it: steps of sets of maps, around a tree or around a base mesh.</summary>
/// <param name="Steps">The steps, outermost first; possibly none.</param>
/// <param name="Tree">What the steps are applied to: a tree with the base at each of its parts; null for the base itself.</param>
/// <param name="Base">The base mesh.</param>
/// <param name="Leaf">The mesh at the ends of the tree's last level; null for none.</param>
public sealed record MeshGrammar(IReadOnlyList<GrammarStep> Steps, MapTree? Tree, Mesh Base, Mesh? Leaf);
