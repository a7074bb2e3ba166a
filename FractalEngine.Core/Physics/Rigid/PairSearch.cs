namespace FractalEngine.Core.Physics.Rigid;

/// <summary>What searches of two surfaces share: the surfaces, where they are and how they move, and the cost.</summary>
internal abstract class PairSearch
{
    private SurfaceMotion _motion1;
    private SurfaceMotion _motion2;

    /// <summary>Number of pairs of boxes that have been tested.</summary>
    public long BoundTests { get; protected set; }

    /// <summary>Number of pairs of triangles whose closest points have been computed.</summary>
    public long FaceTests { get; protected set; }

    /// <summary>The first surface of the pair.</summary>
    protected SurfaceNodes First { get; private set; } = null!;

    /// <summary>The second surface of the pair.</summary>
    protected SurfaceNodes Second { get; private set; } = null!;

    /// <summary>Motion of the first surface.</summary>
    protected ref readonly SurfaceMotion Motion1 => ref _motion1;

    /// <summary>Motion of the second surface, in the same frame.</summary>
    protected ref readonly SurfaceMotion Motion2 => ref _motion2;

    /// <summary>Sets the two surfaces of the next search.</summary>
    protected void SetPair(SurfaceNodes first, in SurfaceMotion motion1, SurfaceNodes second, in SurfaceMotion motion2)
    {
        First = first;
        Second = second;
        _motion1 = motion1;
        _motion2 = motion2;
    }

    /// <summary>Opens the larger part of a pair, of which at least one is no leaf.</summary>
    /// <param name="node1">The first surface's part.</param>
    /// <param name="node2">The second surface's part.</param>
    /// <param name="opensFirst">Receives whose parts are returned.</param>
    protected Range OpenLarger(int node1, int node2, out bool opensFirst)
    {
        opensFirst = !First.IsLeaf(node1) && (Second.IsLeaf(node2)
            || _motion1.Scale * First[node1].Radius >= _motion2.Scale * Second[node2].Radius);
        return opensFirst ? First.Children(node1) : Second.Children(node2);
    }
}
