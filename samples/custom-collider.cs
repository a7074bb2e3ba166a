#:project ../FractalEngine.Core/FractalEngine.Core.csproj
#:property PublishAot=false
// Writes a collider of one's own, a smooth sphere by its formula, and measures how far the engine's mesh of a sphere is from it.
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

var smooth = new SphereCollider(radius: 1);
foreach (var subdivisions in (int[])[1, 3, 5])
{
    var mesh = Shapes.Sphere(subdivisions);
    var collider = Collider.For(mesh);
    var random = new Random(1);
    var positions = Enumerable.Range(0, 1000).Select(_ => 2 * new Vector(random.NextDouble(), random.NextDouble(), 1)).ToArray();
    var worst = positions.Max(position => collider.FindClosest(position).Distance - smooth.FindClosest(position).Distance);
    Console.WriteLine(FormattableString.Invariant($"{mesh.FaceCount,6} faces: at most {worst:E2} too far"));
}

/// <summary>A sphere around the origin, without faces.</summary>
internal sealed class SphereCollider(double radius) : Collider
{
    public override bool IsExact => true;
    public override long StorageBytes => sizeof(double);

    protected override bool FindClosestCore(
        Vector position, double maxDistance, double epsilon, QueryContext context, out ClosestPoint closest)
    {
        var normal = position.UnitVector();
        closest = new(
            Math.Abs(position.Length() - radius), radius * normal, normal, Barycentrics: Vector.I, TriangleFeature.Interior, FaceIndex: 0);
        return closest.Distance <= maxDistance;
    }
}

// Output:
//     80 faces: at most 6.57E-002 too far
//   1280 faces: at most 4.36E-003 too far
//  20480 faces: at most 2.78E-004 too far
