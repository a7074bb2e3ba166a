using System.Globalization;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Bvh;
using FractalEngine.Core.Bvh.Boxes;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Bvh;

/// <summary>Triangles in single precision against the kernel in double precision.</summary>
public class TriangleFramesTests
{
    /// <summary>The bound that <see cref="FloatCutoff"/> takes, of which a search relies on every bit.</summary>
    [Fact]
    public void DistancesSquared_OfAnyTriangles_AreWrongByLessThanTheProvedBound() => Seeded.Run(2000, random =>
    {
        var triangles = Enumerable.Range(0, random.Next(1, 9)).Select(_ => RandomTriangle(random)).ToArray();
        var mesh = MeshOf(triangles);
        var rows = new float[(TriangleFrames.Rows * triangles.Length) + 8];
        var longestEdge = TriangleFrames.Write(mesh, Vector.Zero, 1, [.. Enumerable.Range(0, triangles.Length)], rows);
        for (var i = 0; i < 20; i++)
        {
            var (a, b, c) = triangles[random.Next(triangles.Length)];
            var position = AdversarialTriangle.RandomPosition(random, a, b, c);
            position = position.MaxAbsComponent() < 256 ? position : 256 * AdversarialTriangle.RandomInCube(random);
            var distancesSquared = TriangleFrames.DistancesSquared(
                ref rows[0], triangles.Length, Vector256.Create((float)position.X), Vector256.Create((float)position.Y),
                Vector256.Create((float)position.Z));
            for (var lane = 0; lane < triangles.Length; lane++)
            {
                (a, b, c) = triangles[lane];
                var expected = Math.Sqrt(TriangleKernel.ClosestPoint(position, a, b, c).DistanceSquared);
                var error = Math.Abs(Math.Sqrt(distancesSquared[lane]) - expected);
                var bound = FloatCutoff.ErrorBound(position.MaxAbsComponent(), longestEdge, 1e-12, expected);
                Assert.True(error <= bound, string.Create(
                    CultureInfo.InvariantCulture, $"{triangles[lane]} from {position}: wrong by {error:R}, more than {bound:R}"));
            }
        }
    });

    /// <summary>Draws a triangle of the box from −2 to 2, which meshes are scaled to.</summary>
    private static (Vector A, Vector B, Vector C) RandomTriangle(Random random)
    {
        while (true)
        {
            var (_, a, b, c) = AdversarialTriangle.Random(random);
            var magnitude = Math.Max(a.MaxAbsComponent(), Math.Max(b.MaxAbsComponent(), c.MaxAbsComponent()));
            if (magnitude is 0 or > 1e40 or < 1e-40)
            {
                continue;
            }

            var scale = 2 / magnitude * (random.Next(2) == 0 ? 1 : Math.Pow(10, -random.Next(0, 12)));
            var offset = (2 - (scale * magnitude)) * AdversarialTriangle.RandomInCube(random);
            return ((scale * a) + offset, (scale * b) + offset, (scale * c) + offset);
        }
    }

    private static Mesh MeshOf((Vector A, Vector B, Vector C)[] triangles) => new(
        [.. triangles.SelectMany(triangle => new[] { triangle.A, triangle.B, triangle.C }).SelectMany(v => new[] { v.X, v.Y, v.Z })],
        [.. Enumerable.Range(0, 3 * triangles.Length)]);
}
