using System.Text;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render;
using FractalEngine.Render.Frame;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Tests.Render.Gl;

[Collection(GlTests.Name)]
public sealed class GlObjectTests
{
    private const string Trivial = "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }";

    [SkippableFact]
    public void Renderers_Disposed_LeaveNothingBehind()
    {
        using var context = GlTests.OpenContext();
        var scene = RenderScenes.Scene(new Scene(), (RenderScenes.Menger(1), Transformation.Identity, null));
        using (var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, new())))
        using (var frame = new FrameRenderer(context))
        {
            frame.Draw(renderer, RenderScenes.FrontView, 40, 30, new() { Grid = true, Wireframe = true });
            frame.Capture(overlay: OverlayPanel.OfText(OverlayAnchor.TopLeft, "text"));
            frame.Draw(renderer, RenderScenes.FrontView, 60, 30, new() { Samples = 0 });
            frame.Capture();
            Assert.NotEmpty(context.Resources.LiveObjects);
        }

        Assert.Empty(context.Resources.LiveObjects);
        context.Resources.ThrowOnError("disposing");
    }

    [SkippableFact]
    public void Context_DisposedBeforeItsObjects_NamesThem()
    {
        GlTests.OpenContext().Dispose();
        var leaks = new List<string>();
        var context = new OffscreenContext(leaks.Add);
        var buffer = new VertexArray(context.Resources, "forgotten");
        context.Dispose();
        Assert.Equal("not disposed before its OpenGL context: VertexArray 'forgotten'", Assert.Single(leaks));
        buffer.Dispose();
        context.Dispose();
    }

    [SkippableFact]
    public void Object_DisposedOnAnotherThread_IsDeletedOnTheContextsThread()
    {
        using var context = GlTests.OpenContext();
        var item = new RecordingObject(context.Resources);
        var other = new Thread(item.Dispose);
        other.Start();
        other.Join();
        Assert.Empty(context.Resources.LiveObjects);
        Assert.Empty(item.DeletingThreads);
        context.MakeCurrent();
        context.MakeCurrent();
        Assert.Equal([Environment.CurrentManagedThreadId], item.DeletingThreads);
    }

    [SkippableFact]
    public void Object_MadeOnAnotherThread_IsRefused()
    {
        using var context = GlTests.OpenContext();
        Exception? caught = null;
        var other = new Thread(() => caught = Record.Exception(() => new VertexArray(context.Resources, "foreign")));
        other.Start();
        other.Join();
        Assert.Equal("GL objects can be used on the thread of their context only",
            Assert.IsType<InvalidOperationException>(caught).Message);
        Assert.Empty(context.Resources.LiveObjects);
    }

    [SkippableFact]
    public void Shader_ThatDoesNotCompile_NamesStageAndFileAndKeepsTheLog()
    {
        using var context = GlTests.OpenContext();
        var error = Assert.Throws<GlException>(() => new ShaderProgram(
            context.Resources, ("good.vert", Trivial), ("bad.frag", "#version 330 core\nvoid main() { colour = nonsense; }")));
        Assert.StartsWith("bad.frag (fragment shader) does not compile:\n", error.Message, StringComparison.Ordinal);
        Assert.Contains("nonsense", error.Message, StringComparison.Ordinal);
        Assert.Empty(context.Resources.LiveObjects);
    }

    [SkippableFact]
    public void Program_ThatDoesNotLink_NamesBothFiles()
    {
        using var context = GlTests.OpenContext();
        var error = Assert.Throws<GlException>(() => new ShaderProgram(
            context.Resources,
            ("a.vert", "#version 330 core\nout vec2 shared_;\nvoid main() { shared_ = vec2(1.0); gl_Position = vec4(0.0); }"),
            ("b.frag", "#version 330 core\nin vec3 shared_;\nout vec4 colour;\nvoid main() { colour = vec4(shared_, 1.0); }")));
        Assert.StartsWith("a.vert + b.frag does not link:\n", error.Message, StringComparison.Ordinal);
        Assert.Empty(context.Resources.LiveObjects);
    }

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Contexts_TwentyInARow_AllDraw()
    {
        var scene = DrawableScene.Prepare(RenderScenes.WhiteOnBlack(RenderScenes.Cube(1), Transformation.Identity), new());
        for (var i = 0; i < 20; i++)
        {
            using var context = GlTests.OpenContext();
            using var renderer = new SceneRenderer(context, scene);
            using var frame = new FrameRenderer(context);
            frame.Draw(renderer, RenderScenes.FrontView, 40, 30, new());
            Assert.Equal((255, 255, 255, 255), frame.Capture()[20, 15]);
        }
    }

    [SkippableFact]
    public void Contexts_TwoAtOnce_DrawInTurn()
    {
        using var context1 = GlTests.OpenContext();
        using var context2 = GlTests.OpenContext();
        using var frame1 = new FrameRenderer(context1);
        using var frame2 = new FrameRenderer(context2);
        frame1.Draw(null, RenderScenes.FrontView, 4, 4, new() { Background = new(1, 0, 0) });
        frame2.Draw(null, RenderScenes.FrontView, 4, 4, new() { Background = new(0, 1, 0) });
        Assert.Equal((255, 0, 0, 255), frame1.Capture()[1, 1]);
        Assert.Equal((0, 255, 0, 255), frame2.Capture()[1, 1]);
    }

    [Fact]
    public void ShaderSource_WithSymbols_DefinesThemBehindTheVersionAndKeepsTheNumbersOfLines()
    {
        var lines = ShaderSource.Read("mesh.frag", ["TEXTURED", "GLOSSY"]).Split('\n');
        Assert.Equal(["#version 330 core", "#define TEXTURED", "#define GLOSSY", "#line 2"], lines[..4]);
        Assert.DoesNotContain(lines, line => line.StartsWith("#include", StringComparison.Ordinal));
        var original = EmbeddedResource.ReadText("Shaders/mesh.frag").Split('\n');
        var next = Array.FindLastIndex(lines, line => line.StartsWith("#line ", StringComparison.Ordinal));
        Assert.Equal(original[(int.Parse(lines[next][6..], System.Globalization.CultureInfo.InvariantCulture) - 1)..],
            lines[(next + 1)..^1]);
    }

    [SkippableFact]
    public void Programs_OfAllFeatures_Compile()
    {
        using var context = GlTests.OpenContext();
        for (var features = 0; features < 8; features++)
        {
            new MeshProgram(context, (MeshFeatures)features, LightBlock.SymbolsOf(LoadedScene.Of(new Scene()))).Dispose();
        }

        Assert.Empty(context.Resources.LiveObjects);
    }

    [Fact]
    public void SymbolsOf_AllFeatures_AreThoseOfTheShaders()
    {
        var shaders = ShaderSource.Read("mesh.vert", []) + ShaderSource.Read("mesh.frag", []);
        string[] symbols = [.. MeshProgram.SymbolsOf((MeshFeatures)65535)];
        Assert.Equal(16, symbols.Length);
        Assert.All(symbols, symbol => Assert.Matches($@"(#ifn?def |defined\(){symbol}\b", shaders));
        Assert.Empty(MeshProgram.SymbolsOf(MeshFeatures.None));
    }

    [Fact]
    public void Shaders_AllFiles_AreAscii()
    {
        // OpenTK 4.9.4 hands over the number of characters where OpenGL wants that of bytes: other texts would be cut off at their end.
        var assembly = typeof(SceneRenderer).Assembly;
        var shaders = assembly.GetManifestResourceNames().Where(name => name.StartsWith("Shaders/", StringComparison.Ordinal)).ToArray();
        Assert.NotEmpty(shaders);
        Assert.All(shaders, name => Assert.True(Ascii.IsValid(EmbeddedResource.ReadText(name)), name));
    }

    /// <summary>Records on which threads it is deleted.</summary>
    private sealed class RecordingObject(GlResources resources) : GlObject(resources, "recorded")
    {
        public List<int> DeletingThreads { get; } = [];

        protected internal override void Delete() => DeletingThreads.Add(Environment.CurrentManagedThreadId);
    }
}
