using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Approximation.Grammars;

/// <summary>A mesh as what makes it: steps of sets of maps, around a tree or around a base mesh.</summary>
/// <param name="Steps">The steps, outermost first; possibly none.</param>
/// <param name="Tree">What the steps are applied to: a tree with the base at each of its parts; null for the base itself.</param>
/// <param name="Base">The base mesh.</param>
/// <param name="Leaf">The mesh at the ends of the tree's last level; null for none.</param>
public sealed record MeshGrammar(IReadOnlyList<GrammarStep> Steps, MapTree? Tree, Mesh Base, Mesh? Leaf)
{
    /// <summary>Number of faces that are left: those of the base meshes.</summary>
    public int FaceCount => Base.FaceCount + (Leaf?.FaceCount ?? 0);

    /// <summary>Number of maps of all sets and of the tree, the identity among them.</summary>
    public int MapCount => Steps.Sum(step => step.Sets.Sum(set => set.Count)) + (Tree?.Maps.Count ?? 0);
}
