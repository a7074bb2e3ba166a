using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Core.Visibility;

/// <summary>A stack of the footprints of child instances, one batch for each node on the path of a traversal.</summary>
/// <remarks>A batch is projected eight children at a time in single precision, then sorted from front to back.</remarks>
internal sealed class ChildFootprints
{
    private const int InitialCapacity = 256;
    private const int MaxInsertionSortCount = 24;

    // Boxes closer than this fraction of their parent's distance are projected in double precision.
    private const double MinRelativeDepthForSingle = 1e-3;

    // Rows of eight numbers in the storage of eight footprints: left, right, top, bottom, inverse depth and depth.
    private const int Rows = 6;
    private const int RightRow = LodNode.Lanes;
    private const int TopRow = 2 * LodNode.Lanes;
    private const int BottomRow = 3 * LodNode.Lanes;
    private const int InverseDepthRow = 4 * LodNode.Lanes;
    private const int DepthRow = 5 * LodNode.Lanes;

    private float[] _footprints = new float[InitialCapacity * Rows];
    private float[] _sortKeys = new float[InitialCapacity];
    private int[] _order = new int[InitialCapacity];
    private int _top;

    /// <summary>Removes all batches, and keeps the memory.</summary>
    public void Clear() => _top = 0;

    /// <summary>Pushes the footprints of a node's children, sorted from front to back.</summary>
    /// <param name="frame">Strip that the children are projected to.</param>
    /// <param name="node">Parent of the children.</param>
    /// <param name="map">Map from the node's frame to view space.</param>
    /// <returns>Start of the batch, for <see cref="ChildAt"/>, <see cref="Read"/> and <see cref="Pop"/>.</returns>
    public int Push(in StripFrame frame, LodNode node, in SimdAffineMap map)
    {
        var start = _top;
        var count = node.ChildMaps.Length;
        _top += (count + LodNode.Lanes - 1) / LodNode.Lanes * LodNode.Lanes;
        if (_top > _order.Length)
        {
            Array.Resize(ref _order, 2 * _top);
            Array.Resize(ref _sortKeys, 2 * _top);
            Array.Resize(ref _footprints, 2 * _top * Rows);
        }

        Project(in frame, node, in map, start);
        SortFrontToBack(_sortKeys.AsSpan(start, count), _order.AsSpan(start, count));
        return start;
    }

    /// <summary>Removes the last batch.</summary>
    /// <param name="start">Start of the batch.</param>
    public void Pop(int start) => _top = start;

    /// <summary>Index of a child in the order from front to back.</summary>
    /// <param name="start">Start of the batch.</param>
    /// <param name="rank">Rank in the order; 0 is the closest child.</param>
    public int ChildAt(int start, int rank) => _order[start + rank];

    /// <summary>Reads the footprint of a child from a batch.</summary>
    /// <param name="frame">Strip that the batch was projected to.</param>
    /// <param name="start">Start of the batch.</param>
    /// <param name="child">Index of the child in its node.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public ScreenFootprint Read(in StripFrame frame, int start, int child)
    {
        ref var left = ref _footprints[((start + (child / LodNode.Lanes * LodNode.Lanes)) * Rows) + (child % LodNode.Lanes)];
        var depth = Unsafe.Add(ref left, DepthRow);
        return float.IsNaN(depth) ? new() { NeedsDouble = true }
            : frame.HasFrustumCulling && depth > frame.Far ? ScreenFootprint.Outside
            : frame.ClipRectangle(left, Unsafe.Add(ref left, RightRow), Unsafe.Add(ref left, TopRow), Unsafe.Add(ref left, BottomRow),
                Unsafe.Add(ref left, InverseDepthRow));
    }

    /// <summary>Projects the boxes of a node's children, eight at a time, in single precision.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private void Project(in StripFrame frame, LodNode node, in SimdAffineMap map, int start)
    {
        var centre = map.Apply(node.Centre);
        var rowX = new MapRowX8(in map, centre, 0);
        var rowY = new MapRowX8(in map, centre, 1);
        var rowZ = new MapRowX8(in map, centre, 2);
        var scaleX = Vector256.Create((float)frame.ScaleX);
        var scaleY = Vector256.Create((float)frame.ScaleY);
        var centreX = Vector256.Create((float)frame.CentreX);
        var centreY = Vector256.Create((float)frame.CentreY);
        var zero = Vector256<float>.Zero;
        var distance = Math.Sqrt(Vector256.Dot(centre, centre));
        var minDepthForSingle = Vector256.Create((float)Math.Max(frame.Near, MinRelativeDepthForSingle * distance));
        // Squares of large and small coordinates leave the range of single precision.
        var inverseDistance = Vector256.Create(distance > 0 ? (float)(1 / distance) : 1);
        ref var boxes = ref MemoryMarshal.GetArrayDataReference(node.ChildBoxes);
        ref var footprints = ref MemoryMarshal.GetArrayDataReference(_footprints);
        ref var sortKeys = ref MemoryMarshal.GetArrayDataReference(_sortKeys);
        for (var i = 0; i < node.ChildBoxes.Length / LodNode.BoxRows; i += LodNode.Lanes)
        {
            var boxOffset = (nuint)(i * LodNode.BoxRows);
            var boxX = Vector256.LoadUnsafe(ref boxes, boxOffset);
            var boxY = Vector256.LoadUnsafe(ref boxes, boxOffset + LodNode.Lanes);
            var boxZ = Vector256.LoadUnsafe(ref boxes, boxOffset + (2 * LodNode.Lanes));
            var boxHalfX = Vector256.LoadUnsafe(ref boxes, boxOffset + (3 * LodNode.Lanes));
            var boxHalfY = Vector256.LoadUnsafe(ref boxes, boxOffset + (4 * LodNode.Lanes));
            var boxHalfZ = Vector256.LoadUnsafe(ref boxes, boxOffset + (5 * LodNode.Lanes));
            var x = rowX.Apply(boxX, boxY, boxZ);
            var y = rowY.Apply(boxX, boxY, boxZ);
            var z = rowZ.Apply(boxX, boxY, boxZ);
            var halfX = rowX.TransformHalfSize(boxHalfX, boxHalfY, boxHalfZ);
            var halfY = rowY.TransformHalfSize(boxHalfX, boxHalfY, boxHalfZ);
            var halfZ = rowZ.TransformHalfSize(boxHalfX, boxHalfY, boxHalfZ);
            var zLow = z - halfZ;
            var zHigh = z + halfZ;
            var maxInverseDepth = Vector256<float>.One;
            var minInverseDepth = Vector256<float>.One;
            var footprintInverseDepth = -zLow;
            var sortKey = z;
            if (frame.IsPerspective)
            {
                maxInverseDepth = Vector256<float>.One / zLow;
                minInverseDepth = Vector256<float>.One / zHigh;
                footprintInverseDepth = maxInverseDepth;
                var keyX = x * inverseDistance;
                var keyY = y * inverseDistance;
                var keyZ = z * inverseDistance;
                sortKey = (keyX * keyX) + (keyY * keyY) + (keyZ * keyZ);
            }

            // An edge that points away from the centre of the frame appears farthest out at the closest depth.
            var left = x - halfX;
            var right = x + halfX;
            var top = y + halfY;
            var bottom = y - halfY;
            var leftFactor = Vector256.ConditionalSelect(Vector256.LessThan(left, zero), maxInverseDepth, minInverseDepth);
            var rightFactor = Vector256.ConditionalSelect(Vector256.GreaterThan(right, zero), maxInverseDepth, minInverseDepth);
            var topFactor = Vector256.ConditionalSelect(Vector256.GreaterThan(top, zero), maxInverseDepth, minInverseDepth);
            var bottomFactor = Vector256.ConditionalSelect(Vector256.LessThan(bottom, zero), maxInverseDepth, minInverseDepth);
            left = centreX + (scaleX * left * leftFactor);
            right = centreX + (scaleX * right * rightFactor);
            top = centreY - (scaleY * top * topFactor);
            bottom = centreY - (scaleY * bottom * bottomFactor);
            var offset = (nuint)((start + i) * Rows);
            left.StoreUnsafe(ref footprints, offset);
            right.StoreUnsafe(ref footprints, offset + RightRow);
            top.StoreUnsafe(ref footprints, offset + TopRow);
            bottom.StoreUnsafe(ref footprints, offset + BottomRow);
            footprintInverseDepth.StoreUnsafe(ref footprints, offset + InverseDepthRow);
            // NaN marks boxes that are too close, and so need double precision.
            Vector256.ConditionalSelect(Vector256.LessThan(zLow, minDepthForSingle), Vector256.Create(float.NaN), zLow)
                .StoreUnsafe(ref footprints, offset + DepthRow);
            sortKey.StoreUnsafe(ref sortKeys, (nuint)(start + i));
        }
    }

    /// <summary>Sorts the indices of children by their keys, the smallest first.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private static void SortFrontToBack(Span<float> keys, Span<int> order)
    {
        if (keys.Length > MaxInsertionSortCount)
        {
            for (var i = 0; i < order.Length; i++)
            {
                order[i] = i;
            }

            keys.Sort(order);
            return;
        }

        for (var i = 0; i < keys.Length; i++)
        {
            var key = keys[i];
            var slot = i;
            for (; slot > 0 && keys[slot - 1] > key; slot--)
            {
                keys[slot] = keys[slot - 1];
                order[slot] = order[slot - 1];
            }

            keys[slot] = key;
            order[slot] = i;
        }
    }
}
