namespace FractalEngine.Core.Bvh.Boxes;

/// <summary>
/// Orders the children of a sub-fractal by their distances. Each child has a lower bound of its squared distance, and a key that is the
/// bound or orders children whose bound is 0. Bounds are first rough, and refined only for children whose turn it is.
/// </summary>
internal interface IChildQueue
{
    /// <summary>Finds the child with the smallest key of those whose bound is below a limit.</summary>
    /// <param name="cutoffSquared">Square of the limit, exclusive.</param>
    /// <param name="cutoff">The limit itself.</param>
    /// <param name="child">Index of the child; undefined where there is none.</param>
    bool TryPeek(double cutoffSquared, double cutoff, out int child);

    /// <summary>The present lower bound of a child's squared distance.</summary>
    double BoundOf(int child);

    /// <summary>True for a child whose bound does not exclude the position itself.</summary>
    bool MayContain(int child);

    /// <summary>Removes a child from the queue.</summary>
    void Remove(int child);

    /// <summary>Gives a child a better bound.</summary>
    /// <param name="child">Index of the child.</param>
    /// <param name="bound">Lower bound of its squared distance; ignored if it is smaller than before.</param>
    /// <returns>False when the bound has not grown, so that the child is still the next one.</returns>
    bool Refine(int child, double bound);
}
