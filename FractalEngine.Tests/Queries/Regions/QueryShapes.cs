using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Queries.Closest;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Queries.Regions;

/// <summary>Draws meshes and fractals of all sorts, with few enough triangles to test all of them, and positions around them.</summary>
internal static class QueryShapes
{
    private static readonly string[] SmallMeshes =
        ["one face", "five faces", "nine faces", "fifty faces", "sixty-five faces", "soup of large faces", "tiny soup", "huge soup",
        "needles", "coincident faces", "points", "sizes from 1e-15 to 1", "soup far away"];

    private static readonly string[] Adversarial = [.. AdversarialFractals.All.Keys];

    public static (Fractal Fractal, Collider Collider) Create(Random random, int maxTriangles = 2000)
    {
        if (random.Next(4) == 0)
        {
            var mesh = CollisionMeshes.All[SmallMeshes[random.Next(SmallMeshes.Length)]]();
            return (Fractal.Of(mesh), random.Next(3) == 0 ? new SimpleCollider(mesh) : new HierarchyCollider(mesh));
        }

        var fractal = CreateFractal(random, maxTriangles);
        return (fractal, new ExactFractalCollider(fractal));
    }

    /// <summary>A position on a triangle, close to one, among them or anywhere.</summary>
    public static Vector Position(Random random, ShapeExpansion shape)
    {
        if (shape.Triangles.Length == 0)
        {
            return random.Vector(2);
        }

        var triangle = shape.Triangles[random.Next(shape.Triangles.Length)];
        var (u, v) = random.Barycentrics();
        var point = triangle.A + (u * (triangle.B - triangle.A)) + (v * (triangle.C - triangle.A));
        return random.Next(5) switch
        {
            0 => triangle.A,
            1 => point,
            2 => point + (Math.Pow(10, -random.Next(0, 14)) * random.Vector(triangle.Reach)),
            3 => point + random.Vector((triangle.B - triangle.A).Length()),
            _ => shape.Magnitude * random.Vector(2),
        };
    }

    private static Fractal CreateFractal(Random random, int maxTriangles)
    {
        for (; ; )
        {
            var fractal = random.Next(4) switch
            {
                0 => AdversarialFractals.All[Adversarial[random.Next(Adversarial.Length)]](),
                1 => RandomFractals.Create(random),
                _ => RandomAdversarialFractals.Create(random),
            };
            if (fractal.FaceCount <= maxTriangles)
            {
                return fractal;
            }
        }
    }
}
