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
    private const int ObjectsPerSide = 20;
    private const double Spacing = 1.6;
    private const int SphereRings = 24;
    private const int TextureSize = 512;
    private const int KnotFaces = 40_000;

    private readonly DirectoryInfo _folder = Directory.CreateTempSubdirectory("crowd");

    /// <summary>Writes the files.</summary>
    public CrowdScene()
    {
        ImageFile.SavePng(new(TextureSize, TextureSize, WoodPixels()), PathOf("wood.png"));
        File.WriteAllText(PathOf("wood.mtl"), "newmtl wood\nKd 1 1 1\nmap_Kd wood.png\n");
        File.WriteAllText(PathOf("crate.obj"), BoxObj(1));
        File.WriteAllText(PathOf("pillar.obj"), BoxObj(3));
        WriteMesh(SphereMesh(), "ball");
        WriteMesh(MeshGenerators.Create("torus-knot", 0, KnotFaces), "knot");
        File.WriteAllText(Path, SceneText());
    }

    /// <summary>Of the scene.</summary>
    public string Path => PathOf("crowd.sdo");

    /// <inheritdoc/>
    public void Dispose() => _folder.Delete(recursive: true);

    private string PathOf(string file) => System.IO.Path.Combine(_folder.FullName, file);

    private void WriteMesh(Mesh mesh, string name)
    {
        using var stream = File.Create(PathOf(name + ".obj"));
        ObjWriter.Write(mesh, name, stream);
    }

    private static string SceneText()
    {
        var text = new StringBuilder("c (0.8, 2.2, -1.6) (-0.2, 0, 0) 60\n");
        for (var i = 0; i < ObjectsPerSide * ObjectsPerSide; i++)
        {
            var (x, z) = (Spacing * ((i % ObjectsPerSide) - (ObjectsPerSide / 2)), Spacing * ((i / ObjectsPerSide) - (ObjectsPerSide / 2)));
            var file = z < -3 * Spacing && i % 5 == 0 ? "knot" : (i % 3) switch { 0 => "crate", 1 => "ball", _ => "pillar" };
            text.AppendLine(CultureInfo.InvariantCulture, $"o \"{file}.obj\" (({x:R}, 0, {z:R}), (0, {i * 37 % 90}, 0), #)");
        }

        return text.ToString();
    }

    private static string BoxObj(double height)
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
    private static Mesh SphereMesh()
    {
        var (positions, faces) = (new List<double>(), new List<int>());
        for (var i = 0; i <= SphereRings; i++)
        {
            for (var j = 0; j < 2 * SphereRings; j++)
            {
                var (sine, cosine) = double.SinCosPi((double)i / SphereRings);
                var (acrossSine, acrossCosine) = double.SinCosPi((double)j / SphereRings);
                positions.AddRange([0.6 * sine * acrossCosine, 0.6 * (1 + cosine), 0.6 * sine * acrossSine]);
                if (i < SphereRings)
                {
                    var (a, b) = ((i * 2 * SphereRings) + j, (i * 2 * SphereRings) + ((j + 1) % (2 * SphereRings)));
                    faces.AddRange([a, b, a + (2 * SphereRings), b, b + (2 * SphereRings), a + (2 * SphereRings)]);
                }
            }
        }

        return new([.. positions], [.. faces]);
    }

    private static byte[] WoodPixels()
    {
        var pixels = new byte[4 * TextureSize * TextureSize];
        for (var i = 0; i < TextureSize * TextureSize; i++)
        {
            var (x, y) = (i % TextureSize, i / TextureSize);
            var grain = 0.75 + (0.25 * Math.Sin((0.09 * x) + (3 * Math.Sin(0.013 * y))));
            (pixels[4 * i], pixels[(4 * i) + 1], pixels[(4 * i) + 2], pixels[(4 * i) + 3]) =
                ((byte)(200 * grain), (byte)(140 * grain), (byte)(80 * grain), 255);
        }

        return pixels;
    }
}
