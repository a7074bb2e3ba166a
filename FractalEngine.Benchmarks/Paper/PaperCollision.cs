using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Benchmarks.Paper;

/// <summary>
/// Tests that the colliders make in a query near the surface of a model, and how often the two approximate ones are wrong.
/// </summary>
/// <param name="SimpleFaceTests">Face tests of the simple collider.</param>
/// <param name="FractalFaceTests">Face tests of the fractal collider; null for a mesh.</param>
/// <param name="BoundingBoxFaceTests">
/// Face tests of the bounding box collider, counted as the paper counts: see <see cref="BoundingBoxCollider"/>.
/// </param>
/// <param name="OctreeDepth">Number of levels of the octree.</param>
/// <param name="OwnFaceTests">
/// Face tests of the engine's own collider: the hierarchy for a mesh, the exact one for a fractal.
/// </param>
/// <param name="OwnBoundTests">Bound tests of the engine's own collider.</param>
/// <param name="FractalWrongPercent">
/// Percent of the fractal collider's results that are off by more than 1e-6 of the size; null for a mesh.
/// </param>
/// <param name="BoundingBoxWrongPercent">Percent of the bounding box collider's results that are off by as much.</param>
internal sealed record PaperCollision(
    double SimpleFaceTests, double? FractalFaceTests, double BoundingBoxFaceTests, int OctreeDepth, double OwnFaceTests,
    double OwnBoundTests, double? FractalWrongPercent, double BoundingBoxWrongPercent)
{
    private const int Queries = 1000;
    private const int SimpleQueries = 2;
    private const int MaxFaces = 50_000_000;

    // As a fraction of the size.
    private const double MaxRelativeError = 1e-6;

    /// <summary>
    /// Counts the tests. Fractals are expanded for the colliders that know only meshes, which takes a few GB for the largest.
    /// </summary>
    public static PaperCollision Measure(Model model)
    {
        var fractal = (model as FractalModel)?.Fractal;
        var random = new Random(1);
        Func<Vector> nextPosition = fractal is null
            ? () => QueryPositions.NearSurface(random, model.Mesh)
            : () => QueryPositions.NearSurface(random, fractal);
        var positions = Enumerable.Range(0, Queries).Select(_ => nextPosition()).ToArray();
        var mesh = fractal is null ? model.Mesh : FractalGenerator.Flatten(fractal, MaxFaces);
        var boxes = new BoundingBoxCollider(mesh);
        Collider own = fractal is null ? new HierarchyCollider(mesh) : new ExactFractalCollider(fractal);
        var ownWorkload = new ColliderWorkload(own, positions);
        var greedy = fractal is null ? null : new FractalCollider(fractal);
        return new(
            new ColliderWorkload(new SimpleCollider(mesh), positions[..SimpleQueries]).FaceTests,
            greedy is null ? null : new ColliderWorkload(greedy, positions).FaceTests,
            new ColliderWorkload(boxes, positions).FaceTests,
            boxes.Depth,
            ownWorkload.FaceTests,
            ownWorkload.BoundTests,
            greedy is null ? null : MeasureWrongPercent(greedy, own, positions, model.Bounds),
            MeasureWrongPercent(boxes, own, positions, model.Bounds));
    }

    private static double MeasureWrongPercent(Collider collider, Collider exact, Vector[] positions, BoundingBox bounds)
    {
        var context = new QueryContext();
        var maxError = MaxRelativeError * bounds.Diagonal;
        var wrongCount = positions.Count(position =>
            Math.Abs(collider.ClosestDistance(position, context) - exact.ClosestDistance(position, context)) > maxError);
        return Math.Round(100.0 * wrongCount / positions.Length, 3);
    }
}
