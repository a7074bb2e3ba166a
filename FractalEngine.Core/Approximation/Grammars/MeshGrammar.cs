using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Approximation.Grammars;

/// <summary>A mesh as what makes it: steps of sets of maps, around a tree or a base mesh, and around parts.</summary>
/// <param name="Steps">The steps, outermost first; possibly none.</param>
/// <param name="Tree">What the steps are applied to: a tree with the base at each of its parts; null for the base itself.</param>
/// <param name="Base">The base mesh; empty where the parts are all.</param>
/// <param name="Leaf">The mesh at the ends of the tree's last level; null for none.</param>
public sealed record MeshGrammar(IReadOnlyList<GrammarStep> Steps, MapTree? Tree, Mesh Base, Mesh? Leaf)
{
    private const double ClearShare = 0.1;

    // Maps for each image of the base.
    private const double ClearMaps = 0.5;

    /// <summary>What else the steps are applied to, beside the tree or the base; possibly none.</summary>
    public IReadOnlyList<MeshGrammar> Parts { get; init; } = [];

    /// <summary>Number of faces that are left: of all base meshes and leaves.</summary>
    public int FaceCount => Base.FaceCount + (Leaf?.FaceCount ?? 0) + Parts.Sum(part => part.FaceCount);

    /// <summary>Number of maps of all sets and trees; powers of one map count once.</summary>
    public int MapCount => Steps.Sum(step => step.Sets.Sum(MapRows.CountMaps)) + (Tree?.Maps.Count ?? 0) + Parts.Sum(part => part.MapCount);

    /// <summary>Whether a tree or a step with several levels is in it, so that it is more than rows and sets.</summary>
    public bool IsRecursive => Tree is not null || Steps.Any(step => step.Depth > 1) || Parts.Any(part => part.IsRecursive);

    /// <summary>Whether so few faces and maps are left that they are more than a list of what a mesh consists of.</summary>
    /// <param name="faceCount">Number of faces of the mesh.</param>
    public bool ExplainsMost(int faceCount) =>
        FaceCount <= ClearShare * faceCount && FaceCount * (MapCount + 1L) <= ClearMaps * faceCount;
}
