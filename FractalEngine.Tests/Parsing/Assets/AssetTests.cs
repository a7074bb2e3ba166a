using System.Globalization;
using System.Numerics;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Rays;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Cameras;
using FractalEngine.Tests.Physics;
using FractalEngine.Tests.Support;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Parsing.Assets;

/// <summary>Tests of the files under assets/: each one loads and has the properties that its comments state.</summary>
public sealed class AssetTests
{
    public static TheoryData<string> Files => FilesWithExtensions(".obj", ".fdo", ".sdo");

    public static TheoryData<string> Meshes => FilesWithExtensions(".obj");

    public static TheoryData<string> Scenes => FilesWithExtensions(".sdo");

    [Theory]
    [MemberData(nameof(Files))]
    public void File_IsCheckedWithoutErrorOrWarning(string file) => Assert.Empty(AssetLoader.Check(Full(file)));

    [Theory]
    [InlineData("sierpinski", 10, 16_807)]
    [InlineData("diamond", 10, 117_649)]
    [InlineData("menger", 12, 3_200_000)]
    [InlineData("menger-4", 12, 160_000)]
    [InlineData("menger-3", 12, 8_000)]
    [InlineData("appendix-b", 8, 244_140_625)]
    [InlineData("appendix-b-structure", 8, 390_625)]
    [InlineData("tetrahedron", 4, 16_384)]
    [InlineData("tree", 20, 78_125)]
    [InlineData("tree-leaves", 24, 49_152)]
    [InlineData("romanesco", 28, 32_768)]
    [InlineData("fern", 24, 110_592)]
    [InlineData("shell", 160, 128)]
    [InlineData("snowflake", 22, 14_406)]
    [InlineData("terrain", 12, 65_536)]
    [InlineData("mountain", 36, 100_000)]
    [InlineData("forest", 20, 2_560_000_000)]
    [InlineData("forest-leaves", 24, 1_610_612_736)]
    public void Fractal_HasTheStatedFacesAndInstances(string name, int faces, long instances)
    {
        var fractal = Fractal(name);
        Assert.Equal(faces, fractal.BaseMesh.FaceCount);
        Assert.Equal(instances, fractal.InstanceCount);
    }

    [Theory]
    [InlineData("sierpinski", 168_070)]
    [InlineData("diamond", 1_176_490)]
    [InlineData("menger", 38_400_000)]
    public void PapersModel_HasThePapersFaces(string name, long faces) => Assert.Equal(faces, Fractal(name).FaceCount);

    [Theory]
    [InlineData("sierpinski", 16_807)]
    [InlineData("diamond", 117_649)]
    [InlineData("tree", 21_845)]
    [InlineData("snowflake", 9_330)]
    [InlineData("mountain", 66_430)]
    [InlineData("terrain", 65_536)]
    public void Fractal_HasTheStatedDistinctInstances(string name, int distinct) =>
        Assert.Equal(distinct, DistinctInstances.Count(Fractal(name)));

    [Fact]
    public void Googol_HasAGoogolInstances() => Assert.Equal(BigInteger.Pow(10, 100), Fractal("googol").InstanceCount);

    [Fact]
    public void InfiniteMenger_IsInfiniteAndBounded()
    {
        var fractal = Fractal("infinite-menger");
        Assert.Null(fractal.InstanceCount);
        // The attractor is the unit cube; the bounds are found to 1e-12 of its size.
        Assert.True((fractal.Bounds.Size - Vector.One).MaxAbsComponent() < 1e-11, fractal.Bounds.ToString());
    }

    [Theory]
    [InlineData("shell")]
    public void Fractal_IsConnected_CornerOnCorner(string name) => CheckConnected(name);

    [Theory]
    [InlineData("sierpinski")]
    [InlineData("diamond")]
    [InlineData("menger-3")]
    [InlineData("tetrahedron")]
    [InlineData("terrain")]
    [Trait("Category", "Soak")]
    public void OtherFractal_IsConnected_CornerOnCorner(string name) => CheckConnected(name);

    private static void CheckConnected(string name)
    {
        var fractal = Fractal(name);
        // Rounding separates corners that meet by 1e-15; the smallest details are 1e-3 of the whole.
        Assert.Equal(1,
            ConnectedComponents.Count(FractalGenerator.Expand(fractal, 200_000), fractal.BaseMesh, 1e-8 * fractal.Bounds.Diagonal));
    }

    [Theory]
    [InlineData("sierpinski")]
    [InlineData("diamond")]
    [InlineData("menger")]
    [InlineData("tetrahedron")]
    [InlineData("romanesco")]
    [InlineData("fern")]
    [InlineData("terrain")]
    [InlineData("googol")]
    public void Recursion_Contracts(string name)
    {
        var repetition = Assert.IsType<Repetition>(Fractal(name).Description.Steps.First(step => step is Repetition));
        foreach (var map in FractalGenerator.Expand(new(new(repetition.Round), Fractal(name).BaseMesh), 100_000))
        {
            // Every distance shrinks after a few rounds: the map's spectral radius is that of its linear part's powers.
            var power = Enumerable.Repeat(map.Linear, 64).Aggregate((m1, m2) => m1 * m2);
            Assert.True(power.MaxAbsEntry() < 1e-1, $"{name}: {map}");
        }
    }

    [Theory]
    [MemberData(nameof(Meshes))]
    public void Mesh_StatesItsFacesAndUsesEveryVertex(string file)
    {
        var mesh = AssetLoader.Load(Full(file)).Scene.Objects[0].Model.Mesh;
        var header = File.ReadLines(Full(file)).First();
        Assert.Equal(string.Create(CultureInfo.InvariantCulture, $"# Mesh count: {mesh.FaceCount}"), header);
        Assert.Equal(mesh.VertexCount, mesh.VertexIndices.Distinct().Count());
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            Assert.True(Vector.Cross(b - a, c - a).Length() > 1e-9, $"face {face} has no area");
        }
    }

    [Theory]
    [MemberData(nameof(Meshes))]
    public void Mesh_IsClosedAndWoundOutwards(string file)
    {
        var mesh = AssetLoader.Load(Full(file)).Scene.Objects[0].Model.Mesh;
        var edges = new HashSet<(int From, int To)>();
        for (var corner = 0; corner < mesh.VertexIndices.Length; corner++)
        {
            Assert.True(edges.Add((mesh.VertexIndices[corner], mesh.VertexIndices[corner % 3 == 2 ? corner - 2 : corner + 1])),
                "two faces run the same way along an edge");
        }

        // A floor may be open below.
        Assert.True(file.Contains("floor-", StringComparison.Ordinal) || edges.All(edge => edges.Contains((edge.To, edge.From))),
            "there is a hole");
        var volume = Enumerable.Range(0, mesh.FaceCount).Select(mesh.Face).Sum(face => Vector.Dot(face.A, Vector.Cross(face.B, face.C)));
        Assert.True(volume > 0, "it is inside out");
    }

    [Theory]
    [MemberData(nameof(Scenes))]
    public void Scene_ShowsSomethingBeforeItsCamera(string file)
    {
        var scene = AssetLoader.Load(Full(file)).Scene;
        Assert.NotNull(scene.Scene.Camera);
        Assert.Contains(scene.Objects, placed => scene.Scene.Camera.ToCameraSpace(placed.Bounds.Centre).Z > 0);
    }

    [Fact]
    public void Gallery_StaysWithinItsInstanceBudget()
    {
        var scene = AssetLoader.Load(Full("assets/scenes/gallery.sdo")).Scene;
        var instances = scene.Objects.Aggregate(BigInteger.Zero, (sum, placed) => sum + placed.Model.InstanceCount!.Value);
        Assert.True(instances <= 1_500_000, $"{instances} instances");
    }

    [Theory]
    [InlineData("drop")]
    [InlineData("playground")]
    public void Bodies_After15Seconds_RestOnSurfacesAndNearlyAllSleep(string name)
    {
        var world = Simulate(name, 15 * 60);
        Assert.DoesNotContain(world.Bodies, body => body.IsStuck);
        // The ground is at height 0; a millionth of a radius is what still counts as touching.
        // The sphere around a compound that lies is no ball of it, and reaches below the ground.
        Assert.All(world.Bodies, body => Assert.True(
            body.Position.Y >= (body.Description.Shape is null ? body.Radius * (1 - 1e-6) : 0.1), $"{body.Name} is at {body.Position}"));
        Assert.True(world.Bodies.Count(body => body.IsAsleep) >= 0.9 * world.Bodies.Count,
            string.Join(", ", world.Bodies.Where(body => !body.IsAsleep).Select(body => body.Name)));
    }

    [Fact]
    public void Playground_ItsShrinkingBody_LiesOnTheSpongeAndThenFallsThrough()
    {
        // The sponge reaches from 1 to 4; the hole is as wide as the sphere of the body when that has lost 0.22 of 0.72, after about 6
        // seconds.
        var world = Simulate("playground", 5 * 60);
        var shrinking = world.Bodies.Single(body => body.Name == "shrinking");
        Assert.InRange(shrinking.Position.Y, 4, 4.5);
        world.Run(4 * 60);
        Assert.InRange(shrinking.Position.Y, 0, 1);
    }

    [Fact]
    public void Playground_ItsPlayer_StandsOnTheGroundClearOfEverything()
    {
        var scene = AssetLoader.Load(Full("assets/scenes/playground.sdo")).Scene;
        var player = scene.Scene.Player!;
        Assert.Equal(0, player.Position.Y - (0.5 * player.Height));
        // The centres of the capsule's two spheres: the lower sphere touches the ground, and nothing else is as close.
        foreach (var height in new[] { player.Radius, player.Height - player.Radius })
        {
            Assert.True(new SceneCollider(scene).TryFindClosest(player.Position with { Y = height }, 10, new(), out var closest, out _));
            Near.Equal(height, closest.Distance, 1e-12);
        }
    }

    [Fact]
    public void Planet_ItsPlayer_StandsOnTheTip()
    {
        var world = new PhysicsWorld(AssetLoader.Load(Full("assets/scenes/planet.sdo")).Scene);
        var player = world.Character!;
        player.IsActive = true;
        for (var step = 0; step < 120; step++)
        {
            world.Step();
        }

        Assert.True(player.IsGrounded);
        // It begins on the florets, to the three digits of the file.
        Assert.True((player.Position - player.Description.Position).Length() < 0.1 * player.Description.Radius, $"{player.Position}");
    }

    [Theory]
    [InlineData("chrome")]
    [InlineData("fireflies")]
    [InlineData("nave")]
    [InlineData("planet")]
    public void Film_ItsCamera_PassesThroughNoSurface(string name)
    {
        var scene = AssetLoader.Load(Full($"assets/scenes/{name}.sdo")).Scene;
        var film = scene.Scene.Film!;
        var path = new CameraPath(film.Cameras, scene.Scene.Handedness);
        var rays = RayCaster.For(scene);
        var frames = (int)(25 * film.Duration);
        for (var frame = 0; frame < frames; frame++)
        {
            var from = path.At(frame / 25.0).Position;
            var way = path.At((frame + 1) / 25.0).Position - from;
            Assert.False(way.Length() > 0 && rays.HitsAny(new(from, way), maxDistance: way.Length()), $"frame {frame} at {from}");
        }
    }

    private static PhysicsWorld Simulate(string name, int steps)
    {
        var world = new PhysicsWorld(AssetLoader.Load(Full($"assets/scenes/{name}.sdo")).Scene);
        for (var step = 0; step < steps; step++)
        {
            world.Step();
        }

        return world;
    }

    private static Fractal Fractal(string name) =>
        Assert.IsType<FractalModel>(AssetLoader.Load(Full($"assets/fractals/{name}.fdo")).Scene.Objects[0].Model).Fractal;

    private static TheoryData<string> FilesWithExtensions(params string[] endings) =>
        [.. Directory.EnumerateFiles(Full("assets"), "*", SearchOption.AllDirectories)
            .Where(file => endings.Contains(Path.GetExtension(file)))
            .Select(file => Path.GetRelativePath(Repository.Root, file).Replace('\\', '/')).Order(StringComparer.Ordinal)];

    private static string Full(string file) => Repository.Full(file);
}
