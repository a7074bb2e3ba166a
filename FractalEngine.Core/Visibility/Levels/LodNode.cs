using System.Runtime.Intrinsics;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Sky;

namespace FractalEngine.Core.Visibility.Levels;

/// <summary>
/// A sub-fractal with some number of levels left, as it is drawn: its child instances, a box that holds it, and its proxy.
/// </summary>
internal sealed class LodNode
{
    /// <summary>Number of boxes in one vector.</summary>
    public const int Lanes = 8;

    /// <summary>Number of rows in a vector of boxes: x, y, z of the centres, then x, y, z of the half sizes.</summary>
    public const int BoxRows = 6;

    // Padding of a child's box relative to its size: more than the rounding of single precision.
    private const double RelativeRounding = 1e-6;

    // Padding relative to the box's distance from the centre: half a unit in the last place.
    private const double SingleUnitRoundoff = 6e-8;

    /// <summary>Creates a node from its children.</summary>
    /// <param name="box">Box that holds the whole sub-fractal, in its own frame.</param>
    /// <param name="proxyMap">
    /// Map from the base mesh's frame to the node's: the base mesh under it is the proxy of a sub-fractal that appears small.
    /// </param>
    /// <param name="children">Child instances, each once; none for the base mesh itself.</param>
    /// <param name="setSize">Number of maps of the set that the maps of the children are of.</param>
    /// <param name="pick">Decides which one of the children stands at a place; null where all do.</param>
    public LodNode(BoundingBox box, AffineMap proxyMap, ReadOnlySpan<LodChild> children, int setSize, LevelPick? pick = null)
    {
        Pick = pick;
        SetSize = setSize;
        Box = box;
        IsEmpty = box.IsEmpty;
        ProxyMap = new(proxyMap);
        IsProxyIdentity = proxyMap == AffineMap.Identity;
        ChildMaps = new SimdAffineMap[children.Length];
        ChildLevelSteps = new LevelStep[children.Length];
        ChildMapIndices = new int[children.Length];
        ChildTints = children is [{ Tint: not null }, ..] ? new Vector128<float>[children.Length] : [];
        ChildEdges = children is [{ Edge: not null }, ..] ? new ChildEdge[children.Length] : [];
        var paddedCount = (children.Length + Lanes - 1) / Lanes * Lanes;
        ChildBoxes = new float[paddedCount * BoxRows];
        if (IsEmpty)
        {
            return;
        }

        Centre = SimdAffineMap.ToVector256(box.Centre);
        HalfSize = SimdAffineMap.ToVector256(0.5 * box.Size);
        var coordinateExtent = box.Diagonal + box.Centre.MaxAbsComponent();
        for (var i = 0; i < children.Length; i++)
        {
            var child = children[i];
            ChildMaps[i] = new(child.Map);
            ChildLevelSteps[i] = child.LevelStep;
            ChildMapIndices[i] = child.MapIndex;
            if (child.Tint is { } tint)
            {
                ChildTints[i] = tint.ToSingle();
            }

            if (child.Edge is { } edge)
            {
                ChildEdges[i] = edge;
            }

            var offset = child.Box.Centre - box.Centre;
            var padding = (RelativeRounding * (child.Box.Diagonal + (RelativeRounding * coordinateExtent)))
                + (SingleUnitRoundoff * offset.MaxAbsComponent());
            WriteVector(offset, i, 0);
            WriteVector((0.5 * child.Box.Size) + (padding * Vector.One), i, 3);
            MaxChildSizeRatio = Math.Max(MaxChildSizeRatio, child.Box.Diagonal / box.Diagonal);
        }
    }

    /// <summary>The mean tint of the instances, which the proxy has.</summary>
    public Vector128<float> MeanTint { get; init; } = Tint.None.ToSingle();

    /// <summary>What the maps of the children mix into colours; none where no map does.</summary>
    public Vector128<float>[] ChildTints { get; }

    /// <summary>What the map of a child mixes into colours.</summary>
    public Tint TintOf(int child) => ChildTints.Length == 0 ? Tint.None
        : new(new(ChildTints[child][0], ChildTints[child][1], ChildTints[child][2]), ChildTints[child][3]);

    /// <summary>Whether there is nothing to draw.</summary>
    public bool IsEmpty { get; }

    /// <summary>Box that holds the whole sub-fractal, in its own frame.</summary>
    public BoundingBox Box { get; }

    /// <summary>Centre of the box: x, y, z, 0.</summary>
    public Vector256<double> Centre { get; }

    /// <summary>Half the size of the box: x, y, z, 0.</summary>
    public Vector256<double> HalfSize { get; }

    /// <summary>Map from the base mesh's frame to this one, under which the base mesh is the node's proxy.</summary>
    public SimdAffineMap ProxyMap { get; }

    /// <summary>Whether the proxy is the base mesh as it is, which is so for nearly all nodes.</summary>
    public bool IsProxyIdentity { get; }

    /// <summary>Maps from the frames of the child instances to this one.</summary>
    public SimdAffineMap[] ChildMaps { get; }

    /// <summary>
    /// Boxes that hold the child instances, in this frame, relative to the centre of its box: [children / 8 × 6 × 8], padded with zeros,
    /// see <see cref="BoxRows"/>.
    /// </summary>
    public float[] ChildBoxes { get; }

    /// <summary>Diagonal of the largest child's box, as a fraction of this box's diagonal.</summary>
    public double MaxChildSizeRatio { get; }

    /// <summary>Steps from this node's remaining levels to those of the child instances.</summary>
    public LevelStep[] ChildLevelSteps { get; }

    /// <summary>Indices of the children's maps in their sets; −1 for the identity, which changes no colour.</summary>
    public int[] ChildMapIndices { get; }

    /// <summary>The edges to the children, where places decide what stands there; none elsewhere.</summary>
    public ChildEdge[] ChildEdges { get; }

    /// <summary>Decides which one of the children stands at a place; null where all do.</summary>
    public LevelPick? Pick { get; }

    /// <summary>Number of maps of that set: children that are empty, or there already, have none.</summary>
    public int SetSize { get; }

    /// <summary>
    /// The sides of each child that siblings cover whole, and those that lie in a side of the node, as bits, see
    /// <see cref="CoveredSides"/>; none where no side is known to be covered.
    /// </summary>
    public (byte Covered, byte Shared)[] ChildSides { get; set; } = [];

    /// <summary>What the children leave of each other's sky; null while that is not known.</summary>
    public SkyMasks? SkyMasks { get; set; }

    private void WriteVector(Vector v, int child, int row)
    {
        var start = (child / Lanes * Lanes * BoxRows) + (row * Lanes) + (child % Lanes);
        ChildBoxes[start] = (float)v.X;
        ChildBoxes[start + Lanes] = (float)v.Y;
        ChildBoxes[start + (2 * Lanes)] = (float)v.Z;
    }
}
