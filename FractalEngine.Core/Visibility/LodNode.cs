using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility;

/// <summary>
/// A part of a fractal with some number of levels left, as it is drawn: the copies that it is made of, and a box that holds it.
/// </summary>
internal sealed class LodNode
{
    /// <summary>Boxes are kept in vectors of so many.</summary>
    public const int Lanes = 8;

    /// <summary>Rows of a vector of boxes: x, y, z of the centres, then of half the sizes.</summary>
    public const int BoxRows = 6;

    // Of a copy's size: more than what single precision rounds by.
    private const double RelativeRounding = 1e-6;

    // Of its distance from the middle: half a unit in the last place.
    private const double SingleUnitRoundoff = 6e-8;

    /// <summary>For a level.</summary>
    /// <param name="box">Holds everything, in this frame.</param>
    /// <param name="proxyMap">
    /// From the base mesh's frame to this one: how the mesh stands for everything when it is too small to be told apart.
    /// </param>
    /// <param name="children">The copies, none of them twice; none for the base.</param>
    public LodNode(BoundingBox box, AffineMap proxyMap, ReadOnlySpan<LodChild> children)
    {
        (Box, ProxyMap, IsEmpty) = (box, new(proxyMap), box.IsEmpty);
        IsProxyIdentity = proxyMap == AffineMap.Identity;
        var paddedCount = (children.Length + Lanes - 1) / Lanes * Lanes;
        (ChildMaps, ChildLevelSteps, ChildMapIndices, ChildBoxes) =
            (new SimdAffineMap[children.Length], new LevelStep[children.Length], new int[children.Length], new float[paddedCount * BoxRows]);
        if (IsEmpty)
        {
            return;
        }

        (Centre, HalfSize) = (SimdAffineMap.ToVector256(box.Centre), SimdAffineMap.ToVector256(0.5 * box.Size));
        var coordinateExtent = box.Diagonal + box.Centre.MaxAbsComponent();
        for (var i = 0; i < children.Length; i++)
        {
            var (map, childBox, levelStep, mapIndex) = children[i];
            (ChildMaps[i], ChildLevelSteps[i], ChildMapIndices[i]) = (new(map), levelStep, mapIndex);
            var offset = childBox.Centre - box.Centre;
            var padding = (RelativeRounding * (childBox.Diagonal + (RelativeRounding * coordinateExtent)))
                + (SingleUnitRoundoff * offset.MaxAbsComponent());
            WriteVector(offset, i, 0);
            WriteVector((0.5 * childBox.Size) + (padding * Vector.One), i, 3);
            MaxChildSizeRatio = Math.Max(MaxChildSizeRatio, childBox.Diagonal / box.Diagonal);
        }
    }

    /// <summary>True when there is nothing to draw.</summary>
    public bool IsEmpty { get; }

    /// <summary>Holds everything, in this frame.</summary>
    public BoundingBox Box { get; }

    /// <summary>Of the box: x, y, z, 0.</summary>
    public Vector256<double> Centre { get; }

    /// <summary>Half the size of the box: x, y, z, 0.</summary>
    public Vector256<double> HalfSize { get; }

    /// <summary>From the base mesh's frame to this one.</summary>
    public SimdAffineMap ProxyMap { get; }

    /// <summary>Nearly always.</summary>
    public bool IsProxyIdentity { get; }

    /// <summary>From the frames of the copies to this one.</summary>
    public SimdAffineMap[] ChildMaps { get; }

    /// <summary>
    /// Boxes that hold the copies, in this frame, relative to its box's centre: for each eight copies six rows of eight numbers, see <see
    /// cref="BoxRows"/>.
    /// </summary>
    public float[] ChildBoxes { get; }

    /// <summary>The size of the largest copy as a part of this one's.</summary>
    public double MaxChildSizeRatio { get; }

    /// <summary>Lead from the remaining levels of this node to those of its children.</summary>
    public LevelStep[] ChildLevelSteps { get; }

    /// <summary>The numbers of the copies' maps in their sets; −1 for the identity, which changes no colour.</summary>
    public int[] ChildMapIndices { get; }

    private void WriteVector(Vector v, int child, int row)
    {
        var start = (child / Lanes * Lanes * BoxRows) + (row * Lanes) + (child % Lanes);
        (ChildBoxes[start], ChildBoxes[start + Lanes], ChildBoxes[start + (2 * Lanes)]) = ((float)v.X, (float)v.Y, (float)v.Z);
    }
}

/// <summary>One of the copies that a <see cref="LodNode"/> is made of.</summary>
/// <param name="Map">From its frame.</param>
/// <param name="Box">Holds it, in the frame of the state.</param>
/// <param name="LevelStep">Leads from the remaining levels of the parent to those of the child.</param>
/// <param name="MapIndex">Of the map in its set, −1 for the identity.</param>
internal readonly record struct LodChild(AffineMap Map, BoundingBox Box, LevelStep LevelStep, int MapIndex);
