using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>What a <see cref="ShapeWalk"/> looks for.</summary>
internal interface IShapeVisitor
{
    /// <summary>Number of bounds after which the walk gives up.</summary>
    long MaxBoundTests { get; }

    /// <summary>Tells how a part of the shape lies to what is looked for.</summary>
    /// <returns>
    /// Positive infinity where no face of it counts, negative infinity where the walk has found what it looks for. Else a number by
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
    /// <returns>False to end the walk.</returns>
    bool Visit(int face, Vector a, Vector b, Vector c, in ShapeNode leaf, ReadOnlySpan<int> path);
}
