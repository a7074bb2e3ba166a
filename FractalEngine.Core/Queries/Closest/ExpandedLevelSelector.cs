using FractalEngine.Core.Bvh;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using BigInteger = System.Numerics.BigInteger;

namespace FractalEngine.Core.Queries.Closest;

/// <summary>Selects the levels of a fractal that are expanded, by the work of sample queries.</summary>
/// <remarks>
/// Work is counted, not timed. Counts are the same on every machine and in every run, and so are the levels and the bits of all results.
/// </remarks>
/// <param name="hierarchy">The sub-fractals of one base mesh, all of whose maps are similarities.</param>
/// <param name="bvh">The hierarchy of the base mesh.</param>
internal sealed class ExpandedLevelSelector(FractalHierarchy hierarchy, TriangleBvh bvh)
{
    // The total of all expanded levels of a fractal.
    private const long MaxBytes = 100_000;

    // What a face and a vertex of an expanded level take, at most.
    private const long BytesPerFace = 80;
    private const long BytesPerVertex = 24;

    // The lowest levels of deeper fractals are below the precision of a result.
    private const long MaxLevels = 64;

    private const int SampleCount = 32;

    // About the nanoseconds on one processor, fitted to fractals of the assets (docs/decisions/0012-one-hierarchy.md).
    private const double SubFractalWork = 50;
    private const double ChildBoundWork = 5;
    private const double MeshSearchWork = 120;
    private const double MeshBoundWork = 3;
    private const double FaceWork = 2.5;

    // Where less is saved, the samples don't tell whether anything is.
    private const double MaxRelativeWork = 0.92;

    private readonly InstanceCounts _instanceCounts = new(hierarchy, static _ => 1);

    /// <summary>Selects the levels that are expanded.</summary>
    /// <param name="hierarchy">The sub-fractals, all of whose maps are similarities.</param>
    /// <param name="bvh">The hierarchy of the base mesh.</param>
    /// <remarks>Cost: up to a few milliseconds.</remarks>
    public static ExpandedLevels Select(FractalHierarchy hierarchy, TriangleBvh bvh) =>
        !hierarchy.HasPicks && hierarchy.Levels is > 0 and <= MaxLevels
            ? new ExpandedLevelSelector(hierarchy, bvh).Select()
            : ExpandedLevels.None;

    /// <summary>Tells whether coordinates are in the range in which they are squared as they are.</summary>
    private static bool IsInRange(BoundingBox box) => !box.IsEmpty && !QueryScale.IsNeeded(box.MaxAbsCoordinate());

    private ExpandedLevels Select()
    {
        // The levels below which a search would not go, for the highest one that is expanded.
        var lowest = new List<long>();
        for (var level = 1L; level <= hierarchy.Levels; level++)
        {
            var levels = FindLevelsUpTo(level);
            if (levels.Sum(MeasureBytes) > MaxBytes || !levels.All(lower => IsInRange(hierarchy.At(lower).Box)))
            {
                break;
            }

            lowest = levels;
        }

        if (lowest.Count == 0 || !IsInRange(hierarchy.Root.Box))
        {
            return ExpandedLevels.None;
        }

        var expanded = new ExpandedSubFractal?[lowest.Max() + 1];
        foreach (var level in lowest)
        {
            expanded[level] = new(hierarchy, bvh.Mesh, level);
        }

        var expandedLevels = new ExpandedLevels(expanded);
        var positions = SamplePositions();
        return MeasureWork(expandedLevels, positions) < MaxRelativeWork * MeasureWork(ExpandedLevels.None, positions)
            ? expandedLevels
            : ExpandedLevels.None;
    }

    /// <summary>Lists the levels that a search enters first of those up to a given one, the base left out.</summary>
    private List<long> FindLevelsUpTo(long maxLevel)
    {
        var found = new List<long>();
        var seen = new HashSet<long> { hierarchy.Levels };
        var open = new Stack<long>(seen);
        while (open.TryPop(out var level))
        {
            if (level > 0 && level <= maxLevel)
            {
                found.Add(level);
            }
            else if (level > 0)
            {
                foreach (var child in hierarchy.At(level).AllChildren())
                {
                    var childLevel = child.RemainingLevels(level);
                    if (seen.Add(childLevel))
                    {
                        open.Push(childLevel);
                    }
                }
            }
        }

        return found;
    }

    /// <summary>Measures the bytes of an expanded level: so many that they are too many, or exactly.</summary>
    private long MeasureBytes(long level) => (long)BigInteger.Min(_instanceCounts.SumAt(level), MaxBytes)
        * ((BytesPerFace * bvh.Mesh.FaceCount) + (BytesPerVertex * bvh.Mesh.VertexCount));

    /// <summary>Makes positions anywhere in the box, and near the surface.</summary>
    private Vector[] SamplePositions()
    {
        var random = new Random(1);
        var box = hierarchy.Root.Box;
        var positions = new Vector[2 * SampleCount];
        for (var i = 0; i < SampleCount; i++)
        {
            positions[i] = box.Minimum + box.Size.Stretch(RandomInCube(random));
            positions[SampleCount + i] = RandomVertex(random) + (0.02 * box.Diagonal * (RandomInCube(random) - (0.5 * Vector.One)));
        }

        return positions;
    }

    private Vector RandomVertex(Random random)
    {
        var map = AffineMap.Identity;
        var level = hierarchy.Levels;
        var subFractal = hierarchy.Root;
        // Some recursives have neither calls nor faces.
        while (level > 0 && subFractal.Children.Length > 0)
        {
            var child = subFractal.Children[random.Next(subFractal.Children.Length)];
            map *= child.Map;
            level = child.RemainingLevels(level);
            subFractal = hierarchy.At(child, level);
        }

        return map * bvh.Mesh.Vertex(random.Next(bvh.Mesh.VertexCount));
    }

    private static Vector RandomInCube(Random random) => new(random.NextDouble(), random.NextDouble(), random.NextDouble());

    private double MeasureWork(ExpandedLevels expandedLevels, Vector[] positions)
    {
        var depthFirst = new DepthFirstSearch<SimilarityFrame, OneBaseMesh>(hierarchy, new(bvh), expandedLevels);
        var magnitude = hierarchy.Root.Box.MaxAbsCoordinate();
        var context = new QueryContext();
        var work = 0.0;
        foreach (var position in positions)
        {
            var search = new FractalSearchState(double.PositiveInfinity, 0, position.MaxAbsComponent(), magnitude, context);
            depthFirst.Run(new(position), ref search);
            work += (SubFractalWork * search.VisitedSubFractals)
                + (ChildBoundWork * (search.BoundTests - search.MeshBoundTests)) + (MeshSearchWork * search.MeshSearches)
                + (MeshBoundWork * search.MeshBoundTests) + (FaceWork * search.FaceTests);
        }

        return work;
    }
}
