using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Queries.Regions;

namespace FractalEngine.Tests.Fractals.Levels.Building;

/// <summary>A chain of calls from a recursive down, without any hierarchy.</summary>
/// <param name="Recursive">Index of the recursive that it leads to.</param>
/// <param name="Levels">Number of levels of that one; 0 or less for a base mesh.</param>
/// <param name="Map">From its frame to that of the whole.</param>
/// <param name="Reach">The largest absolute coordinate of a frame's origin on the way.</param>
internal readonly record struct RecursiveChain(int Recursive, long Levels, AffineMap Map, double Reach)
{
    /// <summary>Makes the chain of a recursive itself, before any call.</summary>
    public static RecursiveChain Begin(int root, long levels) => new(root, levels, AffineMap.Identity, 0);

    /// <summary>Makes the chain that one more call leads to.</summary>
    public RecursiveChain Call(FractalRecursive[] recursives, int index)
    {
        var call = recursives[Recursive].Calls[index];
        var map = Map * call.Map;
        return new(call.Target, Levels - call.LevelsLess!.Value, map, Math.Max(Reach, map.Translation.MaxAbsComponent()));
    }

    /// <summary>Makes the chain that a path of calls leads to.</summary>
    public RecursiveChain Follow(FractalRecursive[] recursives, IEnumerable<int> path) =>
        path.Aggregate(this, (chain, index) => chain.Call(recursives, index));

    /// <summary>A face of a mesh at the end.</summary>
    public ExpandedTriangle Triangle(Mesh mesh, int face)
    {
        var (a, b, c) = mesh.Face(face);
        var size = Vector.Max(a.Absolute(), Vector.Max(b.Absolute(), c.Absolute()));
        var reach = (Map.Linear.Absolute() * size).MaxAbsComponent() + Map.Translation.MaxAbsComponent();
        return new(face, Map * a, Map * b, Map * c, Math.Max(Reach, reach));
    }
}
