using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
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

    private static AffineMap[] Expand(FractalDescription description) =>
        [.. new Fractal(description.HasDepth ? description.WithDepth(2) : description, Samples.Tetrahedron).Expand(100_000)];
}
