using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Graphs;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Tests.Fractals.Levels.Building;

/// <summary>Recursives that call each other, and the base meshes that they refer to.</summary>
internal sealed record RecursiveSystem(Mesh[] Meshes, FractalRecursive[] Recursives)
{
    public Mesh BaseMeshOf(int recursive) => Meshes[Recursives[recursive].BasePart];

    public FractalGraph GraphOf(int root, int? levels) => new([.. Meshes], [new RecursivePart([.. Recursives], root, levels)]);
}
