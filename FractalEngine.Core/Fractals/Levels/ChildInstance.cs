using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>
/// An instance of a sub-fractal inside another one, reached by one map after another. All sub-fractals with the same child share it.
/// </summary>
internal sealed class ChildInstance
{
    private static readonly ChildEdge[] ToGroup = [ChildEdge.ToGroup];

    private readonly SimdAffineMap _inverseSimdMap;
    private readonly ChildEdge[] _edges;
    private readonly int _firstEdge;
    private readonly int _edgeCount;

    // Those of the set where there is one edge: wide sets take much memory.
    private readonly AffineMap[] _maps;
    private readonly int _mapIndex;

    /// <summary>Composes an instance from edges.</summary>
    /// <param name="edges">At least one edge, the outermost first.</param>
    public ChildInstance(ChildEdge[] edges)
        : this(edges, 0, edges.Length)
    {
    }

    /// <summary>Composes an instance from a part of an array of edges, which the children of a wide level share.</summary>
    /// <param name="edges">Has the edges.</param>
    /// <param name="firstEdge">Index of the outermost edge.</param>
    /// <param name="edgeCount">Number of edges, at least one.</param>
    public ChildInstance(ChildEdge[] edges, int firstEdge, int edgeCount)
    {
        _edges = edges;
        _firstEdge = firstEdge;
        _edgeCount = edgeCount;
        var map = AffineMap.Identity;
        var inverse = AffineMap.Identity;
        ScaleSquared = 1;
        var areMapsOfLevels = true;
        foreach (var (set, mapIndex, levelStep) in Edges)
        {
            map *= set.Maps[mapIndex];
            inverse = set.Maps[mapIndex].Inverse() * inverse;
            ScaleSquared *= set.ScalesSquared[mapIndex];
            LevelStep = LevelStep.Then(levelStep);
            areMapsOfLevels &= set.IsOfCalls || (levelStep == LevelStep.Down(1) && set.Power is null && set != MapSet.Identity);
        }

        HasMapsOfLevels = areMapsOfLevels;
        InverseScaleSquared = 1 / ScaleSquared;
        InverseScale = Math.Sqrt(InverseScaleSquared);
        (_maps, _mapIndex) = edgeCount > 1 ? ([map], 0) : (Edges[0].Set.Maps, Edges[0].MapIndex);
        _inverseSimdMap = new(inverse);
    }

    private ChildInstance(SubFractal group)
        : this(ToGroup)
    {
        Group = group;
    }

    /// <summary>
    /// The children of one sub-fractal that this one stands for, in the same frame; null where it is an instance of a sub-fractal. Wide
    /// sets are grouped, so that a search tests few bounds of each.
    /// </summary>
    public SubFractal? Group { get; }

    /// <summary>Creates a child that stands for a group of children.</summary>
    public static ChildInstance Of(SubFractal group) => new(group);

    /// <summary>The edges, the outermost first.</summary>
    public ReadOnlySpan<ChildEdge> Edges => new(_edges, _firstEdge, _edgeCount);

    /// <summary>Whether each edge goes down by a map of its level's set, and skips no level with an identity.</summary>
    public bool HasMapsOfLevels { get; }

    /// <summary>The map from the child's frame to that of the parent.</summary>
    public ref readonly AffineMap Map => ref _maps[_mapIndex];

    /// <summary>The map from the parent's frame to that of the child, for kernels.</summary>
    public ref readonly SimdAffineMap InverseSimdMap => ref _inverseSimdMap;

    /// <summary>Square of the factor by which the map lengthens vectors; meaningful for similarities only.</summary>
    public double ScaleSquared { get; }

    /// <summary>Square of the factor by which the inverse map lengthens vectors; meaningful for similarities only.</summary>
    public double InverseScaleSquared { get; }

    /// <summary>The factor by which the inverse map lengthens vectors; meaningful for similarities only.</summary>
    public double InverseScale { get; }

    /// <summary>Upper bound of the factor by which the map lengthens vectors.</summary>
    public double OperatorNormBound
    {
        get
        {
            var bound = 1.0;
            foreach (var edge in Edges)
            {
                bound *= edge.OperatorNormBound;
            }

            return bound;
        }
    }

    /// <summary>Leads from the remaining levels of the parent to those of the child.</summary>
    public LevelStep LevelStep { get; }

    /// <summary>Number of bytes of the maps and edges.</summary>
    public long StorageBytes => (29 * sizeof(double)) + (_edgeCount > 1 ? 15 * sizeof(double) : 0) + (24 * _edgeCount);

    /// <summary>Computes the remaining levels of the child.</summary>
    /// <param name="parentLevels">Remaining levels of the parent.</param>
    public long RemainingLevels(long parentLevels) => LevelStep.RemainingLevels(parentLevels);
}
