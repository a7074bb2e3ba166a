using System.Globalization;
using System.Text;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Render.Images;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>
/// A scene of 400 objects of four files, written into a folder of its own: crates of wood, balls whose poles are fans of faces without
/// area, pillars, and behind the camera knots of many faces. About half of the objects lie outside the picture.
/// </summary>
internal sealed class CrowdScene : IDisposable
{
    private const int Side = 20;
    private const double Spacing = 1.6;
    private const int Rings = 24;
    private const int Pixels = 512;
    private const int KnotFaces = 40_000;

    private readonly DirectoryInfo _folder = Directory.CreateTempSubdirectory("crowd");

    /// <summary>Writes the files.</summary>
    public CrowdScene()
    {
        ImageFile.SavePng(new(Pixels, Pixels, Wood()), In("wood.png"));
        File.WriteAllText(In("wood.mtl"), "newmtl wood\nKd 1 1 1\nmap_Kd wood.png\n");
        File.WriteAllText(In("crate.obj"), Box(1));
        File.WriteAllText(In("pillar.obj"), Box(3));
        Write(Ball(), "ball");
        Write(MeshGenerators.Create("torus-knot", 0, KnotFaces), "knot");
        File.WriteAllText(Path, Text());
    }

    /// <summary>Of the scene.</summary>
    public string Path => In("crowd.sdo");

    /// <inheritdoc/>
    public void Dispose() => _folder.Delete(recursive: true);

    private string In(string file) => System.IO.Path.Combine(_folder.FullName, file);

    private void Write(Mesh mesh, string name)
    {
        using var stream = File.Create(In(name + ".obj"));
        ObjMeshWriter.Write(mesh, stream, name);
    }

    private static string Text()
    {
        var text = new StringBuilder("c (0.8, 2.2, -1.6) (-0.2, 0, 0) 60\n");
        for (var i = 0; i < Side * Side; i++)
        {
            var (x, z) = (Spacing * ((i % Side) - (Side / 2)), Spacing * ((i / Side) - (Side / 2)));
            var file = z < -3 * Spacing && i % 5 == 0 ? "knot" : (i % 3) switch { 0 => "crate", 1 => "ball", _ => "pillar" };
            text.AppendLine(CultureInfo.InvariantCulture, $"o \"{file}.obj\" (({x:R}, 0, {z:R}), (0, {i * 37 % 90}, 0), #)");
        }

        return text.ToString();
    }

    private static string Box(double height)
    {
        var text = new StringBuilder("mtllib wood.mtl\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n");
        for (var i = 0; i < 8; i++)
        {
            text.AppendLine(CultureInfo.InvariantCulture, $"v {(i & 1) - 0.5} {height * (i >> 1 & 1)} {(i >> 2) - 0.5}");
        }

        text.AppendLine("usemtl wood");
        foreach (var (a, b, c, d) in ((int, int, int, int)[])[(1, 3, 4, 2), (6, 8, 7, 5), (5, 7, 3, 1), (2, 4, 8, 6), (3, 7, 8, 4),
            (5, 1, 2, 6)])
        {
            text.AppendLine(CultureInfo.InvariantCulture, $"f {a}/1 {b}/4 {c}/3\nf {a}/1 {c}/3 {d}/2");
        }

        return text.ToString();
    }

    /// <summary>Rings of squares, of which those at the poles have two corners in one place.</summary>
    private static Mesh Ball()
    {
        var (positions, faces) = (new List<double>(), new List<int>());
        for (var i = 0; i <= Rings; i++)
        {
            for (var j = 0; j < 2 * Rings; j++)
            {
                var (sine, cosine) = double.SinCosPi((double)i / Rings);
                var (acrossSine, acrossCosine) = double.SinCosPi((double)j / Rings);
                positions.AddRange([0.6 * sine * acrossCosine, 0.6 * (1 + cosine), 0.6 * sine * acrossSine]);
                if (i < Rings)
                {
                    var (a, b) = ((i * 2 * Rings) + j, (i * 2 * Rings) + ((j + 1) % (2 * Rings)));
                    faces.AddRange([a, b, a + (2 * Rings), b, b + (2 * Rings), a + (2 * Rings)]);
                }
            }
        }

        return new([.. positions], [.. faces]);
    }

    private static byte[] Wood()
    {
        var pixels = new byte[4 * Pixels * Pixels];
        for (var i = 0; i < Pixels * Pixels; i++)
        {
            var (x, y) = (i % Pixels, i / Pixels);
            var grain = 0.75 + (0.25 * Math.Sin((0.09 * x) + (3 * Math.Sin(0.013 * y))));
            (pixels[4 * i], pixels[(4 * i) + 1], pixels[(4 * i) + 2], pixels[(4 * i) + 3]) =
                ((byte)(200 * grain), (byte)(140 * grain), (byte)(80 * grain), 255);
        }

        return pixels;
    }
}
