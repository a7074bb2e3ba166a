using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests;

/// <summary>Equality of values: a copy is equal and has the same hash, and what differs in one part is not.</summary>
public class EqualityTests
{
    private static readonly Colour Red = new(1, 0, 0);

    [Fact]
    public void Scenes_ThatDifferInOnePart_AreNotEqual()
    {
        Scene Make() => new()
        {
            Camera = new(new(0, 1, -9), new(0, 0.5, 0), 50), Lights = [new AmbientLight(Red, 0.5)],
            Objects = [new("a.obj", Transformation.Identity)],
        };
        var scene = Make();
        Check(
            Make,
            scene with { Camera = null }, scene with { Camera = scene.Camera! with { FieldOfView = 51 } },
            scene with { Projection = Projection.Orthographic }, scene with { OrthographicHeight = 3 }, scene with { Aspect = 2 },
            scene with { Clip = (1, 2) }, scene with { Background = Red }, scene with { Sky = new ColourSky(Red, Red) },
            scene with { Exposure = 2 }, scene with { Probe = Vector.Zero },
            scene with { Tone = Tone.Filmic }, scene with { HasAutoExposure = true }, scene with { Fog = new(0.1) },
            scene with { Fog = new(0.1) { Albedo = 0.5 } }, scene with { Fog = new(0.1) { Anisotropy = 0.5 } }, scene with { Lights = [] },
            scene with { Lights = [new AmbientLight(Red, 0.6)] }, scene with { Objects = [] },
            scene with { Objects = [new("b.obj", Transformation.Identity)] }, scene with { Gravity = Vector.J },
            scene with { Player = new(Vector.One, 0.5, 2) }, scene with { Handedness = (Handedness)1 });
    }

    [Fact]
    public void Objects_ThatDifferInOnePart_AreNotEqual()
    {
        var placement = Transformation.Identity with { Position = new(1, 2, 3) };
        SceneObject Make() => new("a.obj", placement) { Name = "a" };
        var placed = Make();
        Check(
            Make,
            placed with { File = "b.obj" }, placed with { File = null }, placed with { Placement = Transformation.Identity },
            placed with { Name = "b" }, placed with { Name = null }, placed with { Colour = Red },
            placed with { Gradient = new(GradientKind.Level, Red) }, placed with { Motion = new() { Velocity = Vector.I } },
            placed with { Belt = Vector.K }, new StaticLookalike("a.obj", placement) { Name = "a" });
        Assert.Equal(placed, placed with { Model = new MeshModel(Samples.Triangle) });
        var model = new MeshModel(Samples.Triangle);
        Assert.Equal(new SceneObject(model), new SceneObject(model));
        Assert.NotEqual(new SceneObject(model), new SceneObject(new MeshModel(Samples.Tetrahedron)));
    }

    [Fact]
    public void Cameras_ThatDifferInOnePart_AreNotEqual()
    {
        var camera = new Camera(Vector.One, new(0.1, 0.2, 0.3), 40);
        Check(
            () => new(Vector.One, new(0.1, 0.2, 0.3), 40),
            camera with { Position = Vector.I }, camera with { Rotation = Vector.I }, camera with { FieldOfView = 41 },
            camera with { Handedness = (Handedness)1 });
    }

    [Fact]
    public void Fractals_ThatDifferInOnePart_AreNotEqual()
    {
        TransformationSet Set(double x = 1) => new([Samples.Move(x, 0, 0), Samples.MoveAndScale(0, 1, 0, 0.5)]);
        Fractal Make() => new(new([new Repetition([Set()], 3), Set()]), Samples.Triangle);
        Fractal With(params FractalStep[] steps) => new(new([.. steps]), Samples.Triangle);
        Check(
            Make,
            new(Make().Description, Samples.Tetrahedron), new(Make().Description with { Composition = (Composition)1 }, Samples.Triangle),
            With(new Repetition([Set()], 3)), With(new Repetition([Set()], 4), Set()), With(new Repetition([Set()], null), Set()),
            With(new Repetition([Set(), Set()], 3), Set()), With(new Repetition([Set(2)], 3), Set()),
            With(new Repetition([Set()], 3), Set(2)),
            With(Set(), new Repetition([Set()], 3)), With(Set(), Set()));
        Check<FractalDescription>(() => new([Set()]), new FractalDescription([]), new([Set()], (Composition)1), new([Set(2)]));
        Check<FractalStep>(() => Set(), new Repetition([Set()], 1), new TransformationSet([]), Set(2));
    }

    [Fact]
    public void Meshes_ThatDifferInOnePart_AreNotEqual()
    {
        Mesh Make() => new Mesh([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], [0, 1, 2]).WithColours([.. Enumerable.Repeat(0.5, 12)])
            .WithTextureCoordinates([0, 0, 1, 1], [0, 1, -1]).WithNormals([0, 0, 1, 1, 0, 0], [0, 1, -1])
            .WithGroups([new(0, 1, "a", "", "", 0)], ["a.mtl"]);
        var mesh = Make();
        Mesh Of(ImmutableArray<double> positions, ImmutableArray<int> indices) => new Mesh(positions, indices).WithColours(mesh.Colours)
            .WithTextureCoordinates(mesh.TextureCoordinates, mesh.TextureIndices).WithNormals(mesh.Normals, mesh.NormalIndices)
            .WithGroups(mesh.Groups, mesh.MaterialLibraries);
        Check(
            Make,
            Of([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2], [0, 1, 2]), Of(mesh.Positions, [0, 1, 3]),
            Of([-0.0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], [0, 1, 2]),
            mesh.WithColours([.. Enumerable.Repeat(0.25, 12)]), mesh.WithTextureCoordinates([0, 0, 1, 0.5], [0, 1, -1]),
            mesh.WithTextureCoordinates([0, 0, 1, 1], [0, 1, 1]), mesh.WithNormals([0, 0, 1, 0, 1, 0], [0, 1, -1]),
            mesh.WithNormals([0, 0, 1, 1, 0, 0], [0, 1, 1]), mesh.WithGroups([new(0, 1, "b", "", "", 0)], ["a.mtl"]),
            mesh.WithGroups([new(0, 1, "a", "", "", 0)], ["b.mtl"]), mesh.WithGroups([], []));
    }

    [Fact]
    public void Hits_ThatDifferInOnePart_AreNotEqual()
    {
        ClosestHit Make() => new(1, Vector.I, Vector.J, 2, [3, 4], 5);
        var hit = Make();
        Check(
            Make,
            hit with { Distance = 2 }, hit with { Point = Vector.J }, hit with { Normal = Vector.I }, hit with { FaceIndex = 3 },
            hit with { InstancePath = [3, 5] }, hit with { InstancePath = [] }, hit with { ObjectIndex = 6 });
    }

    [Fact]
    public void Pairs_ThatDifferInOnePart_AreNotEqual()
    {
        ClosestPair Make() => new(1, Vector.I, Vector.J, 2, 3, [4], [5], 0.5);
        var pair = Make();
        Check(
            Make,
            pair with { Distance = 2 }, pair with { Point = Vector.J }, pair with { OtherPoint = Vector.I }, pair with { FaceIndex = 3 },
            pair with { OtherFaceIndex = 4 }, pair with { InstancePath = [5] }, pair with { OtherInstancePath = [4] },
            pair with { ErrorBound = 0.25 });
    }

    [Fact]
    public void Panels_ThatDifferInOnePart_AreNotEqual()
    {
        OverlayPanel Make() => new(OverlayAnchor.TopLeft, [new("a", "b")]) { Title = "t", Progress = 0.5 };
        var panel = Make();
        Check(
            Make,
            panel with { Anchor = OverlayAnchor.Bottom }, panel with { Lines = [new("a", "c")] }, panel with { Lines = [] },
            panel with { Title = "u" }, panel with { Progress = null }, panel with { IsQuestion = true });
    }

    private static void Check<T>(Func<T> make, params ReadOnlySpan<T> others)
        where T : class
    {
        var one = make();
        Assert.True(one.Equals(make()));
        Assert.Equal(one.GetHashCode(), make().GetHashCode());
        Assert.False(one.Equals(null));
        for (var i = 0; i < others.Length; i++)
        {
            Assert.False(one.Equals(others[i]), $"number {i}: {others[i]}");
            Assert.False(others[i].Equals(one), $"from number {i}: {others[i]}");
        }
    }

    private sealed record StaticLookalike(string Path, Transformation Where) : SceneObject(Path, Where);
}
