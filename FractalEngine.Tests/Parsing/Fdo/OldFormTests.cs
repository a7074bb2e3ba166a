using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Fdo;

/// <summary>Fractals of the assets that say with names and powers what their old forms said with numbered vectors.</summary>
public class OldFormTests
{
    [Theory]
    [InlineData("romanesco", 32 * 32)]
    [InlineData("terrain", 16)]
    [InlineData("snowflake", 6 * 43)]
    [InlineData("fern", 48 * 48)]
    [InlineData("shell", 128)]
    public void Fractal_HasTheInstancesOfItsOldForm(string name, int count)
    {
        var expected = Expand(OldForms.Read(name));
        var path = Repository.Full($"assets/fractals/{name}.fdo");
        var maps = Expand(FractalParser.Parse(SourceText.Read(path, path, 1 << 20)).Description);
        Assert.Equal(count, maps.Length);
        Assert.Equal(count, expected.Length);
        for (var i = 0; i < count; i++)
        {
            foreach (var point in (Vector[])[Vector.Zero, Vector.I, Vector.J, Vector.K])
            {
                Assert.Equal(0, ((maps[i] * point) - (expected[i] * point)).Length(), 1e-13);
            }
        }
    }

    [Theory]
    [InlineData("tree")]
    [InlineData("tree-leaves")]
    [InlineData("forest")]
    [InlineData("forest-leaves")]
    public void Fractal_IsThatOfItsOldForm(string name) => Assert.Equal(
        OldForms.Read(name), FractalFile.Read(Repository.Full($"assets/fractals/{name}.fdo"), Outside).Description);

    [Fact]
    public void LeafyTree_IsTheTreeAndItsLeaves()
    {
        var read = (string name) => FractalFile.Read(Repository.Full($"assets/{name}.fdo"), Outside);
        var both = read("examples/tree-08");
        var separate = (Fractal[])[read("fractals/tree"), read("fractals/tree-leaves")];
        Assert.Equal(separate.Select(static part => DistinctInstances.Count(part)), both.ByMesh.Select(static part => part.InstanceCount));
        foreach (var (part, alone) in both.ByMesh.Zip(separate))
        {
            Assert.Equal(alone.BaseMesh, part.BaseMesh);
            Assert.Equal(0, (alone.Bounds.Minimum - part.Bounds.Minimum).Length(), 1e-12);
            Assert.Equal(0, (alone.Bounds.Maximum - part.Bounds.Maximum).Length(), 1e-12);
        }

        var (joint, colliders) = (Collider.For(both), separate.Select(static part => Collider.For(part)).ToArray());
        Seeded.Run(200, random =>
        {
            var position = (3 * random.Vector()) + Vector.J;
            Assert.Equal(
                colliders.Min(collider => collider.FindClosest(position).Distance), joint.FindClosest(position).Distance, 1e-12);
        });
    }

    private static LoadOptions Outside => new() { AllowOutsideFiles = true };

    private static AffineMap[] Expand(FractalDescription description) =>
        [.. new Fractal(description.HasDepth ? description.WithDepth(2) : description, Samples.Tetrahedron).Expand(100_000)];
}
