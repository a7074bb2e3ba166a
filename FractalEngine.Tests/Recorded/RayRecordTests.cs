using FractalEngine.Core;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Rays;
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
