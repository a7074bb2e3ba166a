using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Bvh;

/// <summary>
/// Builds the tree of a <see cref="TriangleBvh"/>, from the top downwards: a node takes all its faces as one range and divides the
/// range with the largest surface in two, by the surface area heuristic over bins, until there are eight or all are small enough for a
/// leaf.
/// </summary>
/// <remarks>
/// What becomes of a range depends on nothing but its faces and their order, and ranges are numbered from the top, level by level, then
/// subtree by subtree. So the tree is the same on any number of threads.
/// </remarks>
internal sealed class TriangleBvhBuilder
{
    /// <summary>Children of a node: lanes of a Vector256&lt;float&gt;.</summary>
    public const int BranchingFactor = 8;

    /// <summary>Faces of a leaf: lanes of a <see cref="TriangleX4"/>.</summary>
    public const int MaxLeafTriangles = 4;

    /// <summary>
    /// Levels that follow the heuristic. Below, ranges are halved by number, so that no arrangement of faces makes a tree of more than
    /// this and log₈(2³¹) levels.
    /// </summary>
    private const int MaxSahDepth = 20;

    // Below this a subtree is the work of one thread: some milliseconds.
    private const int MaxSubtreeTriangles = 16_384;
    private const int MaxBins = 16;

    private readonly TriangleBounds[] _triangles;
    private readonly BvhLayout _topLevels = new();

    private readonly ParallelOptions _parallelOptions;

    private TriangleBvhBuilder(TriangleBounds[] triangles, int? threads) =>
        (_triangles, _parallelOptions) = (triangles, new() { MaxDegreeOfParallelism = threads ?? -1 });

    /// <summary>Builds the tree.</summary>
    /// <param name="mesh">With at least one face.</param>
    /// <param name="origin">Of the boxes' coordinates.</param>
    /// <param name="scale">By which coordinates are multiplied after that, so that they lie from about −1 to 1.</param>
    /// <param name="threads">At most so many; null for one a core.</param>
    public static BvhLayout Build(Mesh mesh, Vector origin, double scale, int? threads = null)
    {
        var triangles = GC.AllocateUninitializedArray<TriangleBounds>(mesh.FaceCount);
        var builder = new TriangleBvhBuilder(triangles, threads);
        var root = builder.ComputeBounds(mesh, origin, scale);
        builder.BuildTopLevels(mesh, root);
        return builder._topLevels;
    }

    private TriangleRange ComputeBounds(Mesh mesh, Vector origin, double scale)
    {
        var chunks = new TriangleRange[(_triangles.Length + MaxSubtreeTriangles - 1) / MaxSubtreeTriangles];
        ParallelFor(chunks.Length, chunk =>
        {
            var start = chunk * MaxSubtreeTriangles;
            chunks[chunk] = ComputeBounds(mesh, origin, scale, start, Math.Min(MaxSubtreeTriangles, _triangles.Length - start));
        });
        return chunks.Aggregate((range1, range2) => new(
            0,
            range1.Count + range2.Count,
            range1.Bounds.Including(range2.Bounds.Minimum, range2.Bounds.Maximum),
            range1.DoubledCentreBounds.Including(range2.DoubledCentreBounds.Minimum, range2.DoubledCentreBounds.Maximum)));
    }

    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private TriangleRange ComputeBounds(Mesh mesh, Vector origin, double scale, int start, int count)
    {
        var positions = mesh.Positions.AsSpan();
        var indices = mesh.VertexIndices.AsSpan();
        var (simdOrigin, simdScale) = (Vector256.Create(origin.X, origin.Y, origin.Z, 0), Vector256.Create(scale));
        var (bounds, doubledCentreBounds) = (SimdBoundingBox.Empty, SimdBoundingBox.Empty);
        for (var face = start; face < start + count; face++)
        {
            var a = LoadVertex(positions, indices[3 * face]);
            var b = LoadVertex(positions, indices[(3 * face) + 1]);
            var c = LoadVertex(positions, indices[(3 * face) + 2]);
            var minimum = Vector256.MinNative(Vector256.MinNative(a, b), c);
            var maximum = Vector256.MaxNative(Vector256.MaxNative(a, b), c);
            var triangleBounds = new TriangleBounds(
                RoundDown((minimum - simdOrigin) * simdScale).AsInt32().WithElement(3, face).AsSingle(),
                RoundUp((maximum - simdOrigin) * simdScale));
            _triangles[face] = triangleBounds;
            bounds = bounds.Including(triangleBounds.Minimum, triangleBounds.Maximum);
            doubledCentreBounds = doubledCentreBounds.Including(triangleBounds.DoubledCentre, triangleBounds.DoubledCentre);
        }

        return new(start, count, bounds, doubledCentreBounds);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<double> LoadVertex(ReadOnlySpan<double> positions, int vertex)
    {
        var v = positions.Slice(3 * vertex, 3);
        return Vector256.Create(v[0], v[1], v[2], 0);
    }

    /// <summary>To single precision and at least one place down.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector128<float> RoundDown(Vector256<double> v) => TriangleBvh.ToSingle(v) switch
    {
        var single => single - TriangleBvh.UlpBound(single),
    };

    /// <summary>To single precision and at least one place up.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector128<float> RoundUp(Vector256<double> v) => TriangleBvh.ToSingle(v) switch
    {
        var single => single + TriangleBvh.UlpBound(single),
    };

    /// <summary>Builds level by level while ranges are large, then all subtrees at once, then joins them.</summary>
    private void BuildTopLevels(Mesh mesh, TriangleRange root)
    {
        var (currentLevel, depth) = (new List<(TriangleRange Range, int Slot)> { (root, -1) }, 0);
        var subtrees = new List<(TriangleRange Range, int Slot, int Depth)>();
        while (currentLevel.Count > 0)
        {
            var largeRanges = currentLevel.Where(entry => entry.Range.Count > MaxSubtreeTriangles).ToArray();
            subtrees.AddRange(currentLevel.Where(entry => entry.Range.Count <= MaxSubtreeTriangles)
                .Select(entry => (entry.Range, entry.Slot, depth)));
            var childRanges = new TriangleRange[largeRanges.Length][];
            ParallelFor(largeRanges.Length, i =>
            {
                Span<TriangleRange> children = stackalloc TriangleRange[BranchingFactor];
                childRanges[i] = children[..SplitIntoChildren(largeRanges[i].Range, children, depth, inParallel: true)].ToArray();
            });
            currentLevel.Clear();
            for (var i = 0; i < largeRanges.Length; i++)
            {
                var node = _topLevels.AddNode(childRanges[i]);
                _topLevels.SetChild(largeRanges[i].Slot, node);
                currentLevel.AddRange(childRanges[i].Select((range, child) => (range, (node * BranchingFactor) + child)));
            }

            depth++;
        }

        var subtreeLayouts = new BvhLayout[subtrees.Count];
        ParallelFor(subtreeLayouts.Length, i =>
        {
            subtreeLayouts[i] = new();
            BuildSubtree(mesh, subtreeLayouts[i], subtrees[i].Range, -1, subtrees[i].Depth);
        });
        for (var i = 0; i < subtreeLayouts.Length; i++)
        {
            _topLevels.AppendSubtree(subtreeLayouts[i], subtrees[i].Slot);
        }
    }

    private void BuildSubtree(Mesh mesh, BvhLayout layout, TriangleRange range, int slot, int depth)
    {
        // The root is a node in any case, so that the search begins at one.
        if (range.Count <= MaxLeafTriangles && slot >= 0)
        {
            layout.AddLeaf(slot, mesh, _triangles.AsSpan(range.Start, range.Count));
            return;
        }

        Span<TriangleRange> children = stackalloc TriangleRange[BranchingFactor];
        children = children[..SplitIntoChildren(range, children, depth, inParallel: false)];
        var node = layout.AddNode(children);
        layout.SetChild(slot, node);
        for (var child = 0; child < children.Length; child++)
        {
            BuildSubtree(mesh, layout, children[child], (node * BranchingFactor) + child, depth + 1);
        }
    }

    /// <summary>Divides a range into up to eight.</summary>
    /// <returns>How many.</returns>
    private int SplitIntoChildren(TriangleRange range, Span<TriangleRange> children, int depth, bool inParallel)
    {
        (children[0], var count) = (range, 1);
        if (inParallel)
        {
            // Three rounds of halving; what is left to do after them is little.
            var ranges = new TriangleRange[BranchingFactor];
            ranges[0] = range;
            for (; count < BranchingFactor && ranges.AsSpan(0, count).ToArray().All(r => r.Count > MaxLeafTriangles); count *= 2)
            {
                var halfCount = count;
                ParallelFor(halfCount, i => (ranges[i], ranges[halfCount + i]) = Split(ranges[i], depth));
            }

            ranges.AsSpan(0, count).CopyTo(children);
        }

        for (; count < BranchingFactor; count++)
        {
            var largest = FindLargestSplittable(children[..count], depth);
            if (largest < 0)
            {
                break;
            }

            (children[largest], children[count]) = Split(children[largest], depth);
        }

        return count;
    }

    private static int FindLargestSplittable(ReadOnlySpan<TriangleRange> ranges, int depth)
    {
        var (largest, largestSize) = (-1, -1f);
        for (var i = 0; i < ranges.Length; i++)
        {
            var rangeSize = depth < MaxSahDepth ? ranges[i].Bounds.HalfArea : ranges[i].Count;
            if (ranges[i].Count > MaxLeafTriangles && rangeSize > largestSize)
            {
                (largest, largestSize) = (i, rangeSize);
            }
        }

        return largest;
    }

    // A mesh is built once, often before the tiers of the compiler have warmed up.
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private (TriangleRange Left, TriangleRange Right) Split(TriangleRange range, int depth)
    {
        if (depth >= MaxSahDepth || !TryFindSplitPlane(range, out var axis, out var bin, out var binning))
        {
            return SplitInHalf(range);
        }

        var triangles = _triangles.AsSpan(range.Start, range.Count);
        var (leftBox, leftCentres, rightBox, rightCentres) = (SimdBoundingBox.Empty, SimdBoundingBox.Empty, SimdBoundingBox.Empty,
            SimdBoundingBox.Empty);
        var (left, right) = (0, triangles.Length - 1);
        while (left <= right)
        {
            var bounds = triangles[left];
            var doubledCentre = bounds.DoubledCentre;
            if (binning.BinsOf(doubledCentre)[axis] <= bin)
            {
                leftBox = leftBox.Including(bounds.Minimum, bounds.Maximum);
                leftCentres = leftCentres.Including(doubledCentre, doubledCentre);
                left++;
            }
            else
            {
                rightBox = rightBox.Including(bounds.Minimum, bounds.Maximum);
                rightCentres = rightCentres.Including(doubledCentre, doubledCentre);
                (triangles[left], triangles[right]) = (triangles[right], bounds);
                right--;
            }
        }

        return (new(range.Start, left, leftBox, leftCentres), new(range.Start + left, range.Count - left, rightBox, rightCentres));
    }

    /// <summary>Divides by number: faces that no plane divides, or a tree that is deep already.</summary>
    private (TriangleRange Left, TriangleRange Right) SplitInHalf(TriangleRange range) => (range.Count / 2) switch
    {
        var half => (CreateRange(range.Start, half), CreateRange(range.Start + half, range.Count - half)),
    };

    private TriangleRange CreateRange(int start, int count)
    {
        var (box, doubledCentreBounds) = (SimdBoundingBox.Empty, SimdBoundingBox.Empty);
        foreach (var bounds in _triangles.AsSpan(start, count))
        {
            box = box.Including(bounds.Minimum, bounds.Maximum);
            doubledCentreBounds = doubledCentreBounds.Including(bounds.DoubledCentre, bounds.DoubledCentre);
        }

        return new(start, count, box, doubledCentreBounds);
    }

    /// <summary>How centres are counted into bins.</summary>
    private readonly record struct Binning(Vector128<float> Minimum, Vector128<float> Scale, Vector128<int> LastBin)
    {
        public static Binning Of(SimdBoundingBox centres, int binCount)
        {
            var size = centres.Maximum - centres.Minimum;
            // An axis without extent has one bin; the least floats would make the factor infinite.
            var isWide = Vector128.GreaterThan(size, Vector128.Create(1e-30f));
            return new(centres.Minimum, Vector128.Create((float)binCount) / size & isWide, Vector128.Create(binCount - 1));
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Vector128<int> BinsOf(Vector128<float> doubledCentre) => Vector128.Min(
            Vector128.ConvertToInt32Native((doubledCentre - Minimum) * Scale), LastBin);
    }

    /// <summary>The plane between two bins with the least expected cost.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private bool TryFindSplitPlane(TriangleRange range, out int bestAxis, out int bestBin, out Binning binning)
    {
        var binCount = range.Count >= 64 ? MaxBins : MaxBins / 2;
        binning = Binning.Of(range.DoubledCentreBounds, binCount);
        (bestAxis, bestBin) = (-1, -1);
        Span<SimdBoundingBox> boxes = stackalloc SimdBoundingBox[3 * MaxBins];
        Span<int> counts = stackalloc int[3 * MaxBins];
        boxes.Fill(SimdBoundingBox.Empty);
        foreach (ref readonly var bounds in _triangles.AsSpan(range.Start, range.Count))
        {
            var (minimum, maximum) = (bounds.Minimum, bounds.Maximum);
            var bin = binning.BinsOf(minimum + maximum);
            var (x, y, z) = (bin[0], MaxBins + bin[1], (2 * MaxBins) + bin[2]);
            boxes[x] = boxes[x].Including(minimum, maximum);
            boxes[y] = boxes[y].Including(minimum, maximum);
            boxes[z] = boxes[z].Including(minimum, maximum);
            counts[x]++;
            counts[y]++;
            counts[z]++;
        }

        var bestCost = float.PositiveInfinity;
        Span<float> rightCosts = stackalloc float[MaxBins];
        for (var axis = 0; axis < 3; axis++)
        {
            if (binning.Scale[axis] == 0)
            {
                continue;
            }

            var axisBoxes = boxes.Slice(axis * MaxBins, binCount);
            var axisCounts = counts.Slice(axis * MaxBins, binCount);
            var (box, count) = (SimdBoundingBox.Empty, 0);
            for (var bin = binCount - 1; bin > 0; bin--)
            {
                box = box.Including(axisBoxes[bin].Minimum, axisBoxes[bin].Maximum);
                count += axisCounts[bin];
                rightCosts[bin] = SahCost(box, count);
            }

            (box, count) = (SimdBoundingBox.Empty, 0);
            for (var bin = 0; bin < binCount - 1; bin++)
            {
                box = box.Including(axisBoxes[bin].Minimum, axisBoxes[bin].Maximum);
                count += axisCounts[bin];
                var cost = SahCost(box, count) + rightCosts[bin + 1];
                if (count > 0 && count < range.Count && cost < bestCost)
                {
                    (bestCost, bestAxis, bestBin) = (cost, axis, bin);
                }
            }
        }

        return bestAxis >= 0;
    }

    /// <summary>Surface times leaves.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static float SahCost(SimdBoundingBox box, int triangleCount) =>
        triangleCount == 0 ? 0 : box.HalfArea * ((triangleCount + MaxLeafTriangles - 1) / MaxLeafTriangles);

    private void ParallelFor(int count, Action<int> body)
    {
        if (count == 1)
        {
            body(0);
        }
        else
        {
            Parallel.For(0, count, _parallelOptions, body);
        }
    }
}
