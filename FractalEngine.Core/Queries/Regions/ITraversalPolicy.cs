using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries.Regions;

/// <summary>What a <see cref="ShapeTraversal"/> looks for: which nodes count, in which order, and what happens at their faces.</summary>
internal interface ITraversalPolicy
{
    /// <summary>Number of bounds after which the traversal gives up.</summary>
    long MaxBoundTests { get; }

    /// <summary>Tells which of four boxes may hold a face that counts: all bits of their lanes are set. May err on that side.</summary>
    /// <param name="centres">The middles of the boxes in the frame of the query.</param>
    /// <param name="extents">Half their sizes.</param>
    /// <param name="slack">How far rounding may have moved what is inside.</param>
    Vector256<double> MayCountX4(VectorX4 centres, VectorX4 extents, double slack);

    /// <summary>Tells how a part of the shape lies to what is looked for.</summary>
    /// <returns>
    /// Positive infinity where no face of it counts, negative infinity where the traversal has found what it looks for. Else a number by
    /// which the children of one node are ordered: the smallest is visited first.
    /// </returns>
    double Measure(in ShapeNode node);

    /// <summary>Visits a face of an instance.</summary>
    /// <param name="face">Its index in the base mesh.</param>
    /// <param name="a">The first corner in the frame of the query.</param>
    /// <param name="b">The second corner.</param>
    /// <param name="c">The third corner.</param>
    /// <param name="leaf">The leaf that the face belongs to.</param>
    /// <param name="path">Indices of the child instances that lead to it.</param>
    /// <returns>False to end the traversal.</returns>
    bool Visit(int face, Vector a, Vector b, Vector c, in ShapeNode leaf, ReadOnlySpan<int> path);
}
