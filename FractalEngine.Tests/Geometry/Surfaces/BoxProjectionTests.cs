using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry.Surfaces;

/// <summary>Images that are projected onto faces without texture coordinates.</summary>
public class BoxProjectionTests
{
    [Fact]
    public void Projection_OfAnyFace_IsThatOfTheSideItLooksAtMost() => Seeded.Run(500, random =>
    {
        var (a, b, c) = (random.Vector(1), random.Vector(1), random.Vector(1));
        var mesh = new Mesh([a.X, a.Y, a.Z, b.X, b.Y, b.Z, c.X, c.Y, c.Z], [0, 1, 2]).WithBoxProjection();
        var normal = Vector.Cross(b - a, c - a).UnitVector();
        var side = ((Vector[])[Vector.I, Vector.J, Vector.K, -Vector.I, -Vector.J, -Vector.K]).MaxBy(axis => Vector.Dot(axis, normal));
        // From outside, the image is upright, or has z upwards where one looks along y. In a left-handed frame, what is seen to the right
        // and upwards has the direction of the eye as its cross product.
        var up = side.Y != 0 ? Vector.K : Vector.J;
        var right = Vector.Cross(up, -side);
        Near.Equal(-side, Vector.Cross(right, up), 0);
        foreach (var (i, corner) in ((Vector[])[a, b, c]).Index())
        {
            var index = 2 * mesh.TextureIndices[i];
            Near.Equal(0.5 + Vector.Dot(right, corner), mesh.TextureCoordinates[index], 1e-15);
            Near.Equal(0.5 + Vector.Dot(up, corner), mesh.TextureCoordinates[index + 1], 1e-15);
        }
    });
}
