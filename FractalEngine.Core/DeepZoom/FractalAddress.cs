using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Core.DeepZoom;

/// <summary>
/// The position of a camera in a fractal, at any depth: the path to a sub-fractal near the camera, and the camera's position relative to
/// that sub-fractal.
/// </summary>
/// <remarks>
/// As the camera moves, the sub-fractal is replaced by one further in or further out. So all numbers stay about 1 and nothing loses
/// precision, however deep the camera goes. This replaces the paper's m ← m·t (§4.3.2), which keeps one matrix and loses it at about
/// level 50. Memory: 16 bytes a level, at most <see cref="FractalLimits.Depth"/> levels. Lengths are in a unit that changes with the
/// depth; perspective shows the same in any unit.
/// </remarks>
public sealed class FractalAddress
{
    // Boxes smaller than this fraction of their distance are as far away as what they hold.
    private const double RelativeDistanceTolerance = 0.1;

    // Sub-fractals smaller than this fraction of the whole are below the last place of a coordinate.
    private const double MinRelativeSize = 1e-17;

    // Among surfaces that are never far, as in a solid, distances are no smaller than this fraction of the sub-fractal's size.
    private const double MinRelativeDistance = 1e-3;

    private readonly LodHierarchy _hierarchy;
    private readonly CameraFrame _frame;
    private double? _closestDistance;

    /// <summary>Creates the address of a camera relative to the whole fractal.</summary>
    /// <param name="hierarchy">Hierarchy of the fractal.</param>
    /// <param name="objectToWorld">The object's matrix m, from the fractal's frame to world space.</param>
    /// <param name="cameraPosition">Camera position, world space.</param>
    public FractalAddress(LodHierarchy hierarchy, AffineMap objectToWorld, Vector cameraPosition)
        : this(hierarchy, new(hierarchy, new(hierarchy), new(objectToWorld.Linear, objectToWorld.Translation - cameraPosition)))
    {
    }

    private FractalAddress(LodHierarchy hierarchy, CameraFrame frame)
    {
        _hierarchy = hierarchy;
        _frame = frame;
    }

    /// <summary>Number of child instances that lead to the sub-fractal.</summary>
    public int Depth => NodePath.Depth;

    /// <summary>The path to the sub-fractal: for each level the index of the child instance.</summary>
    public IReadOnlyList<int> Path => NodePath.Children;

    /// <summary>Map from the sub-fractal's frame to world axes about the camera, in the present unit.</summary>
    public AffineMap FrameToCamera => _frame.FrameToCamera;

    /// <summary>The natural logarithm of the present unit, in scene units.</summary>
    public double LogUnit => _frame.LogUnit;

    /// <summary>Memory of the path in bytes.</summary>
    public long StorageBytes => NodePath.StorageBytes;

    private FractalPath NodePath => _frame.Path;

    /// <summary>Copies the address, so that one of the two can move alone. Cost O(depth).</summary>
    public FractalAddress Clone() => new(_hierarchy, _frame.Clone());

    /// <summary>Moves the camera, and updates the address.</summary>
    /// <param name="displacement">World axes, in the present unit; finite.</param>
    public void Move(Vector displacement)
    {
        _closestDistance = null;
        _frame.Move(displacement);
    }

    /// <summary>
    /// Collects the sub-fractals to draw, the closest first: the one that the address names, and the siblings of its ancestors.
    /// </summary>
    /// <param name="maxAncestors">
    /// Maximum number of ancestors; what is further out, or 10¹⁵ times as large as the present unit, is not drawn.
    /// </param>
    public ImmutableArray<LodRoot> CollectRoots(int maxAncestors)
    {
        return [.. EnumerateRoots(maxAncestors).Select(static found => found.Root).OrderBy(DistanceTo)];
    }

    /// <summary>Makes the address of the same camera relative to one of the sub-fractals around it, in the same unit.</summary>
    /// <param name="root">One of <see cref="CollectRoots"/>, since this address was moved last.</param>
    /// <exception cref="ArgumentException">There is no such sub-fractal around the camera.</exception>
    public FractalAddress RelativeTo(LodRoot root)
    {
        var (_, parent, child) = EnumerateRoots(int.MaxValue).FirstOrDefault(found => found.Root == root, (default, -1, -1));
        ArgumentCheck.Require(parent >= 0, "expected a sub-fractal around the camera", nameof(root));
        return new(_hierarchy, _frame.RelativeTo(parent, child, root.FrameToCamera));
    }

    /// <summary>
    /// Lists the maps that lead to the sub-fractal: for each level the index of the map in its set, −1 for an identity that leaves a set
    /// out.
    /// </summary>
    public ImmutableArray<int> MapIndices =>
        [.. Enumerable.Range(0, Depth).Select(depth => NodePath.NodeAt(depth).ChildMapIndices[Path[depth]])];

    /// <summary>Finds the box around a sub-fractal on the path, and where it is.</summary>
    /// <param name="depth">Number of child instances that lead to it, from 0 for the whole fractal to <see cref="Depth"/>.</param>
    /// <returns>
    /// The box in the frame of that sub-fractal, and the map from there to world axes about the camera, in the present unit. Null where it
    /// is 10¹⁵ times as large as the unit.
    /// </returns>
    public (BoundingBox Box, AffineMap FrameToCamera)? SubFractalAt(int depth) =>
        _frame.FrameToCameraAt(depth) is { } map ? (NodePath.NodeAt(depth).Box, map) : null;

    /// <summary>Computes the map from the surroundings of another camera in the same fractal to those of this one.</summary>
    /// <param name="other">The address of the other camera.</param>
    /// <returns>
    /// From world axes about the other camera, in its unit, to world axes about this one, in the present unit. Null where the fractals
    /// differ, or what holds both cameras is 10¹⁵ times as large as one of the units.
    /// </returns>
    /// <remarks>Cost O(depth).</remarks>
    public AffineMap? MapFrom(FractalAddress other)
    {
        ArgumentNullException.ThrowIfNull(other);
        if (!ReferenceEquals(_hierarchy, other._hierarchy))
        {
            return null;
        }

        var shared = 0;
        while (shared < Math.Min(Depth, other.Depth) && Path[shared] == other.Path[shared])
        {
            shared++;
        }

        return _frame.FrameToCameraAt(shared) is { } own && other._frame.FrameToCameraAt(shared) is { } others
            ? own * others.Inverse()
            : null;
    }

    /// <summary>Computes the camera position in world space, as far as a double can tell it.</summary>
    /// <param name="objectToWorld">The object's matrix m.</param>
    public Vector WorldPosition(AffineMap objectToWorld)
    {
        var frameToWorld = objectToWorld;
        var minDiagonal = MinRelativeSize * NodePath.NodeAt(0).Box.Transform(objectToWorld).Diagonal;
        for (var depth = 0; depth < Depth; depth++)
        {
            var node = NodePath.NodeAt(depth);
            if (!(node.Box.Transform(frameToWorld).Diagonal > minDiagonal))
            {
                return frameToWorld * node.Box.Centre;
            }

            frameToWorld *= node.ChildMaps[Path[depth]].ToAffineMap();
        }

        return frameToWorld * _frame.CameraPosition();
    }

    /// <summary>Computes an upper bound of the distance of drawn surfaces, in the present unit.</summary>
    /// <param name="roots">Sub-fractals that are drawn, see <see cref="CollectRoots"/>.</param>
    public double MaxDrawDistance(ImmutableArray<LodRoot> roots)
    {
        var maxDistance = 0.0;
        foreach (var root in roots)
        {
            var node = _hierarchy.NodeAt(root.RemainingLevels);
            if (!node.IsEmpty)
            {
                var box = node.Box.Transform(root.FrameToCamera);
                maxDistance = Math.Max(maxDistance, box.Centre.Length() + box.Diagonal);
            }
        }

        return maxDistance;
    }

    /// <summary>Estimates the distance of the closest surface, in the present unit.</summary>
    /// <remarks>
    /// It is right to about a tenth, unless more than some thousand sub-fractals are about as close. Close to an instance of the base mesh
    /// it is the distance of the instance's box. The result is kept until the camera moves.
    /// </remarks>
    public double ClosestSurfaceDistance()
    {
        if (_closestDistance is { } cached)
        {
            return cached;
        }

        var node = NodePath.CurrentNode;
        var distance = node.ChildMaps.Length == 0
            ? CameraFrame.DistanceToBox(node.Box.Transform(FrameToCamera), Vector.Zero)
            : _frame.FindClosestNode(RelativeDistanceTolerance).Distance;
        var closestDistance = Math.Max(distance, MinRelativeDistance * _frame.CurrentDiagonal);
        _closestDistance = closestDistance;
        return closestDistance;
    }

    /// <summary>Lists the sub-fractals to draw, with the depth of the one that each is a child of; −1 for no child.</summary>
    private IEnumerable<(LodRoot Root, int Parent, int Child)> EnumerateRoots(int maxAncestors)
    {
        var pathToCamera = NodePath.ColourPathTo(Depth, out var toFractal);
        yield return (
            RootAt(NodePath.StateAt(Depth), FrameToCamera, pathToCamera, NodePath.TintTo(Depth)) with { FrameToFractal = toFractal },
            Depth, -1);
        var frameToCamera = FrameToCamera;
        for (var depth = Depth - 1; depth >= Math.Max(0, Depth - (long)maxAncestors); depth--)
        {
            var node = NodePath.NodeAt(depth);
            frameToCamera *= node.ChildMaps[Path[depth]].ToAffineMap().Inverse();
            if (!CameraFrame.IsWithinScale(frameToCamera))
            {
                yield break;
            }

            var colourPath = NodePath.ColourPathTo(depth, out var parentToFractal);
            var tint = NodePath.TintTo(depth);
            for (var child = 0; child < node.ChildMaps.Length; child++)
            {
                if (child != Path[depth])
                {
                    toFractal = parentToFractal;
                    var root = RootAt(
                        NodePath.ChildState(depth, child),
                        frameToCamera * node.ChildMaps[child].ToAffineMap(),
                        NodePath.Append(colourPath, node, child, ref toFractal),
                        tint.Then(node.TintOf(child))) with
                    { FrameToFractal = toFractal };
                    yield return (root, depth, child);
                }
            }
        }
    }

    private static LodRoot RootAt(LevelState state, AffineMap frameToCamera, ColourPath colourPath, Tint tint) =>
        new(state.Level, frameToCamera, colourPath) { State = state, Tint = tint };

    private double DistanceTo(LodRoot root)
    {
        var node = _hierarchy.NodeAt(root.RemainingLevels);
        return node.IsEmpty ? double.PositiveInfinity : CameraFrame.DistanceToBox(node.Box.Transform(root.FrameToCamera), Vector.Zero);
    }
}
