using FractalEngine.Benchmarks.Colliders;
using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Tests.Benchmarks;

public class FractalCaseTests
{
    public static TheoryData<string> Names => [.. FractalCase.Names];

    [Theory]
    [InlineData("menger", true)]
    [InlineData("menger:3", true)]
    [InlineData("binary-tree:20", true)]
    [InlineData("menger:", false)]
    [InlineData("menger:0", false)]
    [InlineData("menger:-3", false)]
    [InlineData("menger:3:3", false)]
    [InlineData("menger:three", false)]
    [InlineData("MENGER", false)]
    [InlineData("menger.fdo", false)]
    [InlineData("../fractals/menger", false)]
    [InlineData("", false)]
    [InlineData(":3", false)]
    public void IsKnown_OfAText_TellsWhetherThereIsSuchAFractal(string text, bool isCase)
    {
        Assert.Equal(isCase, FractalCase.IsKnown(text));
        Assert.Equal(isCase, BenchmarkShape.IsKnown(text));
    }

    [Fact]
    public void Parse_WithADepth_OverridesTheFile()
    {
        var (name, fractal) = FractalCase.Parse("menger:2");
        Assert.Equal("menger 2", name);
        // A cube's twelve faces, twenty maps a level.
        Assert.Equal(12 * 400, fractal.FaceCount);
        Assert.Equal("menger", FractalCase.Parse("menger").Name);
    }

    [Theory]
    [MemberData(nameof(Names))]
    public void Load_OfEveryName_GivesAFractalWithFaces(string name) =>
        Assert.InRange(FractalCase.Load(name).Fractal.BaseMesh.FaceCount, 1, 10_000);

    [Theory]
    [InlineData("menger:1", 240)]
    [InlineData("sierpinski:2", 490)]
    [InlineData("tree-stump:3000", 3000)]
    public void Create_OfAShape_HasItsFaces(string name, int faces)
    {
        var shape = BenchmarkShape.Create(name);
        Assert.Equal((name.Split(':')[0], faces), (shape.Name, shape.Faces!.FaceCount));
    }

    [Theory]
    [InlineData("infinite-menger")]
    [InlineData("googol")]
    [InlineData("menger:5")]
    public void Create_OfAFractalOfTooManyFaces_HasCollidersOfFractalsOnly(string name)
    {
        var shape = BenchmarkShape.Create(name);
        Assert.Null(shape.Faces);
        Assert.Equal(["exact", "fractal"], ColliderVariant.CreateAll(shape).Select(row => row.ColliderName).Distinct());
    }
}
