using System.Text;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Wavefront.Writing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Wavefront.Writing;

public class ObjSceneWriterTests
{
    private static LoadedScene Scene(params (Model Model, Transformation Placement)[] placed)
    {
        var objects = placed.Select(p => (Declared: new SceneObject(p.Model.SourcePath!, p.Placement), p.Model)).ToArray();
        return new(new() { Objects = [.. objects.Select(o => o.Declared)] },
            [.. objects.Select(o => new PlacedModel(o.Declared, o.Model))]);
    }

    private static string Write(LoadedScene scene, long limit = 1_000_000)
    {
        using var stream = new MemoryStream();
        ObjSceneWriter.Write(scene, stream, limit);
        return Encoding.UTF8.GetString(stream.ToArray());
    }

    private static Mesh WriteAndParse(LoadedScene scene)
    {
        var file = Samples.ParseObj(Write(scene));
        Assert.Empty(file.Warnings);
        return file.Mesh;
    }

    private static FractalModel Model(Fractal fractal) => new(fractal) { SourcePath = "/a/fractal.fdo" };

    [Fact]
    public void Write_OfAMesh_KeepsEveryBitAndFace()
    {
        var mesh = new Mesh([0.1, 1.0 / 3, -0.0, 1e-300, 1e300, 5, 6, 7, 8], [0, 1, 2]);
        var written = WriteAndParse(Scene((new MeshModel(mesh) { SourcePath = "/a/m.obj" }, Transformation.Identity)));
        Assert.Equal(mesh.Positions.ToArray(), written.Positions.ToArray());
        Assert.Equal(mesh.VertexIndices.ToArray(), written.VertexIndices.ToArray());
    }

    [Theory]
    [InlineData(Composition.Affine)]
    [InlineData(Composition.Componentwise)]
    public void Write_OfAnyFractal_IsItsExpansion(Composition composition) => Seeded.Run(40, random =>
    {
        var (fractal, placement) = (RandomFractals.CreateAny(random, composition), random.Transformation());
        var written = WriteAndParse(Scene((Model(fractal), placement)));
        // Without repeated instances; the corners of a face keep their order but for mirrored ones, so faces are compared as sets of
        // corners.
        var expected = NaiveFractal.Distinct(NaiveFractal.Chains(fractal.Description), 1e-12)
            .Select(chain => NaiveFractal.Compose(NaiveFractal.MapOf(placement), chain))
            .SelectMany(map => fractal.BaseMesh.VertexIndices.Chunk(3)
            .Select(face => Key(face.Select(v => NaiveFractal.Apply(map, fractal.BaseMesh.Vertex(v))))));
        var actual = written.VertexIndices.Chunk(3).Select(face => Key(face.Select(written.Vertex)));
        AssertNear(expected, actual);
    });

    [Fact]
    public void Write_OfMirroredMaps_KeepsTrianglesOutward() => Seeded.Run(100, random =>
    {
        var fractal = Samples.Repeated(2, random.Transformation(), random.Transformation());
        var written = WriteAndParse(Scene((Model(fractal), random.Transformation())));
        for (var instance = 0; instance < written.FaceCount; instance += Samples.Tetrahedron.FaceCount)
        {
            // The signed volume under outward faces is positive, for each instance by itself.
            var volume = Enumerable.Range(instance, Samples.Tetrahedron.FaceCount)
                .Sum(face => written.Face(face) switch { var (a, b, c) => Vector.Dot(a, Vector.Cross(b, c)) / 6 });
            Assert.True(volume > 0, $"instance {instance / 4} has volume {volume}");
        }
    });

    [Fact]
    public void Write_OfSeveralObjects_PutsThemBehindEachOtherInWorldSpace()
    {
        var model = new MeshModel(Samples.Triangle) { SourcePath = "/a/m.obj" };
        var written = WriteAndParse(Scene((model, Samples.Move(10, 0, 0)), (model, Samples.Move(0, 20, 0))));
        Assert.Equal([new(10, 0, 0), new(11, 0, 0), new(10, 1, 0), new(0, 20, 0), new(1, 20, 0), new(0, 21, 0)],
            NaiveFractal.Vertices(written));
        Assert.Equal([0, 1, 2, 3, 4, 5], written.VertexIndices.ToArray());
    }

    [Fact]
    public void Write_OfNormals_RotatesThemWithTheSurface() => Seeded.Run(100, random =>
    {
        // A normal that is that of its face stays so, under skew and mirrors too.
        var mesh = Samples.Triangle.WithNormals([0, 0, 1], [0, 0, 0]);
        var written = WriteAndParse(Scene((new MeshModel(mesh) { SourcePath = "/a/m.obj" }, random.Transformation())));
        var (a, b, c) = written.Face(0);
        var normal = new Vector(written.Normals[0], written.Normals[1], written.Normals[2]);
        Near.Equal(Vector.Cross(b - a, c - a).UnitVector(), normal.UnitVector(), 1e-13);
    });

    [Fact]
    public void Write_OfTextureCoordinates_KeepsThem()
    {
        var mesh = Samples.Triangle.WithTextureCoordinates([0, 0, 1, 0, 0, 1], [0, 1, 2]);
        var written =
            WriteAndParse(
                Scene((Model(new(Samples.Repeated(1, Samples.Move(1, 0, 0), Samples.Move(2, 0, 0)).Description, mesh)),
                Transformation.Identity)));
        Assert.Equal(
            [0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1],
            written.TextureIndices.SelectMany(
                number => new[] { written.TextureCoordinates[2 * number], written.TextureCoordinates[(2 * number) + 1] }));
    }

    [Fact]
    public void Write_OfColours_KeepsThem()
    {
        var mesh = Samples.Triangle.WithColours([1, 0, 0, 0, 0.25, 0, 0, 0, 1.0 / 3]);
        var written = WriteAndParse(Scene(
            (Model(new(Samples.Repeated(1, Samples.Move(1, 0, 0), Samples.Move(2, 0, 0)).Description, mesh)), Transformation.Identity),
            (Model(Samples.Repeated(0, Samples.Move(1, 0, 0))), Transformation.Identity)));
        // Vertices of a mesh without colours are white.
        Assert.Equal([.. mesh.Colours, .. mesh.Colours, .. Enumerable.Repeat(1.0, 12)], written.Colours.ToArray());
    }

    [Fact]
    public void Write_StartsWithTheMeshCount()
    {
        var fractal = Samples.Repeated(2, Samples.Move(1, 0, 0), Samples.Move(0, 7, 0));
        // Four chains, two of which give the same instance; four faces each.
        Assert.StartsWith("# Mesh count: 12\n", Write(Scene((Model(fractal), Transformation.Identity))), StringComparison.Ordinal);
    }

    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void Write_InAnyCulture_IsTheSameText(string culture)
    {
        var scene = Scene((Model(Samples.AppendixBAt(1)), Samples.Move(0.5, -0.25, 0)));
        Assert.Equal(Write(scene), InCulture.Run(culture, () => Write(scene)));
    }

    [Fact]
    public void Write_BeyondTheLimit_WritesNothing()
    {
        using var stream = new MemoryStream();
        var scene = Scene((Model(Samples.Repeated(100, Samples.Move(1, 0, 0), Samples.Move(2, 0, 0))), Transformation.Identity));
        // 2¹⁰⁰ chains, of which 101 are distinct.
        Assert.Throws<FractalLimitException>(() => ObjSceneWriter.Write(scene, stream, (101 * 4) - 1));
        Assert.Equal(0, stream.Length);
    }

    [Fact]
    public void Write_OfFewDistinctInstancesOfManyChains_WritesThem()
    {
        var scene = Scene((Model(Samples.Repeated(100, Samples.Move(1, 0, 0), Samples.Move(2, 0, 0))), Transformation.Identity));
        Assert.Equal(101 * 4, Samples.ParseObj(Write(scene, 101 * 4)).Mesh.FaceCount);
    }

    [Fact]
    public void Write_AtTheLimit_Succeeds() => Assert.Equal(32, Samples.ParseObj(Write(Scene((Model(Samples.Repeated(
        3, Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(9, 0, 0, 0.5))), Transformation.Identity)), 32)).Mesh.FaceCount);

    [Fact]
    public void Write_OfTheInfinite_IsRefused() => Assert.Throws<FractalLimitException>(
        () => Write(
            Scene((Model(Samples.Repeated(null, Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(1, 0, 0, 0.5))),
            Transformation.Identity))));

    // The corners of a face in an order that does not depend on the winding; crooked weights keep ties apart.
    private static double[] Key(IEnumerable<Vector> corners) =>
        [.. corners.OrderBy(v => v.X + (0.7123 * v.Y) + (0.3917 * v.Z)).SelectMany(v => new[] { v.X, v.Y, v.Z })];

    private static void AssertNear(IEnumerable<double[]> expected, IEnumerable<double[]> actual)
    {
        static double Order(double[] key) => key.Select((entry, i) => entry * Math.Sqrt(i + 2)).Sum();
        var (first, second) = (expected.OrderBy(Order).ToArray(), actual.OrderBy(Order).ToArray());
        Assert.Equal(first.Length, second.Length);
        for (var i = 0; i < first.Length; i++)
        {
            // Chains of up to eight maps with entries up to 10.
            Assert.True(first[i].Zip(second[i]).All(pair => Math.Abs(pair.First - pair.Second) < 1e-11), $"face {i} differs");
        }
    }

    [Fact]
    public void Write_BeyondTheLimit_NamesTheLimitThatWasGiven()
    {
        var scene = Scene((Model(Samples.Repeated(100, Samples.Move(1, 0, 0), Samples.Move(2, 0, 0))), Transformation.Identity));
        var error = Assert.Throws<FractalLimitException>(() => Write(scene, 345));
        Assert.Contains("345", error.Message, StringComparison.Ordinal);
    }
}
