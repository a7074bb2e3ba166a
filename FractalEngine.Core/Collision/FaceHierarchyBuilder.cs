using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>
/// Builds the tree of a <see cref="FaceHierarchy"/>, from the top downwards: a node takes all its faces as one range and divides the
/// range with the largest surface in two, by the surface area heuristic over bins, until there are eight or all are small enough for a leaf.
/// </summary>
/// <remarks>
/// What becomes of a range depends on nothing but its faces and their order, and ranges are numbered from the top, level by level, then
/// subtree by subtree. So the tree is the same on any number of threads.
/// </remarks>
internal sealed class FaceHierarchyBuilder
{
    /// <summary>Children of a node: lanes of a Vector256&lt;float&gt;.</summary>
    public const int Width = 8;

    /// <summary>Faces of a leaf: lanes of a <see cref="FaceQuartet"/>.</summary>
    public const int LeafFaces = 4;

    /// <summary>
    /// Levels that follow the heuristic. Below, ranges are halved by number, so that no arrangement of faces makes a tree of more than
    /// this and log₈(2³¹) levels.
    /// </summary>
    private const int HeuristicLevels = 20;

    // Below this a subtree is the work of one thread: some milliseconds.
    private const int SubtreeFaces = 16_384;
    private const int Bins = 16;

    private readonly FaceBounds[] _faces;
    private readonly HierarchyLayout _top = new();

    private readonly ParallelOptions _parallel;

    private FaceHierarchyBuilder(FaceBounds[] faces, int? threads) =>
        (_faces, _parallel) = (faces, new() { MaxDegreeOfParallelism = threads ?? -1 });

    /// <summary>Builds the tree.</summary>
    /// <param name="mesh">With at least one face.</param>
    /// <param name="origin">Of the boxes' coordinates.</param>
    /// <param name="scale">By which coordinates are multiplied after that, so that they lie from about −1 to 1.</param>
    /// <param name="threads">At most so many; null for one a core.</param>
    public static HierarchyLayout Build(Mesh mesh, Vector origin, double scale, int? threads = null)
    {
        var faces = GC.AllocateUninitializedArray<FaceBounds>(mesh.FaceCount);
        var builder = new FaceHierarchyBuilder(faces, threads);
        var root = builder.Measure(mesh, origin, scale);
        builder.BuildTop(mesh, root);
        return builder._top;
    }

    private FaceRange Measure(Mesh mesh, Vector origin, double scale)
    {
        var parts = new FaceRange[(_faces.Length + SubtreeFaces - 1) / SubtreeFaces];
        For(parts.Length, part =>
        {
            var start = part * SubtreeFaces;
            parts[part] = Measure(mesh, origin, scale, start, Math.Min(SubtreeFaces, _faces.Length - start));
        });
        return parts.Aggregate((range1, range2) => new(
            0,
            range1.Count + range2.Count,
            range1.Box.Including(range2.Box.Minimum, range2.Box.Maximum),
            range1.Centres.Including(range2.Centres.Minimum, range2.Centres.Maximum)));
    }

    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private FaceRange Measure(Mesh mesh, Vector origin, double scale, int start, int count)
    {
        var positions = mesh.Positions.AsSpan();
        var corners = mesh.Faces.AsSpan();
        var (shift, factor) = (Vector256.Create(origin.X, origin.Y, origin.Z, 0), Vector256.Create(scale));
        var (box, centres) = (BuildBox.Empty, BuildBox.Empty);
        for (var face = start; face < start + count; face++)
        {
            var a = Load(positions, corners[3 * face]);
            var b = Load(positions, corners[(3 * face) + 1]);
            var c = Load(positions, corners[(3 * face) + 2]);
            var minimum = Vector256.MinNative(Vector256.MinNative(a, b), c);
            var maximum = Vector256.MaxNative(Vector256.MaxNative(a, b), c);
            var bounds = new FaceBounds(
                Downwards((minimum - shift) * factor).AsInt32().WithElement(3, face).AsSingle(), Upwards((maximum - shift) * factor));
            _faces[face] = bounds;
            box = box.Including(bounds.Minimum, bounds.Maximum);
            centres = centres.Including(bounds.Centre2, bounds.Centre2);
        }

        return new(start, count, box, centres);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<double> Load(ReadOnlySpan<double> positions, int vertex)
    {
        var v = positions.Slice(3 * vertex, 3);
        return Vector256.Create(v[0], v[1], v[2], 0);
    }

    /// <summary>To single precision and at least one place down.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector128<float> Downwards(Vector256<double> v) => FaceHierarchy.Single(v) switch
    {
        var single => single - FaceHierarchy.LastPlace(single),
    };

    /// <summary>To single precision and at least one place up.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector128<float> Upwards(Vector256<double> v) => FaceHierarchy.Single(v) switch
    {
        var single => single + FaceHierarchy.LastPlace(single),
    };

    /// <summary>Builds level by level while ranges are large, then all subtrees at once, then joins them.</summary>
    private void BuildTop(Mesh mesh, FaceRange root)
    {
        var (level, depth) = (new List<(FaceRange Range, int Slot)> { (root, -1) }, 0);
        var subtrees = new List<(FaceRange Range, int Slot, int Depth)>();
        while (level.Count > 0)
        {
            var large = level.Where(entry => entry.Range.Count > SubtreeFaces).ToArray();
            subtrees.AddRange(level.Where(entry => entry.Range.Count <= SubtreeFaces).Select(entry => (entry.Range, entry.Slot, depth)));
            var divided = new FaceRange[large.Length][];
            For(large.Length, i =>
            {
                Span<FaceRange> children = stackalloc FaceRange[Width];
                divided[i] = children[..Divide(large[i].Range, children, depth, inParallel: true)].ToArray();
            });
            level.Clear();
            for (var i = 0; i < large.Length; i++)
            {
                var node = _top.AddNode(divided[i]);
                _top.SetChild(large[i].Slot, node);
                level.AddRange(divided[i].Select((range, child) => (range, (node * Width) + child)));
            }

            depth++;
        }

        var parts = new HierarchyLayout[subtrees.Count];
        For(parts.Length, i =>
        {
            parts[i] = new();
            BuildSubtree(mesh, parts[i], subtrees[i].Range, -1, subtrees[i].Depth);
        });
        for (var i = 0; i < parts.Length; i++)
        {
            _top.Append(parts[i], subtrees[i].Slot);
        }
    }

    private void BuildSubtree(Mesh mesh, HierarchyLayout layout, FaceRange range, int slot, int depth)
    {
        // The root is a node in any case, so that the search begins at one.
        if (range.Count <= LeafFaces && slot >= 0)
        {
            layout.AddLeaf(slot, mesh, _faces.AsSpan(range.Start, range.Count));
            return;
        }

        Span<FaceRange> children = stackalloc FaceRange[Width];
        children = children[..Divide(range, children, depth, inParallel: false)];
        var node = layout.AddNode(children);
        layout.SetChild(slot, node);
        for (var child = 0; child < children.Length; child++)
        {
            BuildSubtree(mesh, layout, children[child], (node * Width) + child, depth + 1);
        }
    }

    /// <summary>Divides a range into up to eight.</summary>
    /// <returns>How many.</returns>
    private int Divide(FaceRange range, Span<FaceRange> children, int depth, bool inParallel)
    {
        (children[0], var count) = (range, 1);
        if (inParallel)
        {
            // Three rounds of halving; what is left to do after them is little.
            var ranges = new FaceRange[Width];
            ranges[0] = range;
            for (; count < Width && ranges.AsSpan(0, count).ToArray().All(r => r.Count > LeafFaces); count *= 2)
            {
                var halves = count;
                For(halves, i => (ranges[i], ranges[halves + i]) = Split(ranges[i], depth));
            }

            ranges.AsSpan(0, count).CopyTo(children);
        }

        for (; count < Width; count++)
        {
            var largest = LargestToDivide(children[..count], depth);
            if (largest < 0)
            {
                break;
            }

            (children[largest], children[count]) = Split(children[largest], depth);
        }

        return count;
    }

    private static int LargestToDivide(ReadOnlySpan<FaceRange> ranges, int depth)
    {
        var (largest, size) = (-1, -1f);
        for (var i = 0; i < ranges.Length; i++)
        {
            var ownSize = depth < HeuristicLevels ? ranges[i].Box.HalfArea : ranges[i].Count;
            if (ranges[i].Count > LeafFaces && ownSize > size)
            {
                (largest, size) = (i, ownSize);
            }
        }

        return largest;
    }

    // A mesh is built once, often before the tiers of the compiler have warmed up.
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private (FaceRange Left, FaceRange Right) Split(FaceRange range, int depth)
    {
        if (depth >= HeuristicLevels || !TryFindPlane(range, out var axis, out var bin, out var binning))
        {
            return Halve(range);
        }

        var faces = _faces.AsSpan(range.Start, range.Count);
        var (leftBox, leftCentres, rightBox, rightCentres) = (BuildBox.Empty, BuildBox.Empty, BuildBox.Empty, BuildBox.Empty);
        var (left, right) = (0, faces.Length - 1);
        while (left <= right)
        {
            var bounds = faces[left];
            var centre = bounds.Centre2;
            if (binning.BinsOf(centre)[axis] <= bin)
            {
                leftBox = leftBox.Including(bounds.Minimum, bounds.Maximum);
                leftCentres = leftCentres.Including(centre, centre);
                left++;
            }
            else
            {
                rightBox = rightBox.Including(bounds.Minimum, bounds.Maximum);
                rightCentres = rightCentres.Including(centre, centre);
                (faces[left], faces[right]) = (faces[right], bounds);
                right--;
            }
        }

        return (new(range.Start, left, leftBox, leftCentres), new(range.Start + left, range.Count - left, rightBox, rightCentres));
    }

    /// <summary>Divides by number: faces that no plane divides, or a tree that is deep already.</summary>
    private (FaceRange Left, FaceRange Right) Halve(FaceRange range) => (range.Count / 2) switch
    {
        var half => (Around(range.Start, half), Around(range.Start + half, range.Count - half)),
    };

    private FaceRange Around(int start, int count)
    {
        var (box, centres) = (BuildBox.Empty, BuildBox.Empty);
        foreach (var bounds in _faces.AsSpan(start, count))
        {
            box = box.Including(bounds.Minimum, bounds.Maximum);
            centres = centres.Including(bounds.Centre2, bounds.Centre2);
        }

        return new(start, count, box, centres);
    }

    /// <summary>How centres are counted into bins.</summary>
    private readonly record struct Binning(Vector128<float> Minimum, Vector128<float> Factor, Vector128<int> Last)
    {
        public static Binning Of(BuildBox centres, int bins)
        {
            var size = centres.Maximum - centres.Minimum;
            // An axis without extent has one bin; the least floats would make the factor infinite.
            var wide = Vector128.GreaterThan(size, Vector128.Create(1e-30f));
            return new(centres.Minimum, Vector128.Create((float)bins) / size & wide, Vector128.Create(bins - 1));
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Vector128<int> BinsOf(Vector128<float> centre2) => Vector128.Min(
            Vector128.ConvertToInt32Native((centre2 - Minimum) * Factor), Last);
    }

    /// <summary>The plane between two bins with the least expected cost.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private bool TryFindPlane(FaceRange range, out int bestAxis, out int bestBin, out Binning binning)
    {
        var bins = range.Count >= 64 ? Bins : Bins / 2;
        binning = Binning.Of(range.Centres, bins);
        (bestAxis, bestBin) = (-1, -1);
        Span<BuildBox> boxes = stackalloc BuildBox[3 * Bins];
        Span<int> counts = stackalloc int[3 * Bins];
        boxes.Fill(BuildBox.Empty);
        foreach (ref readonly var bounds in _faces.AsSpan(range.Start, range.Count))
        {
            var (minimum, maximum) = (bounds.Minimum, bounds.Maximum);
            var bin = binning.BinsOf(minimum + maximum);
            var (x, y, z) = (bin[0], Bins + bin[1], (2 * Bins) + bin[2]);
            boxes[x] = boxes[x].Including(minimum, maximum);
            boxes[y] = boxes[y].Including(minimum, maximum);
            boxes[z] = boxes[z].Including(minimum, maximum);
            counts[x]++;
            counts[y]++;
            counts[z]++;
        }

        var bestCost = float.PositiveInfinity;
        Span<float> rightCosts = stackalloc float[Bins];
        for (var axis = 0; axis < 3; axis++)
        {
            if (binning.Factor[axis] == 0)
            {
                continue;
            }

            var axisBoxes = boxes.Slice(axis * Bins, bins);
            var axisCounts = counts.Slice(axis * Bins, bins);
            var (box, count) = (BuildBox.Empty, 0);
            for (var bin = bins - 1; bin > 0; bin--)
            {
                box = box.Including(axisBoxes[bin].Minimum, axisBoxes[bin].Maximum);
                count += axisCounts[bin];
                rightCosts[bin] = Cost(box, count);
            }

            (box, count) = (BuildBox.Empty, 0);
            for (var bin = 0; bin < bins - 1; bin++)
            {
                box = box.Including(axisBoxes[bin].Minimum, axisBoxes[bin].Maximum);
                count += axisCounts[bin];
                var cost = Cost(box, count) + rightCosts[bin + 1];
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
    private static float Cost(BuildBox box, int count) => count == 0 ? 0 : box.HalfArea * ((count + LeafFaces - 1) / LeafFaces);

    private void For(int count, Action<int> body)
    {
        if (count == 1)
        {
            body(0);
        }
        else
        {
            Parallel.For(0, count, _parallel, body);
        }
    }
}
