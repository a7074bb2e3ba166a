using System.Runtime.CompilerServices;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Core.Visibility;

/// <summary>
/// Culls the objects of one strip of a frame: traverses the hierarchy of each object from the root, front to back, and emits the
/// visible instances.
/// </summary>
/// <remarks>
/// Sub-fractals outside the frustum and hidden ones are skipped; those that appear small become one proxy instance. The culler owns only
/// memory that is reused; all parameters of a run are in a <see cref="StripContext"/>.
/// </remarks>
internal sealed class StripCuller
{
    // A sub-fractal at this depth becomes a proxy, since its levels hardly shrink.
    private const int MaxDepth = 1000;

    // A sub-fractal also becomes a proxy when its children would be smaller than this fraction of the minimum size.
    private const double MinChildSizeRatio = 0.5;

    // The rule for small children holds up to this multiple of the minimum size: children that are tiny beside the gaps between them are
    // no solid.
    private const double MaxProxySizeRatio = 3;

    private readonly OccluderRasterizer _rasterizer = new();
    private readonly ChildFootprints _footprints = new();
    private readonly List<int> _candidates = [];
    private readonly SkyPath _skyPath = new();

    /// <summary>Finds the visible instances of all objects.</summary>
    /// <param name="frame">Parameters of the strip.</param>
    /// <param name="objects">Objects of the scene.</param>
    /// <param name="order">Indices of the objects, the closest first: close objects occlude others.</param>
    /// <param name="ranks">Position of each object in that order.</param>
    /// <param name="bvh">
    /// Tells with frustum culling which of the objects, none with roots, may be visible; null to test each of them.
    /// </param>
    /// <param name="output">Receives the instances and statistics.</param>
    /// <remarks>The output is that of a run without the hierarchy: objects that it skips count as tested.</remarks>
    public void Cull(
        in StripFrame frame, IReadOnlyList<CulledObject> objects, ReadOnlySpan<int> order, ReadOnlySpan<int> ranks, CulledObjectBvh? bvh,
        StripOutput output)
    {
        output.Clear();
        _rasterizer.Clear(in frame);
        _candidates.Clear();
        if (bvh is null)
        {
            for (var rank = 0; rank < order.Length; rank++)
            {
                _candidates.Add(rank);
            }
        }
        else if (frame.Left < frame.Right)
        {
            bvh.CollectCandidates(in frame, ranks, _candidates);
        }

        var nextRank = 0;
        foreach (var rank in _candidates)
        {
            Skip(in frame, objects, order[nextRank..rank], output);
            CullObject(new StripContext(in frame, objects[order[rank]], output), objects[order[rank]]);
            output.EndObject();
            nextRank = rank + 1;
        }

        Skip(in frame, objects, order[nextRank..], output);
    }

    /// <summary>Ends the results of objects outside the frustum, which are counted as if they had been tested.</summary>
    private static void Skip(
        in StripFrame frame, IReadOnlyList<CulledObject> objects, ReadOnlySpan<int> skipped, StripOutput output)
    {
        foreach (var index in skipped)
        {
            var hierarchy = objects[index].Hierarchy;
            if (frame.Left < frame.Right && !hierarchy.NodeAt(hierarchy.LevelCount).IsEmpty)
            {
                output.Statistics.VisitedNodes++;
                output.Statistics.OutsideFrustum++;
            }

            output.EndObject();
        }
    }

    private void CullObject(in StripContext context, CulledObject item)
    {
        ref readonly var frame = ref context.Frame;
        _footprints.Clear();
        var worldToView = frame.Axes.Inverse();
        if (item.Roots is not { } roots)
        {
            var objectToView =
                new AffineMap(worldToView * item.ObjectToWorld.Linear, worldToView * (item.ObjectToWorld.Translation - frame.Position));
            VisitRoot(
                ContextOf(in context, item, objectToView, AffineMap.Identity), item.Hierarchy.Start, objectToView, CullingPath.Start);
            return;
        }

        for (var i = 0; i < roots.Length; i++)
        {
            var frameToCamera = roots[i].FrameToCamera;
            var rootToView = new AffineMap(worldToView * frameToCamera.Linear, worldToView * frameToCamera.Translation);
            VisitRoot(
                ContextOf(in context, item, rootToView, roots[i].FrameToFractal), roots[i].State, rootToView,
                CullingPath.FromRoot(i, roots[i].ColourPath, roots[i].Tint));
        }
    }

    /// <summary>The context of a root, which knows places in the fractal where colours depend on them.</summary>
    private static StripContext ContextOf(in StripContext context, CulledObject item, AffineMap rootToView, AffineMap rootToFractal) =>
        item.Shading is { NeedsPlaces: true }
            ? new(in context.Frame, item, context.Output, new(rootToFractal * rootToView.Inverse())) : context;

    private void VisitRoot(in StripContext context, LevelState state, AffineMap rootToView, CullingPath path)
    {
        ref readonly var frame = ref context.Frame;
        var root = new LodInstance(context.Hierarchy.NodeAt(state.Level), state, new SimdAffineMap(rootToView), 0, path);
        // Some strips of a frame of less than eight columns have none.
        if (root.Node.IsEmpty || frame.Left >= frame.Right)
        {
            return;
        }

        context.Output.Statistics.VisitedNodes++;
        VisitExact(in context, in root);
    }

    /// <summary>Visits a sub-fractal after projecting its box in double precision.</summary>
    private void VisitExact(in StripContext context, in LodInstance instance)
    {
        var footprint = context.Frame.ProjectBox(
            instance.NodeToView.Apply(instance.Node.Centre), instance.NodeToView.TransformHalfSize(instance.Node.HalfSize));
        if (!TryCull(in context, in footprint))
        {
            Visit(in context, in instance, in footprint);
        }
    }

    /// <summary>Visits a sub-fractal whose footprint was not culled, unless it is cut away.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private void Visit(in StripContext context, in LodInstance instance, in ScreenFootprint footprint)
    {
        ref readonly var frame = ref context.Frame;
        if (!frame.HasSection)
        {
            VisitKept(in context, in instance, in footprint);
            return;
        }

        var side = frame.SideOf(
            instance.NodeToView.Apply(instance.Node.Centre), instance.NodeToView.TransformHalfSize(instance.Node.HalfSize));
        if (side == SectionSide.CutAway)
        {
            context.Output.Statistics.CutAway++;
            return;
        }

        VisitKept(in context, in instance, footprint with { IsSectioned = side == SectionSide.Cut });
    }

    /// <summary>Draws a sub-fractal, or visits its children.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private void VisitKept(in StripContext context, in LodInstance instance, in ScreenFootprint footprint)
    {
        if (!IsWithinBudget(in context))
        {
            context.Output.IsOverBudget = true;
            return;
        }

        if (instance.Node.ChildMaps.Length == 0)
        {
            Emit(in context, in instance, in footprint);
        }
        else if (instance.Depth >= MaxDepth || IsSmall(footprint.ProjectedSize, instance.Node, context.Frame.MinProjectedSize))
        {
            context.Output.Statistics.Proxies++;
            Emit(in context, in instance, in footprint);
        }
        else
        {
            VisitChildren(in context, in instance);
        }
    }

    private static bool IsWithinBudget(in StripContext context)
    {
        var output = context.Output;
        return !output.IsOverBudget && output.Statistics.VisitedNodes <= context.Frame.MaxNodes
            && output.InstanceCount <= context.Frame.InstanceBudget;
    }

    private static bool IsSmall(double projectedSize, LodNode node, double minProjectedSize) =>
        !(projectedSize > minProjectedSize)
        || (projectedSize <= MaxProxySizeRatio * minProjectedSize
            && projectedSize * node.MaxChildSizeRatio <= MinChildSizeRatio * minProjectedSize);

    /// <summary>Tests whether a footprint can be skipped, and counts it in the statistics if so.</summary>
    private bool TryCull(in StripContext context, in ScreenFootprint footprint)
    {
        ref var statistics = ref context.Output.Statistics;
        if (footprint.IsOutside)
        {
            statistics.OutsideFrustum++;
            return true;
        }

        if (!context.Frame.HasOcclusionCulling || !footprint.IsBeyondNearPlane)
        {
            return false;
        }

        if (footprint.CoversNoSample)
        {
            statistics.ZeroCoverage++;
            return true;
        }

        if (_rasterizer.IsOccluded(in footprint))
        {
            statistics.Occluded++;
            return true;
        }

        return false;
    }

    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private void VisitChildren(in StripContext context, in LodInstance parent)
    {
        var childCount = parent.Node.ChildMaps.Length;
        context.Output.Statistics.VisitedNodes += childCount;
        var start = _footprints.Push(in context.Frame, parent.Node, in parent.NodeToView);
        for (var rank = 0; rank < childCount; rank++)
        {
            var child = _footprints.ChildAt(start, rank);
            var footprint = _footprints.Read(in context.Frame, start, child);
            if (!footprint.NeedsDouble && TryCull(in context, in footprint))
            {
                continue;
            }

            var instance = Descend(in context, in parent, child);
            while (instance.Node.ChildMaps.Length == 1 && instance.Depth < MaxDepth)
            {
                // An only child fills its parent, so that there is nothing to cull between the two.
                instance = Descend(in context, in instance, 0);
            }

            if (instance.Node.IsEmpty)
            {
                continue;
            }

            if (footprint.NeedsDouble)
            {
                VisitExact(in context, in instance);
            }
            else
            {
                Visit(in context, in instance, in footprint);
            }
        }

        _footprints.Pop(start);
    }

    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private LodInstance Descend(in StripContext context, in LodInstance parent, int child)
    {
        var node = parent.Node;
        _skyPath.Set(parent.Depth, new(node, parent.State.Level, child));
        var state = context.Hierarchy.Enter(node, child, parent.State);
        var sides = node.ChildSides.Length == 0 ? default : node.ChildSides[child];
        var path = parent.Path.Append(child, parent.Depth, node.ChildMapIndices[child], node.SetSize, context.Gradient, sides);
        var nodeToView = SimdAffineMap.Compose(in parent.NodeToView, in node.ChildMaps[child]);
        if (context.Gradient == GradientKind.Trap && context.Shading is { } shading && node.ChildMapIndices[child] >= 0)
        {
            path = path with { ColourPath = shading.PassBy(path.ColourPath, ToFractal(in context, in nodeToView)) };
        }

        return new(
            context.Hierarchy.NodeAt(state.Level),
            state,
            in nodeToView,
            parent.Depth + 1,
            node.ChildTints.Length == 0 ? path : path.WithTint(node.ChildTints[child]));
    }

    private static SimdAffineMap ToFractal(in StripContext context, in SimdAffineMap nodeToView)
    {
        var viewToFractal = context.ViewToFractal;
        return SimdAffineMap.Compose(in viewToFractal, in nodeToView);
    }

    /// <summary>Appends the base mesh under a sub-fractal's proxy map to the output, unless closer instances hide it.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private void Emit(in StripContext context, in LodInstance instance, in ScreenFootprint footprint)
    {
        ref readonly var frame = ref context.Frame;
        var output = context.Output;
        var instanceToView = instance.NodeToView;
        if (!instance.Node.IsProxyIdentity)
        {
            var proxyMap = instance.Node.ProxyMap;
            instanceToView = SimdAffineMap.Compose(in instanceToView, in proxyMap);
        }

        // What is cut open hides nothing for certain.
        if (frame.HasOcclusionCulling && footprint is { IsBeyondNearPlane: true, IsSectioned: false } && context.CanOcclude
            && !_rasterizer.Rasterize(in frame, context.Occluder, in instanceToView, context.WindingSign))
        {
            output.Statistics.ZeroCoverage++;
            return;
        }

        output.IsNearClipped |= !footprint.IsBeyondNearPlane || footprint.IsSectioned;
        var viewToWorld = frame.ViewToWorld;
        var instanceToWorld = SimdAffineMap.Compose(in viewToWorld, in instanceToView);
        var instances = footprint.IsShared || !footprint.IsBeyondNearPlane ? output.SharedInstances : output.Instances;
        instances.Add(in instanceToWorld, context.VertexOrigin, instance.Path.Hash);
        if (context.Shading is { } shading)
        {
            instances.SetShade(
                shading.ShadeOf(
                    instance.Path.ColourPath, instance.Node, instance.State.Level, ToFractal(in context, in instance.NodeToView)),
                shading.Gradient.Palette is not null);
        }
        else if (context.Gradient != GradientKind.None)
        {
            instances.SetGradientFactor(instance.Path.ColourPath.ComputeGradientFactor(context.Gradient, context.Hierarchy.ColourLevels));
        }

        if (context.HasColours)
        {
            instances.SetTint(instance.Path.WithTint(instance.Node.MeanTint).MapTint);
        }

        if (context.Hierarchy.HasCoveredSides)
        {
            // A proxy stands beside others whose parts may be drawn, with holes.
            instances.SetCoveredSides(instance.Node.ChildMaps.Length == 0 ? instance.Path.CoveredSides : 0);
        }

        if (context.HasSkyParts)
        {
            InstanceSky.ComputeParts(_skyPath, in context, in instance, in instanceToView, in footprint, instances.LastSkyParts());
        }
    }
}
