using System.Globalization;
using FractalEngine.Core.Generation;
using FractalEngine.Parsing.Wavefront.Writing;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Bvh;

/// <summary>The hierarchy on processors that lack the instructions for which it was written.</summary>
public sealed class TriangleBvhWithoutAvxTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    /// <inheritdoc/>
    public void Dispose() => _folder.Dispose();

    /// <summary>Distances, points and counts of face tests are those of a processor with all instructions.</summary>
    [Fact]
    public void Query_WithoutInstructions_PrintsTheSameBits() => CheckWithout("DOTNET_EnableHWIntrinsic");

    /// <summary>The same where only the widest ones are missing.</summary>
    [Fact]
    [Trait("Category", "Soak")]
    public void Query_WithoutAvx2_PrintsTheSameBits() => CheckWithout("DOTNET_EnableAVX2");

    private void CheckWithout(string variable)
    {
        var mesh = MeshGenerators.Create("tree-stump", 1, 3000);
        using (var file = File.Create(_folder["mesh.obj"]))
        {
            ObjMeshWriter.Write(mesh, file);
        }

        var random = new Random(1);
        File.WriteAllLines(_folder["points.txt"], Enumerable.Range(0, 1000).Select(_ => CollisionMeshes.RandomPosition(random, mesh))
            .Select(p => string.Create(CultureInfo.InvariantCulture, $"{p.X:R} {p.Y:R} {p.Z:R}")));
        string[] arguments = ["query", "mesh.obj", "--points", "points.txt", "--collider", "hierarchy"];
        var expected = AppProcess.Run(_folder.Path, arguments);
        var actual = AppProcess.Run(_folder.Path, new() { [variable] = "0" }, arguments);
        Assert.Equal((0, 0), (expected.ExitCode, actual.ExitCode));
        Assert.Equal(expected.Output, actual.Output);
        Assert.Equal(1000, actual.Output.AsSpan().Count('\n'));
    }
}
