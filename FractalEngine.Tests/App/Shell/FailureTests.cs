using System.Reflection;
using FractalEngine.App.Shell;
using FractalEngine.Core;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Windowing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Shell;

/// <summary>Tests that every error ends a command with one message and the exit code of its kind, never with a stack trace.</summary>
public sealed class FailureTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public FailureTests()
    {
        _folder.Write("cube.obj", SampleFiles.Cube);
        _folder.Write("point.obj", "v 0 0 0\nf 1 1 1\n");
    }

    public static TheoryData<Exception, int, string> Errors => new()
    {
        { new SourceException("a.obj", "file not found"), 1, "a.obj:1:1: error: file not found" },
        { new SourceException("a.obj", "too large", isLimitExceeded: true), 3, "a.obj:1:1: error: too large" },
        { new ColliderMismatchException("it does not fit"), 2, "error: it does not fit" },
        { new FractalLimitException("too many"), 3, "error: too many" },
        { new GlException("no memory"), 3, "error: no memory" },
        { new GraphicsUnavailableException("no display"), 4, "error: no display" },
        {
            new SingularMatrixException(default(Matrix)), 1,
            $"error: the matrix {default(Matrix)} has no inverse: its determinant is 0"
        },
        { new UsageException("nothing to do"), 2, "error: nothing to do" },
        { new IOException("disk full"), 2, "error: disk full" },
        { new UnauthorizedAccessException("not yours"), 2, "error: not yours" },
        { new OperationCanceledException("interrupted"), 130, "error: interrupted" },
        { new AggregateException(new FractalLimitException("too many")), 3, "error: too many" },
        { new InsufficientMemoryException(), 3, "error: the machine's memory does not suffice" },
        { new FormatException("two\nlines"), 70, "error: internal error, please report it: FormatException: two lines" },
    };

    public void Dispose() => _folder.Dispose();

    [Theory]
    [MemberData(nameof(Errors))]
    public void Of_AnError_HasTheExitCodeOfItsKindAndOneLine(Exception exception, int exitCode, string text) =>
        Assert.Equal(new Failure(exitCode, text), Failure.Of(exception));

    [Fact]
    public void Exceptions_OfTheEngine_AllHaveOneRoot()
    {
        var exceptions = new[] { "Core", "Parsing", "Render" }
            .SelectMany(name => Assembly.Load($"FractalEngine.{name}").GetTypes())
            .Where(type => typeof(Exception).IsAssignableFrom(type)).ToArray();
        Assert.True(exceptions.Length >= 8, $"only {exceptions.Length}");
        Assert.All(exceptions, type => Assert.True(typeof(FractalEngineException).IsAssignableFrom(type), type.Name));
    }

    [Fact]
    public void RenderAfterSomeTime_WithAColliderThatDoesNotFit_IsOneLine()
    {
        _folder.Write("scene.sdo", "o \"cube.obj\" #\np \"cube.obj\" ((0, 5, 0), #, #) 1 collider fractal\n");
        Assert.Equal(
            new AppResult(2, "", "error: cube.obj: the collider 'fractal' needs a fractal, and this is a mesh: "
                + "expected exact, hierarchy, bounding-box or simple\n"),
            Run("render", "scene.sdo", "--time", "1", "--output", "image.png"));
        Assert.False(File.Exists(_folder["image.png"]));
    }

    [Fact]
    public void RenderAfterSomeTime_OfABodyWithoutSize_PointsToItsLine()
    {
        _folder.Write("scene.sdo", "p \"point.obj\" # 0.5 name \"dot\"\n");
        var (exitCode, output, error) = Run("render", "scene.sdo", "--time", "1", "--output", "image.png");
        Assert.Equal((1, ""), (exitCode, output));
        Assert.StartsWith("scene.sdo:1:1: error: body dot: ", error, StringComparison.Ordinal);
        Assert.Equal(3, error.TrimEnd('\n').Split('\n').Length);
    }

    [Fact]
    public void Query_OfAFractalWhoseBaseHasManyUnusedVertices_IsOverTheLimit()
    {
        _folder.Write("base.obj", string.Concat(Enumerable.Repeat("v 1 2 3\n", 200_000)) + "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n");
        _folder.Write("many.fdo", "v 1 0 0\nv 0.5 0.5 0.5\nt.a. (a, #, 2)\nx. \"base.obj\"\nz<x>. [#, t.1] x\n<$>. z 14\n");
        _folder.Write("points.txt", "1 2 3\n");
        var (exitCode, output, error) = Run("query", "many.fdo", "--points", "points.txt", "--collider", "hierarchy");
        Assert.Equal((3, ""), (exitCode, output));
        Assert.Matches("^error: [^\n]+\n$", error);
    }

    private AppResult Run(params string[] arguments) => AppProcess.Run(_folder.Path, arguments);
}
