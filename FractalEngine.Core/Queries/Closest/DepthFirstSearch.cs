using FractalEngine.Core.Bvh.Boxes;
using FractalEngine.Core.Fractals.Levels;

namespace FractalEngine.Core.Queries.Closest;

/// <summary>
/// Searches a fractal depth first: each sub-fractal's children are visited by ascending lower bounds, and culled where the bound is beyond
/// the closest triangle so far.
/// </summary>
/// <typeparam name="TFrame">How bounds and positions are compared; a struct, so that the search is compiled for it.</typeparam>
/// <typeparam name="TBaseMeshes">One base mesh or several; a struct for the same reason.</typeparam>
/// <param name="hierarchy">The sub-fractals.</param>
/// <param name="baseMeshes">The base meshes.</param>
/// <param name="expandedLevels">The levels that are searched as meshes.</param>
internal sealed class DepthFirstSearch<TFrame, TBaseMeshes>(
    FractalHierarchy hierarchy, TBaseMeshes baseMeshes, ExpandedLevels expandedLevels) : IDepthFirstSearch<TFrame>
    where TFrame : struct, ISearchFrame<TFrame>
    where TBaseMeshes : struct, IBaseMeshes
{
    private const int MaxUrgentLevels = 12;

    // To test all triangles of a smaller base costs no more than to test its hull.
    private const int MaxFacesWithoutHull = 8;

    // From here on, no sub-fractal is searched as a mesh.
    private readonly long _meshLevels = expandedLevels.Count;
    private readonly TBaseMeshes _baseMeshes = baseMeshes;

    /// <inheritdoc/>
    public void Run(TFrame frame, ref FractalSearchState search) => Visit(hierarchy.Root, hierarchy.Start, ref frame, 0, 0, ref search);

    /// <summary>Searches a sub-fractal and its children.</summary>
    /// <param name="subFractal">The sub-fractal.</param>
    /// <param name="state">Its place.</param>
    /// <param name="frame">Its frame, which stays as it is; an <c>in</c> parameter would be copied by each call of the interface.</param>
    /// <param name="depth">Number of child instances that lead to it.</param>
    /// <param name="offset">Where free scratch memory begins.</param>
    /// <param name="search">The state of the search.</param>
    private void Visit(
        SubFractal subFractal, LevelState state, ref TFrame frame, int depth, int offset, ref FractalSearchState search)
    {
        var remainingLevels = state.Level;
        if (remainingLevels < _meshLevels && expandedLevels.At(remainingLevels) is { } expanded)
        {
            frame.TestTriangles(expanded.Bvh, expanded, depth, ref search);
            return;
        }

        if (remainingLevels < _baseMeshes.Count || frame.RadiusSquared(subFractal) <= search.MinRadiusSquared)
        {
            frame.TestTriangles(_baseMeshes.At(subFractal.BaseIndex), null, depth, ref search);
            return;
        }

        if (!search.WithinBudget(depth))
        {
            return;
        }

        search.VisitedSubFractals++;

        var cutoffSquared = frame.ChildCutoffSquared(in search);
        if (frame.IsNear(subFractal))
        {
            var lanes = subFractal.ChildBoundsX8!;
            var position = frame.LocalPosition;
            var queue = new FloatChildQueue(search.ScratchSlice(offset, lanes.PaddedCount), lanes.DistanceError(position));
            lanes.FillQueue(hierarchy, remainingLevels, position, cutoffSquared, in queue);
            search.BoundTests += subFractal.Children.Length;
            // Outside all children, their hulls have better bounds than lanes compute.
            var refined = lanes.IsComplete && !search.NeedsTightBounds && subFractal.IsWithinRadii(position, 1) ? ulong.MaxValue : 0;
            VisitChildren(subFractal, state, ref frame, depth, offset + lanes.PaddedCount, queue, refined, ref search);
        }
        else
        {
            var length = ChildQueue.ValuesPerChild * subFractal.PaddedCount;
            var queue = new ChildQueue(search.ScratchSlice(offset, length));
            frame.FillQueue(subFractal, in queue, ref search);
            var refined = 0UL;
            if (subFractal.Clusters is not null)
            {
                RefineAll(subFractal, state, ref frame, in queue, cutoffSquared, ref search);
                refined = ulong.MaxValue;
            }

            VisitChildren(subFractal, state, ref frame, depth, offset + length, queue, refined, ref search);
        }
    }

    /// <summary>Searches the children in a queue.</summary>
    /// <typeparam name="TQueue">The kind of queue; a struct, so that the search is compiled for it.</typeparam>
    /// <param name="subFractal">The sub-fractal.</param>
    /// <param name="state">Its place.</param>
    /// <param name="frame">Its frame.</param>
    /// <param name="depth">Number of child instances that lead to it.</param>
    /// <param name="offset">Where free scratch memory begins.</param>
    /// <param name="queue">The children with their bounds.</param>
    /// <param name="refined">One bit for each child whose bound is the best there is.</param>
    /// <param name="search">The state of the search.</param>
    private void VisitChildren<TQueue>(
        SubFractal subFractal, LevelState state, ref TFrame frame, int depth, int offset, TQueue queue, ulong refined,
        ref FractalSearchState search)
        where TQueue : struct, IChildQueue, allows ref struct
    {
        var children = subFractal.Children;
        var cutoffSquared = frame.ChildCutoffSquared(in search);
        var cutoff = frame.ChildCutoff(in search);
        var hasNext = queue.TryPeek(cutoffSquared, cutoff, out var closestChild);
        while (hasNext)
        {
            var child = children[closestChild];
            var childState = hierarchy.Enter(child, in state);
            var childLevels = childState.Level;
            var childSubFractal = hierarchy.At(child, childLevels);
            if (hierarchy.HasPicks && childSubFractal.Box.IsEmpty)
            {
                queue.Remove(closestChild);
                hasNext = queue.TryPeek(cutoffSquared, cutoff, out closestChild);
                continue;
            }

            var childFrame = frame.Enter(child);
            var isSmallBase = childLevels < _baseMeshes.Count && _baseMeshes.MaxFaceCount <= MaxFacesWithoutHull;
            // While nothing excludes any child, one around the position is visited as it is; but not from far above the faces.
            var isUrgent = childLevels < MaxUrgentLevels && !(cutoffSquared < double.PositiveInfinity) && queue.MayContain(closestChild);
            if ((refined & (1UL << closestChild)) == 0
                && frame.CanRefine(subFractal, childSubFractal, isSmallBase, isUrgent, in search))
            {
                // The child's own bounds are tighter than the box around its image. Only children that seem closest are refined.
                var refinedBound = frame.RefinedBoundSquared(
                    subFractal, child, childSubFractal, ref childFrame, cutoffSquared, ref search);
                refined |= 1UL << closestChild;
                if (queue.Refine(closestChild, refinedBound))
                {
                    hasNext = queue.TryPeek(cutoffSquared, cutoff, out var next);
                    if (!hasNext || next != closestChild)
                    {
                        closestChild = next;
                        continue;
                    }
                }
            }

            queue.Remove(closestChild);
            search.RecordChild(depth, closestChild);
            Visit(childSubFractal, childState, ref childFrame, depth + 1, offset, ref search);
            cutoffSquared = frame.ChildCutoffSquared(in search);
            cutoff = frame.ChildCutoff(in search);
            hasNext = queue.TryPeek(cutoffSquared, cutoff, out closestChild);
        }
    }

    /// <summary>Refines all children, where their boxes are nearly empty and tell nothing of their order.</summary>
    private void RefineAll(
        SubFractal subFractal, LevelState state, ref TFrame frame, in ChildQueue queue, double cutoffSquared,
        ref FractalSearchState search)
    {
        for (var i = 0; i < subFractal.Children.Length; i++)
        {
            if (!(queue.BoundOf(i) < cutoffSquared))
            {
                continue;
            }

            var child = subFractal.Children[i];
            var childFrame = frame.Enter(child);
            var childSubFractal = hierarchy.At(child, hierarchy.Enter(child, in state).Level);
            queue.Refine(i, childSubFractal.Box.IsEmpty ? double.PositiveInfinity
                : frame.RefinedBoundSquared(subFractal, child, childSubFractal, ref childFrame, cutoffSquared, ref search));
        }
    }
}
