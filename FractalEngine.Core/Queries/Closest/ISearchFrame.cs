using System.Runtime.Intrinsics;
using FractalEngine.Core.Bvh;
using FractalEngine.Core.Bvh.Boxes;
using FractalEngine.Core.Fractals.Levels;

namespace FractalEngine.Core.Queries.Closest;

/// <summary>
/// How a <see cref="DepthFirstSearch{TFrame, TBaseMeshes}"/> relates the sub-fractal it is in to the position of the query.
/// </summary>
/// <typeparam name="TSelf">The type that implements the interface.</typeparam>
internal interface ISearchFrame<TSelf>
    where TSelf : struct, ISearchFrame<TSelf>
{
    /// <summary>Computes the squared radius of a sub-fractal in the frame of the query, or an upper bound of it.</summary>
    double RadiusSquared(SubFractal subFractal);

    /// <summary>Computes the limit for squared bounds of children, in the units of this frame's bounds.</summary>
    double ChildCutoffSquared(in FractalSearchState search);

    /// <summary>Computes the limit for bounds of children, not squared.</summary>
    double ChildCutoff(in FractalSearchState search);

    /// <summary>The position of the query in the frame of the sub-fractal: x, y, z, 0.</summary>
    Vector256<double> LocalPosition { get; }

    /// <summary>True where floats tell the children of a sub-fractal apart, so that it has lanes to search.</summary>
    bool IsNear(SubFractal subFractal);

    /// <summary>Sets rough bounds for all children of a sub-fractal.</summary>
    /// <param name="subFractal">The sub-fractal of this frame.</param>
    /// <param name="queue">Receives the bounds.</param>
    /// <param name="search">Receives the cost.</param>
    void FillQueue(SubFractal subFractal, in ChildQueue queue, ref FractalSearchState search);

    /// <summary>Computes the frame of a child.</summary>
    TSelf Enter(ChildInstance child);

    /// <summary>Tells whether the child's own bounds are worth their cost.</summary>
    /// <param name="parent">The sub-fractal of this frame.</param>
    /// <param name="childSubFractal">The sub-fractal of the child.</param>
    /// <param name="isSmallBase">True for a child that is a base mesh of so few triangles that a hull costs as much.</param>
    /// <param name="isUrgent">True while nothing excludes a child that is around the position.</param>
    /// <param name="search">The state of the search.</param>
    bool CanRefine(
        SubFractal parent, SubFractal childSubFractal, bool isSmallBase, bool isUrgent, in FractalSearchState search);

    /// <summary>Computes the best bound of a child there is: from the child's own box and hull.</summary>
    /// <param name="parent">The sub-fractal of this frame.</param>
    /// <param name="child">The child instance.</param>
    /// <param name="childSubFractal">The sub-fractal of the child.</param>
    /// <param name="childFrame">The frame of the child.</param>
    /// <param name="cutoffSquared">The method may return early at this value.</param>
    /// <param name="search">Receives the cost.</param>
    double RefinedBoundSquared(
        SubFractal parent, ChildInstance child, SubFractal childSubFractal, ref TSelf childFrame, double cutoffSquared,
        ref FractalSearchState search);

    /// <summary>Searches the base mesh, or that of an expanded sub-fractal, in this frame.</summary>
    /// <param name="bvh">The hierarchy of the mesh.</param>
    /// <param name="expanded">The sub-fractal that the mesh is; null for the base mesh.</param>
    /// <param name="depth">Number of child instances that lead to this frame.</param>
    /// <param name="search">Receives the closest triangle and the cost.</param>
    void TestTriangles(TriangleBvh bvh, ExpandedSubFractal? expanded, int depth, ref FractalSearchState search);
}
