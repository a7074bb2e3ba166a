using FractalEngine.Core;
using FractalEngine.Core.Generation;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing;

public sealed class MeshFileTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Write_OfAMesh_ReadsBackEqual()
    {
        var mesh = Shapes.Sphere(1);
        MeshFile.Write(_folder["sub/a.obj"], mesh);
        Assert.Equal(mesh, MeshFile.Read(_folder["sub/a.obj"]));
        Assert.Single(Directory.GetFiles(_folder["sub"]));
    }

    [Fact]
    public void Write_OverAFile_ReplacesIt()
    {
        MeshFile.Write(_folder["a.obj"], Samples.Tetrahedron);
        MeshFile.Write(_folder["a.obj"], Samples.Triangle);
        Assert.Equal(Samples.Triangle, MeshFile.Read(_folder["a.obj"]));
    }

    [Fact]
    public void Write_ThatIsRefused_KeepsTheOldFile()
    {
        MeshFile.Write(_folder["a.obj"], Samples.Triangle);
        Assert.Throws<FractalEngineException>(() => MeshFile.Write(
            _folder["a.obj"], Samples.Triangle.WithNormals([double.NaN, 0, 0], [0, 0, 0])));
        Assert.Equal(Samples.Triangle, MeshFile.Read(_folder["a.obj"]));
        Assert.Single(Directory.GetFiles(_folder.Path));
    }

    [Fact]
    public void ReadAndWrite_OfOtherEndings_AreRefused()
    {
        Assert.Throws<ArgumentException>(() => MeshFile.Write(_folder["a.fdo"], Samples.Triangle));
        Assert.Throws<ArgumentException>(() => MeshFile.Read(_folder["a.fdo"]));
    }

    [Fact]
    public void Read_OfAMissingFile_SaysSo() => Assert.EndsWith(
        "gone.obj:1:1: error: file not found", Assert.Throws<SourceException>(() => MeshFile.Read(_folder["gone.obj"])).Message,
        StringComparison.Ordinal);
}
