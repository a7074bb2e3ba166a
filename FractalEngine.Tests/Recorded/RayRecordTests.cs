using FractalEngine.Core;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Recorded;

/// <summary>Records what rays hit, with what they cost.</summary>
public class RayRecordTests
{
    private const int RayCount = 60;

    [Fact]
    public void Rays_AtFractals_AreAsRecorded() => RecordedText.Check(
        "rays.txt",
        RecordedShapes.Fractals().Select(shape => Line(
            shape.Name, () => RayCaster.For(shape.Fractal), shape.Fractal.Bounds, RecordedShapes.TargetsOf(shape.Fractal))));

    [Fact]
    public void Rays_AtMeshes_AreAsRecorded() => RecordedText.Check(
        "mesh-rays.txt",
        RecordedShapes.Meshes().Select(shape => Line(
            shape.Name, () => RayCaster.For(shape.Mesh), shape.Mesh.Bounds, RecordedShapes.TargetsOf(shape.Mesh))));

    /// <summary>Rays at corners and edges, along edges and faces, from faces and from far away, to a face and from it on.</summary>
    [Fact]
    public void Rays_AtEdgesOfAllShapes_AreAsRecorded() => RecordedText.Check("edge-rays.txt", RecordedShapes.Faces().Select(EdgeLine));

    private static string EdgeLine((string Name, Model Model, Func<Random, (Vector A, Vector B, Vector C)> Face) shape)
    {
        RayCaster caster;
        try
        {
            caster = shape.Model.CreateRayCaster();
        }
        catch (FractalEngineException exception)
        {
            return $"{shape.Name}: {exception.Message.Split('\n')[0]}";
        }

        var context = new QueryContext();
        var random = new Random(5);
        double size = shape.Model.Bounds.Diagonal;
        bool isInfinite = shape.Name.StartsWith("infinite", StringComparison.Ordinal);
        var (places, hits, shadows) = (new Digest(), 0, 0);
        for (int i = 0; i < RayCount; i++)
        {
            var (a, b, c) = shape.Face(random);
            var middle = (1 / 3.0) * (a + b + c);
            var outside = middle + (size * random.Direction());
            var normal = Vector.Cross(b - a, c - a);
            var axis = (i / 12 % 3) switch { 0 => Vector.I, 1 => Vector.J, _ => Vector.K };
            var (origin, direction) = (i % 12) switch
            {
                0 => (outside, a - outside),
                1 => (outside, (0.5 * (a + b)) - outside),
                2 => (a - (2 * (b - a)), b - a),
                3 => (middle + (3 * (middle - b)), (middle - c) + (middle - a)),
                4 => (a - (size * axis), axis),
                5 => (middle, normal),
                6 => (middle + (1e6 * (outside - middle)), middle - outside),
                7 or 8 => (outside, middle - outside),
                9 => (b, c - b),
                10 => (outside, b + (0.3 * (c - b)) - outside),
                _ => (middle - (1e-3 * normal), normal + (1e-4 * normal.Length() * random.Direction())),
            };
            if (direction == Vector.Zero)
            {
                continue;
            }

            double length = (middle - origin).Length() / direction.Length();
            var ray = new Ray(origin, i % 3 == 0 ? direction : 1 / direction.Length() * direction);
            var (least, most) = (i % 12) switch
            {
                7 => (0, length * direction.Length()),
                8 => (length * direction.Length(), double.PositiveInfinity),
                _ => (0, double.PositiveInfinity),
            };
            var footprint = isInfinite || i % 12 == 10 ? new RayFootprint(1e-4 * size, 0.01) : default;
            if (caster.TryFindNearest(ray, context, out var hit, least, most, footprint))
            {
                hits++;
                places.Add(hit.Distance).Add(hit.Point);
            }

            shadows += caster.HitsAny(ray, context, least, most, footprint) ? 1 : 0;
        }

        return $"{shape.Name}: {hits} hits, {shadows} shadows {places}, "
            + $"{context.Statistics.FaceTests} faces, {context.Statistics.BoundTests} bounds";
    }

    private static string Line(string name, Func<RayCaster> create, BoundingBox box, Func<Random, Vector> targetOf)
    {
        RayCaster caster;
        try
        {
            caster = create();
        }
        catch (FractalEngineException exception)
        {
            return $"{name}: {exception.Message.Split('\n')[0]}";
        }

        var context = new QueryContext();
        var (points, places, paths, maps) = (new Digest(), new Digest(), new Digest(), new Digest());
        var (hits, shadows) = (0, 0);
        var random = new Random(3);
        double size = box.Diagonal;
        for (int i = 0; i < RayCount; i++)
        {
            var target = i % 4 == 0 ? box.Centre + (0.5 * random.Vector().Stretch(box.Size)) : targetOf(random);
            var origin = i % 6 == 5 ? box.Centre + (0.4 * random.Vector().Stretch(box.Size)) : box.Centre + (size * random.Direction());
            var axis = (i / 10 % 3) switch { 0 => Vector.I, 1 => Vector.J, _ => Vector.K };
            var direction = i % 10 == 9 ? (i % 20 == 9 ? -1 : 1) * axis : target - origin;
            var ray = new Ray(i % 10 == 9 ? target - (size * direction) : origin, random.Between(0.1, 10) * direction);
            bool isWide = i % 5 == 4 || name.StartsWith("infinite", StringComparison.Ordinal);
            var footprint = isWide ? new RayFootprint(1e-4 * size, 0.01) : default;
            var (least, most) = i % 4 == 3 ? (0.3 * size, 1.1 * size) : (0, double.PositiveInfinity);
            if (caster.TryFindNearest(ray, context, out var hit, least, most, footprint))
            {
                hits++;
                points.Add(hit.Distance).Add(hit.Point).Add(hit.Normal);
                places.Add(hit.Barycentrics).Add(hit.FaceIndex).Add(hit.IsFrontFace ? 1 : 0);
                paths.Add(context.InstancePath);
                maps.Add(hit.InstanceMap);
            }

            shadows += caster.HitsAny(ray, context, least, most, footprint) ? 1 : 0;
        }

        return $"{name}: {caster.StorageBytes} bytes, {hits} hits, {shadows} shadows {points} {places} {paths} {maps}, "
            + $"{context.Statistics.FaceTests} faces, {context.Statistics.BoundTests} bounds";
    }
}
