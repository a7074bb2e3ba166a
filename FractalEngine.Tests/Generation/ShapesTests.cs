using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Generation;

public class ShapesTests
{
    public static TheoryData<string, int, int, double> Solids { get; } = new()
    {
        // Volumes: 1, 8/(9·√3), 4/3.
        { nameof(Shapes.Cube), 8, 12, 1 },
        { nameof(Shapes.Tetrahedron), 4, 4, 8 / (9 * Math.Sqrt(3)) },
        { nameof(Shapes.Octahedron), 6, 8, 4.0 / 3 },
    };

    [Theory]
    [MemberData(nameof(Solids))]
    public void Solid_HasItsVolumeAndClosesAroundIt(string name, int vertices, int faces, double volume)
    {
        var mesh = name switch
        {
            nameof(Shapes.Cube) => Shapes.Cube(),
            nameof(Shapes.Tetrahedron) => Shapes.Tetrahedron(),
            _ => Shapes.Octahedron(),
        };
        Assert.Equal((vertices, faces), (mesh.VertexCount, mesh.FaceCount));
        var signedVolume = 0.0;
        var area = Vector.Zero;
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            signedVolume += Vector.Dot(a, Vector.Cross(b, c)) / 6;
            area += Vector.Cross(b - a, c - a);
            // Each face looks away from the middle.
            Assert.True(Vector.Dot(a, Vector.Cross(b - a, c - a)) * signedVolume > 0);
        }

        Assert.Equal(volume, Math.Abs(signedVolume), 1e-14);
        Near.Equal(Vector.Zero, area, 1e-14);
    }
}
