using FractalEngine.Core;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Recorded;

/// <summary>Records closest points, regions and pairs with what they cost.</summary>
public class QueryRecordTests
{
    private const int PositionCount = 24;
    private const int MaxExpanded = 20_000;

    // Of the pairs that meet the limit of work, one is quick enough for the default run.
    private static readonly string[] WithLongPairs =
    [
        "appendix-b.fdo", "terrain.fdo", "infinite-menger.fdo", "appendix-b-structure.fdo", "googol.fdo", "mesh 4",
    ];

    [Fact]
    public void Queries_OfFractals_AreAsRecorded() =>
        RecordedText.Check("queries.txt", RecordedShapes.Fractals().SelectMany(shape => Lines(
            shape.Name, kind => Collider.For(shape.Fractal, kind), shape.Fractal.Bounds, RecordedShapes.TargetsOf(shape.Fractal),
            shape.Fractal.FaceCount > MaxExpanded)));

    [Fact]
    public void Queries_OfMeshes_AreAsRecorded() =>
        RecordedText.Check("mesh-queries.txt", RecordedShapes.Meshes().SelectMany(shape => Lines(
            shape.Name, kind => Collider.For(shape.Mesh, kind), shape.Mesh.Bounds, RecordedShapes.TargetsOf(shape.Mesh), false)));

    [Fact]
    public void Regions_AreAsRecorded() =>
        RecordedText.Check("regions.txt", All().Select(shape => RegionLine(shape.Name, shape.Collider, shape.Box, shape.Target)));

    [Fact]
    public void Pairs_AreAsRecorded() => RecordedText.Check("pairs.txt", PairLines(static name => !WithLongPairs.Contains(name)));

    [Fact]
    [Trait("Category", "Soak")]
    public void Pairs_ThatMeetTheLimitOfWork_AreAsRecorded() => RecordedText.Check("long-pairs.txt", PairLines(WithLongPairs.Contains));

    private static IEnumerable<string> PairLines(Func<string, bool> isChosen)
    {
        // Pairs of fractals without end go on until their limit of work.
        var all = All().Where(shape => !shape.Name.StartsWith("infinite ", StringComparison.Ordinal)).ToList();
        return all.Index().Where(shape => isChosen(shape.Item.Name))
            .Select(shape => PairLine(shape.Item, all[((shape.Index * 11) + 5) % all.Count], shape.Index));
    }

    /// <summary>Positions at corners, on edges and faces, above them, and far away; radii that just reach a face, or just don't.</summary>
    [Fact]
    public void Queries_AtEdgesOfAllShapes_AreAsRecorded() =>
        RecordedText.Check("edge-queries.txt", RecordedShapes.Faces().Select(EdgeLine));

    private static string EdgeLine((string Name, Model Model, Func<Random, (Vector A, Vector B, Vector C)> Face) shape)
    {
        Collider collider;
        try
        {
            collider = shape.Model.CreateCollider();
        }
        catch (FractalEngineException exception)
        {
            return $"{shape.Name}: {exception.Message.Split('\n')[0]}";
        }

        var context = new QueryContext();
        var random = new Random(6);
        double size = shape.Model.Bounds.Diagonal;
        var (places, bounds, found, overlaps) = (new Digest(), new Digest(), 0, 0);
        for (int i = 0; i < PositionCount; i++)
        {
            var (a, b, c) = shape.Face(random);
            var middle = (1 / 3.0) * (a + b + c);
            var normal = Vector.Cross(b - a, c - a);
            var position = (i % 8) switch
            {
                0 => a,
                1 => 0.5 * (a + b),
                2 => middle,
                3 => middle + (0.5 / Math.Sqrt(Math.Max(normal.Length(), 1e-300)) * normal),
                4 => b + (1e-9 * (b - middle)),
                5 => middle + (1e6 * size * random.Direction()),
                6 => a + (1e-13 * size * random.Direction()),
                _ => middle + (0.1 * size * random.Direction()),
            };
            bool isFound = collider.TryFindClosest(position, double.PositiveInfinity, context, out var closest);
            if (!isFound)
            {
                continue;
            }

            places.Add(closest.Distance).Add(closest.Point);
            bounds.AddBound(closest.ErrorBound);
            foreach (double factor in (double[])[1 - 1e-9, 1, 1 + 1e-9])
            {
                found += collider.TryFindClosest(position, factor * closest.Distance, context, out _) ? 1 : 0;
                overlaps += collider.Overlaps(position, factor * closest.Distance, context) ? 1 : 0;
            }
        }

        return $"{shape.Name}: {found} found, {overlaps} overlaps {places} bounds {bounds}{Work(context)}";
    }

    private static IEnumerable<(string Name, Collider Collider, BoundingBox Box, Func<Random, Vector> Target)> All() =>
        [
            .. RecordedShapes.Fractals().Where(shape => shape.Fractal.Description.Composition == Composition.Affine)
                .Select(shape => (shape.Name, Collider.For(shape.Fractal), shape.Fractal.Bounds, RecordedShapes.TargetsOf(shape.Fractal))),
            .. RecordedShapes.Meshes()
                .Select(shape => (shape.Name, Collider.For(shape.Mesh), shape.Mesh.Bounds, RecordedShapes.TargetsOf(shape.Mesh))),
        ];

    private static IEnumerable<string> Lines(
        string name, Func<ColliderKind, Collider> create, BoundingBox box, Func<Random, Vector> target, bool isLarge)
    {
        var kinds = Enum.GetValues<ColliderKind>().Where(kind => !isLarge || kind is ColliderKind.Exact or ColliderKind.Fractal);
        foreach (var kind in kinds)
        {
            string line;
            try
            {
                line = QueryLine(create(kind), box, target);
            }
            catch (FractalEngineException exception)
            {
                line = exception.Message.Split('\n')[0];
            }

            yield return $"{name}, {kind}: {line}";
        }
    }

    private static string QueryLine(Collider collider, BoundingBox box, Func<Random, Vector> target)
    {
        var context = new QueryContext();
        var (points, normals, places, paths) = (new Digest(), new Digest(), new Digest(), new Digest());
        var (errors, allowed) = (new Digest(), new Digest());
        int found = 0;
        var positions = RecordedShapes.Positions(target, box, 1, collider.IsExact ? PositionCount : PositionCount / 3);
        for (int i = 0; i < positions.Length; i++)
        {
            double radius = i % 3 == 1 ? 0.2 * box.Diagonal : double.PositiveInfinity;
            double epsilon = collider.IsExact && i % 4 == 3 ? 0.3 : 0;
            if (collider.TryFindClosest(positions[i], radius, context, out var closest, epsilon))
            {
                found++;
                points.Add(closest.Distance).Add(closest.Point);
                normals.Add(closest.Normal);
                places.Add(closest.Barycentrics).Add((int)closest.Feature).Add(closest.FaceIndex);
                paths.Add(context.InstancePath);
                (epsilon == 0 ? errors : allowed).AddBound(closest.ErrorBound);
            }
        }

        return $"{collider.StorageBytes} bytes, {found} found {points} {normals} {places} {paths} errors {errors} {allowed}"
            + Work(context);
    }

    private static string RegionLine(string name, Collider collider, BoundingBox box, Func<Random, Vector> target)
    {
        var context = new QueryContext();
        var (all, overlaps) = (new Digest(), new Digest());
        int count = 0;
        foreach (var position in RecordedShapes.Positions(target, box, 2, 6))
        {
            double radius = 0.02 * box.Diagonal;
            try
            {
                foreach (var hit in collider.FindAllWithin(position, radius, 3000, context))
                {
                    count++;
                    all.Add(hit.Distance).Add(hit.Point).Add(hit.Normal).Add(hit.FaceIndex).Add(hit.InstancePath.AsSpan());
                }
            }
            catch (FractalLimitException)
            {
                all.Add(-1);
            }

            var around = new BoundingBox(position - (radius * Vector.One), position + (2 * radius * Vector.One));
            overlaps.Add(collider.Overlaps(position, radius, context) ? 1 : 0).Add(collider.Overlaps(around, context) ? 1 : 0);
        }

        return $"{name}: {count} within {all} overlaps {overlaps}{Work(context)}";
    }

    private static string PairLine(
        (string Name, Collider Collider, BoundingBox Box, Func<Random, Vector> Target) first,
        (string Name, Collider Collider, BoundingBox Box, Func<Random, Vector> Target) second,
        int seed)
    {
        var random = new Random(seed);
        var context = new QueryContext();
        var (points, paths, errors) = (new Digest(), new Digest(), new Digest());
        for (int i = 0; i < 2 && context.Statistics.FaceTests < 5_000; i++)
        {
            // These are of about the same size, beside each other.
            double scale = first.Box.Diagonal / second.Box.Diagonal;
            var turned = scale * random.Transformation().ToAffineMap().Linear;
            var place = first.Target(random) + (first.Box.Diagonal * random.Between(0, 0.3) * random.Direction());
            var placement = new AffineMap(turned, place - (turned * second.Target(random)));
            try
            {
                var pair = first.Collider.FindClosestPair(second.Collider, placement, context);
                points.Add(pair.Distance).Add(pair.Point).Add(pair.OtherPoint);
                paths.Add(pair.FaceIndex).Add(pair.OtherFaceIndex).Add(pair.InstancePath.AsSpan()).Add(pair.OtherInstancePath.AsSpan());
                errors.AddBound(pair.ErrorBound);
            }
            catch (FractalEngineException exception)
            {
                return $"{first.Name}, {second.Name}: {exception.Message.Split('\n')[0]}";
            }
        }

        return $"{first.Name}, {second.Name}: {points} {paths} errors {errors}{Work(context)}";
    }

    private static string Work(QueryContext context) => $", {context.Statistics.FaceTests} faces, {context.Statistics.BoundTests} bounds";
}
