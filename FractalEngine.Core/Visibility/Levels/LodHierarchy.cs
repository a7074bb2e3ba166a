using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Core.Visibility.Sky;

namespace FractalEngine.Core.Visibility.Levels;

/// <summary>
/// The level-of-detail hierarchy of a fractal: one node for each number of remaining levels, with the bounding boxes that exact search
/// has found. It takes kilobytes at any depth.
/// </summary>
public sealed class LodHierarchy
{
    private readonly LevelTable<LodNode> _nodes;
    private AmbientCube? _sides;
    private VisibleSides? _visibleSides;
    private SkyMasks?[] _lastSkyMasks = [];

    // Set on the thread that bakes, after all masks.
    private volatile bool _hasSkyMasks;
    private volatile bool _isSkyBaked;

    internal LodHierarchy(LevelTable<LodNode> nodes, long levelCount, Mesh mesh)
    {
        _nodes = nodes;
        Start = new(levelCount);
        ColourLevels = levelCount;
        Mesh = mesh;
        Occluder = new(mesh);
    }

    /// <summary>The base mesh that every instance draws.</summary>
    public Mesh Mesh { get; }

    /// <summary>The base mesh in the form that an <see cref="OcclusionBuffer"/> rasterizes.</summary>
    internal OccluderMesh Occluder { get; }

    /// <summary>Points of the base mesh that stand for its sides.</summary>
    internal AmbientCube Sides => _sides ??= new(Mesh);

    /// <summary>Tells which of these an eye sees.</summary>
    internal VisibleSides VisibleSides => _visibleSides ??= new(Mesh);

    /// <summary>Number of levels of the whole fractal; a huge number where they are infinitely many.</summary>
    internal long LevelCount => Start.Level;

    /// <summary>The place of the whole fractal.</summary>
    internal LevelState Start { get; private set; }

    /// <summary>The box of what stands there; null where that is the box of the whole node, since nothing depends on places.</summary>
    internal BoundingBox? TrueBounds => HasPicks ? Source?.Bounds : null;

    /// <summary>What the hierarchy was built of; null for a mesh.</summary>
    internal Fractal? Source { get; init; }

    /// <summary>The box of the fractal with all of its meshes; null for a mesh, and for a fractal in componentwise composition.</summary>
    internal BoundingBox? WholeBounds => Source?.WholeBounds;

    /// <summary>True where maps mix colours into what they make, so that instances have tints.</summary>
    public bool HasColours { get; internal init; }

    /// <summary>True where instances come with the sides that are never seen, see <see cref="CoveredSides"/>.</summary>
    public bool HasCoveredSides { get; internal init; }

    /// <summary>True where places decide what stands there, by chance or by size.</summary>
    internal bool HasPicks
    {
        get;
        init
        {
            field = value;
            Start = Resolve(Start);
        }
    }

    /// <summary>Number of maps of the longest chain, by which gradients go; a huge number where they are infinitely many.</summary>
    internal long ColourLevels { get; init; }

    /// <summary>True for a mesh, and for a fractal that is its base mesh: one instance, or none where it is not visible.</summary>
    public bool HasNoLevels => LevelCount == 0;

    /// <summary>Builds the hierarchy of a fractal.</summary>
    /// <param name="fractal">
    /// Fractal of any composition and depth. That of several base meshes is for cameras only: each of <see cref="Fractal.ByMesh"/> is drawn
    /// by itself.
    /// </param>
    /// <exception cref="FractalLimitException">
    /// Bounds overflow a double or don't converge, as those of an infinite fractal that grows; or there are more than
    /// <see cref="FractalLimits.ComponentwiseSums"/> sums in componentwise composition.
    /// </exception>
    /// <exception cref="SingularMatrixException">A map of the fractal flattens space.</exception>
    public static LodHierarchy Build(Fractal fractal) => LodHierarchyBuilder.Build(fractal);

    /// <summary>Builds the hierarchy of a mesh that is drawn once.</summary>
    public static LodHierarchy Build(Mesh mesh) =>
        new(new([new(mesh.FaceCount == 0 ? BoundingBox.Empty : mesh.Bounds, AffineMap.Identity, [], 0)], [new(0, 1, 0, 1)]), 0, mesh)
        {
            IsSkyBaked = true,
        };

    /// <summary>Whether it is known what the parts of the fractal leave of each other's sky: see <c>SkyMaskBaker.Bake</c>.</summary>
    public bool HasSkyMasks
    {
        get => _hasSkyMasks;
        internal set => _hasSkyMasks = value;
    }

    /// <summary>Whether <c>SkyMaskBaker.Bake</c> has nothing more to do.</summary>
    public bool IsSkyBaked
    {
        get => _isSkyBaked;
        internal set => _isSkyBaked = value;
    }

    /// <summary>Is held while masks are computed: two preparations of a scene may share the hierarchy.</summary>
    internal Lock BakeLock { get; } = new();

    /// <summary>
    /// Whether no part of the fractal can hide another one's sky, so that <c>SkyMaskBaker.Bake</c> would find nothing: it is one part, or
    /// lies in a plane. Costs a pass over the base mesh and the nodes; false proves nothing.
    /// </summary>
    public bool HasOpenSky() => OpenSky.IsSinglePath(_nodes.Items) || IsFlat();

    /// <summary>Whether all instances of the base mesh certainly lie in one plane.</summary>
    public bool IsFlat() => OpenSky.IsFlat(Mesh, _nodes.Items);

    /// <summary>Bytes of the tables that <c>SkyMaskBaker.Bake</c> has made.</summary>
    public int SkyMaskBytes => HasSkyMasks
        ? _nodes.Items.ToArray().Select(static node => node.SkyMasks).Concat(_lastSkyMasks).OfType<SkyMasks>().Distinct()
            .Sum(static masks => masks.ByteCount)
        : 0;

    /// <summary>Sets the masks of the last levels: they end in the base mesh, unlike others with the same node.</summary>
    internal void SetLastSkyMasks(SkyMasks?[] masks) => _lastSkyMasks = masks;

    /// <summary>Finds the masks of a node with a number of remaining levels; null for none.</summary>
    internal SkyMasks? SkyMasksAt(LodNode node, long remainingLevels) =>
        remainingLevels < _lastSkyMasks.Length ? _lastSkyMasks[remainingLevels] : node.SkyMasks;

    /// <summary>Goes on from a place to a child: as far as places decide at once.</summary>
    /// <param name="node">The node of the place.</param>
    /// <param name="child">Index of the child.</param>
    /// <param name="parent">The place.</param>
    internal LevelState Enter(LodNode node, int child, in LevelState parent) => HasPicks
        ? Resolve(node.ChildEdges[child].Enter(in parent))
        : new(node.ChildLevelSteps[child].RemainingLevels(parent.Level));

    private LevelState Resolve(LevelState state)
    {
        while (HasPicks && NodeAt(state.Level) is { Pick: { } pick, IsEmpty: false } node)
        {
            state = node.ChildEdges[pick.Select(in state)].Enter(in state);
        }

        return state;
    }

    /// <summary>Finds the node of a number of remaining levels.</summary>
    internal LodNode NodeAt(long remainingLevels) => _nodes.At(remainingLevels);
}
