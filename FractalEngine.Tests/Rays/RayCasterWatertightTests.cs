using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Rays;

/// <summary>
/// Tests that no ray leaks through a closed surface, also where it is aimed at edges and vertices, and where instances share them.
/// </summary>
public class RayCasterWatertightTests
{
    private const int Rays = 4000;
    private const int SoakRays = 400_000;

    // A unit square of two triangles, which instances tile.
    private static readonly Mesh Square = new([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0], [0, 1, 2, 0, 2, 3]);

    /// <summary>Closed surfaces around the origin.</summary>
    public static TheoryData<string> Solids => ["icosphere", "skewed icosphere", "rotated cube", "needle", "far"];

    /// <summary>Placements of a tiled square: nothing is as exact as the first.</summary>
    public static TheoryData<string> Placements => ["none", "rotated", "skewed", "mirrored", "thirds", "far", "needles", "returned"];

    [Theory]
    [MemberData(nameof(Solids))]
    public void Rays_FromInsideASolid_AllHit(string name) => CheckSolid(name, 1, Rays);

    [Theory]
    [MemberData(nameof(Solids))]
    [Trait("Category", "Soak")]
    public void Rays_FromInsideASolidForLong_AllHit(string name) => CheckSolid(name, 2, SoakRays);

    [Theory]
    [MemberData(nameof(Placements))]
    public void Rays_AtTilesOfAFractal_AllHit(string name) => CheckTiles(name, 1, Rays);

    [Theory]
    [MemberData(nameof(Placements))]
    [Trait("Category", "Soak")]
    public void Rays_AtTilesOfAFractalForLong_AllHit(string name) => CheckTiles(name, 2, SoakRays);

    [Fact]
    public void Rays_AtASurfaceOfManyTinyFaces_CountEvenlyThroughASolid()
    {
        // A ray from outside enters and leaves: walking from hit to hit, the sides alternate.
        var mesh = MeshGenerators.Create("icosphere", 1, 1280);
        var caster = RayCaster.For(mesh);
        var context = new QueryContext();
        Seeded.Run(300, random =>
        {
            var target = 0.5 * random.Vector();
            var origin = 3 * mesh.Bounds.Diagonal * random.Direction();
            var ray = new Ray(origin, target - origin);
            var sides = new List<bool>();
            for (var start = 0.0; caster.TryFindNearest(ray, context, out var hit, start); start = hit.Distance + 1e-9)
            {
                sides.Add(hit.IsFrontFace);
            }

            Assert.Equal([true, false], sides);
        });
    }

    private static void CheckSolid(string name, int seed, int rays)
    {
        var mesh = CreateSolid(name);
        RayCaster[] casters =
        [
            RayCaster.For(mesh),
            RayCaster.For(Fractal.Of(mesh).Apply([new(Vector.Zero, new(10, 20, 30), new(0.9, 0.9, -0.9))])),
        ];
        AffineMap[] maps = [AffineMap.Identity, new Transformation(Vector.Zero, new(10, 20, 30), new(0.9, 0.9, -0.9)).ToAffineMap()];
        var context = new QueryContext();
        var centre = mesh.Bounds.Centre;
        var reach = Math.Max(mesh.Bounds.Minimum.MaxAbsComponent(), mesh.Bounds.Maximum.MaxAbsComponent());
        Seeded.RunOne(seed, random =>
        {
            for (var i = 0; i < rays; i++)
            {
                var (a, b, c) = mesh.Face(random.Next(mesh.FaceCount));
                var target = random.Next(3) switch
                {
                    0 => a,
                    1 => b + (random.NextDouble() * (c - b)),
                    _ => 0.5 * (c + a),
                };
                var kind = random.Next(casters.Length);
                var origin = maps[kind] * (random.Next(2) == 0 ? centre : centre + (random.Between(0, 0.1) * (target - centre)));
                var ray = new Ray(origin, (maps[kind] * target) - origin);
                Assert.True(casters[kind].TryFindNearest(ray, context, out var hit), $"{kind}: {ray} leaks");
                Assert.True(casters[kind].HitsAny(ray, context), $"{kind}: {ray} leaks");
                AssertDistance(ray, hit, reach);
            }
        });
    }

    /// <summary>Fails unless a ray to a target hits there. At a low angle, a coordinate that is off moves the hit along the ray.</summary>
    private static void AssertDistance(Ray ray, RayHit hit, double reach)
    {
        var sine = Math.Abs(Vector.Dot(hit.Normal, ray.Direction.UnitVector()));
        Near.Equal(ray.Direction.Length(), hit.Distance, 1e-13 * reach / sine);
    }

    private static Mesh CreateSolid(string name)
    {
        var sphere = MeshGenerators.Create("icosphere", 1, 1280);
        Mesh cube = new(
            [-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1],
            [0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 2, 3, 7, 2, 7, 6, 1, 2, 6, 1, 6, 5, 0, 4, 7, 0, 7, 3]);
        var rotation = new Vector(17, 29, 41).LocalAxesFromDegrees();
        return name switch
        {
            "icosphere" => sphere,
            "skewed icosphere" => sphere.Transform(v => rotation * new Vector(v.X + (0.3 * v.Y), v.Y, 0.2 * v.Z)),
            "rotated cube" => cube.Transform(v => rotation * v),
            "needle" => cube.Transform(v => rotation * v.Stretch(new(1, 1e-3, 1e-3))),
            _ => sphere.Transform(v => (10 * v) + new Vector(1e4, -2e4, 3e4)),
        };
    }

    /// <summary>Rays at points of a square that a fractal of depth 5 tiles, most of them at edges and corners of tiles.</summary>
    private static void CheckTiles(string name, int seed, int rays)
    {
        var count = name == "thirds" ? 3 : 2;
        var stretch = name == "needles" ? new Vector(1, 1e-7, 1) : Vector.One;
        var away = name == "returned" ? new Vector(1000, -999, 0.7) : Vector.Zero;
        var tiles = from x in Enumerable.Range(0, count) from y in Enumerable.Range(0, count) select Tile(x, y);
        var placement = name switch
        {
            "rotated" or "needles" or "returned" => new(new(0.1, 0.2, 0.3), new(33, 44, 55), Vector.One),
            "skewed" => new Transformation(Vector.Zero, new(33, 44, 55), new(1, 3, 0.1)),
            "mirrored" => new(Vector.I, new(-20, 70, 10), new(-1, 1, 1)),
            "far" => new(new(1e5, 2e5, -1e5), new(33, 44, 55), Vector.One),
            _ => Transformation.Identity,
        };
        var outer = name == "skewed" ? [placement, Samples.Move(1e3, 0, 0) with { Rotation = new(0, 10, 0) }] : new[] { placement };
        var square = Square.Transform(v => v.Stretch(stretch) + away);
        var caster = RayCaster.For(Fractal.Of(square).Repeat([.. tiles], 5).Apply([Samples.Move(-away.X, -away.Y, -away.Z)]).Apply(outer));
        var map = placement.ToAffineMap();
        var context = new QueryContext();
        var cells = (int)Math.Pow(count, 5);
        Seeded.RunOne(seed, random =>
        {
            for (var i = 0; i < rays; i++)
            {
                var x = (double)random.Next(1, cells) / cells;
                var y = random.Next(2) == 0 ? (double)random.Next(1, cells) / cells : random.Between(0.001, 0.999);
                var target = map * (random.Next(2) == 0 ? new Vector(x, y, 0) : new Vector(y, x, 0)).Stretch(stretch);
                // Rounding turns the plane of needles by more than the slope of a grazing ray.
                var isSteep = name == "needles" || random.Next(2) == 0;
                var height = isSteep ? random.Between(0.1, 2) : Math.Pow(10, -random.Next(7));
                var origin = map * new Vector(random.Between(-1, 2), random.Between(-1, 2), height);
                var ray = random.Next(4) == 0
                    ? new Ray(target + (map.Linear * Vector.K), -(map.Linear * Vector.K))
                    : new Ray(origin, target - origin);
                Assert.True(caster.TryFindNearest(ray, context, out var hit), $"{ray} leaks");
                Assert.True(caster.HitsAny(ray, context), $"{ray} leaks");
                // A grazing ray hits the nearest edge within the rounding of the whole shape, of which a copy may lie far off.
                var farthest = isSteep || name != "skewed" ? away : 1e3 * Vector.I;
                var reach = Math.Max(farthest.MaxAbsComponent(), Math.Max(target.MaxAbsComponent(), ray.Origin.MaxAbsComponent()));
                AssertDistance(ray with { Direction = target - ray.Origin }, hit, reach);
            }
        });

        // Tiles are placed away from the origin, to which the whole returns.
        Transformation Tile(int x, int y) => Transformation.At(
            (new Vector(x, y, 0).Stretch(stretch) / count) + away - (away / count), 1.0 / count);
    }
}
