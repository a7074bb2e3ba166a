using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Views;
using FractalEngine.Core.Visibility;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Visibility.Frames;

/// <summary>Views of fractals, and the instances that are visible in them as plain maps.</summary>
internal static class CullingViews
{
    /// <summary>The settings under which every instance is drawn.</summary>
    public static readonly CullingSettings NoCulling = new()
    {
        MinProjectedSize = 0,
        FrustumCulling = false,
        OcclusionCulling = false,
        ThreadCount = 1,
    };

    public static CulledObject CreateObject(Fractal fractal) => CreateObject(fractal, AffineMap.Identity);

    public static CulledObject CreateObject(Fractal fractal, AffineMap map, int windingSign = 0) =>
        new(LodHierarchy.Build(fractal), map, fractal.BaseMesh.FaceCount == 0 ? Vector.Zero : fractal.BaseMesh.Bounds.Centre, windingSign);

    /// <summary>Creates a view from one position towards another.</summary>
    public static CullingView CreateView(
        Vector from, Vector to, bool isPerspective = true, int width = 160, int height = 120, double near = 0.01, double far = 1e4,
        double halfHeight = 0.5)
    {
        var axes = CameraFraming.LookRotation(to - from).LocalAxes();
        return new(from, axes, isPerspective, halfHeight, width, height, (double)width / height, near, far);
    }

    /// <summary>Creates a view of a whole box from some side.</summary>
    public static CullingView CreateViewOfBox(
        BoundingBox box, Vector direction, bool isPerspective = true, int width = 160, int height = 120)
    {
        var size = Math.Max(box.Diagonal, 1e-300);
        var eye = box.Centre - (1.5 * size * direction.UnitVector());
        return CreateView(eye, box.Centre, isPerspective, width, height, 0.5 * size, 3 * size, isPerspective ? 0.5 : 0.6 * size);
    }

    /// <summary>
    /// Creates a view of a fractal from anywhere: around it, near it, or within it; in both projections; with planes that often clip it.
    /// </summary>
    public static CullingView RandomView(Random random, BoundingBox box, int width = 160, int height = 120)
    {
        var size = box.Diagonal;
        var from = random.Next(4) switch
        {
            0 => box.Centre + (0.5 * box.Size.Stretch(random.Vector())),
            1 => box.Centre + (random.Between(0.3, 0.7) * size * random.Direction()),
            _ => box.Centre + (random.Between(0.8, 3) * size * random.Direction()),
        };
        var to = box.Centre + (0.4 * box.Size.Stretch(random.Vector()));
        var isPerspective = random.Next(3) > 0;
        var near = (random.Next(2) == 0 ? 1e-3 : random.Between(0, 1)) * size;
        var far = near + (random.Between(0.2, 4) * size);
        var halfHeight = isPerspective ? random.Between(0.2, 1) : random.Between(0.1, 0.7) * size;
        return CreateView(from, to, isPerspective, width, height, Math.Max(near, 1e-6 * size), far, halfHeight);
    }

    /// <summary>Lists the visible instances of an object as maps from the base mesh's frame to world axes about the camera.</summary>
    public static List<AffineMap> VisibleMaps(VisibleSet set, CulledObject item, int index = 0)
    {
        var maps = new List<AffineMap>();
        for (var chunk = 0; chunk < VisibleSet.ChunkCount; chunk++)
        {
            var rows = set.Instances(index, chunk);
            for (var i = 0; i < rows.Length; i += VisibleSet.FloatsPerInstance)
            {
                var linear = Matrix.FromRows(
                    new(rows[i], rows[i + 1], rows[i + 2]),
                    new(rows[i + 4], rows[i + 5], rows[i + 6]),
                    new(rows[i + 8], rows[i + 9], rows[i + 10]));
                maps.Add(new(linear, new Vector(rows[i + 3], rows[i + 7], rows[i + 11]) - (linear * item.VertexOrigin)));
            }
        }

        return maps;
    }

    /// <summary>Lists all floats of the visible instances, object after object and chunk after chunk.</summary>
    public static float[] RawInstances(VisibleSet set, int objectCount) =>
    [
        .. from objectIndex in Enumerable.Range(0, objectCount)
           from chunk in Enumerable.Range(0, VisibleSet.ChunkCount)
           from number in set.Instances(objectIndex, chunk).ToArray()
           select number,
    ];

    /// <summary>Lists the distinct instances of an object as maps to world axes about the camera.</summary>
    public static AffineMap[] ExpectedMaps(Fractal fractal, AffineMap map, in CullingView view)
    {
        var objectToCamera = AffineMap.Translate(-view.Position) * map;
        return [.. FractalGenerator.Expand(fractal, 2_000_000).Select(instance => objectToCamera * instance)];
    }

    /// <summary>
    /// Counts for each expected map how often it is visible.
    /// </summary>
    /// <remarks>
    /// Visible maps are in single precision, and were composed in another order: they may differ by a few units in the seventh place of
    /// the largest entry of their kind.
    /// </remarks>
    /// <param name="expected">Maps of all instances.</param>
    /// <param name="visible">Maps of the visible instances, each of which must be among the expected ones.</param>
    public static int[] CountMatches(AffineMap[] expected, IReadOnlyList<AffineMap> visible)
    {
        var length = 1e-300;
        var factor = 1e-300;
        foreach (var map in expected)
        {
            length = Math.Max(length, map.Translation.MaxAbsComponent());
            factor = Math.Max(factor, map.Linear.MaxAbsEntry());
        }

        return CountMatches(expected, visible, 3e-6 * Math.Max(length, factor), 2e-6 * factor);
    }

    /// <summary>Counts for each expected map how often it is visible, within given tolerances.</summary>
    /// <param name="expected">Maps of all instances.</param>
    /// <param name="visible">Maps of the visible instances.</param>
    /// <param name="lengthTolerance">Tolerance of translations.</param>
    /// <param name="factorTolerance">Tolerance of the entries of matrices.</param>
    public static int[] CountMatches(
        AffineMap[] expected, IReadOnlyList<AffineMap> visible, double lengthTolerance, double factorTolerance)
    {
        var order = Enumerable.Range(0, expected.Length).OrderBy(i => expected[i].Translation.X).ToArray();
        var keys = order.Select(i => expected[i].Translation.X).ToArray();
        var counts = new int[expected.Length];
        foreach (var map in visible)
        {
            var index = Array.BinarySearch(keys, map.Translation.X - lengthTolerance);
            var best = -1;
            var minDifference = double.PositiveInfinity;
            for (index = index < 0 ? ~index : index; index < keys.Length && keys[index] <= map.Translation.X + lengthTolerance; index++)
            {
                var other = expected[order[index]];
                var difference = Math.Max(
                    Near.Difference(map.Translation, other.Translation) / lengthTolerance,
                    Near.Difference(map.Linear, other.Linear) / factorTolerance);
                // Among several that are equal within rounding (overlapping instances), the one that has the fewest matches so far.
                if (difference <= 1
                    && (counts[order[index]], difference).CompareTo((best < 0 ? int.MaxValue : counts[best], minDifference)) < 0)
                {
                    best = order[index];
                    minDifference = difference;
                }
            }

            Assert.True(best >= 0, $"{map} is visible, and is no instance");
            counts[best]++;
        }

        return counts;
    }

    /// <summary>
    /// Counts for each expected map the visible ones that take all vertices to the same places as it does, though they may be other maps.
    /// </summary>
    /// <param name="mesh">The base mesh.</param>
    /// <param name="expected">Maps of all instances.</param>
    /// <param name="visible">Maps of the visible instances, each of which must take the vertices to where an expected one does.</param>
    public static int[] CountSameImages(Mesh mesh, AffineMap[] expected, IReadOnlyList<AffineMap> visible)
    {
        var vertices = mesh.VertexIndices.Distinct().Select(mesh.Vertex).ToArray();
        Vector[][] Images(IEnumerable<AffineMap> maps) => [.. maps.Select(map => vertices.Select(vertex => map * vertex).ToArray())];
        var (expectedImages, visibleImages) = (Images(expected), Images(visible));
        // A map's entries are rounded to singles, and its place is that of the middle of the mesh.
        var place = expectedImages.Max(image => image.Max(vertex => vertex.MaxAbsComponent()));
        var tolerance = 3e-6 * Math.Max(place, expected.Max(map => map.Linear.MaxAbsEntry()) * mesh.Bounds.Diagonal);
        var counts = new int[expected.Length];
        for (var i = 0; i < visibleImages.Length; i++)
        {
            var isExpected = false;
            for (var j = 0; j < expectedImages.Length; j++)
            {
                var isSame = true;
                for (var k = 0; isSame && k < vertices.Length; k++)
                {
                    isSame = Near.Difference(visibleImages[i][k], expectedImages[j][k]) <= tolerance;
                }

                counts[j] += isSame ? 1 : 0;
                isExpected |= isSame;
            }

            Assert.True(isExpected, $"{visible[i]} is visible, and is no instance");
        }

        return counts;
    }

    /// <summary>Fails unless each expected map is visible exactly once.</summary>
    public static void AssertEachVisibleOnce(AffineMap[] expected, IReadOnlyList<AffineMap> visible)
    {
        var counts = CountMatches(expected, visible);
        var missing = counts.Count(count => count == 0);
        var repeated = counts.Count(count => count > 1);
        Assert.True(
            missing + repeated == 0, $"{visible.Count} of {expected.Length} instances: {missing} are missing, {repeated} are repeated");
    }

    /// <summary>Creates a Menger sponge of twenty maps, from −1 to 1 along each axis.</summary>
    /// <remarks>
    /// Its instances differ by more than rounding, so that <see cref="CountMatches(AffineMap[], IReadOnlyList{AffineMap})"/> tells them
    /// apart.
    /// </remarks>
    public static Fractal Menger(int? depth)
    {
        var maps = from x in (int[])[-1, 0, 1]
                   from y in (int[])[-1, 0, 1]
                   from z in (int[])[-1, 0, 1]
                   where Math.Abs(x) + Math.Abs(y) + Math.Abs(z) >= 2
                   select Samples.MoveAndScale(2 * x / 3.0, 2 * y / 3.0, 2 * z / 3.0, 1 / 3.0);
        return new(new([new Repetition([new TransformationSet([.. maps])], depth)]), Cube);
    }

    /// <summary>A cube from −1 to 1 along each axis, wound outwards.</summary>
    public static Mesh Cube { get; } = new(
        [-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1, -1, -1, 1, 1, -1, 1, -1, 1, 1, 1, 1, 1],
        [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 4, 2, 4, 6, 2, 1, 3, 5, 3, 7, 5, 2, 6, 3, 3, 6, 7, 0, 1, 4, 1, 5, 4]);
}
