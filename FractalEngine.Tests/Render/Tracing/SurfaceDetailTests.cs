using System.Collections.Immutable;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Tracing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render.Tracing;

public class SurfaceDetailTests
{
    /// <summary>The oracle is the cross product of the raised plane's own tangents, at any angle or mirrored.</summary>
    [Fact]
    public void BendBySlopes_OfSkewedTangents_IsTheNormalOfTheRaisedPlane() => Seeded.Run(200, random =>
    {
        var normal = RandomVector(random).UnitVector();
        var (alongU, alongV) = (Vector.Cross(normal, RandomVector(random)), Vector.Cross(normal, RandomVector(random)));
        if (Vector.Cross(alongU, alongV).Length() < 0.05)
        {
            return;
        }

        var (slopeU, slopeV) = (random.NextDouble() - 0.5, random.NextDouble() - 0.5);
        var expected = Vector.Cross(alongU + (slopeU * normal), alongV + (slopeV * normal)).UnitVector();
        expected *= Math.Sign(Vector.Dot(expected, normal));
        Near.Equal(expected, SurfaceDetail.BendBySlopes(normal, alongU, alongV, slopeU, slopeV).UnitVector(), 1e-12);
    });

    /// <summary>Heights that rise evenly along u and along v, in images of any shape.</summary>
    [Theory]
    [InlineData(64, 64)]
    [InlineData(64, 16)]
    [InlineData(8, 128)]
    public void Apply_OfHeights_BendsByTheSlopeWhateverTheImageHasOfPixels(int width, int height)
    {
        // By 8 of 255 a unit to the right, and by 4 a unit upwards; rows are stored from the top.
        using var textures = new TexturedScenes();
        var heights = textures.CreateTexture("heights.png", width, height, (x, y) =>
        {
            var grey = (byte)Math.Round((160.0 * x / width) + (80.0 * (height - 1 - y) / height));
            return (grey, grey, grey, 255);
        });
        var model = TexturedScenes.CreateSquare(1, new("m") { BumpTexture = heights with { BumpFactor = 0.25 } });
        var notices = ImmutableArray.CreateBuilder<string>();
        var traced = new TracedModel(model, 45, new(notices, shareTextures: true, []));
        var corners = (new Vector(0, 0, 0), new Vector(1, 0, 0), new Vector(0, 1, 0));
        var sum = Vector.Zero;
        // Bytes round, which evens out over many places.
        for (var i = 0; i < 900; i++)
        {
            var (u, v) = (0.2 + (0.02 * (i % 30)), 0.2 + (0.02 * (i / 30)));
            sum += SurfaceDetail.Apply(traced.MaterialOf(0), Vector.K, Matrix.Identity, corners, corners, u, v, -Vector.K);
        }

        var expected = new Vector(-0.25 * 160 / 255, -0.25 * 80 / 255, 1).UnitVector();
        Near.Equal(expected, sum.UnitVector(), 0.02);
    }

    /// <summary>A texture that is moved to the side only has its rows where they are.</summary>
    [Theory]
    [InlineData(0.5, 0, 3, 6)]
    [InlineData(0, 0.5, 1, 2)]
    [InlineData(0.5, 0.5, 3, 2)]
    public void Sample_OfATextureThatIsMoved_ReadsItsPlace(double offsetU, double offsetV, int column, int row)
    {
        var pixels = new byte[4 * 4 * 8];
        for (var i = 0; i < 32; i++)
        {
            (pixels[4 * i], pixels[(4 * i) + 1], pixels[(4 * i) + 3]) = ((byte)(60 * (i % 4)), (byte)(30 * (i / 4)), 255);
        }

        var texture = new TracedTexture(new(4, 8, pixels), new("a.png") { Offset = (offsetU, offsetV) });
        // The centre of the pixel in column 1 and row 6 from the top, without an offset.
        var values = texture.SampleValues(0.375, 0.1875);
        Near.Equal(new Vector(60 * column, 30 * row, 0) / 255, values, 1e-6);
    }

    private static Vector RandomVector(Random random) =>
        new(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5);
}
