using System.Reflection;
using System.Runtime.InteropServices;
using System.Security.Cryptography;
using FractalEngine.App.Shell;
using FractalEngine.Core.Approximation;
using FractalEngine.Core.Approximation.Damaged;
using FractalEngine.Core.Approximation.Repetition;
using FractalEngine.Core.Approximation.Symmetries;
using FractalEngine.Core.Distances;
using FractalEngine.Core.Files;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Simplification;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Core.Visibility.SkyBaking;
using FractalEngine.Parsing.Approximation;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Exports;
using FractalEngine.Parsing.Simulation;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Wavefront;
using FractalEngine.Parsing.Wavefront.Writing;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Robustness;

/// <summary>
/// Tests that whatever can be cancelled, or tells its progress, can be ended at any moment: nothing is half done then, and doing it again
/// gives what it gives at once. The members are found by reflection, so that a new one needs a row of <see cref="Make"/>.
/// </summary>
[Collection(TimedTests.Name)]
public sealed class CancellationTests : IDisposable
{
    // Milliseconds, after which one moment must do.
    private const long LongTime = 100;

    private readonly TemporaryFolder _folder = new();

    /// <summary>Does the work of a member on what <see cref="Make"/> has made, and describes the outcome.</summary>
    /// <param name="cancellation">Handed over.</param>
    /// <param name="told">Called at each report of progress.</param>
    private delegate string Work(CancellationToken cancellation, Action told);

    public static TheoryData<string> Cancellable => [.. MembersWith(static type => type == typeof(CancellationToken))];

    public static TheoryData<string> Telling =>
        [.. MembersWith(static type => type.IsGenericType && type.GetGenericTypeDefinition() == typeof(IProgress<>))];

    public void Dispose() => _folder.Dispose();

    [Theory]
    [MemberData(nameof(Cancellable))]
    public void Member_CancelledBeforeAndMeanwhile_GivesAllOrNothing(string member)
    {
        var first = Make(member);
        var start = Environment.TickCount64;
        var expected = first(CancellationToken.None, static () => { });
        var time = Environment.TickCount64 - start;
        foreach (var moment in time > LongTime ? [0.5] : (double[])[0, 0.3, 0.7])
        {
            var work = Make(member);
            for (var i = 0; i < 2; i++)
            {
                Assert.ThrowsAny<OperationCanceledException>(() => work(new(canceled: true), static () => { }));
            }

            using var source = new CancellationTokenSource(TimeSpan.FromMilliseconds(moment * time));
            string outcome;
            try
            {
                outcome = work(source.Token, static () => { });
            }
            catch (OperationCanceledException)
            {
                outcome = work(CancellationToken.None, static () => { });
            }

            Assert.Equal(expected, outcome);
        }
    }

    [Theory]
    [MemberData(nameof(Telling))]
    public void Member_WhoseProgressThrows_PassesThatOnAndCanBeRepeated(string member)
    {
        var count = 0;
        var expected = Make(member)(CancellationToken.None, () => count++);
        Assert.True(count > 0 || member.EndsWith(".Write", StringComparison.Ordinal), $"{member} tells nothing");
        foreach (var last in new[] { 1, (count + 1) / 2, count }.Where(number => count > 0).Distinct())
        {
            var work = Make(member);
            var thrown = new InvalidDataException("by the caller");
            var told = 0;
            var caught = Record.Exception(() => work(CancellationToken.None, () => _ = ++told == last ? throw thrown : told));
            // Where several threads read a file, it depends on them how often the calling one tells.
            Assert.Same(told < last ? null : thrown, caught);
            Assert.True(told <= last, "told more after that");
            Assert.DoesNotContain(OpenFiles.List(), file => file.StartsWith(_folder.Path, StringComparison.Ordinal));
            Assert.Equal(expected, work(CancellationToken.None, static () => { }));
        }
    }

    /// <summary>Lists public members with such a parameter; those that take <see cref="ExportSettings"/> to write have both.</summary>
    private static IEnumerable<string> MembersWith(Func<Type, bool> isMeant) =>
        new[] { typeof(Fractal), typeof(AssetLoader), typeof(View), typeof(ExitCode) }
            .SelectMany(static one => one.Assembly.GetExportedTypes())
            .SelectMany(static type => type.GetMembers(
                BindingFlags.Public | BindingFlags.Instance | BindingFlags.Static | BindingFlags.DeclaredOnly))
            .OfType<MethodBase>()
            .Where(member => !member.IsAbstract && (member.IsConstructor || !member.IsSpecialName)
                && Array.Exists(member.GetParameters(), parameter => isMeant(parameter.ParameterType)
                    || (member.Name == "Write" && parameter.ParameterType == typeof(ExportSettings))))
            .SelectMany(
                static member => member.DeclaringType is { IsAbstract: true, IsSealed: false } shared
                    ? shared.Assembly.GetExportedTypes().Where(type => type.IsSubclassOf(shared)) : [member.DeclaringType!],
                static (member, type) => $"{type.Name}.{member.Name}")
            .Distinct();

    private Work Make(string member)
    {
        switch (member)
        {
            case "DamagedSearch.Find":
                return static (token, _) => $"{DamagedSearch.Find(Row(3).Flatten(1000), new(), token)?.FaceCount}";
            case "GrammarSearch.FindExact":
                return static (token, _) => $"{GrammarSearch.FindExact(Row(4).Flatten(1000), token)?.FaceCount}";
            case "RepetitionSearch.Find":
                return static (token, _) => $"{RepetitionSearch.Find(Shapes.Sphere(1), token)?.FaceCount}";
            case "MirrorSearch.Find":
                return static (token, _) =>
                {
                    var plane = MirrorSearch.Find(Shapes.Cube(), token);
                    return $"{plane.Normal} {plane.Offset:R}";
                };
            case "MeshWelding.Weld":
                return static (_, told) =>
                {
                    var mesh = Row(3).Flatten(1000);
                    return HashOf(MeshWelding.Weld(mesh, MeshWelding.FindSides(mesh), 1e-9, new Teller<double>(told)));
                };
            case "MeshApproximator.Find":
                return static (token, told) =>
                    $"{MeshApproximator.Find(Row(3).Flatten(1000), null, new Teller<ApproximationProgress>(told), token).Bytes}";
            case "QuadricSimplifier.Simplify":
                return static (token, _) => HashOf(QuadricSimplifier.Simplify(Shapes.Sphere(4), 100, token));
            case "SurfaceDistance.Between":
                return static (token, _) => $"{SurfaceDistance.Between(Shapes.Sphere(2), Shapes.Sphere(1), null, token).MaxDistance}";
            case "PhysicsWorld.BuildColliders":
                var world = new PhysicsWorld(new Scene { Objects = [new(Shapes.Sphere(2)), new(Shapes.Sphere(3)), new(Row(5))] });
                return (token, _) =>
                {
                    world.BuildColliders(token);
                    return $"{world.ColliderCounts}";
                };
            case "SkyMaskBaker.Bake":
                var hierarchy = LodHierarchy.Build(Row(2));
                return (token, _) =>
                {
                    Assert.False(hierarchy.HasSkyMasks);
                    SkyMaskBaker.Bake(hierarchy, 1, token);
                    return $"{hierarchy.SkyMaskBytes}";
                };
            case "AssetLoader.Load":
                var cache = new AssetCache();
                return (_, told) => HashOf(
                    AssetLoader.Load(WriteMesh(), null, new Teller<LoadProgress>(told), cache).Scene.Objects[0].Model.Mesh);
            case "ObjReader.Read":
                return (_, told) => HashOf(ObjReader.Read(WriteMesh(), "a.obj", new Teller<double>(told)).Mesh);
            case "ObjParser.Parse":
                var text = new SourceText("a.obj", MeshText());
                return (_, told) => HashOf(ObjParser.Parse(text, new Teller<double>(told)).Mesh);
            case "AnimatedBodies.AdvanceTo":
                _folder.Write("cube.obj", SampleFiles.Cube);
                var path = _folder.Write("moving.sdo", "o \"cube.obj\" (#, #, #) moving velocity (1, 2, 0)\n");
                var file = AssetLoader.Load(path);
                var bodies = new AnimatedBodies(path, file, file.Scene);
                return (token, _) =>
                {
                    bodies.AdvanceTo(5, token);
                    return $"{bodies.Maps[0].Map.Translation} {bodies.GetScene().Objects[0].ObjectToWorld.Translation}";
                };
            case "PathTracer.AddSample":
                var tracer = MakeTracer();
                return (token, _) =>
                {
                    tracer.AddSample(cancellation: token);
                    return Hash(tracer.ToImage().Pixels);
                };
            case "PathTracer.Denoise":
                var noisy = MakeTracer();
                noisy.AddSample();
                return (token, _) => Hash(noisy.Denoise(cancellation: token).Pixels);
            case "PathTracer.ToLightFrame":
                var lit = MakeTracer();
                lit.AddSample();
                return (token, _) => string.Concat(lit.ToLightFrame([FrameLayer.Colour], token).Light.Pixels.Select(static x => $"{x:R} "));
            case "PathTracer.FindLayers":
                var layered = MakeTracer();
                return (token, _) => string.Concat(
                    layered.FindLayers([FrameLayer.Depth, FrameLayer.Normal], token).SelectMany(static channel => channel.Values));
            case "DrawableScene.Prepare":
                return static (token, told) => Describe(
                    DrawableScene.Prepare(Lit, new(), new Teller<PreparationProgress>(told), token));
            case "ScenePreparation.PrepareAll" or "ScenePreparation.PrepareVisible":
                var preparation = new ScenePreparation(Lit, new());
                return (token, told) =>
                {
                    Assert.Null(preparation.Current);
                    var progress = new Teller<PreparationProgress>(told);
                    if (member.EndsWith("All", StringComparison.Ordinal))
                    {
                        preparation.PrepareAll(progress, token);
                    }
                    else
                    {
                        preparation.PrepareVisible(RenderScenes.FrontView, 1, progress, token);
                    }

                    return Describe(preparation.Scene);
                };
            case "ScenePreparation.BakeSky":
                var unbaked = new ScenePreparation(Lit, new());
                unbaked.PrepareAll(null, CancellationToken.None);
                return (token, _) =>
                {
                    Assert.True(unbaked.HasUnbakedSky(new()));
                    unbaked.BakeSky(token);
                    return $"{unbaked.HasUnbakedSky(new())} {unbaked.Scene.Objects[0].Model.LodHierarchy!.SkyMaskBytes}";
                };
            case "ObjSceneWriter.Write":
                return Exporting(static (settings, stream) => ObjSceneWriter.Write(Lit, stream, settings, null, ""));
            case var write when write.EndsWith(".Write", StringComparison.Ordinal):
                var type = typeof(SceneExport).Assembly.GetTypes().Single(one => $"{one.Name}.Write" == write);
                var export = (SceneExport)Activator.CreateInstance(type)!;
                return Exporting((settings, stream) => export.Write(Lit, settings, stream));
            default:
                throw new InvalidOperationException($"{member} can be cancelled or tells its progress, and has no row here");
        }
    }

    /// <summary>Replaces a file, which nothing but a whole new one may change.</summary>
    private Work Exporting(Action<ExportSettings, Stream> write) => (token, told) =>
    {
        const string Before = "before";
        var path = _folder.Write("out", Before);
        try
        {
            AtomicFile.Write(
                path, stream => write(new() { Cancellation = token, Progress = new Teller<double>(told) }, stream));
            return Hash(File.ReadAllBytes(path));
        }
        catch (Exception)
        {
            Assert.Equal(Before, File.ReadAllText(path));
            throw;
        }
        finally
        {
            Assert.Equal([path], Directory.GetFiles(_folder.Path));
        }
    };

    private static LoadedScene Lit { get; } = LoadedScene.Of(new()
    {
        Lights = [RenderScenes.FullLight],
        Objects = [new SceneObject(Row(2)), new SceneObject(Shapes.Sphere(2))],
    });

    /// <summary>Cubes that touch each other, 2^<paramref name="depth"/> of them, which hide each other's sky.</summary>
    private static Fractal Row(int depth) => Fractal.Of(Shapes.Cube())
        .Repeat([Transformation.At(new(-0.25, 0, 0), 0.5), Transformation.At(new(0.25, 0, 0), 0.5)], depth);

    private static PathTracer MakeTracer() => new(Lit, RenderScenes.FrontView, 24, 24) { CanDenoise = true };

    /// <summary>Several blocks of a mesh, in a comment at whose end the file turns out to be Latin-1.</summary>
    private string WriteMesh()
    {
        if (!File.Exists(_folder["a.obj"]))
        {
            File.WriteAllText(_folder["a.obj"], MeshText() + "# é\n", System.Text.Encoding.Latin1);
        }

        return _folder["a.obj"];
    }

    private static string MeshText()
    {
        var filler = $"# {new string('x', 1 << 16)}\n";
        return "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" + string.Concat(Enumerable.Repeat(filler, 50));
    }

    private static string Describe(DrawableScene scene) =>
        $"{scene.InstanceCount} {scene.TriangleCount} {scene.Models.Count(static model => model.IsPlaceholder)}";

    private static string HashOf(Mesh mesh) =>
        Hash(MemoryMarshal.AsBytes(mesh.Positions.AsSpan())) + Hash(MemoryMarshal.AsBytes(mesh.VertexIndices.AsSpan()));

    private static string Hash(ReadOnlySpan<byte> bytes) => Convert.ToHexString(SHA256.HashData(bytes));

    private sealed class Teller<T>(Action told) : IProgress<T>
    {
        public void Report(T value) => told();
    }
}
