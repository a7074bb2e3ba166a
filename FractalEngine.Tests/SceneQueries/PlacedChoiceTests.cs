using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.SceneQueries;

/// <summary>Tests that a fractal that decides by places, sizes or levels decides alike wherever it stands, against its mesh.</summary>
public sealed class PlacedChoiceTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public static TheoryData<string> Texts =>
    [
        "z<box>. [((1, 1, 0), #, (0.5)), ((-1, 1, 0), #, (0.5))] box\n<$>. z until 0.5",
        "z<box>. [((1, 1, 0), #, (0.5)), ((-1, 1, 0), #, (0.5))] box\n<$>. z until 3",
        "z<box>. [((1, 1, 0), (0, 30, 0), (0.6)), ((-1, 1, 0), #, (0.3, 0.5, 0.4))] box\n<$>. [((2, 0, 0), #, (2))] z until 0.4",
        "seed 2\nz<box>. 1: [((-2, 0, 0), #, (0.5)), ((2, 0, 0), #, (0.5))] box | 1: ball + [((0, 2, 0), #, (0.6))] box\n<$>. z 4",
        "z<box>. level 0..1: [((-2, 0, 0), #, (0.5)), ((2, 0, 0), #, (0.5))] box | 2..: [((0, 2, 0), #, (0.6))] box\n<$>. z 4",
    ];

    public void Dispose() => _folder.Dispose();

    [Theory]
    [MemberData(nameof(Texts))]
    public void Queries_OfAPlacedFractal_AreThoseOfItsMesh(string text)
    {
        var fractal = FractalFile.Read(_folder.Write("a.fdo", text + "\n"));
        var parts = fractal.ByMesh.Select(static part => part.Flatten(100_000)).ToArray();
        Seeded.Run(30, random =>
        {
            // Similar, mirrored, skewed by two turns, tiny and large.
            var scale = Math.Pow(10, random.Between(-3, 3));
            var placement = new Transformation(
                random.Vector(3 * scale), random.Vector(180),
                scale * (random.Next(2) == 0 ? Vector.One : new Vector(random.Between(0.3, 2), -1, random.Between(0.3, 2))));
            var levels = new Scene { Objects = [new SceneObject(fractal) { Placement = placement }] };
            var flat = new Scene { Objects = [.. parts.Select(mesh => new SceneObject(mesh) { Placement = placement })] };
            var (caster, expectedCaster) = (new SceneRayCaster(levels), new SceneRayCaster(flat));
            var (collider, expectedCollider) = (new SceneCollider(levels), new SceneCollider(flat));
            var map = placement.ToAffineMap();
            for (var i = 0; i < 20; i++)
            {
                var mesh = parts[random.Next(parts.Length)];
                var (a, b, c) = mesh.Face(random.Next(mesh.FaceCount));
                var from = map * random.Vector(4);
                var ray = new Ray(from, (map * ((1.0 / 3) * (a + b + c))) - from);
                Assert.True(expectedCaster.TryFindNearest(ray, new QueryContext(), out var expected));
                Assert.True(caster.TryFindNearest(ray, new QueryContext(), out var hit));
                Near.Equal(1, hit.Distance / expected.Distance, 1e-9);
                Near.Equal(
                    expectedCollider.FindClosest(from).Distance, collider.FindClosest(from).Distance, 1e-9 * scale);
            }
        });
    }
}
