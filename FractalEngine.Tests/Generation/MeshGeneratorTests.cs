using System.Collections.Concurrent;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Wavefront;
using FractalEngine.Parsing.Wavefront.Writing;

namespace FractalEngine.Tests.Generation;

public sealed class MeshGeneratorTests
{
    // Those by default have up to 280,000 faces, and several tests look at each.
    private static readonly ConcurrentDictionary<string, Mesh> DefaultMeshes = new();

    public static TheoryData<string> Names => [.. MeshGenerators.All.Select(generator => generator.Name)];

    [Theory]
    [InlineData("spaceship-interior", 277_654)]
    [InlineData("tree-stump", 237_664)]
    public void PaperModel_ByDefault_HasExactlyThePapersFaces(string name, int faces) =>
        Assert.Equal(faces, CreateDefault(name).FaceCount);

    [Theory]
    [InlineData("spaceship-interior", 277_654)]
    [InlineData("tree-stump", 237_664)]
    [Trait("Category", "Soak")]
    public void PaperModel_OfManySeeds_HasExactlyThePapersFaces(string name, int faces)
    {
        for (var seed = 1UL; seed <= 20; seed++)
        {
            Assert.Equal(faces, MeshGenerators.Create(name, seed).FaceCount);
        }
    }

    [Theory]
    [MemberData(nameof(Names))]
    public void Create_ByDefault_HasTheStatedNumberOfFaces(string name) =>
        Assert.Equal(MeshGenerators.Find(name)!.DefaultFaceCount, CreateDefault(name).FaceCount);

    [Theory]
    [InlineData("spaceship-interior", 20_000)]
    [InlineData("spaceship-interior", 60_001)]
    [InlineData("tree-stump", 300)]
    [InlineData("tree-stump", 5_001)]
    [InlineData("terrain", 2)]
    [InlineData("terrain", 3)]
    [InlineData("terrain", 10_007)]
    [InlineData("torus-knot", 200)]
    [InlineData("torus-knot", 5_002)]
    [InlineData("icosphere", 320)]
    public void Create_OfANumberOfFaces_HasExactlyThat(string name, int faces) =>
        Assert.Equal(faces, MeshGenerators.Create(name, 3, faces).FaceCount);

    [Theory]
    [InlineData("spaceship-interior", 500_000)]
    [InlineData("tree-stump", 400_000)]
    [Trait("Category", "Soak")]
    public void Create_OfManyFaces_HasExactlyThat(string name, int faces) =>
        Assert.Equal(faces, MeshGenerators.Create(name, 3, faces).FaceCount);

    [Theory]
    [InlineData("torus-knot", 5_001, 5_000)]
    [InlineData("icosphere", 700, 320)]
    [InlineData("icosphere", 900, 1280)]
    [InlineData("tree-stump", 1, 300)]
    [InlineData("icosphere", 1, 20)]
    public void Create_OfANumberThatTheShapeDoesNotAllow_TakesTheClosest(string name, int requested, int expected) =>
        Assert.Equal(expected, MeshGenerators.Create(name, 3, requested).FaceCount);

    [Theory]
    [InlineData(0)]
    [InlineData(-1)]
    [InlineData(MeshGenerators.MaxFaceCount + 1)]
    public void Create_OfANumberOutOfRange_Throws(int faces) =>
        Assert.Throws<ArgumentOutOfRangeException>(() => MeshGenerators.Create("terrain", 0, faces));

    [Fact]
    public void Create_OfAnUnknownName_Throws() => Assert.Throws<ArgumentException>(() => MeshGenerators.Create("teapot"));

    [Theory]
    [MemberData(nameof(Names))]
    public void Create_WithTheSameSeed_GivesTheSameBits(string name)
    {
        var first = MeshGenerators.Create(name, 5, 12_000);
        var second = MeshGenerators.Create(name, 5, 12_000);
        Assert.True(Bits(first).AsSpan().SequenceEqual(Bits(second)));
        Assert.True(first.VertexIndices.AsSpan().SequenceEqual(second.VertexIndices.AsSpan()));
        Assert.True(first.NormalIndices.AsSpan().SequenceEqual(second.NormalIndices.AsSpan()));
    }

    [Theory]
    [MemberData(nameof(Names))]
    public void HasRandomDetails_IsWhetherAnotherSeedGivesAnotherMesh(string name) => Assert.Equal(
        MeshGenerators.Find(name)!.HasRandomDetails,
        !Bits(MeshGenerators.Create(name, 1, 12_000)).SequenceEqual(Bits(MeshGenerators.Create(name, 2, 12_000))));

    [Theory]
    [MemberData(nameof(Names))]
    public void Create_UsesEveryVertexAndOnlyFiniteOnes(string name)
    {
        var mesh = CreateDefault(name);
        var used = new bool[mesh.VertexCount];
        foreach (var vertex in mesh.VertexIndices)
        {
            used[vertex] = true;
        }

        Assert.DoesNotContain(false, used);
        Assert.True(mesh.Positions.All(double.IsFinite) && mesh.Normals.All(double.IsFinite)
            && mesh.TextureCoordinates.All(double.IsFinite));
    }

    [Theory]
    [MemberData(nameof(Names))]
    public void Create_HasNoFaceWithoutArea(string name)
    {
        var mesh = CreateDefault(name);
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            // Meshes are a few units large, and their smallest details a tenth of a millimetre, 1e-8 in area.
            if (!(Vector.Cross(b - a, c - a).Length() > 1e-11))
            {
                Assert.Fail($"face {face} of {name}: {a} {b} {c}");
            }
        }
    }

    [Theory]
    [InlineData("icosphere")]
    [InlineData("torus-knot")]
    public void ClosedShape_HasEveryEdgeTwice_OnceInEachDirection(string name)
    {
        var mesh = CreateDefault(name);
        var edges = Edges(mesh).ToHashSet();
        Assert.Equal(3 * mesh.FaceCount, edges.Count);
        Assert.All(edges, edge => Assert.Contains((edge.To, edge.From), edges));
        Assert.True(Volume(mesh) > 0, "inside out");
    }

    [Fact]
    public void TreeStump_IsOpenBelowOnly()
    {
        var mesh = MeshGenerators.Create("tree-stump", 4, 20_000);
        var edges = Edges(mesh).ToHashSet();
        Assert.All(edges.Where(edge => !edges.Contains((edge.To, edge.From))), edge => Assert.True(mesh.Vertex(edge.From).Y < 0.05));
    }

    [Fact]
    public void SpaceshipInterior_FacesTheCorridor()
    {
        // From the centre of the section nearly all of the area shows its front; only the far sides of raised fittings do not.
        var mesh = MeshGenerators.Create("spaceship-interior", 0, 40_000);
        var front = 0.0;
        var all = 0.0;
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            var normal = Vector.Cross(b - a, c - a);
            all += normal.Length();
            front += Vector.Dot(normal, new Vector(0, 1.4, a.Z) - a) > 0 ? normal.Length() : 0;
        }

        Assert.True(front > 0.75 * all, $"{front / all:P0} of the area faces the corridor");
    }

    [Theory]
    [MemberData(nameof(Names))]
    public void Write_ThenParse_GivesTheSameMesh(string name)
    {
        var mesh = MeshGenerators.Create(name, 9, 9_000);
        using var stream = new MemoryStream();
        ObjMeshWriter.Write(mesh, stream, name);
        var text = System.Text.Encoding.UTF8.GetString(stream.ToArray());
        Assert.StartsWith($"# Mesh count: {mesh.FaceCount}\n", text, StringComparison.Ordinal);
        var read = ObjParser.Parse(new SourceText(name, text)).Mesh;
        Assert.Equal(Bits(mesh), Bits(read));
        Assert.True(mesh.VertexIndices.AsSpan().SequenceEqual(read.VertexIndices.AsSpan()));
        Assert.True(mesh.TextureIndices.AsSpan().SequenceEqual(read.TextureIndices.AsSpan()));
        Assert.True(mesh.NormalIndices.AsSpan().SequenceEqual(read.NormalIndices.AsSpan()));
        Assert.Equal(
            mesh.Groups.Select(group => group.GroupName),
            read.Groups.Select(group => group.GroupName).Where(groupName => groupName.Length > 0));
    }

    private static Mesh CreateDefault(string name) => DefaultMeshes.GetOrAdd(name, static name => MeshGenerators.Create(name));

    private static long[] Bits(Mesh mesh) => [.. mesh.Positions.Select(BitConverter.DoubleToInt64Bits)];

    private static double Volume(Mesh mesh) => Enumerable.Range(0, mesh.FaceCount).Select(mesh.Face)
        .Sum(face => Vector.Dot(face.A, Vector.Cross(face.B, face.C)) / 6);

    private static IEnumerable<(int From, int To)> Edges(Mesh mesh)
    {
        for (var corner = 0; corner < mesh.VertexIndices.Length; corner++)
        {
            yield return (mesh.VertexIndices[corner], mesh.VertexIndices[corner % 3 == 2 ? corner - 2 : corner + 1]);
        }
    }
}
